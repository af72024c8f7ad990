"""Cylindrical rollers in motion, as the equations of motion want them."""

from __future__ import annotations

from flexcage.modes.basis import FACES
from flexcage.system.motion import Motion, parts_type
from flexcage.system.roller_model import RollerModel, build_roller_model, roller_work
from flexcage.system.roller_pockets import roller_pockets
from flexcage.system.roller_residual import evaluate
from flexcage.system.roller_scales import roller_weights
from flexcage.system.roller_start import roller_start
from flexcage.system.rows import shared_rows

RollerParts = parts_type("RollerParts", RollerModel, __name__)

MOTION = Motion(
    family="cylindrical_roller",
    element="roller",
    build_model=build_roller_model,
    parts=RollerParts,
    new_work=roller_work,
    evaluate=evaluate,
    apart=(roller_pockets, shared_rows),
    implicit=True,
    faces=FACES,
    ribs=("rib +x", "rib -x"),
    start=roller_start,
    error_weights=roller_weights,
)
