"""Single-row ball bearings: angular contact and deep groove."""

from flexcage.bearings.family import Family
from flexcage.geometry.angular_contact_ball import AngularContactBallBearing
from flexcage.geometry.deep_groove_ball import DeepGrooveBallBearing

FAMILY = Family(name="ball", types=(AngularContactBallBearing, DeepGrooveBallBearing))
