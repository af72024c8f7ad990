"""Profiles of rings and rollers."""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.render.shapes import Shapes


def roller_shapes(b: RollerBearing) -> Shapes:
    """An inner ring with two ribs, a plain outer ring, and a roller with chamfers."""
    half, gap = 0.5 * b.width, 0.5 * b.rib_gap
    bore, race, rib = 0.5 * b.bore, 0.5 * b.inner_race_diameter, 0.5 * b.rib_diameter
    outer, outside = 0.5 * b.outer_race_diameter, 0.5 * b.outside_diameter
    r, end, c = 0.5 * b.roller_diameter, 0.5 * b.roller_length, 0.05 * b.roller_diameter
    return Shapes(
        inner=[(-half, bore), (0.0, bore), (0.0, race), (-gap, race), (-gap, rib), (-half, rib)],
        outer=[(-half, outer), (0.0, outer), (0.0, outside), (-half, outside)],
        element=[
            (-end, 0.0), (end, 0.0), (end, r - c), (end - c, r), (c - end, r), (-end, r - c)
        ],
    )  # fmt: skip
