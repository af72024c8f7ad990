"""Figures of the solver's work and of wall times."""

from __future__ import annotations

from functools import partial
from math import isfinite

from flexcage.core.timing import Stages
from flexcage.results.figures.figure import FigureTable, Found, Mark
from flexcage.solve.contract import Effort

_LEAST_STEP = "least over the run, by the spectral radius"
_NO_TIME = 1e-3  # s: a stage that is shorter had nothing to do


def _count(key: str, rare: bool, effort: Effort) -> Found | None:
    count = effort.counts.get(key)
    return None if count is None else Found(count, idle=rare and not count)


def _stable_step(effort: Effort) -> Found | None:
    step = effort.stable_step
    return Found(step, _LEAST_STEP) if isfinite(step) else None


_COUNTS: tuple[tuple[str, str, str, *tuple[Mark, ...]], ...] = (
    ("steps", "Steps", "accepted", "effort"),
    ("explicit_steps", "Explicit steps", "of them, by the explicit method", "rare"),
    ("residuals", "Residuals", "evaluations of the equations"),
    ("jacobians", "Jacobians", "", "rare"),
    ("factorisations", "Factorisations", "of Newton's matrix", "rare"),
    ("failed_error_tests", "Failed error tests", "steps repeated for their error", "effort"),
    ("failed_newton", "Failed Newton iterations", "", "effort", "rare"),
    ("repeated_blocks", "Blocks done again",
     "with a tenth of the tolerance or less, as their energy did not balance", "effort", "rare"),
)  # fmt: skip
SOLVER = FigureTable[Effort]("Solver")
for _key, _title, _meaning, *_marks in _COUNTS:
    SOLVER.add(_key, _title, "", _meaning, *_marks, take=partial(_count, _key, "rare" in _marks))
SOLVER.add(
    "stable_step", "Stability bound of explicit steps", "us", _LEAST_STEP, take=_stable_step,
)  # fmt: skip


def _wall(stage: str, stages: Stages) -> Found | None:
    if stage not in stages:
        return None
    return Found(stages[stage], idle=stages[stage] < _NO_TIME)


def add_wall(table: FigureTable[Stages], stage: str, *marks: Mark) -> None:
    """Add the wall time of a stage."""
    title = f"Wall time, {stage.replace('_', ' ')}"
    table.add(f"wall_{stage}", title, "s", "of this stage", *marks, take=partial(_wall, stage))


def is_wall_time(name: str) -> bool:
    """Whether a figure is a wall time, which another computer's run has otherwise."""
    return name.startswith("wall_")


TIMES = FigureTable[Stages]("Wall time")
for _stage in ("mesh", "modes", "kernels", "start"):
    add_wall(TIMES, _stage)
add_wall(TIMES, "solve", "effort")
for _stage in ("cage", "rings", "rivet_joint", "pictures"):
    add_wall(TIMES, _stage, "later")
TIMES.add(
    "wall_total", "Wall time, total", "s", "of the whole command", "brief",
    take=lambda stages: stages.total,
)  # fmt: skip
