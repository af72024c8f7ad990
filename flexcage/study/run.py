"""Running a study: what its folder lacks goes to the workers."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterable
from contextlib import ExitStack
from pathlib import Path
from typing import Any

from flexcage.core.binding import expect, path_of
from flexcage.core.progress import Silent
from flexcage.core.stopping import unwinding
from flexcage.run.cost import Cost
from flexcage.run.foreseen import report_foreseen
from flexcage.study.case_row import CaseRow
from flexcage.study.cluster import connect, default_workers, require_packages
from flexcage.study.desk import Crew, Desk, one_by_one
from flexcage.study.folder import Folder
from flexcage.study.origin import check_origins
from flexcage.study.outputs import beyond_summary, lacking, needs_stress
from flexcage.study.plan import Plan, Planned, make_plan
from flexcage.study.progress import TOPIC, Board
from flexcage.study.results import StudyResults
from flexcage.study.shards import gather, remove_empty, shards_in
from flexcage.study.spec import Study

log = logging.getLogger(__name__)


def run_study(
    study: Study,
    *,
    out: str | Path,
    workers: int | None = None,
    scheduler: Any = None,
    retry: bool = False,
    other_version: bool = False,
    progress: Callable[..., Any] | None = None,
) -> StudyResults:
    """Compute what the folder ``out`` lacks of a study, and gather its tables.

    Runs on ``workers`` processes of this machine (default: one a core), or on a Dask ``scheduler``,
    by its address or as a Dask cluster, whose certificates are then taken. Cases found in the
    folder are not computed again; ``retry`` tries those again that failed, and ``other_version``
    adds cases to those that a flexcage of other physics computed, which table and page then say.
    ``progress`` is a context like ``core.progress.Progress``. One process at a time runs a study in
    a folder.

    A case that fails is a row with its reason. Raises InputError for a mistake in the plan, a
    folder in which another process runs a study, or one whose cases are of other physics, before
    anything is computed, and RunFailed if the scheduler is lost; what is finished stays, and the
    tables show it.
    """
    expect(study, Study, "study", "flexcage.load_study reads one from a file")
    require_packages()
    plan = make_plan(study)
    folder = Folder(path_of(out, "out").resolve())
    check_physics(plan, folder, allowed=other_version)
    folder.prepare(plan)
    crew = Crew(workers, scheduler, retry=retry)
    return run_plan(plan, folder, crew, other_version=other_version, progress=progress)


def run_plan(
    plan: Plan,
    folder: Folder,
    crew: Crew,
    *,
    other_version: bool = False,
    progress: Callable[..., Any] | None = None,
) -> StudyResults:
    """Compute what the folder of a study and its shards lack of the plan that it was prepared for,
    and gather its tables."""
    with folder.held():
        take_shards(plan.cases, folder, other_version=other_version)
        try:
            compute(plan, folder, crew, progress)
        except BaseException:  # Ctrl-C as well: the tables show what is finished
            _try_to_write(folder)
            raise
        results = StudyResults(folder.path)
        results.write()
    return results


def take_shards(cases: Iterable[Planned], folder: Folder, *, other_version: bool = False) -> None:
    """Move what shards have computed of these cases to the folder of the study."""
    shards = shards_in(folder.path).values()
    if shards:
        gather(folder, map(Folder, shards), {c.hash for c in cases}, mixed=other_version)
        remove_empty(folder.path, shards)


def compute(
    plan: Plan, folder: Folder, crew: Crew, progress: Callable[..., Any] | None = None
) -> None:
    """Compute what the folder lacks of a plan."""
    todo = _lacking(plan, folder, crew)
    if todo:
        _report_before(plan, folder, todo, crew)
        with unwinding():  # Ctrl-C ends the workers
            _compute(plan, folder, todo, crew, progress)


def _report_before(plan: Plan, folder: Folder, todo: set[str], crew: Crew) -> None:
    """Log what is foreseen of the cases to compute, and what disk and time they will take."""
    cost = Cost(keeps=plan.study.keep == "runs")
    cases = (cost.counted(plan.case(planned)) for planned in plan.cases if planned.hash in todo)
    report_foreseen(cases, stress=needs_stress(plan.study.outputs))
    if crew.scheduler is None:
        workers = 1 if crew.alone else min(crew.workers or default_workers(), len(todo))
        cost.announce(folder.path, workers=workers, each=_seconds_each(plan, folder))


def _seconds_each(plan: Plan, folder: Folder) -> float | None:
    """Processor time [s] of a case, by those that are done; None before the first."""
    rows = (folder.row(planned.hash) for planned in plan.cases)
    seconds = [row.seconds for row in rows if row is not None]
    return sum(seconds) / len(seconds) if seconds else None


def _compute(
    plan: Plan,
    folder: Folder,
    todo: set[str],
    crew: Crew,
    progress: Callable[..., Any] | None,
) -> None:
    """Compute the cases ``todo``."""
    total, done = len(plan.cases), len(plan.cases) - len(todo)
    numbers = {c.hash: k for k, c in enumerate(plan.cases) if c.hash in todo}
    with ExitStack() as stack:
        client = None if crew.alone else stack.enter_context(connect(crew.scheduler, crew.workers))
        bar = stack.enter_context((progress or Silent)(total, "cases"))
        bar.begin_at(done)
        board = Board(bar, numbers, total, done)
        stack.callback(board.close)
        if client is None:
            names = one_by_one(plan, folder, crew, todo)
        else:
            client.subscribe_topic(TOPIC, board.on_event)
            names = Desk(client, plan, folder, crew, board).work_off(todo)
        for name in names:
            board.finished(name)


def _try_to_write(folder: Folder) -> None:
    """Write the tables of a study that ended early; what ended it matters more than a failure."""
    try:
        StudyResults(folder.path).write()
    except Exception as exc:
        log.warning("the tables were not written: %s", exc)


def check_physics(plan: Plan, folder: Folder, *, allowed: bool) -> None:
    """Refuse, or say, that cases of a plan would join finished ones of other physics."""
    rows = {planned.hash: folder.row(planned.hash) for planned in plan.cases}
    done = [row.origin for row in rows.values() if row is not None]
    beyond = beyond_summary(plan.study.outputs)
    new = sum(not _has(row, beyond) for row in rows.values())
    if mixed := check_origins(done, new=new, folder=folder.path, allowed=allowed):
        log.warning(mixed)


def _lacking(plan: Plan, folder: Folder, crew: Crew) -> set[str]:
    """Hashes of the cases to compute, or to complete."""
    todo, beyond = set(), beyond_summary(plan.study.outputs)
    for planned in plan.cases:
        failure = folder.failure(planned.hash)
        if failure is not None and crew.retry:
            folder.forget_failure(planned.hash)
        if failure is not None and failure.final and not crew.retry:
            continue
        if crew.elsewhere is not None and crew.elsewhere(planned.hash):
            continue
        if _lacks(planned, folder, beyond, crew):
            todo.add(planned.hash)
    return todo


def _lacks(planned: Planned, folder: Folder, beyond: tuple[str, ...], crew: Crew) -> bool:
    """Is there anything to do for a case? Of one whose recording is kept elsewhere, only what
    needs no other run."""
    has = _has(folder.row(planned.hash), beyond)
    if crew.keeper is None:
        return not has
    if not crew.keeper(planned).has():
        return True
    return not has and (folder.has_run(planned.hash) or folder.is_whole(planned.hash))


def _has(row: CaseRow | None, beyond: tuple[str, ...]) -> bool:
    """Is a case done, with the outputs that no summary holds?"""
    return row is not None and not lacking(beyond, row.figures)
