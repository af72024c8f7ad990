"""Single-row cylindrical and needle roller bearings."""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller import slots
from flexcage.bearings.cylindrical_roller.bearing import OTHER_DESIGNS, RollerBearing
from flexcage.bearings.cylindrical_roller.needle import (
    DrawnCupNeedleRollerBearing,
    NeedleRollerBearing,
)
from flexcage.bearings.cylindrical_roller.rules import RULES
from flexcage.bearings.cylindrical_roller.spot import RollerSpot
from flexcage.bearings.family import Family
from flexcage.geometry.rollers import RollerProfile

# specs that ``flexcage.spec`` shows
__all__ = [
    "DrawnCupNeedleRollerBearing",
    "NeedleRollerBearing",
    "RollerBearing",
    "RollerProfile",
    "RollerSpot",
]

FAMILY = Family(
    name="cylindrical_roller",
    types=(RollerBearing, NeedleRollerBearing, DrawnCupNeedleRollerBearing),
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
    other_designs=OTHER_DESIGNS,
)
