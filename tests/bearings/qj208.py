"""A four-point contact bearing QJ 208 as tests take it, and its static solution."""

from math import radians

from flexcage.bearings import statics_of
from flexcage.bearings.four_point import FourPointContactBearing
from flexcage.system.spec import Load
from flexcage.system.statics.options import StaticOptions
from flexcage.system.statics.solve import solve_bearing

INSIDE = dict(
    bore=0.04, outside_diameter=0.08, width=0.018, pitch_diameter=0.06, ball_diameter=12.7e-3,
    ball_count=13, inner_groove_radius=0.515 * 12.7e-3, outer_groove_radius=0.525 * 12.7e-3,
)  # fmt: skip
QJ208 = FourPointContactBearing(
    **INSIDE, inner_shim=0.19e-3, outer_shim=0.32e-3, contact_angle=radians(35.0)
)


def solved(bearing=QJ208, *, speed=0.0, gyroscopic="outer_race", tilt="held", **load):
    return solve_bearing(
        bearing, statics_of(bearing), load=Load(**{"radial": 0.0, **load}), speed=speed,
        options=StaticOptions(gyroscopic=gyroscopic, tilt=tilt),
    )  # fmt: skip
