"""A user's own bearing type, as flexcage/README.md promises: linear springs between two rings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from flexcage.bearings import Family
from flexcage.cages.round_pocket.cage import BallCage
from flexcage.geometry.bearing import (
    Bearing,
    EquivalentLoad,
    Rules,
    Spec,
    type_name,
)
from flexcage.register import bearing_family, option, quantity
from flexcage.system.statics.elements import ElementLoads, Response


@dataclass(frozen=True, kw_only=True)
class SpringBearing(Bearing):
    """Radial springs that push and pull, all around."""

    kind: ClassVar[str] = "spring bearing"
    family: ClassVar[str] = "spring"
    cage_spec: ClassVar[Spec] = BallCage
    type: str = type_name("springs")
    count: int = option(doc="number of springs", minimum=3)
    stiffness: float = quantity("N/um", doc="stiffness of one", above=0.0)


RULES = Rules[SpringBearing](
    check=lambda bearing, cage, defects: None,  # any springs will do
    static_rating=lambda bearing: 1e6,
    dynamic_rating=lambda bearing: 1e6,
    equivalent_load=lambda bearing, radial, axial: EquivalentLoad(radial, 1.0, 0.0, 3.0),
)


@dataclass(frozen=True)
class Springs:
    """Half of each spring to either side of a massless element."""

    bearing: SpringBearing
    speed: float = 0.0
    contacts: object = None
    options: object = None
    carries = (False, True, True, False, False)
    scale = 1e-4
    conservative = True
    pressure_limit = np.inf

    @property
    def azimuth(self):
        return 2.0 * np.pi * np.arange(self.bearing.count) / self.bearing.count

    def guesses(self, v):
        return [np.zeros((len(v), 2))]

    def moved(self, w, step):
        return w + step

    def respond(self, v, w, share):
        half, Z = 2.0 * self.bearing.stiffness, len(v)
        inner, outer = half * (v[:, 1] - w[:, 0]), half * w[:, 0]
        zeros = np.zeros
        ring, rest = zeros((Z, 3)), zeros((Z, 2))
        ring[:, 1], rest[:, 0] = inner, outer - inner
        ring_v, ring_w, rest_w = zeros((Z, 3, 3)), zeros((Z, 3, 2)), zeros((Z, 2, 2))
        ring_v[:, 1, 1], ring_w[:, 1, 0], rest_w[:, 0, 0] = half, -half, 2.0 * half
        energy = 0.5 * (inner**2 + outer**2) / half
        return Response(energy, ring, rest, ring_v, ring_w, ring_w.transpose(0, 2, 1), rest_w)

    def loads(self, v, w):
        Z = len(v)
        force = np.abs(self.respond(v, w, 0.0).ring[:, 1])[:, None] * np.ones(2)
        none, both = np.zeros(Z), np.zeros((Z, 2))
        return ElementLoads(
            self.azimuth, force, both, both, both, both, both - np.inf, none, none, none, both
        )

    def check(self, loads):
        pass

    def reference_life(self, v, w):
        return np.inf


bearing_family(
    Family(
        name="spring",
        types=(SpringBearing,),
        rules=RULES,
        statics=lambda: Springs,
        motion=None,
        recording=None,
        variables=None,
        speed=None,
        figures=None,
        rubbing=None,
        shapes=None,
        inside=None,
    )
)
