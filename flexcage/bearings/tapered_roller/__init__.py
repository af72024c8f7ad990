"""Single-row tapered roller bearings."""

from __future__ import annotations

from flexcage.bearings.family import Family
from flexcage.bearings.tapered_roller import slots
from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing
from flexcage.bearings.tapered_roller.rules import RULES
from flexcage.geometry.rollers import RollerProfile

# specs that ``flexcage.spec`` shows
__all__ = ["RollerProfile", "TaperedRollerBearing"]

FAMILY = Family(
    name="tapered_roller",
    types=(TaperedRollerBearing,),
    rules=RULES,
    statics=lambda: slots.statics,
    motion=lambda: slots.motion,
    recording=lambda: slots.recording,
    variables=lambda: slots.variables,
    speed=lambda: slots.speed,
    figures=lambda: slots.figures,
    rubbing=lambda: slots.rubbing,
    shapes=lambda: slots.shapes,
    losses=lambda: slots.losses,
    inside=lambda: slots.inside,
    built_on="cylindrical_roller",
    catalogue="flexcage.bearings.tapered_roller.catalogue",
)
