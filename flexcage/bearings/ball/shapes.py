"""Profiles of grooved rings and balls."""

from __future__ import annotations

from math import cos, pi, sin, sqrt

import numpy as np

from flexcage.bearings.ball.bearing import BallBearing
from flexcage.render.shapes import Profile, Shapes

_ARC = 14  # points of a groove's arc


def ball_shapes(b: BallBearing) -> Shapes:
    """Two rings with grooves between shoulders, and a ball."""
    half, bore, outside = 0.5 * b.width, 0.5 * b.bore, 0.5 * b.outside_diameter
    inner, outer = (0.5 * d for d in b.shoulder_diameters)
    below = _groove(b.inner_groove_centre, b.inner_groove_radius, inner, half)
    above = _groove(b.outer_groove_centre, b.outer_groove_radius, outer, half)
    r = 0.5 * b.ball_diameter
    arc = [(r * cos(a), r * sin(a)) for a in np.linspace(pi, 0.0, 25)[1:-1][::-1]]
    return Shapes(
        inner=[(-half, bore), (0.0, bore), *below, (-half, inner)],
        outer=[(-half, outer), *above[::-1], (0.0, outside), (-half, outside)],
        element=[(-r, 0.0), (r, 0.0), *arc],
    )


def _groove(centre: tuple[float, float], radius: float, shoulder: float, half: float) -> Profile:
    """A groove's arc from x = 0 to its ``shoulder`` (a radius), or to the ring's end at -half."""
    x, r = centre
    side = 1.0 if shoulder > r else -1.0  # the outer race lies outside of its groove's centre
    depth = min(abs(shoulder - r), radius)
    end = max(x - sqrt(radius**2 - depth**2), -half)
    places = np.linspace(0.0, end, _ARC)
    return [(float(p), r + side * sqrt(radius**2 - (p - x) ** 2)) for p in places]
