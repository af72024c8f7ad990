"""Running a study: what its folder lacks goes to the workers, a few cases ahead of them."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

from flexcage.core.binding import expect, path_of
from flexcage.core.errors import RunFailed
from flexcage.core.hashing import content_hash
from flexcage.core.progress import Silent
from flexcage.core.stopping import check, unwinding
from flexcage.run.cost import Cost
from flexcage.run.foreseen import report_foreseen
from flexcage.study.cluster import connect, default_workers, require_packages
from flexcage.study.folder import CaseRow, Failure, Folder
from flexcage.study.origin import check_origins
from flexcage.study.outputs import beyond_summary, lacking, needs_stress
from flexcage.study.plan import Plan, Planned, make_plan
from flexcage.study.progress import TOPIC, Board
from flexcage.study.results import StudyResults
from flexcage.study.spec import Study
from flexcage.study.work import Order, do_case, order_of, prepare

log = logging.getLogger(__name__)

AHEAD = 3  # cases handed out per worker: one runs, the others wait beside it
_LOOK = 1.0  # s between two looks at how many workers there are
_WAIT = 0.05  # s between two looks at what has come back


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
    with folder.held():
        todo = _lacking(plan, folder, retry=retry)
        try:
            if todo:
                _report_before(plan, folder, todo, (scheduler, workers))
                with unwinding():  # Ctrl-C ends the workers
                    _compute(plan, folder, todo, (scheduler, workers), progress)
        except BaseException:  # Ctrl-C as well: the tables show what is finished
            _try_to_write(folder)
            raise
        results = StudyResults(folder.path)
        results.write()
    return results


def _report_before(
    plan: Plan, folder: Folder, todo: set[str], where: tuple[Any, int | None]
) -> None:
    """Log what is foreseen of the cases to compute, and what disk and time they will take."""
    cost = Cost(keeps=plan.study.keep == "runs")
    cases = (cost.counted(plan.case(planned)) for planned in plan.cases if planned.hash in todo)
    report_foreseen(cases, stress=needs_stress(plan.study.outputs))
    scheduler, workers = where
    if scheduler is None:
        crew = min(workers or default_workers(), len(todo))
        cost.announce(folder.path, workers=crew, each=_seconds_each(plan, folder))


def _seconds_each(plan: Plan, folder: Folder) -> float | None:
    """Processor time [s] of a case, by those that are done; None before the first."""
    rows = (folder.row(planned.hash) for planned in plan.cases)
    seconds = [row.seconds for row in rows if row is not None]
    return sum(seconds) / len(seconds) if seconds else None


def _compute(
    plan: Plan,
    folder: Folder,
    todo: set[str],
    where: tuple[Any, int | None],
    progress: Callable[..., Any] | None,
) -> None:
    """Compute the cases ``todo`` on a scheduler or a number of workers: ``where``."""
    with connect(*where) as client:
        total, done = len(plan.cases), len(plan.cases) - len(todo)
        with (progress or Silent)(total, "cases") as bar:
            bar.begin_at(done)
            numbers = {c.hash: k for k, c in enumerate(plan.cases) if c.hash in todo}
            board = Board(bar, numbers, total, done)
            client.subscribe_topic(TOPIC, board.on_event)
            try:
                for name in _Desk(client, plan, folder, board).work_off(todo):
                    board.finished(name)
            finally:
                board.close()


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


def _lacking(plan: Plan, folder: Folder, *, retry: bool) -> set[str]:
    """Hashes of the cases to compute."""
    todo, beyond = set(), beyond_summary(plan.study.outputs)
    for planned in plan.cases:
        failure = folder.failure(planned.hash)
        if failure is not None and retry:
            folder.forget_failure(planned.hash)
        if failure is not None and failure.final and not retry:
            continue
        if not _has(folder.row(planned.hash), beyond):
            todo.add(planned.hash)
    return todo


def _has(row: CaseRow | None, beyond: tuple[str, ...]) -> bool:
    """Is a case done, with the outputs that no summary holds?"""
    return row is not None and not lacking(beyond, row.figures)


class _Desk:
    """Hands cases to the workers and takes them back; holds only those that are out."""

    def __init__(self, client: Any, plan: Plan, folder: Folder, board: Board) -> None:
        self.client, self.plan, self.folder, self.board = client, plan, folder, board
        self.address = client.scheduler.address
        self._modes: dict[str, Any] = {}  # futures of modes that cases share, by key
        self._names: dict[str, str] = {}  # hash of a case by the key of its future
        self._window, self._looked = 1, -_LOOK
        self._back: list[Any] = []  # futures that have come back and wait to be taken
        self._reasons: set[str] = set()  # why cases failed, as far as it was said

    def work_off(self, todo: set[str]) -> Iterator[str]:
        """Hash of every case of ``todo``, as it comes back."""
        from distributed import as_completed

        out = as_completed(loop=self.client.loop)
        # those that share modes one after the other, so that the cache need not hold them all
        cases = (planned for planned in self.plan.cases if planned.hash in todo)
        for planned in sorted(cases, key=lambda planned: planned.modes):
            while out.count() + len(self._back) >= self._window_size():
                yield self._take(out)
            out.add(self._submit(planned))
        while out.count() or self._back:
            yield self._take(out)

    def _window_size(self) -> int:
        """How many cases may be out: a few for every thread that there is now."""
        if time.monotonic() - self._looked > _LOOK:
            try:
                threads = sum(self.client.nthreads().values())
            except (OSError, RuntimeError) as exc:
                raise self._lost() from exc
            self._window, self._looked = AHEAD * max(threads, 1), time.monotonic()
            self.board.workers(threads)
        return self._window

    def _submit(self, planned: Planned) -> Any:
        order = order_of(self.plan, planned, self.folder.path)
        waits = [self._shared_modes(order, planned.modes)] if planned.modes else []
        key = f"case-{content_hash(order)}"
        self._names[key] = planned.hash
        return self.client.submit(do_case, order, *waits, key=key)

    def _shared_modes(self, order: Order, key: str) -> Any:
        """Future of the modes that this case shares with others; made when first asked for."""
        if key not in self._modes:
            self._modes[key] = self.client.submit(prepare, order, key=f"modes-{key}")
        return self._modes[key]

    def _take(self, out: Any) -> str:
        """Wait for the next case that comes back; its hash."""
        while not self._back:
            check()
            self._back += out.next_batch(block=False)
            if not self._back:
                time.sleep(_WAIT)
        future = self._back.pop(0)
        name = self._names.pop(future.key)
        if future.status == "error":
            error = future.exception()
            reason = f"its worker did not bring it back: {type(error).__name__}: {error}"
            self.folder.write_failure(name, Failure(type(error).__name__, reason, final=False))
            log.warning("case %s: %s", name, reason)
        elif future.status != "finished":
            raise self._lost()
        else:
            self._say_why(name)
        return name

    def _say_why(self, name: str) -> None:
        """Say at once why a case failed, if it did, each reason once: the next may fail alike."""
        failure = self.folder.failure(name)
        if failure is not None and failure.reason not in self._reasons:
            self._reasons.add(failure.reason)
            log.warning("Case %s failed: %s", name, failure.reason)

    def _lost(self) -> RunFailed:
        return RunFailed(
            f"The scheduler at '{self.address}' is lost; what is finished is kept in "
            f"'{self.folder.path}', and 'flexcage study resume' goes on from there."
        )
