"""Spherical roller bearings for tests: one of about a 22208's size, and one without its clearance
whose rows are not staggered."""

from dataclasses import replace
from math import radians

from flexcage.spec import SphericalRollerBearing

MM = 1e-3
BEARING = SphericalRollerBearing(
    bore=40 * MM, outside_diameter=80 * MM, width=23 * MM, contact_angle=radians(10.55),
    pitch_diameter=61.36 * MM, roller_diameter=10.7 * MM, roller_length=8.5 * MM,
    effective_length=7.33 * MM, roller_count=16, barrel_radius=35.82 * MM,
    inner_groove_radius=36.55 * MM, radial_clearance=20e-6,
)  # fmt: skip
TIGHT = replace(BEARING, radial_clearance=0.0, staggered=False)
