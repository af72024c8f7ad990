"""The static solution of a machine, with its table and JSON."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from flexcage._version import __version__
from flexcage.core.writing import write_text
from flexcage.machine.state import BearingResult, MachineState
from flexcage.machine.table import html_of, table_of

__all__ = ["BearingResult", "MachineSolution"]

FORMAT = 1


@dataclass(frozen=True, eq=False)
class MachineSolution(MachineState):
    """Equilibrium of a machine, as ``MachineState`` has it; as a table, and as JSON."""

    def table(self, width: int = 0) -> str:
        """Everything as text, in lines of at most ``width`` characters (0: as the terminal)."""
        return table_of(self, width)

    __str__ = table

    def _repr_html_(self) -> str:
        """For notebooks."""
        return html_of(self)

    def __repr__(self) -> str:
        borne = ", ".join(f"{b.name} {b.radial:.4g} N" for b in self.bearings)
        return f"MachineSolution({self.name}: radially {borne})"

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
