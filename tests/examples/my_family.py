"""A user's own bearing family: balls that a magnet in the outer ring pulls outwards."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import FunctionType
from typing import ClassVar, NamedTuple

from flexcage.bearings.ball import FAMILY as BALLS
from flexcage.bearings.ball.deep_groove import DeepGrooveBallBearing
from flexcage.bearings.ball.model import SpottedBalls
from flexcage.bodies.floating_frame import BodyData
from flexcage.contacts.ball_ball import BallBallContact
from flexcage.contacts.ball_pocket import BallPockets
from flexcage.contacts.evaluation import REPORT
from flexcage.contacts.groove import Groove
from flexcage.contacts.land import LandData
from flexcage.core.jit import fields, part
from flexcage.geometry.bearing import BEARING_TYPES
from flexcage.register import bearing_family, option, quantity
from flexcage.system.data import GRAVITY, Bodies, RingBody
from flexcage.system.layout import PER_ELEMENT
from flexcage.system.motion import Motion, parts_type

MOTION_OF_BALLS = BALLS.motion()


@dataclass(frozen=True, kw_only=True)
class MagnetBearing(DeepGrooveBallBearing):
    """A deep groove ball bearing with a magnet."""

    kind: ClassVar[str] = "magnet bearing"
    family: ClassVar[str] = "magnet"
    type: str = option("magnet", doc="type of bearing", choices=BEARING_TYPES)
    pull: float = quantity("N", 0.0, doc="pull on a ball, outwards", minimum=0.0)


class Magnet(NamedTuple):
    pull: float


class MagnetModel(NamedTuple):
    bodies: Bodies
    inner_ring: RingBody
    outer_ring: RingBody
    cage: BodyData
    inner: Groove
    outer: Groove
    pocket: BallPockets
    neighbours: BallBallContact
    spot: SpottedBalls
    land: LandData
    magnet: Magnet


MagnetParts = parts_type("MagnetParts", MagnetModel, __name__)


def build_model(bearing, *args, **kwargs):
    return MagnetModel(
        *MOTION_OF_BALLS.build_model(bearing, *args, **kwargs), Magnet(float(bearing.pull))
    )


# a part for this module: what the balls' own family compiles stays as it is
_balls = part(FunctionType(MOTION_OF_BALLS.evaluate.__code__, MOTION_OF_BALLS.evaluate.__globals__))


def evaluate(t, y, yd, d, law, out, mode):
    """The balls' rows, and the pull in that of each along its radius; its power is gravity's."""
    _balls(t, y, yd, d, law, out, mode)
    at = fields(d.places)
    for i in range(at.elements):
        radial = at.u + PER_ELEMENT * i + 1
        out[radial] -= fields(d.magnet).pull
        if mode >= REPORT:
            fields(d.report).power[GRAVITY] += fields(d.magnet).pull * y[radial]


MOTION = Motion(
    build_model=build_model,
    parts=MagnetParts,
    new_work=MOTION_OF_BALLS.new_work,
    evaluate=evaluate,
    separate=MOTION_OF_BALLS.separate,
    faces=MOTION_OF_BALLS.faces,
    ribs=(),
    start=MOTION_OF_BALLS.start,
    error_weights=MOTION_OF_BALLS.error_weights,
    linearise=MOTION_OF_BALLS.linearise,  # a constant pull has no slope
    implicit_share=MOTION_OF_BALLS.implicit_share,
    implicit_weights=MOTION_OF_BALLS.implicit_weights,
)

# between rings that bend nothing pulls: their equations are those of other balls
bearing_family(
    replace(BALLS, name="magnet", types=(MagnetBearing,), motion=lambda: MOTION, bending=None)
)
