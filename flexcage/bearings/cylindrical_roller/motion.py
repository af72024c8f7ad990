"""Cylindrical rollers in motion, as the equations of motion want them."""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.model import RollerModel, build_roller_model, roller_work
from flexcage.bearings.cylindrical_roller.neighbours import touch_next
from flexcage.bearings.cylindrical_roller.pockets import roller_pockets
from flexcage.bearings.cylindrical_roller.residual import evaluate
from flexcage.bearings.cylindrical_roller.scales import roller_weights
from flexcage.bearings.cylindrical_roller.start import roller_start
from flexcage.modes.basis import FACES
from flexcage.system.equations import shared_equations
from flexcage.system.motion import Motion, parts_type

RollerParts = parts_type("RollerParts", RollerModel, __name__)


MOTION = Motion(
    build_model=build_roller_model,
    parts=RollerParts,
    new_work=roller_work,
    evaluate=evaluate,
    separate=(roller_pockets, shared_equations),
    faces=FACES,
    uncaged=((touch_next, shared_equations), ("next roller",)),
    ribs=("rib +x", "rib -x", "counter rib +x", "counter rib -x"),
    start=roller_start,
    error_weights=roller_weights,
    implicit_share=1.0,
)
