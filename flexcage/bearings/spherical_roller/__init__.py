"""Spherical roller bearings."""

from __future__ import annotations

from flexcage.bearings.family import Family
from flexcage.bearings.spherical_roller import slots
from flexcage.bearings.spherical_roller.bearing import SphericalRollerBearing
from flexcage.bearings.spherical_roller.rules import RULES

# the spec that ``flexcage.spec`` shows
__all__ = ["SphericalRollerBearing"]

FAMILY = Family(
    name="spherical_roller",
    types=(SphericalRollerBearing,),
    rules=RULES,
    statics=lambda: slots.statics,
    motion=lambda: slots.motion,
    recording=lambda: slots.recording,
    variables=lambda: slots.variables,
    speed=lambda: slots.speed,
    figures=lambda: slots.figures,
    rubbing=lambda: slots.rubbing,
    shapes=lambda: slots.shapes,
    inside=lambda: slots.inside,
    losses=lambda: slots.losses,
    catalogue=f"{__name__}.catalogue",
    built_on="tapered_roller",
)
