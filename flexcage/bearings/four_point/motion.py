"""Balls between races of two arcs in motion, as the equations of motion want them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from flexcage.bearings.ball.motion import MOTION as BALLS
from flexcage.bearings.four_point.model import (
    RIBS,
    FourPointModel,
    build_four_point_model,
    four_point_work,
)
from flexcage.bearings.four_point.residual import evaluate
from flexcage.bearings.four_point.start import four_point_start
from flexcage.bearings.four_point.tangent import linearise
from flexcage.system.motion import Motion, parts_type

FourPointParts = parts_type("FourPointParts", FourPointModel, __name__)

_BALLS: Motion[Any] = BALLS
MOTION = replace(
    _BALLS,
    build_model=build_four_point_model,
    parts=FourPointParts,
    new_work=four_point_work,
    evaluate=evaluate,
    linearise=linearise,
    ribs=RIBS,
    start=four_point_start,
)
