"""Ball bearings with two arcs a race: four-point contact, and split inner rings."""

from __future__ import annotations

from flexcage.bearings.family import Family
from flexcage.bearings.four_point import slots
from flexcage.bearings.four_point.bearing import FourPointContactBearing
from flexcage.bearings.four_point.rules import RULES

__all__ = ["FourPointContactBearing"]  # specs that ``flexcage.spec`` shows

FAMILY = Family(
    name="four_point",
    types=(FourPointContactBearing,),
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
    built_on="ball",
)
