"""Single-row cylindrical roller bearings."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from flexcage.bearings.cylindrical_roller.bearing import (
    OTHER_DESIGNS,
    RollerBearing,
    RollerProfile,
)
from flexcage.bearings.cylindrical_roller.spot import RollerSpot
from flexcage.bearings.family import Family

# specs that ``flexcage.spec`` shows
__all__ = ["RollerBearing", "RollerProfile", "RollerSpot"]

if TYPE_CHECKING:
    from flexcage.geometry.inside import Inside
    from flexcage.geometry.ring import SectionsOf
    from flexcage.integrate.recording import Recording
    from flexcage.render.shapes import ShapesOf
    from flexcage.results.figures import OwnFigures
    from flexcage.results.metrics import ElementSpeed
    from flexcage.results.registry import OwnVariables
    from flexcage.stress.rubbing import Rub
    from flexcage.system.motion import Motion
    from flexcage.system.statics.elements import ElementsOf


def _variables() -> OwnVariables:
    from flexcage.bearings.cylindrical_roller.variables import VARIABLES

    return VARIABLES


def _speed() -> ElementSpeed:
    from flexcage.bearings.cylindrical_roller.slip import SPEED

    return SPEED


def _figures() -> OwnFigures:
    from flexcage.bearings.cylindrical_roller.figures import FIGURES

    return FIGURES


def _rubbing() -> Rub:
    from flexcage.bearings.cylindrical_roller.rubbing import rubbing

    return rubbing


def _statics() -> ElementsOf:
    from flexcage.bearings.cylindrical_roller.statics import rollers_of

    return rollers_of


def _motion() -> Motion[Any]:
    from flexcage.bearings.cylindrical_roller.motion import MOTION

    return MOTION


def _recording() -> Recording[Any]:
    from flexcage.bearings.cylindrical_roller.recording import RECORDING

    return RECORDING


def _shapes() -> ShapesOf:
    from flexcage.bearings.cylindrical_roller.shapes import roller_shapes

    return roller_shapes


def _inside() -> Inside:
    from flexcage.bearings.cylindrical_roller.inside import INSIDE

    return INSIDE


def _rings() -> SectionsOf:
    from flexcage.bearings.cylindrical_roller.rings import roller_rings

    return roller_rings


FAMILY = Family(
    name="cylindrical_roller",
    types=(RollerBearing,),
    variables=_variables,
    speed=_speed,
    figures=_figures,
    rubbing=_rubbing,
    statics=_statics,
    motion=_motion,
    recording=_recording,
    shapes=_shapes,
    inside=_inside,
    rings=_rings,
    other_designs=OTHER_DESIGNS,
)
