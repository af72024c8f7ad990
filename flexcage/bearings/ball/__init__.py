"""Single-row ball bearings: angular contact and deep groove."""

from __future__ import annotations

from flexcage.bearings.ball import slots
from flexcage.bearings.ball.angular_contact import AngularContactBallBearing
from flexcage.bearings.ball.bearing import BallBearing
from flexcage.bearings.ball.deep_groove import DeepGrooveBallBearing
from flexcage.bearings.ball.rules import RULES
from flexcage.bearings.ball.spot import BallSpot
from flexcage.bearings.family import Family

# specs that ``flexcage.spec`` shows
__all__ = [
    "AngularContactBallBearing",
    "BallBearing",
    "BallSpot",
    "DeepGrooveBallBearing",
]

FAMILY = Family(
    name="ball",
    types=(AngularContactBallBearing, DeepGrooveBallBearing),
    rules=RULES,
    variables=lambda: slots.variables,
    speed=lambda: slots.speed,
    figures=lambda: slots.figures,
    rubbing=lambda: slots.rubbing,
    statics=lambda: slots.statics,
    losses=lambda: slots.losses,
    motion=lambda: slots.motion,
    bending=lambda: slots.bending,
    recording=lambda: slots.recording,
    shapes=lambda: slots.shapes,
    inside=lambda: slots.inside,
    rings=lambda: slots.rings,
)
