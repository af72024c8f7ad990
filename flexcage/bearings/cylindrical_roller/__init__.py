"""Single-row cylindrical roller bearings."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flexcage.bearings.family import Family
from flexcage.geometry.cylindrical_roller import OTHER_DESIGNS, RollerBearing

if TYPE_CHECKING:
    from flexcage.integrate.recording import Recording
    from flexcage.render.shapes import ShapesOf
    from flexcage.system.motion import Motion
    from flexcage.system.statics.elements import ElementsOf


def _statics() -> ElementsOf:
    from flexcage.system.statics.rollers import rollers_of

    return rollers_of


def _motion() -> Motion[Any]:
    from flexcage.system.roller_motion import MOTION

    return MOTION


def _recording() -> Recording[Any]:
    from flexcage.integrate.roller_recording import RECORDING

    return RECORDING


def _shapes() -> ShapesOf:
    from flexcage.render.roller_shapes import roller_shapes

    return roller_shapes


FAMILY = Family(
    name="cylindrical_roller",
    types=(RollerBearing,),
    statics=_statics,
    motion=_motion,
    recording=_recording,
    shapes=_shapes,
    other_designs=OTHER_DESIGNS,
)
