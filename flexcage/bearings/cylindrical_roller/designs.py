"""Designs of cylindrical roller bearings: which ring has ribs, and on which sides.

Their names are those of makers' catalogues (NSK, Rolling Bearings, E1102e). The ring with two ribs
guides the rollers; a rib of the other ring, the counter rib, makes the bearing carry axial load.
"""

from __future__ import annotations

from dataclasses import dataclass

RINGS = ("inner", "outer")
SIDES = ("+x", "-x")  # order of a ring's ribs in all arrays
BOTH = (True, True)


@dataclass(frozen=True)
class Design:
    """``guide``: the ring with two ribs; ``counter``: how many ribs the other one has."""

    guide: str
    counter: int

    @property
    def other(self) -> str:
        """The ring that does not guide the rollers."""
        return RINGS[1 - RINGS.index(self.guide)]


#: Designs by their names in catalogues.
DESIGNS = {
    "N": Design("inner", 0),
    "NU": Design("outer", 0),
    "NJ": Design("outer", 1),
    "NUP": Design("outer", 2),
    "NF": Design("inner", 1),
}
ALL = "N, NU, NJ, NUP and NF"


@dataclass(frozen=True)
class Ribs:
    """Ribs of one ring: their diameter towards the rollers and their distance [m], and the sides,
    +x and -x, that have one. A single rib is half of the distance from the middle."""

    diameter: float
    gap: float
    sides: tuple[bool, bool]

    @property
    def name(self) -> str:
        return "ribs" if all(self.sides) else "rib"
