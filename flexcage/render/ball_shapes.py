"""Rings and balls of ball bearings as solids."""

from __future__ import annotations

from math import cos, pi, sin, sqrt
from typing import TYPE_CHECKING

import numpy as np

from flexcage.geometry.ball_bearing import BallBearing
from flexcage.render.shapes import Profile, Shapes
from flexcage.render.solids import revolved

if TYPE_CHECKING:
    import pyvista

_ARC = 14  # points of a groove's arc


def _rings(b: BallBearing) -> tuple[Profile, Profile]:
    half, bore, outside = 0.5 * b.width, 0.5 * b.bore, 0.5 * b.outside_diameter
    inner, outer = (0.5 * d for d in b.shoulder_diameters)
    below = _groove(b.inner_groove_centre, b.inner_groove_radius, inner, half)
    above = _groove(b.outer_groove_centre, b.outer_groove_radius, outer, half)
    return (
        [(-half, bore), (0.0, bore), *below, (-half, inner)],
        [(-half, outer), *above[::-1], (0.0, outside), (-half, outside)],
    )


def _groove(centre: tuple[float, float], radius: float, shoulder: float, half: float) -> Profile:
    """A groove's arc from x = 0 to its ``shoulder`` (a radius), or to the ring's end at -half."""
    x, r = centre
    side = 1.0 if shoulder > r else -1.0  # the outer race lies outside of its groove's centre
    depth = min(abs(shoulder - r), radius)
    end = max(x - sqrt(radius**2 - depth**2), -half)
    places = np.linspace(0.0, end, _ARC)
    return [(float(p), r + side * sqrt(radius**2 - (p - x) ** 2)) for p in places]


def _element(b: BallBearing) -> pyvista.PolyData:
    r = 0.5 * b.ball_diameter
    angles = np.linspace(pi, 0.0, 25)[1:-1]
    arc = [(r * cos(a), r * sin(a)) for a in angles[::-1]]
    return revolved([(-r, 0.0), (r, 0.0), *arc], segments=48)


def _end(b: BallBearing) -> float:
    return 0.5 * b.ball_diameter


SHAPES = Shapes(rings=_rings, element=_element, end=_end)
