"""Profiles of rings and tapered rollers. Rollers are amid the outer ring, whose back is at +x; that
of the inner ring is at -x, the bearing's width away."""

from __future__ import annotations

from math import cos, sin, tan

from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing
from flexcage.render.shapes import Profile, Shapes


def tapered_shapes(b: TaperedRollerBearing) -> Shapes:
    """Inner ring with its large rib, outer ring, and a roller about its centre of mass."""
    bore, outside, front = 0.5 * b.bore, 0.5 * b.outside_diameter, -0.5 * b.outer_width
    foot, top = _rib(b)
    back = min(0.5 * b.outer_width - b.width, top[0])
    return Shapes(
        inner=[(back, bore), (0.0, bore), (0.0, _race(b, 0, 0.0)), foot, top, (back, top[1])],
        outer=[(front, _race(b, 1, front)), (0.0, _race(b, 1, 0.0)), (0.0, outside),
               (front, outside)],
        element=_roller(b),
    )  # fmt: skip


def _race(b: TaperedRollerBearing, k: int, x: float) -> float:
    """Radius [m] of the inner (0) or outer race at a place x [m] on the bearing's axis."""
    return (b.apex_distance * cos(b.axis_angle) - x) * tan(b.race_angles[k])


def _rib(b: TaperedRollerBearing) -> Profile:
    """Where the rib's face begins at the inner race, and where it ends."""
    (along, across), beta = b.rib_place, b.axis_angle
    x = along * cos(beta) + across * sin(beta)
    r = b.pitch_radius - along * sin(beta) + across * cos(beta)
    lean = beta - b.rib_angle  # of the face's normal, inwards
    slope = tan(b.race_angles[0])
    down = (r - _race(b, 0, x)) / (cos(lean) + sin(lean) * slope)
    foot = x - down * sin(lean), r - down * cos(lean)
    return [foot, (foot[0] + b.rib_height * sin(lean), foot[1] + b.rib_height * cos(lean))]


def _roller(b: TaperedRollerBearing) -> Profile:
    """A roller with chamfers, its small end at +x."""
    chamfer, middle = b.element_edge, -b.roller.centre
    begin, end = middle - 0.5 * b.roller_length, middle + 0.5 * b.roller_length
    large, small = b.roller.ends
    taper = chamfer * tan(b.half_angle)
    return [
        (begin, 0.0), (end, 0.0), (end, small - chamfer), (end - chamfer, small + taper),
        (begin + chamfer, large - taper), (begin, large - chamfer),
    ]  # fmt: skip
