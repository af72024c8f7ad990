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
from flexcage.results.figures.figure import FLEXIBLE, FigureTable, Found
from flexcage.results.row import SummaryRow
from flexcage.system.bodies import unbalance_of

_CUT = "of a push's deflection of its own pocket, what others would feel of it beyond the modes"
# measured on pinched pockets of an N1013, in tests/verification/test_pinch.py
_FAR = f"{_CUT}; changes an N1013's pinch forces by under 0.5 %"


SUPPORT = FigureTable[str]("Support")
SUPPORT.add(
    "inner_held", "Support of the inner ring", "", "what holds the ring", "text",
    take=lambda held: held,
)  # fmt: skip


@dataclass(frozen=True, kw_only=True, eq=False)
class CageFacts:
    """A run's cage, its mesh and, of a flexible one, its modes, whose table stands in a file."""

    cage: Cage
    mesh: MeshReport
    basis: ModeBasis | None
    table: str
    count: int = 1  # so many such cages
    pinched: Sequence[int] = ()  # pockets
    pinch_force: float = 0.0  # N

    @property
    def modes(self) -> ModeBasis:
        """The modes, for figures of them."""
        assert self.basis is not None
        return self.basis

    @cached_property
    def mass(self) -> tuple[float, np.ndarray, str]:
        """Mass [kg] and its centre [m], with what unbalances it, and a remark on that."""
        mass, centre = self.mesh.volume * self.cage.material.density, self.mesh.mass_centre
        each = "" if self.count == 1 else f"of each of {self.count}"
        if not self.cage.unbalance:
            return mass, centre, each
        added, place = unbalance_of(self.cage)
        centre = (mass * centre + added * place) / (mass + added)
        note = f"{added * 1e3:.4g} g of them make the unbalance, at the cage's mean radius"
        return mass + added, centre, "; ".join(filter(None, (note, each)))


def _warm(facts: CageFacts) -> Found | None:
    """The modulus of a cage whose temperature the case gives."""
    cage = facts.cage
    if cage.temperature is None:
        return None
    warm, material = cage.warm_material.youngs_modulus, cage.material
    note = (
        f"of {material.name} at {typeset(cage.temperature, 'degC')}, "
        f"{warm / material.youngs_modulus:.0%} of that at 23°C"
    )
    return Found(warm, note)


def _pinch(facts: CageFacts) -> Found | None:
    pockets = f"pockets {', '.join(map(str, facts.pinched))}"
    return Found(facts.pinch_force, pockets) if facts.pinched else None


def _far(facts: CageFacts) -> Found | None:
    residual = facts.modes.residual
    return None if residual is None else Found(residual.far_coupling, _FAR)


# fmt: off
CAGE = FigureTable[CageFacts]("Cage")
CAGE.add("cage_mass", "Cage mass", "g", "with the mass that unbalances it", "convergence",
         take=lambda facts: Found(facts.mass[0], facts.mass[2]))
CAGE.add("cage_centre_shift", "Cage mass centre, shift", "um", "from the axis of the sound cage",
         take=lambda facts: float(np.linalg.norm(facts.mass[1])))
CAGE.add("cage_modulus", "Cage modulus, warm", "GPa", "of a case with a cage.temperature",
         take=_warm)
PINCH = FigureTable[CageFacts](CAGE.section)
PINCH.add("pinch_force", "Pinch force at the start", "N",
          "of elements that a deformed pocket squeezes when assembled", "convergence", take=_pinch)
MODES = FigureTable[CageFacts](CAGE.section, "flexible cage")
MODES.add("mode_count", "Cage modes", "", "number of modal coordinates",
          take=lambda facts: Found(facts.modes.size, f"table: {facts.table}"))
MODES.add("first_frequency", "Cage modes, first frequency", "Hz", "of the free cage",
          "convergence", take=lambda facts: facts.modes.frequencies[0])
MODES.add("far_coupling", "Pockets' local coupling cut", "%", _CUT, take=_far)
# fmt: on


def cage_rows(facts: CageFacts) -> tuple[SummaryRow, ...]:
    """The section of the cage."""
    modes = MODES.rows(facts, FLEXIBLE if facts.basis is None else "")
    return (*CAGE.rows(facts), *modes, *PINCH.rows(facts))
