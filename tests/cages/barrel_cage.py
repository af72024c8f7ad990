"""The cage of a spherical roller bearing for tests, of about a 22208's size with few barrels."""

from math import radians

from flexcage.cages.barrel.cage import BarrelCage
from flexcage.spec import SphericalRollerBearing

MM = 1e-3
BARRELS = SphericalRollerBearing(
    bore=30 * MM, outside_diameter=72 * MM, width=27 * MM, contact_angle=radians(12.0),
    pitch_diameter=52 * MM, roller_diameter=11 * MM, roller_length=9 * MM,
    effective_length=8 * MM, roller_count=11, barrel_radius=31 * MM,
    inner_groove_radius=31.7 * MM, radial_clearance=20e-6,
)  # fmt: skip
COUNT = BARRELS.roller_count
BARREL_CAGE = BarrelCage(
    cone_angle=radians(12.0), pitch_diameter=52 * MM, row_distance=BARRELS.row_distance,
    offset=2.6 * MM, thickness=2.4 * MM, rim=1.5 * MM, pocket_length=9.25 * MM,
    pocket_width=10.2 * MM, flank_angle=radians(24.0), fillet_radius=0.6 * MM,
)  # fmt: skip
