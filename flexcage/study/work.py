"""What a worker does: one case from its text to its folder. Safe to call twice, and to be killed.

A lock on the case keeps two processes from computing the same one; the lock of a killed process
is free. Whoever gets it goes on from the last block that the other had committed.
"""

from __future__ import annotations

import logging
import shutil
import time
from collections.abc import Mapping
from contextlib import nullcontext
from dataclasses import dataclass, field, replace
from functools import partial
from pathlib import Path
from typing import Any, Protocol

from flexcage.case import Case, load_case, load_extension
from flexcage.case.extensions import sources
from flexcage.compiling import kernels_of
from flexcage.core import kernel_marks
from flexcage.core.errors import EnvironmentLacks, FlexcageError, InputError
from flexcage.core.threads import on_one_core
from flexcage.mesh.options import MeshOptions
from flexcage.run import Run
from flexcage.run.folder import was_written, write_case
from flexcage.run.foreseen import reported_at_once
from flexcage.simulate import load_run, simulate
from flexcage.stages import cage_mesh, cage_reduction, keep_at_hand, keep_mesh_at_hand
from flexcage.study.about import plain
from flexcage.study.case_row import CaseRow, Failure
from flexcage.study.folder import Folder
from flexcage.study.origin import Origin, this_one
from flexcage.study.outputs import beyond_summary, figures_of, lacking, late_figures, needs_stress
from flexcage.study.plan import Plan, Planned
from flexcage.study.progress import ReportedProgress, stage_reporter

log = logging.getLogger(__name__)


class Keeper(Protocol):
    """What is kept of a finished run elsewhere than in its study, before the run may go: data that
    a worker receives, and that has a content hash."""

    def has(self) -> bool:
        """Is it there already?"""

    def keep(self, run: Run, row: CaseRow) -> None:
        """Write it, in one move."""


@dataclass(frozen=True)
class Order:
    """One case as a worker receives it."""

    hash: str
    text: str  # the case, canonical TOML
    folder: str  # of the study, absolute
    beyond: tuple[str, ...]  # outputs that no summary holds
    stress: bool  # whether any output needs the cage's
    use: tuple[str, ...]  # extensions to load
    keep: str
    values: Mapping[str, Any]  # that the study's axes gave, by path
    origin: Origin = field(default_factory=this_one)  # the flexcage that planned it
    keeper: Keeper | None = None


def order_of(plan: Plan, planned: Planned, folder: Path, keeper: Keeper | None = None) -> Order:
    """What a worker needs to compute a planned case."""
    return Order(
        hash=planned.hash,
        text=plan.case(planned).to_toml(),
        folder=str(folder),
        beyond=beyond_summary(plan.study.outputs),
        stress=needs_stress(plan.study.outputs),
        use=sources(),
        keep=plan.study.keep,
        values=plain(planned.point.values),
        keeper=keeper,
    )


@on_one_core
def do_case(order: Order, *prepared: object) -> str:
    """Compute what the case lacks. Returns "done" or "failed"; the rest is in the folder.

    ``prepared`` only makes the call wait for what it shares with others.
    """
    import filelock

    folder = Folder(order.folder)
    with filelock.FileLock(folder.lock(order.hash)):
        try:
            with reported_at_once(()):  # the study told it of all its cases
                _complete(order, folder)
        except Exception as exc:
            folder.write_failure(order.hash, _failure(exc))
            return "failed"
        folder.lock(order.hash).unlink(missing_ok=True)  # who waits for it finds the case done
        return "done"


@on_one_core
def prepare(order: Order) -> None:
    """Make the modes that cases share, so that they are in the cache when those begin.

    A failure here is left to the cases: it becomes their own.
    """
    stage_reporter(order.hash)("mesh and modes", None)
    try:
        case = _case_of(order)
        keep_at_hand(cage_reduction(case, cage_mesh(case)))
    except Exception:
        return


def _complete(order: Order, folder: Folder) -> None:
    row, keeper = folder.row(order.hash), order.keeper
    missing = order.beyond if row is None else lacking(order.beyond, row.figures)
    kept = keeper is None or keeper.has()
    if row is not None and not missing and kept:
        return
    _load(order)
    if row is not None and folder.has_run(order.hash):  # only outputs were added
        _complete_from_run(order, folder, row, missing)
    elif keeper is not None and kept:  # killed before it had its name; or the study was removed
        folder.finish_begun(order.hash)
    else:
        _compute(order, folder)


def _complete_from_run(
    order: Order, folder: Folder, row: CaseRow, missing: tuple[str, ...]
) -> None:
    """Add outputs, and what is kept elsewhere, from the run of a finished case."""
    run = load_run(folder.case(order.hash))
    if missing:
        figures = {**row.figures, **late_figures(run, missing)}
        row = replace(row, figures=figures, warnings=run.warnings)
        folder.write_row(folder.case(order.hash), row)
    if order.keeper is not None and not order.keeper.has():
        order.keeper.keep(run, row)


def _compute(order: Order, folder: Folder) -> None:
    begin = time.process_time()
    case = _case_of(order)
    report = stage_reporter(order.hash)
    report("kernels", None)
    compile_kernels(case)
    part = folder.part(order.hash)
    run = _march(case, part, order, partial(ReportedProgress, report))
    keep_at_hand(run.cage)
    if case.cage is not None:
        keep_mesh_at_hand(case, run.mesh)
    figures = figures_of(run, order.beyond)
    seconds = time.process_time() - begin
    row = CaseRow(order.hash, seconds, figures, run.warnings, order.values, this_one())
    folder.write_row(part, row)
    if order.keeper is not None:
        order.keeper.keep(run, row)
    folder.finish(order.hash)


def _load(order: Order) -> None:
    """Load the extensions that the study was run with."""
    for source in order.use:
        load_extension(source)


def _case_of(order: Order) -> Case:
    """The case, which must be the same here as where it was planned."""
    if order.origin != this_one():
        raise InputError(
            f"The study was planned by flexcage {order.origin}, and the worker has "
            f"{this_one()}; install the same on both."
        )
    _load(order)
    case = load_case(order.text)
    if case.hash != order.hash:
        raise InputError(
            f"The case has the hash {order.hash} where it was planned and {case.hash} on the "
            "worker: an extension or a mesh file differs there."
        )
    return case


def _march(case: Case, part: Path, order: Order, progress: Any) -> Run:
    if order.keep == "runs":
        where = part.parent.parent
        return run_in(part, case, study=where, stress=order.stress, progress=progress)
    write_case(part, case)
    return simulate(case, stress=order.stress, progress=progress)


def run_in(folder: Path, case: Case, *, progress: Any = None, **how: Any) -> Run:
    """Run the case in its folder, from the last committed block if there is one; ``how`` as
    ``simulate`` takes it.

    A beginning that this flexcage cannot go on with, another one's or a damaged one, is made anew.
    """
    if was_written(folder):
        try:
            return simulate(case, out=folder, resume=True, progress=progress, **how)
        except InputError as error:
            log.warning("the run begun in '%s' begins anew: %s", folder, error)
            shutil.rmtree(folder)
    return simulate(case, out=folder, progress=progress, **how)


def compile_kernels(case: Case) -> None:
    """Compile the kernels once a machine: workers that need them at the same time wait."""
    import filelock

    if kernel_marks.kernels_cached(kernels_of(case)):
        return
    lock = kernel_marks.compiling_lock(kernels_of(case))
    with nullcontext() if lock is None else filelock.FileLock(lock):
        if not kernel_marks.kernels_cached(kernels_of(case)):
            simulate(_shortest(case))


def _shortest(case: Case) -> Case:
    """A case that needs the same kernels and takes the least time."""
    short = case.replace("solver.duration", 2.0 / case.output.rate)
    if case.cage is None:
        return short
    rigid = short.replace("cage.model", "rigid").replace("defects", ())
    return rigid.replace("mesh", MeshOptions(fineness="coarse"))


def _failure(exc: Exception) -> Failure:
    """What to keep of an error. What the machine lacked may be there the next time."""
    passing = isinstance(exc, (OSError, MemoryError, EnvironmentLacks))
    if isinstance(exc, FlexcageError):
        return Failure(type(exc).__name__, str(exc), final=not passing)
    return Failure(type(exc).__name__, f"{type(exc).__name__}: {exc}", final=not passing)
