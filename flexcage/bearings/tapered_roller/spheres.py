"""Spheres of which the surface of a tapered roller is the envelope: the slices of its contacts."""

from __future__ import annotations

from math import cos, tan

import numpy as np

from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing


def spheres(b: TaperedRollerBearing, slices: int) -> tuple[np.ndarray, np.ndarray]:
    """Spheres of which the surface of a bearing's roller is the envelope: places (n,) of their
    centres on its axis from its centre of mass, and radii (n,) less the profile's drop [m]. They
    touch the surface in the middles of slices of the static solution."""
    x, drop = b.profile.slices(slices, diameter=b.roller_diameter, length=b.effective_length)
    radius = 0.5 * b.roller_diameter - x * tan(b.half_angle)
    place = x - radius * tan(b.half_angle) - b.roller.centre
    return place, radius / cos(b.half_angle) - drop
