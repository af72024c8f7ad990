"""Double row ball bearings: angular contact, and self-aligning."""

from __future__ import annotations

from flexcage.bearings.double_row_ball import slots
from flexcage.bearings.double_row_ball.angular_contact import DoubleRowAngularContactBallBearing
from flexcage.bearings.double_row_ball.rules import RULES
from flexcage.bearings.double_row_ball.self_aligning import SelfAligningBallBearing
from flexcage.bearings.family import Family

# specs that ``flexcage.spec`` shows
__all__ = ["DoubleRowAngularContactBallBearing", "SelfAligningBallBearing"]

FAMILY = Family(
    name="double_row_ball",
    types=(DoubleRowAngularContactBallBearing, SelfAligningBallBearing),
    rules=RULES,
    statics=lambda: slots.statics,
    motion=lambda: slots.motion,
    recording=lambda: slots.recording,
    variables=lambda: slots.variables,
    speed=lambda: slots.speed,
    figures=lambda: slots.figures,
    rubbing=lambda: slots.rubbing,
    losses=lambda: slots.losses,
    shapes=lambda: slots.shapes,
    inside=lambda: slots.inside,
    catalogue=f"{__name__}.catalogue",
    built_on="ball",
)
