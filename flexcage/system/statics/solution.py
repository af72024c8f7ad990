"""The static solution: what came of it, as a frozen value with a table and JSON."""

from __future__ import annotations

import dataclasses
import json
from dataclasses import dataclass, field
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from flexcage._version import __version__
from flexcage.core.writing import write_text
from flexcage.geometry.film import Film
from flexcage.system.statics.elements import ElementLoads
from flexcage.system.statics.rings import BentRing
from flexcage.system.statics.table import html_of, table_of

FORMAT = 1


@dataclass(frozen=True)
class Ratings:
    """Ratings [N] and lives [10^6 revolutions that nine bearings in ten reach]."""

    static: float  # C0 of ISO 76
    dynamic: float  # C, ISO 281's or the catalogue's
    names: tuple[str, str]  # their symbols
    equivalent_load: float  # P of ISO 281 [N], NaN where the standard has no factors
    life: float  # L10 of ISO 281
    reference_life: float  # L10r of ISO/TS 16281, from every element's load


@dataclass(frozen=True, eq=False)
class StaticSolution:
    """Equilibrium of one bearing's inner ring, in SI units and radians.

    Arrays of five are x, y, z and the tilts about y and z, of forces and moments on the inner ring
    likewise; they refer to the middle of the plane of ball centres, or of the rollers. ``load`` is
    what was asked, ``reaction`` what holds motions that are held, and what a compliant shaft's
    springs bear. ``elements`` lists every element, inner race before outer, and ``film`` (Z, 2) the
    lubricant's thickness there, of rolling without slip. ``stiffness`` (5, 5) is the exact tangent
    of what the elements bear over displacement, at constant speed, the elements following.
    ``outer`` (5,) is the displacement of the outer ring, whose seat may yield: ``displacement`` and
    ``stiffness`` have the seat's share in them.
    """

    title: str
    speed: float
    load: np.ndarray
    displacement: np.ndarray
    reaction: np.ndarray
    stiffness: np.ndarray
    elements: ElementLoads
    film: Film
    ratings: Ratings
    warnings: tuple[str, ...]
    unbalanced: float  # largest force left over, as a share of the load
    held: str = ""  # how the inner ring is held, in words
    rings: tuple[BentRing, ...] = ()  # that bend
    outer: np.ndarray = field(default_factory=lambda: np.zeros(5))

    @property
    def largest_force(self) -> float:
        """Largest force [N] of an element on a race."""
        return float(self.elements.force.max())

    @property
    def largest_pressure(self) -> float:
        """Largest Hertz pressure [Pa]."""
        return float(self.elements.pressure.max())

    @property
    def loaded(self) -> int:
        """Number of elements that bear more than a millionth of the largest force on both races."""
        least = 1e-6 * self.largest_force
        return int(np.count_nonzero((self.elements.force > least).all(axis=1)))

    def life_hours(self) -> float:
        """Basic reference rating life [h] at this speed; infinite at rest."""
        turns = abs(self.speed) / (2.0 * np.pi) * 3600.0
        return 1e6 * self.ratings.reference_life / turns if turns else float("inf")

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
        names = [f.name for f in dataclasses.fields(self) if f.name != "rings"]
        fields = {name: _plain(getattr(self, name)) for name in names}
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
