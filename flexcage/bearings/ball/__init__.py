"""Single-row ball bearings: angular contact and deep groove."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flexcage.bearings.family import Family
from flexcage.geometry.angular_contact_ball import AngularContactBallBearing
from flexcage.geometry.deep_groove_ball import DeepGrooveBallBearing

if TYPE_CHECKING:
    from flexcage.integrate.recording import Recording
    from flexcage.render.shapes import ShapesOf
    from flexcage.system.motion import Motion
    from flexcage.system.statics.elements import ElementsOf


def _statics() -> ElementsOf:
    from flexcage.system.statics.balls import balls_of

    return balls_of


def _motion() -> Motion[Any]:
    from flexcage.system.ball_motion import MOTION

    return MOTION


def _recording() -> Recording[Any]:
    from flexcage.integrate.ball_recording import RECORDING

    return RECORDING


def _shapes() -> ShapesOf:
    from flexcage.render.ball_shapes import ball_shapes

    return ball_shapes


FAMILY = Family(
    name="ball",
    types=(AngularContactBallBearing, DeepGrooveBallBearing),
    statics=_statics,
    motion=_motion,
    recording=_recording,
    shapes=_shapes,
)
