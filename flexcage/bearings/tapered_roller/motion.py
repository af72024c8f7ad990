"""Tapered rollers in motion, as the equations of motion want them."""

from __future__ import annotations

from typing import Any

from flexcage.bearings.cylindrical_roller.scales import roller_weights
from flexcage.bearings.tapered_roller.model import (
    TaperedModel,
    build_tapered_model,
    tapered_work,
)
from flexcage.bearings.tapered_roller.neighbours import touch_next
from flexcage.bearings.tapered_roller.pockets import cone_pockets
from flexcage.bearings.tapered_roller.residual import evaluate
from flexcage.bearings.tapered_roller.start import tapered_start
from flexcage.modes.basis import FACES
from flexcage.system.equations import shared_equations
from flexcage.system.motion import Motion, parts_type

TaperedParts = parts_type("TaperedParts", TaperedModel, __name__)

_WEIGHTS: Any = roller_weights
MOTION = Motion(
    build_model=build_tapered_model,
    parts=TaperedParts,
    new_work=tapered_work,
    evaluate=evaluate,
    separate=(cone_pockets, shared_equations),
    faces=FACES,
    uncaged=((touch_next, shared_equations), ("next roller",)),
    ribs=("small rib", "large rib"),
    start=tapered_start,
    error_weights=_WEIGHTS,
    implicit_share=1.0,
)
