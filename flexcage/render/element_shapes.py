"""Rings and rolling elements as solids, by the bearing's spec.

Rings are cut at mid-width: their profiles (x, r) [m] are of the half with x < 0.
"""

from __future__ import annotations

from functools import singledispatch
from math import cos, pi, sin, sqrt
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.geometry.ball_bearing import BallBearing
from flexcage.geometry.cylindrical_roller import RollerBearing
from flexcage.render.solids import revolved

if TYPE_CHECKING:
    import pyvista

Profile = list[tuple[float, float]]
_ARC = 14  # points of a groove's arc


@singledispatch
def ring_profiles(bearing: Any) -> tuple[Profile, Profile]:
    """Half sections of inner and outer ring, counter-clockwise."""
    raise InputError(f"There is no picture of a {type(bearing).__name__}.", where="bearing")


@singledispatch
def element_shape(bearing: Any) -> pyvista.PolyData:
    """A rolling element about its centre, its axis along x."""
    raise InputError(f"There is no picture of a {type(bearing).__name__}.", where="bearing")


@singledispatch
def element_end(bearing: Any) -> float:
    """Distance [m] along x from an element's centre to the side that faces the viewer."""
    raise InputError(f"There is no picture of a {type(bearing).__name__}.", where="bearing")


@ring_profiles.register
def _(b: RollerBearing) -> tuple[Profile, Profile]:
    half, gap = 0.5 * b.width, 0.5 * b.rib_gap
    bore, race, rib = 0.5 * b.bore, 0.5 * b.inner_race_diameter, 0.5 * b.rib_diameter
    outer, outside = 0.5 * b.outer_race_diameter, 0.5 * b.outside_diameter
    return (
        [(-half, bore), (0.0, bore), (0.0, race), (-gap, race), (-gap, rib), (-half, rib)],
        [(-half, outer), (0.0, outer), (0.0, outside), (-half, outside)],
    )


@element_shape.register(RollerBearing)
def _(b: RollerBearing) -> pyvista.PolyData:
    r, half = 0.5 * b.roller_diameter, 0.5 * b.roller_length
    c = 0.05 * b.roller_diameter
    shape = [(-half, 0.0), (half, 0.0), (half, r - c), (half - c, r), (c - half, r), (-half, r - c)]
    return revolved(shape, segments=48)


@element_end.register
def _(b: RollerBearing) -> float:
    return 0.5 * b.roller_length


@ring_profiles.register
def _(b: BallBearing) -> tuple[Profile, Profile]:
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


@element_shape.register(BallBearing)
def _(b: BallBearing) -> pyvista.PolyData:
    r = 0.5 * b.ball_diameter
    angles = np.linspace(pi, 0.0, 25)[1:-1]
    arc = [(r * cos(a), r * sin(a)) for a in angles[::-1]]
    return revolved([(-r, 0.0), (r, 0.0), *arc], segments=48)


@element_end.register
def _(b: BallBearing) -> float:
    return 0.5 * b.ball_diameter
