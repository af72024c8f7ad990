"""Double row ball bearings: angular contact, and self-aligning."""

from __future__ import annotations

from flexcage.bearings.double_row_ball.angular_contact import DoubleRowAngularContactBallBearing
from flexcage.bearings.double_row_ball.rules import RULES
from flexcage.bearings.double_row_ball.self_aligning import SelfAligningBallBearing
from flexcage.bearings.family import Family
from flexcage.bearings.two_rows import rows_of

# specs that ``flexcage.spec`` shows
__all__ = ["DoubleRowAngularContactBallBearing", "SelfAligningBallBearing"]

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
    inside=None,
    built_on="ball",
)
