"""Barrels in motion, as the equations of motion want them."""

from __future__ import annotations

from typing import Any

from flexcage.bearings.cylindrical_roller.scales import roller_weights
from flexcage.bearings.spherical_roller.model import (
    SphericalModel,
    build_spherical_model,
    spherical_work,
)
from flexcage.bearings.spherical_roller.neighbours import touch_in_rows
from flexcage.bearings.spherical_roller.pockets import barrel_pockets
from flexcage.bearings.spherical_roller.residual import evaluate
from flexcage.bearings.spherical_roller.start import spherical_start
from flexcage.modes.basis import FACES
from flexcage.system.equations import shared_equations
from flexcage.system.motion import Motion, parts_type

SphericalParts = parts_type("SphericalParts", SphericalModel, __name__)

_WEIGHTS: Any = roller_weights
MOTION = Motion(
    build_model=build_spherical_model,
    parts=SphericalParts,
    new_work=spherical_work,
    evaluate=evaluate,
    separate=(barrel_pockets, shared_equations),
    faces=FACES,
    uncaged=((touch_in_rows, shared_equations), ("next roller",)),
    ribs=(),
    start=spherical_start,
    error_weights=_WEIGHTS,
    implicit_share=1.0,
)
