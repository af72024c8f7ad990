"""Profiles of rings with two rows of grooves, and balls."""

from __future__ import annotations

from math import sqrt
from typing import Any

import numpy as np

from flexcage.bearings.ball.shapes import ball_shapes
from flexcage.render.shapes import Profile, Shapes

_POINTS = 14  # of a groove


def double_row_shapes(b: Any) -> Shapes:
    """Two rings whose grooves stand where their rows do, and a ball, at one end of the bearing; see
    ``_profile``."""
    half, bore, outside = 0.5 * b.width, 0.5 * b.bore, 0.5 * b.outside_diameter
    inner, outer = (0.5 * d for d in b.shoulder_diameters)
    below, above = _profile(b, "inner", inner), _profile(b, "outer", outer)
    return Shapes(
        inner=[(-half, bore), (0.0, bore), *below, (-half, below[-1][1])],
        outer=[(-half, above[-1][1]), *above[::-1], (0.0, outside), (-half, outside)],
        element=ball_shapes(b.row).element,
    )


def _profile(b: Any, ring: str, shoulder: float) -> Profile:
    """A race from the middle of the bearing to its end at -x: the groove of the row there between
    ``shoulder`` radii, or the sphere."""
    row, place = b.row, b.row_places[0]
    x, r = row.inner_groove_centre if ring == "inner" else row.outer_groove_centre
    x = place.place + place.sense * (x - (b.late if ring == "inner" else 0.0))
    side, radius = (-1.0 if ring == "inner" else 1.0), getattr(row, f"{ring}_groove_radius")
    half = 0.5 * b.width
    depth = min(abs(shoulder - r), radius)
    reach = sqrt(radius**2 - depth**2)
    begin, end = min(x + reach, 0.0), max(x - reach, -half)
    places = np.linspace(begin, end, _POINTS)
    arc = [(float(p), r + side * sqrt(max(radius**2 - (p - x) ** 2, 0.0))) for p in places]
    return [(0.0, arc[0][1]), *arc] if begin < 0.0 else arc
