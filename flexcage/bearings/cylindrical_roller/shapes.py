"""Profiles of rings and rollers."""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.bearings.cylindrical_roller.designs import SIDES
from flexcage.render.shapes import Profile, Shapes


def roller_shapes(b: RollerBearing) -> Shapes:
    """Rings with the ribs of the design, and a roller with chamfers."""
    half, bore, outside = 0.5 * b.width, 0.5 * b.ring_bore, 0.5 * b.outside_diameter
    r, end, c = 0.5 * b.roller_diameter, 0.5 * b.roller_length, 0.05 * b.roller_diameter
    inner, outer = _surface(b, "inner"), _surface(b, "outer")
    return Shapes(
        inner=[(-half, bore), (0.0, bore), *inner],
        outer=[*outer[::-1], (0.0, outside), (-half, outside)],
        element=[
            (-end, 0.0), (end, 0.0), (end, r - c), (end - c, r), (c - end, r), (-end, r - c)
        ],
    )  # fmt: skip


def _surface(b: RollerBearing, ring: str) -> Profile:
    """What of a ring faces the rollers, from the cut at mid-width to its end, where it has a rib if
    it has one at all."""
    half = 0.5 * b.width
    race = 0.5 * (b.outer_race_diameter if ring == "outer" else b.inner_race_diameter)
    ribs = b.ribs(ring)
    if ribs is None or not ribs.sides[SIDES.index("-x")]:
        return [(0.0, race), (-half, race)]
    gap, rib = 0.5 * ribs.gap, 0.5 * ribs.diameter
    return [(0.0, race), (-gap, race), (-gap, rib), (-half, rib)]
