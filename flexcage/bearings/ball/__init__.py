"""Single-row ball bearings: angular contact and deep groove."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flexcage.bearings.ball.angular_contact import AngularContactBallBearing
from flexcage.bearings.ball.bearing import BallBearing
from flexcage.bearings.ball.deep_groove import DeepGrooveBallBearing
from flexcage.bearings.ball.spot import BallSpot
from flexcage.bearings.family import Family

# specs that ``flexcage.spec`` shows
__all__ = [
    "AngularContactBallBearing",
    "BallBearing",
    "BallSpot",
    "DeepGrooveBallBearing",
]

if TYPE_CHECKING:
    from flexcage.geometry.inside import Inside
    from flexcage.geometry.ring import SectionsOf
    from flexcage.integrate.recording import Recording
    from flexcage.render.shapes import ShapesOf
    from flexcage.results.figures import OwnFigures
    from flexcage.results.metrics import ElementSpeed
    from flexcage.results.registry import OwnVariables
    from flexcage.stress.rubbing import Rub
    from flexcage.system.motion import Motion
    from flexcage.system.statics.elements import ElementsOf


def _variables() -> OwnVariables:
    from flexcage.bearings.ball.variables import VARIABLES

    return VARIABLES


def _speed() -> ElementSpeed:
    from flexcage.bearings.ball.slip import SPEED

    return SPEED


def _figures() -> OwnFigures:
    from flexcage.bearings.ball.figures import FIGURES

    return FIGURES


def _rubbing() -> Rub:
    from flexcage.bearings.ball.rubbing import rubbing

    return rubbing


def _statics() -> ElementsOf:
    from flexcage.bearings.ball.statics import balls_of

    return balls_of


def _motion() -> Motion[Any]:
    from flexcage.bearings.ball.motion import MOTION

    return MOTION


def _recording() -> Recording[Any]:
    from flexcage.bearings.ball.recording import RECORDING

    return RECORDING


def _shapes() -> ShapesOf:
    from flexcage.bearings.ball.shapes import ball_shapes

    return ball_shapes


def _inside() -> Inside:
    from flexcage.bearings.ball.inside import INSIDE

    return INSIDE


def _rings() -> SectionsOf:
    from flexcage.bearings.ball.rings import ball_rings

    return ball_rings


FAMILY = Family(
    name="ball",
    types=(AngularContactBallBearing, DeepGrooveBallBearing),
    variables=_variables,
    speed=_speed,
    figures=_figures,
    rubbing=_rubbing,
    statics=_statics,
    motion=_motion,
    recording=_recording,
    shapes=_shapes,
    inside=_inside,
    rings=_rings,
)
