"""Double row cylindrical roller bearings."""

from __future__ import annotations

from flexcage.bearings.double_row_roller import slots
from flexcage.bearings.double_row_roller.bearing import DoubleRowRollerBearing
from flexcage.bearings.double_row_roller.rules import RULES
from flexcage.bearings.family import Family

__all__ = ["DoubleRowRollerBearing"]  # the spec that ``flexcage.spec`` shows

FAMILY = Family(
    name="double_row_roller",
    types=(DoubleRowRollerBearing,),
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
    built_on="cylindrical_roller",
)
