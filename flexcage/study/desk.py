"""Handing a plan's cases to workers, a few ahead of them, or computing them in this process."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Any

from flexcage.core.errors import RunFailed
from flexcage.core.hashing import content_hash
from flexcage.core.stopping import check
from flexcage.study.case_row import Failure
from flexcage.study.folder import Folder
from flexcage.study.plan import Plan, Planned
from flexcage.study.progress import Board
from flexcage.study.work import Keeper, Order, do_case, order_of, prepare

log = logging.getLogger(__name__)

AHEAD = 3  # cases handed out per worker: one runs, the others wait beside it
_LOOK = 1.0  # s between two looks at how many workers there are
_WAIT = 0.05  # s between two looks at what has come back


@dataclass(frozen=True)
class Crew:
    """Who computes the cases of a plan, and how.

    ``workers`` processes of this machine, or a Dask ``scheduler``; ``alone``: this process, one
    case after the other. ``retry`` tries those again that failed. ``keeper`` gives what is kept of
    a case's run beside its row, and ``elsewhere`` says of a hash whether that case is finished in
    another folder.
    """

    workers: int | None = None
    scheduler: Any = None
    alone: bool = False
    retry: bool = False
    keeper: Callable[[Planned], Keeper] | None = None
    elsewhere: Callable[[str], bool] | None = None

    def order(self, plan: Plan, planned: Planned, folder: Folder) -> Order:
        """What a worker receives of a case."""
        keeper = self.keeper(planned) if self.keeper else None
        return order_of(plan, planned, folder.path, keeper)


def in_turn(plan: Plan, todo: set[str]) -> list[Planned]:
    """The cases ``todo``, those that share modes one after the other, so that the cache need not
    hold them all."""
    cases = (planned for planned in plan.cases if planned.hash in todo)
    return sorted(cases, key=lambda planned: planned.modes)


class Reasons:
    """Says why cases fail, as they do, each reason once: the next may fail alike."""

    def __init__(self, folder: Folder) -> None:
        self.folder = folder
        self._said: set[str] = set()

    def look(self, name: str) -> None:
        """Say why this case failed, if it did."""
        failure = self.folder.failure(name)
        if failure is not None and failure.reason not in self._said:
            self._said.add(failure.reason)
            log.warning("Case %s failed: %s", name, failure.reason)


def one_by_one(plan: Plan, folder: Folder, crew: Crew, todo: set[str]) -> Iterator[str]:
    """Compute the cases ``todo`` in this process; the hash of each as it is done."""
    reasons = Reasons(folder)
    for planned in in_turn(plan, todo):
        check()
        do_case(crew.order(plan, planned, folder))
        reasons.look(planned.hash)
        yield planned.hash


class Desk:
    """Hands cases to the workers and takes them back; holds only those that are out."""

    def __init__(self, client: Any, plan: Plan, folder: Folder, crew: Crew, board: Board) -> None:
        self.client, self.plan, self.folder, self.board = client, plan, folder, board
        self.crew, self._reasons = crew, Reasons(folder)
        self.address = client.scheduler.address
        self._modes: dict[str, Any] = {}  # futures of modes that cases share, by key
        self._names: dict[str, str] = {}  # hash of a case by the key of its future
        self._window, self._looked = 1, -_LOOK
        self._back: list[Any] = []  # futures that have come back and wait to be taken

    def work_off(self, todo: set[str]) -> Iterator[str]:
        """Hash of every case of ``todo``, as it comes back."""
        from distributed import as_completed

        out = as_completed(loop=self.client.loop)
        for planned in in_turn(self.plan, todo):
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
        order = self.crew.order(self.plan, planned, self.folder)
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
            self._reasons.look(name)
        return name

    def _lost(self) -> RunFailed:
        return RunFailed(
            f"The scheduler at '{self.address}' is lost; what is finished is kept in "
            f"'{self.folder.path}', and 'flexcage study resume' goes on from there."
        )
