"""Figures of a run's cage, and of what holds the inner ring."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from flexcage.core.units import typeset
from flexcage.geometry.cage import Cage
from flexcage.mesh.quality import MeshReport
from flexcage.modes.basis import ModeBasis
from flexcage.results.figures.figure import CONVERGENCE, FLEXIBLE, TEXT, Facts, Found, Table
from flexcage.results.row import Row
from flexcage.system.bodies import unbalance_of

# measured on pinched pockets of an N1013, in tests/verification/test_pinch.py
_FAR = (
    "of a push's deflection of its own pocket, what others would feel of it beyond the modes; "
    "changes an N1013's pinch forces by under 0.5 %"
)


@dataclass(frozen=True)
class Held(Facts):
    """What holds the inner ring, in words."""

    words_of_load: str


SUPPORT = Table[Held]("Support")


@SUPPORT.figure("Support of the inner ring", "", "what holds the ring", TEXT)
def inner_held(held: Held) -> str:
    return held.words_of_load


@dataclass(frozen=True, kw_only=True, eq=False)
class CageFacts(Facts):
    """A run's cage, its mesh and, of a flexible one, its modes, whose table stands in a file."""

    cage: Cage
    mesh: MeshReport
    basis: ModeBasis | None
    table: str
    pinched: Sequence[int] = ()  # pockets
    pinch_force: float = 0.0  # N

    def has(self, need: str) -> bool:
        return self.basis is not None

    @property
    def modes(self) -> ModeBasis:
        """The modes, for figures of them."""
        assert self.basis is not None
        return self.basis

    @cached_property
    def mass(self) -> tuple[float, np.ndarray, str]:
        """Mass [kg] and its centre [m], with what unbalances it, and a remark on that."""
        mass, centre = self.mesh.volume * self.cage.material.density, self.mesh.mass_centre
        if not self.cage.unbalance:
            return mass, centre, ""
        added, place = unbalance_of(self.cage)
        centre = (mass * centre + added * place) / (mass + added)
        note = f"{added * 1e3:.4g} g of them make the unbalance, at the cage's mean radius"
        return mass + added, centre, note


CAGE = Table[CageFacts]("Cage")


@CAGE.figure("Cage mass", "g", "with the mass that unbalances it", CONVERGENCE)
def cage_mass(facts: CageFacts) -> Found:
    mass, _, note = facts.mass
    return Found(mass, note)


@CAGE.figure("Cage mass centre, shift", "um", "from the axis of the sound cage")
def cage_centre_shift(facts: CageFacts) -> float:
    return float(np.linalg.norm(facts.mass[1]))


@CAGE.figure("Cage modulus, warm", "GPa", "of a case with a cage.temperature")
def cage_modulus(facts: CageFacts) -> Found | None:
    cage = facts.cage
    if cage.temperature is None:
        return None
    warm, material = cage.warm_material.youngs_modulus, cage.material
    note = (
        f"of {material.name} at {typeset(cage.temperature, 'degC')}, "
        f"{warm / material.youngs_modulus:.0%} of that at 23°C"
    )
    return Found(warm, note)


PINCH = Table[CageFacts](CAGE.section)


@PINCH.figure(
    "Pinch force at the start", "N",
    "of elements that a deformed pocket squeezes when assembled", CONVERGENCE,
)  # fmt: skip
def pinch_force(facts: CageFacts) -> Found | None:
    if not facts.pinched:
        return None
    return Found(facts.pinch_force, f"pockets {', '.join(map(str, facts.pinched))}")


MODES = Table[CageFacts](CAGE.section, needs=FLEXIBLE)


@MODES.figure("Cage modes", "", "number of modal coordinates")
def mode_count(facts: CageFacts) -> Found:
    return Found(facts.modes.size, f"table: {facts.table}")


@MODES.figure("Cage modes, first frequency", "Hz", "of the free cage", CONVERGENCE)
def first_frequency(facts: CageFacts) -> float:
    return facts.modes.frequencies[0]


@MODES.figure(
    "Pockets' local coupling cut", "%",
    "of a push's deflection of its own pocket, what others would feel of it beyond the modes",
)  # fmt: skip
def far_coupling(facts: CageFacts) -> Found | None:
    residual = facts.modes.residual
    return None if residual is None else Found(residual.far_coupling, _FAR)


def cage_rows(facts: CageFacts) -> tuple[Row, ...]:
    """The section of the cage."""
    return (*CAGE.rows(facts), *MODES.rows(facts), *PINCH.rows(facts))
