"""Profiles of rings of two rows of rollers, and a roller."""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.shapes import roller_shapes
from flexcage.bearings.double_row_roller.bearing import DoubleRowRollerBearing
from flexcage.render.shapes import Profile, Shapes


def double_row_roller_shapes(b: DoubleRowRollerBearing) -> Shapes:
    """Rings with the ribs of the row at -x, the inner of which both rows share, and a roller."""
    half, bore, outside = 0.5 * b.width, 0.5 * b.ring_bore, 0.5 * b.outside_diameter
    inner, outer = _surface(b, "inner"), _surface(b, "outer")
    return Shapes(
        inner=[(-half, bore), (0.0, bore), *inner],
        outer=[*outer[::-1], (0.0, outside), (-half, outside)],
        element=roller_shapes(b.row).element,
    )


def _surface(b: DoubleRowRollerBearing, ring: str) -> Profile:
    """What of a ring faces the rollers, from the middle of the bearing to its end at -x."""
    half, ribs = 0.5 * b.width, b.ribs(ring)
    race = 0.5 * (b.outer_race_diameter if ring == "outer" else b.inner_race_diameter)
    if ribs is None or not all(ribs.sides):
        return [(0.0, race), (-half, race)]
    rib = 0.5 * ribs.diameter
    near, far = (-0.5 * b.row_distance + side * 0.5 * ribs.gap for side in (1.0, -1.0))
    between = [(0.0, rib), (near, rib)] if near < 0.0 else [(0.0, race)]
    return [*between, (min(near, 0.0), race), (far, race), (far, rib), (-half, rib)]
