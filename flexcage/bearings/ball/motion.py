"""Balls in motion, as the equations of motion want them."""

from __future__ import annotations

from flexcage.bearings.ball.model import BallModel, ball_work, build_ball_model
from flexcage.bearings.ball.neighbours import touch_neighbours
from flexcage.bearings.ball.residual import evaluate
from flexcage.bearings.ball.scales import ball_weights, implicit_ball_weights
from flexcage.bearings.ball.start import ball_start
from flexcage.bearings.ball.tangent import linearise
from flexcage.system.equations import shared_equations
from flexcage.system.motion import Motion, parts_type

BallParts = parts_type("BallParts", BallModel, __name__)


MOTION = Motion(
    build_model=build_ball_model,
    parts=BallParts,
    new_work=ball_work,
    evaluate=evaluate,
    separate=(shared_equations, touch_neighbours),
    faces=("pocket",),
    uncaged=((shared_equations, touch_neighbours), ()),
    ribs=("next ball",),
    start=ball_start,
    error_weights=ball_weights,
    linearise=linearise,
    implicit_share=3.5,
    implicit_weights=implicit_ball_weights,
)
