"""All bearing types that flexcage ships: importing this module registers them and their parts."""

from flexcage.geometry import ball_catalogue, ball_checks, ribbon_cage
from flexcage.geometry.angular_contact_ball import AngularContactBallBearing
from flexcage.geometry.ball_bearing import BallBearing
from flexcage.geometry.bearing import BEARING_TYPES, OTHER_DESIGNS, Bearing
from flexcage.geometry.cylindrical_roller import RollerBearing
from flexcage.geometry.deep_groove_ball import DeepGrooveBallBearing

__all__ = [
    "BEARING_TYPES",
    "OTHER_DESIGNS",
    "AngularContactBallBearing",
    "BallBearing",
    "Bearing",
    "DeepGrooveBallBearing",
    "RollerBearing",
    "ball_catalogue",
    "ball_checks",
    "ribbon_cage",
]
