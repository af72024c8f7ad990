"""A spot of a roller: a pit or a flat, its dimensions and where it stands at the start."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from flexcage.core.spec import option, quantity
from flexcage.core.units import mm, typeset
from flexcage.geometry.spall import covered

if TYPE_CHECKING:
    from flexcage.bearings.cylindrical_roller.bearing import RollerBearing

_WIDEST = 0.25  # of the roller's diameter, to which a spot is small against the roller


@dataclass(frozen=True, kw_only=True)
class RollerSpot:
    """A pit or a flat on one roller; none while its size is zero.

    A pit has sharp edges and one depth. A flat is as deep as its chord. On both, the roller sinks
    towards a race as a race's spall lets it, once a turn on each race; pockets do not feel it.
    """

    size: float = quantity("mm", 0.0, doc="length round the roller; 0: no spot", minimum=0.0)
    kind: str = option("pit", doc="what it is", choices=("pit", "flat"))
    roller: int = option(0, doc="roller that has it", minimum=0)
    depth: float = quantity("um", 100e-6, doc="depth of a pit", above=0.0)
    width: float | None = quantity("mm", None, doc="axial width (default: all)", above=0.0)
    offset: float = quantity("mm", 0.0, doc="axial distance of its middle from the roller's")
    angle: float = quantity(
        "deg", 0.0, doc="where it is at the start: from outwards towards the sense of the orbit"
    )

    def dimensions(self, radius: float, effective: float) -> np.ndarray:
        """Half of its angle, 0, its depth, and the drop over the square of an angle, as
        ``contacts.uneven.sunk_at`` has them, of a roller of a radius [m] on a race with which it
        has the ``effective`` one [m]."""
        half = 0.5 * self.size
        depth = half**2 / (2.0 * radius) if self.kind == "flat" else self.depth
        return np.array([half / radius, 0.0, depth, radius**2 / (2.0 * effective)])

    def covered(self, centres: np.ndarray, slice_width: float) -> np.ndarray:
        """Share (n,) of slices that lie on it, by the places of their centres (n,) [m]."""
        return covered(centres, slice_width, self.width, self.offset)

    def in_words(self) -> str:
        """A sentence on it; empty if there is none."""
        if not self.size:
            return ""
        deep = "" if self.kind == "flat" else f", {typeset(self.depth, 'um')} deep"
        return f" Roller {self.roller} has a {self.kind} of {typeset(self.size, 'mm')}{deep}."


def find_in_spot(b: RollerBearing) -> Iterator[tuple[str, str]]:
    """What is impossible in the spot of a bearing's roller; where, and in a sentence."""
    spot, where = b.roller_spot, "bearing.roller_spot"
    most, deepest, reach = _WIDEST * b.roller_diameter, 0.1 * b.roller_diameter, b.effective_length
    if not spot.size:
        return
    if spot.roller >= b.roller_count:
        yield (
            f"{where}.roller",
            f"{where}.roller is {spot.roller}, but the rollers are numbered 0 to "
            f"{b.roller_count - 1}.",
        )
    if spot.size > most:
        yield (
            f"{where}.size",
            f"{where}.size is {mm(spot.size)}; give a quarter of the roller's diameter, "
            f"{mm(most)}, or less.",
        )
    if spot.kind == "pit" and spot.depth > deepest:
        yield (
            f"{where}.depth",
            f"{where}.depth is {mm(spot.depth)}; give a tenth of the roller's diameter, "
            f"{mm(deepest)}, or less.",
        )
    if spot.width is not None and abs(spot.offset) - 0.5 * spot.width >= 0.5 * reach:
        yield (
            f"{where}.offset",
            f"{where}.offset is {mm(spot.offset)}, where the roller touches no race: it does to "
            f"{mm(0.5 * reach)} from its middle.",
        )
