"""The static solution: an equilibrium with its table and JSON."""

from __future__ import annotations

import dataclasses
import json
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from flexcage._version import __version__
from flexcage.core.writing import write_text
from flexcage.system.statics.state import StaticState
from flexcage.system.statics.table import html_of, table_of

FORMAT = 1
_IF_ANY = ("mounting", "lives")  # of cases that ask for them


@dataclass(frozen=True, eq=False)
class StaticSolution(StaticState):
    """Equilibrium of one bearing's inner ring, in SI units and radians: ``displacement``,
    ``reaction``, ``stiffness``, ``elements``, ``film``, ``ratings`` and more, as ``StaticState``
    has them; as a table, in a notebook, and as JSON."""

    def table(self, width: int = 0) -> str:
        """Everything as text, in lines of at most ``width`` characters (0: as the terminal is
        wide)."""
        return table_of(self, width)

    __str__ = table

    def __repr__(self) -> str:
        x, y, z = 1e6 * self.displacement[:3]
        return (
            f"StaticSolution({self.title}: {x:.4g}, {y:.4g}, {z:.4g} um; {self.loaded} elements "
            f"loaded, up to {self.largest_force:.5g} N and {self.largest_pressure / 1e6:.5g} MPa)"
        )

    def _repr_html_(self) -> str:
        """For notebooks."""
        return html_of(self)

    def to_dict(self) -> dict[str, Any]:
        """Plain values; what is not a number or infinite is None."""
        names = [f.name for f in dataclasses.fields(self) if f.name not in (*_IF_ANY, "rings")]
        fields = {name: _plain(getattr(self, name)) for name in names}
        more = {name: getattr(self, name) for name in _IF_ANY}
        fields |= {name: _plain(value) for name, value in more.items() if value is not None}
        if self.rings:
            fields["rings"] = {ring.side: _plain(ring.figures()) for ring in self.rings}
        return {"format": FORMAT, "flexcage": __version__, **fields}

    def to_json(self, path: str | Path | None = None) -> str:
        """JSON text of ``to_dict``, written to ``path`` as well if one is given."""
        text = json.dumps(self.to_dict(), indent=1) + "\n"
        if path is not None:
            write_text(Path(path), text)
        return text


def _plain(value: Any) -> Any:
    if dataclasses.is_dataclass(value) and not isinstance(value, type):
        found = {f.name: getattr(value, f.name) for f in dataclasses.fields(value)}
        return {name: _plain(own) for name, own in found.items() if own is not None}
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, np.ndarray):
        return [_plain(item) for item in value]
    if isinstance(value, (tuple, list)):
        return [_plain(item) for item in value]
    if isinstance(value, (float, np.floating)):
        return float(value) if isfinite(value) else None
    return value
