"""The corridor: one call a stage, from what is asked to what happened.

case -> mesh -> modes -> bodies -> contacts and system -> start -> solve -> results (a Run).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from flexcage.case import Case
from flexcage.core.binding import expect
from flexcage.core.locks import held
from flexcage.core.timing import Stages
from flexcage.results.recording import Recorder
from flexcage.run import Run, check_assembly, check_written, has_begun, open_folder
from flexcage.stages import (
    assembled_start,
    begin_compiling,
    build_bearing,
    cage_mesh,
    cage_reduction,
    run_store,
)


def simulate(
    case: Case, *, out: str | Path | None = None, resume: bool = False, progress: Any = None
) -> Run:
    """Simulate a case; results are kept in memory, or in the folder ``out`` as the run goes.

    ``resume`` goes on with a run that stopped, from its last committed block. ``progress`` is a
    context like ``core.progress.Progress``. Raises InputError for an impossible case and
    RunFailed for a run that cannot go on, with what was computed kept.
    """
    expect(case, Case, "case", "flexcage.load_case reads one from a file")
    if out is None:
        return _simulated(case, None, resume, progress)
    if resume:
        check_written(Path(out))
    with held(Path(out), inside=True):
        return _simulated(case, Path(out), resume, progress)


def _simulated(case: Case, folder: Path | None, resume: bool, progress: Any) -> Run:
    stages = Stages(progress)
    if folder is not None and resume:
        resume = has_begun(folder, case)
    compiling = begin_compiling(case.bearing.element)
    mesh = stages.named("mesh", cage_mesh, case)
    cage = stages.named("modes", cage_reduction, case, mesh)
    bearing = stages.named("kernels", build_bearing, case, mesh, cage, compiling)
    start = stages("start", assembled_start, case, bearing, stages.progress)
    check_assembly(case, mesh, cage, start)
    store = run_store(case, bearing, folder, resume=resume)
    run = Run(case, store, folder, mesh, cage, start, stages)
    recorder = Recorder(bearing, start, store, solver=case.solver, output=case.output)
    stages("solve", recorder.march, progress)
    return run.finish(recorder)


def load_run(folder: str | Path, *, progress: Any = None) -> Run:
    """A stored run, finished or not, for looking at and drawing; ``progress`` as above."""
    case, store = open_folder(Path(folder))
    stages = Stages(progress)
    mesh = stages.named("mesh", cage_mesh, case)
    cage = stages.named("modes", cage_reduction, case, mesh)
    return Run(case, store, Path(folder), mesh, cage, stages=stages)
