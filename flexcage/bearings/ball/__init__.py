"""Single-row ball bearings: angular contact and deep groove."""

from __future__ import annotations

from typing import TYPE_CHECKING

from flexcage.bearings.family import Family
from flexcage.geometry.angular_contact_ball import AngularContactBallBearing
from flexcage.geometry.deep_groove_ball import DeepGrooveBallBearing

if TYPE_CHECKING:
    from flexcage.render.shapes import ShapesOf


def _shapes() -> ShapesOf:
    from flexcage.render.ball_shapes import ball_shapes

    return ball_shapes


FAMILY = Family(
    name="ball",
    types=(AngularContactBallBearing, DeepGrooveBallBearing),
    shapes=_shapes,
)
