"""Profiles of rings and barrels."""

from __future__ import annotations

from math import cos, sin

import numpy as np

from flexcage.bearings.spherical_roller.bearing import SphericalRollerBearing
from flexcage.render.shapes import Profile, Shapes

_POINTS = 14  # of an arc


def barrel_shapes(b: SphericalRollerBearing) -> Shapes:
    """An outer ring with a sphere, an inner ring with a groove, and a barrel."""
    half, bore, outside = 0.5 * b.width, 0.5 * b.bore, 0.5 * b.outside_diameter
    x = np.linspace(0.0, half, _POINTS)
    sphere = [(-float(p), float(np.sqrt(b.sphere_radius**2 - p**2))) for p in x]
    return Shapes(
        inner=[(-half, bore), (0.0, bore), *_inner(b)],
        outer=[*sphere[::-1], (0.0, outside), (-half, outside)],
        element=_barrel(b),
    )


def _inner(b: SphericalRollerBearing) -> Profile:
    """The groove at -x, from the middle to the side: cylinders beyond the barrels' ends."""
    along = np.linspace(-0.5, 0.5, _POINTS) * b.roller_length
    radii = [0.5 * b.race_diameter("inner", float(s)) for s in along]
    middle = 0.5 * b.row_distance
    groove = []
    for s, r in zip(along, radii):
        # the race's point at s: along the axis by s cos(alpha), and its height times sin(alpha)
        height = (r - b.pitch_radius + s * sin(b.contact_angle)) / cos(b.contact_angle)
        groove.append((-middle - s * cos(b.contact_angle) - height * sin(b.contact_angle), r))
    first, last = groove[0], groove[-1]
    return [(0.0, first[1]), *groove, (-0.5 * b.width, last[1])]


def _barrel(b: SphericalRollerBearing) -> Profile:
    x = np.linspace(-0.5, 0.5, _POINTS) * b.roller_length
    half = 0.5 * b.roller_length
    arc = [(float(p), float(r)) for p, r in zip(x, b.roller.radius(x))]
    return [(-half, 0.0), (half, 0.0), *arc[::-1]]
