"""Sections of rings with plain raceways and ribs, for rings that bend.

Undercuts between race and ribs, and chamfers, are left out; axial forces on ribs bend no ring.
"""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.bearings.cylindrical_roller.designs import RINGS
from flexcage.geometry.ring import Raceway, RingSection


def roller_rings(
    b: RollerBearing,
    *,
    angle: tuple[float, float],
    across: tuple[float, float],
    seat: tuple[float, float],
) -> tuple[RingSection, RingSection]:
    """Sections of inner and outer ring of a bearing, with the ribs of its design; rollers press
    along their effective length."""
    inner, outer = (_section(b, ring, 0.5 * d) for ring, d in zip(RINGS, seat))
    return inner, outer


def _section(b: RollerBearing, ring: str, seat: float) -> RingSection:
    half, end = 0.5 * b.width, 0.5 * b.effective_length
    race = 0.5 * (b.outer_race_diameter if ring == "outer" else b.inner_race_diameter)
    side = 1.0 if ring == "outer" else -1.0
    left, right = _end_outline(b, ring, -1.0, race), _end_outline(b, ring, 1.0, race)
    outline = [*left, (-end, race), (end, race), *right[::-1], (half, seat), (-half, seat)]
    names = [""] * len(outline)
    names[len(left)], names[-2] = "race", "seat"
    return RingSection(
        outline=tuple(outline),
        names=tuple(names),
        raceway=Raceway(place=(0.0, race), normal=(0.0, side), extent=end, line=True),
        wall=side * (seat - race),
    )


def _end_outline(
    b: RollerBearing, ring: str, side: float, race: float
) -> list[tuple[float, float]]:
    """From a ring's end, at ``side`` of the middle, to the place where rollers press."""
    end, ribs = side * 0.5 * b.width, b.ribs(ring)
    if ribs is None or not ribs.sides[0 if side > 0.0 else 1]:
        return [(end, race)]
    gap, rib = side * 0.5 * ribs.gap, 0.5 * ribs.diameter
    return [(end, rib), (gap, rib), (gap, race)]
