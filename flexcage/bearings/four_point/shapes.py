"""Profiles of rings with two arcs a race, and balls."""

from __future__ import annotations

from math import sqrt

import numpy as np

from flexcage.bearings.ball.shapes import ball_shapes
from flexcage.bearings.four_point.bearing import FourPointContactBearing
from flexcage.render.shapes import Profile, Shapes

_POINTS = 14  # of half a race


def four_point_shapes(b: FourPointContactBearing) -> Shapes:
    """Two rings whose races meet in a ridge in the middle where they have two arcs, and a ball."""
    half, bore, outside = 0.5 * b.width, 0.5 * b.bore, 0.5 * b.outside_diameter
    inner, outer = (0.5 * d for d in b.shoulder_diameters)
    below, above = _half_race(b, "inner", inner), _half_race(b, "outer", outer)
    return Shapes(
        inner=[(-half, bore), (0.0, bore), *below, (-half, inner)],
        outer=[(-half, outer), *above[::-1], (0.0, outside), (-half, outside)],
        element=ball_shapes(b).element,
    )


def _half_race(b: FourPointContactBearing, ring: str, shoulder: float) -> Profile:
    """The arc at -x, from the middle to its ``shoulder`` (a radius), or to the ring's end."""
    side, radius = (-1.0 if ring == "inner" else 1.0), getattr(b, f"{ring}_groove_radius")
    centre = b.inner_groove_centre[1] if ring == "inner" else b.outer_groove_centre[1]
    x = float(np.abs(b.arcs(ring)).max())  # of the centre: beyond the middle
    depth = min(abs(shoulder - centre), radius)
    end = max(x - sqrt(radius**2 - depth**2), -0.5 * b.width)
    places = np.linspace(0.0, end, _POINTS)
    return [(float(p), centre + side * sqrt(radius**2 - (p - x) ** 2)) for p in places]
