"""Two rows of balls in motion, as the equations of motion want them."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from flexcage.bearings.ball.motion import MOTION as BALLS
from flexcage.bearings.double_row_ball.model import (
    DoubleRowModel,
    build_double_row_model,
    double_row_work,
)
from flexcage.bearings.double_row_ball.neighbours import touch_in_rows
from flexcage.bearings.double_row_ball.residual import evaluate
from flexcage.bearings.double_row_ball.start import double_row_start
from flexcage.bearings.double_row_ball.tangent import linearise
from flexcage.system.equations import shared_equations
from flexcage.system.motion import Motion, parts_type

DoubleRowParts = parts_type("DoubleRowParts", DoubleRowModel, __name__)

_BALLS: Motion[Any] = BALLS
MOTION = replace(
    _BALLS,
    build_model=build_double_row_model,
    parts=DoubleRowParts,
    new_work=double_row_work,
    evaluate=evaluate,
    separate=(shared_equations, touch_in_rows),
    uncaged=((shared_equations, touch_in_rows), ()),
    linearise=linearise,
    start=double_row_start,
)
