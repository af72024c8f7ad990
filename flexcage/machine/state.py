"""What the static solution of a machine holds: its shaft, its bearings, and what may be asked of
both."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.units import mm
from flexcage.machine.linear import Linearised, of_shaft
from flexcage.machine.shaft import SectionForces, ShaftModel
from flexcage.machine.spec import Gravity, Whirl
from flexcage.system.statics.solution import StaticSolution

if TYPE_CHECKING:
    from flexcage.machine.housing import HousingSeats

_NOTHING = 1e-13  # of the largest stiffness: a spring that holds what else nothing does
_ROUNDING = 1e-6  # of a load's largest component [N, N m]


@dataclass(frozen=True, eq=False)
class BearingResult:
    """One bearing of the machine. ``force`` (5,) is what the bearing exerts on the shaft,
    ``displacement`` (5,) the shaft's there and ``stiffness`` (5, 5) that of bearing and seat, in
    the machine's axes; ``solution`` is the bearing's own, in its own axes (x as it faces).
    ``offset`` [m] is by how far its inner ring was pressed in before loads came."""

    name: str
    position: float
    facing: str
    offset: float
    force: np.ndarray
    displacement: np.ndarray
    stiffness: np.ndarray
    damping: float
    solution: StaticSolution

    @property
    def radial(self) -> float:
        """Radial force [N]."""
        return float(np.hypot(*self.force[1:3]))


@dataclass(frozen=True, eq=False)
class MachineState:
    """Equilibrium of a machine, in SI units, radians and the machine's axes.

    ``displacement`` (n, 5) are x, y, z and the turns about y and z of the shaft at ``position``
    (n,), and ``coordinates`` (c,) all of its own; ``sections`` what its sections bear, ``load``
    (c,) what loads it beside the bearings.
    ``tangent`` are the exact slopes over the shaft's own motions, bearings and seats included,
    ``housing`` the seats of several rings in one body, if there is one.
    """

    name: str
    speed: float
    shaft: ShaftModel
    displacement: np.ndarray
    coordinates: np.ndarray
    sections: SectionForces
    bearings: tuple[BearingResult, ...]
    load: np.ndarray
    tangent: np.ndarray
    warnings: tuple[str, ...]
    unbalanced: float
    whirl: Whirl = Whirl()
    gravity: Gravity = Gravity()
    housing: HousingSeats | None = None

    @property
    def position(self) -> np.ndarray:
        """Places (n,) [m] of the shaft."""
        return self.shaft.places

    def __getitem__(self, name: str) -> BearingResult:
        """The bearing of this name."""
        found = {b.name: b for b in self.bearings}
        if name not in found:
            raise InputError(
                f"The machine has no bearing '{name}'; they are {', '.join(found)}.",
                where="bearings", value=name,
            )  # fmt: skip
        return found[name]

    @cached_property
    def compliance(self) -> np.ndarray:
        """(5 n, 5 n) displacements of all places under unit forces there."""
        T, own = self.shaft.motions, np.abs(np.diag(self.tangent))
        nodes = 1 if self.shaft.rigid else len(self.position)
        size = own[: 5 * nodes].reshape(-1, 5)
        moves, turns = _NOTHING * size[:, :3].max(), _NOTHING * size[:, 3:].max()
        held = np.zeros(len(own))  # what nothing holds
        held[: 5 * nodes] = np.tile([moves, moves, moves, turns, turns], nodes)
        found: np.ndarray = T @ np.linalg.inv(self.tangent + np.diag(held)) @ T.T
        return found

    def deflection(self, position: float) -> np.ndarray:
        """Displacement (5,) of the shaft at a place [m]."""
        found: np.ndarray = self._at(position) @ self.displacement.ravel()
        return found

    def stiffness_at(self, position: float) -> np.ndarray:
        """Stiffness (5, 5) of the machine at a place [m] of the shaft: forces and moments there
        over the displacement there, as of a spindle's nose."""
        return np.linalg.inv(self.compliance_at(position))

    def compliance_at(self, position: float) -> np.ndarray:
        """The inverse (5, 5) of that: displacements there under unit forces and moments there."""
        at = self._at(position)
        found: np.ndarray = at @ self.compliance @ at.T + self.shaft.own_compliance(position)
        return found

    def _at(self, position: float) -> np.ndarray:
        left, right = self.shaft.reach
        if not left <= position <= right * (1.0 + 1e-12):
            raise InputError(
                f"position is {mm(position)}, off the shaft, which is {mm(right)} long.",
                where="position", value=position,
            )  # fmt: skip
        return self.shaft.at(position)

    @cached_property
    def linearised(self) -> Linearised:
        """The machine of small motions about this equilibrium: natural frequencies, critical
        speeds, unbalance response."""
        damping = {b.position: b.damping for b in self.bearings}
        return of_shaft(self.shaft, self.tangent, damping)

    @property
    def largest_stress(self) -> float:
        """Largest nominal stress [Pa] of the shaft."""
        return float(self.sections.stress.max())

    @property
    def largest_deflection(self) -> tuple[float, float]:
        """Largest displacement across the axis [m], and where [m]."""
        across = np.hypot(self.displacement[:, 1], self.displacement[:, 2])
        k = int(across.argmax())
        return float(across[k]), float(self.position[k])


def without_rounding(load: np.ndarray) -> np.ndarray:
    """A load (5,) whose components that are rounding, beside the largest, are 0."""
    return np.where(np.abs(load) > _ROUNDING * np.abs(load).max(), load, 0.0)
