"""The static solution of a machine: its shaft, its bearings, and what may be asked of both."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage._version import __version__
from flexcage.core.errors import InputError
from flexcage.core.units import mm
from flexcage.core.writing import write_text
from flexcage.machine.shaft import SectionForces, ShaftModel
from flexcage.machine.spec import Gravity, Whirl
from flexcage.system.statics.solution import StaticSolution

if TYPE_CHECKING:
    from flexcage.machine.linear import Linearised

FORMAT = 1
_NOTHING = 1e-13  # of the largest stiffness: a spring that holds what else nothing does


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
class MachineSolution:
    """Equilibrium of a machine, in SI units, radians and the machine's axes.

    ``displacement`` (n, 5) are x, y, z and the turns about y and z of the shaft at ``position``
    (n,); ``sections`` what its sections bear, ``load`` (5 n,) what loads it beside the bearings.
    ``tangent`` are the exact slopes over the shaft's own motions, bearings and seats included.
    """

    name: str
    speed: float
    shaft: ShaftModel
    displacement: np.ndarray
    sections: SectionForces
    bearings: tuple[BearingResult, ...]
    load: np.ndarray
    tangent: np.ndarray
    warnings: tuple[str, ...]
    unbalanced: float
    whirl: Whirl = Whirl()
    gravity: Gravity = Gravity()

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
        T, size = self.shaft.motions, np.abs(np.diag(self.tangent)).reshape(-1, 5)
        moves, turns = _NOTHING * size[:, :3].max(), _NOTHING * size[:, 3:].max()
        held = np.tile([moves, moves, moves, turns, turns], len(size))  # what nothing holds
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
        length = float(self.position[-1])
        if not 0.0 <= position <= length * (1.0 + 1e-12):
            raise InputError(
                f"position is {mm(position)}, off the shaft, which is {mm(length)} long.",
                where="position", value=position,
            )  # fmt: skip
        return self.shaft.at(position)

    @cached_property
    def linearised(self) -> Linearised:
        """The machine of small motions about this equilibrium: natural frequencies, critical
        speeds, unbalance response."""
        from flexcage.machine.linear import linearised

        return linearised(self)

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

    def table(self, width: int = 0) -> str:
        """Everything as text, in lines of at most ``width`` characters (0: as the terminal)."""
        from flexcage.machine.table import table_of

        return table_of(self, width)

    __str__ = table

    def __repr__(self) -> str:
        borne = ", ".join(f"{b.name} {b.radial:.4g} N" for b in self.bearings)
        return f"MachineSolution({self.name}: radially {borne})"

    def _repr_html_(self) -> str:
        """For notebooks."""
        from flexcage.machine.table import html_of

        return html_of(self)

    def to_dict(self) -> dict[str, Any]:
        """Plain values; what is not a number or infinite is None."""
        lines = self.linearised
        return {
            "format": FORMAT,
            "flexcage": __version__,
            "name": self.name,
            "speed": self.speed,
            "shaft": {
                "position": self.position.tolist(),
                "displacement": self.displacement.tolist(),
                "section_position": self.sections.position.tolist(),
                "section_force": self.sections.force.tolist(),
                "stress": self.sections.stress.tolist(),
            },
            "bearings": {b.name: _plain(b) for b in self.bearings},
            "critical_speeds": [float(s) for s in lines.critical_speeds()[:6]],
            "warnings": list(self.warnings),
            "unbalanced": self.unbalanced,
        }

    def to_json(self, path: str | Path | None = None) -> str:
        """JSON text of ``to_dict``, written to ``path`` as well if one is given."""
        text = json.dumps(self.to_dict(), indent=1) + "\n"
        if path is not None:
            write_text(Path(path), text)
        return text


def _plain(b: BearingResult) -> Mapping[str, Any]:
    return {
        "position": b.position,
        "facing": b.facing,
        "offset": b.offset,
        "force": b.force.tolist(),
        "displacement": b.displacement.tolist(),
        "stiffness": b.stiffness.tolist(),
        "solution": b.solution.to_dict(),
    }
