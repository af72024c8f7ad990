"""A tapered roller bearing for tests, of about a 30205's size."""

from math import radians

from flexcage.spec import TaperedRollerBearing

MM = 1e-3
BEARING = TaperedRollerBearing(
    bore=25 * MM, outside_diameter=52 * MM, width=16.25 * MM, inner_width=15 * MM,
    outer_width=13 * MM, contact_angle=radians(14.0), pitch_diameter=39 * MM,
    roller_diameter=6.2 * MM, roller_length=9.5 * MM, effective_length=8.8 * MM, roller_count=17,
    rib_height=1.2 * MM, end_radius=76 * MM,
)  # fmt: skip
