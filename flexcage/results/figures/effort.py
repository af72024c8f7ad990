"""Figures of the solver's work and of wall times."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from math import isfinite
from typing import Any

from flexcage.core.timing import Stages
from flexcage.results.figures.figure import BRIEF, EFFORT, LATER, RARE, Facts, Found, Table
from flexcage.solve.contract import Effort

_NO_TIME = 1e-3  # s: a stage that is shorter had nothing to do


@dataclass(frozen=True, eq=False)
class Solved(Facts):
    """What the integration of a run took."""

    effort: Effort


SOLVER = Table[Solved]("Solver")


def _count(key: str, rare: bool, solved: Solved) -> Found | None:
    count = solved.effort.counts.get(key)
    return None if count is None else Found(count, idle=rare and not count)


for _key, _title, _meaning, *_marks in (
    ("steps", "Steps", "accepted", EFFORT),
    ("explicit_steps", "Explicit steps", "of them, by the explicit method", RARE),
    ("residuals", "Residuals", "evaluations of the equations"),
    ("jacobians", "Jacobians", "", RARE),
    ("factorisations", "Factorisations", "of Newton's matrix", RARE),
    ("failed_error_tests", "Failed error tests", "steps repeated for their error", EFFORT),
    ("failed_newton", "Failed Newton iterations", "", EFFORT, RARE),
    ("repeated_blocks", "Blocks done again",
     "with a tenth of the tolerance or less, as their energy did not balance", EFFORT, RARE),
):  # fmt: skip
    SOLVER.add(_key, _title, "", _meaning, *_marks, take=partial(_count, _key, RARE in _marks))


@SOLVER.figure(
    "Stability bound of explicit steps", "us", "least over the run, by the spectral radius"
)
def stable_step(solved: Solved) -> Found | None:
    step = solved.effort.stable_step
    return Found(step, "least over the run, by the spectral radius") if isfinite(step) else None


@dataclass(frozen=True, eq=False)
class Times(Facts):
    """Wall times of a run's stages."""

    stages: Stages


def _wall(stage: str, times: Times) -> Found | None:
    if stage not in times.stages:
        return None
    return Found(times.stages[stage], idle=times.stages[stage] < _NO_TIME)


def add_wall(table: Table[Any], stage: str, *marks: str) -> None:
    """Add the wall time of a stage."""
    title = f"Wall time, {stage.replace('_', ' ')}"
    table.add(f"wall_{stage}", title, "s", "of this stage", *marks, take=partial(_wall, stage))


TIMES = Table[Times]("Wall time")
for _stage in ("mesh", "modes", "kernels", "start"):
    add_wall(TIMES, _stage)
add_wall(TIMES, "solve", EFFORT)
for _stage in ("cage", "rings", "rivet_joint", "pictures"):
    add_wall(TIMES, _stage, LATER)


@TIMES.figure("Wall time, total", "s", "of the whole command", BRIEF)
def wall_total(times: Times) -> float:
    return times.stages.total
