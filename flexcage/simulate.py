"""The corridor: one call a stage, from what is asked to what happened.

case -> mesh -> modes -> bodies -> contacts and system -> start -> solve -> results (a Run).
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

from flexcage.bearings import recording_of
from flexcage.case import Case
from flexcage.compiling import begin_compiling, build_bearing
from flexcage.core.binding import expect, path_of
from flexcage.core.locks import held
from flexcage.core.output_folders import check_no_file
from flexcage.core.timing import Stages
from flexcage.integrate.integration import integration_of
from flexcage.results.store import MemoryRunStore
from flexcage.run import Run, warnings_at_start
from flexcage.run.cost import note_pace, report_cost
from flexcage.run.folder import begun_store, check_written, open_folder, report_unfinished
from flexcage.run.foreseen import already_reported, report_before
from flexcage.run.sensors import check_places
from flexcage.run.storing import run_store, stored_cage
from flexcage.stages import assembled_start, made_cage


def simulate(
    case: Case,
    *,
    out: str | Path | None = None,
    resume: bool = False,
    study: str | Path | None = None,
    stress: bool = True,
    other_version: bool = False,
    progress: Any = None,
) -> Run:
    """Simulate a case; results are kept in memory, or in the folder ``out`` as the run goes.

    ``resume`` goes on with a run that stopped, from its last committed block; ``other_version``
    allows that with one that a flexcage of other physics began. ``study`` is the
    folder of a study whose runs share the files of their cages. Without ``stress``, the
    cage's is computed only when asked for, unless it may exceed the proof stress. ``progress`` is a
    context like ``core.progress.Progress``. Raises InputError for an impossible case and RunFailed
    for a run that cannot go on, with what was computed kept.
    """
    expect(case, Case, "case", "flexcage.load_case reads one from a file")
    if out is None:
        return _simulated(case, None, None, None, stress, progress)
    folder = path_of(out, "out")
    check_no_file(folder)
    if resume:
        check_written(folder)
    with held(folder, inside=True):
        begun = begun_store(folder, case, other_version=other_version) if resume else None
        return _simulated(case, folder, begun, study, stress, progress)


def _simulated(
    case: Case,
    folder: Path | None,
    begun: MemoryRunStore | None,
    study: str | Path | None,
    stress: bool,
    progress: Any,
) -> Run:
    stages = Stages(progress)
    foreseen = report_before(case, stress=stress)
    if not begun:
        report_cost(case, folder, quiet=already_reported())
    compiling = begin_compiling(case)
    if folder and begun:
        mesh, cage = stored_cage(case, begun, folder, stages)
    else:
        mesh, cage = made_cage(case, stages)
    bearing = stages.named("kernels", build_bearing, case, mesh, cage, compiling)
    check_places(case, cage)
    start = stages("start", assembled_start, case, bearing, stages.progress)
    warned = (*foreseen, *warnings_at_start(case, mesh, cage, start))
    store = begun or run_store(
        case, bearing, (mesh, cage), folder, study=Path(study) if study else None, warned=warned
    )
    run = Run(case, store, folder, mesh, cage, start, stages)
    integration = integration_of(
        bearing, recording_of(case.bearing), start, store, solver=case.solver, output=case.output
    )
    stages("solve", integration.march, progress)
    note_pace(case, *integration.pace)
    return run.finish(integration.effort, stress=stress)


def load_run(folder: str | Path, *, progress: Any = None) -> Run:
    """A stored run, finished or not, for looking at and drawing; ``progress`` as above.

    Needs nothing but the folder: the cage is the one that the run had. An edit of its case.toml is
    ignored with a warning.
    """
    path = path_of(folder, "run")
    case, store, edited = open_folder(path)
    report_unfinished(path, store, case.solver.duration)
    stages = Stages(progress)
    mesh, cage = stored_cage(case, store, path, stages)
    return Run(case, store, path, mesh, cage, stages=stages, edited=edited)
