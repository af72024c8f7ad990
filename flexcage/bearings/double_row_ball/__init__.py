"""Double row ball bearings: angular contact, and self-aligning."""

from __future__ import annotations

from typing import TYPE_CHECKING

from flexcage.bearings.double_row_ball.angular_contact import DoubleRowAngularContactBallBearing
from flexcage.bearings.double_row_ball.rules import RULES
from flexcage.bearings.double_row_ball.self_aligning import SelfAligningBallBearing
from flexcage.bearings.family import Family
from flexcage.bearings.two_rows import rows_of

if TYPE_CHECKING:
    from flexcage.geometry.inference import Inference

# specs that ``flexcage.spec`` shows
__all__ = ["DoubleRowAngularContactBallBearing", "SelfAligningBallBearing"]


def _inside() -> Inference:
    from flexcage.bearings.double_row_ball.inference import INFERENCE

    return INFERENCE


FAMILY = Family(
    name="double_row_ball",
    types=(DoubleRowAngularContactBallBearing, SelfAligningBallBearing),
    rules=RULES,
    statics=lambda: rows_of,
    motion=None,
    recording=None,
    variables=None,
    speed=None,
    figures=None,
    rubbing=None,
    shapes=None,
    inside=_inside,
    catalogue=f"{__name__}.catalogue",
    built_on="ball",
)
