"""What a study shows while it runs: how many workers there are, and which case is at which stage.

Workers tell their stages as events of Dask's, a second apart at most; the client draws them on its
progress line. Nothing is told, and nothing lost, where a case does not run on a worker.
"""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping
from contextlib import suppress
from threading import Lock
from typing import Any

from flexcage.core.progress import Silent

TOPIC = "flexcage-stages"
_INTERVAL = 1.0  # s between two shares told of one stage
_SOLVING = "solving"
_SOLVED = 0.95  # of a case, when its motion is solved

ReportStage = Callable[[str, "float | None"], None]


def stage_reporter(case: str) -> ReportStage:
    """A function of a stage and the share of it that is done, which tells them of a case."""
    try:
        from distributed import get_worker

        worker = get_worker()
    except (ImportError, ValueError):  # in no worker
        return lambda stage, share: None

    def report(stage: str, share: float | None) -> None:
        with suppress(Exception):  # a scheduler that is lost: the case goes on
            worker.log_event(TOPIC, {"case": case, "stage": stage, "share": share})

    return report


class ReportedProgress(Silent):
    """Progress that is told: a context like ``core.progress.Progress``."""

    def __init__(self, report: ReportStage, total: float | None, label: str = "") -> None:
        super().__init__(total, label)
        self._report, self._last = report, -_INTERVAL

    def __enter__(self) -> ReportedProgress:
        super().__enter__()
        self._send(self.done)
        return self

    def to(self, done: float) -> None:
        """State how much is done in all."""
        super().to(done)
        if time.monotonic() - self._last >= _INTERVAL:
            self._send(done)

    __call__ = to

    def _send(self, done: float) -> None:
        self._last = time.monotonic()
        self._report(self.label, min(done / self.total, 1.0) if self.total else None)


class Board:
    """What is known of the cases that are out, drawn on a progress ``bar`` of ``total`` cases.

    Events come on a thread of Dask's: one draws at a time.
    """

    def __init__(self, bar: Any, numbers: Mapping[str, int], total: int, done: int) -> None:
        self._bar, self._numbers, self._total, self._done = bar, numbers, total, done
        self._stages: dict[str, tuple[str, float | None]] = {}
        self._lock, self._workers = Lock(), 0

    def on_event(self, event: Any) -> None:
        """An event of a worker: when, and what."""
        message = event[1]
        with self._lock, suppress(KeyError, TypeError):
            if message["case"] in self._numbers:
                self._stages[message["case"]] = (message["stage"], message["share"])
                self._draw()

    def workers(self, count: int) -> None:
        """So many workers are there now."""
        with self._lock:
            self._workers = count
            self._draw()

    def finished(self, case: str) -> None:
        """A case has come back."""
        with self._lock:
            self._done += 1
            self._stages.pop(case, None)
            self._numbers = {name: k for name, k in self._numbers.items() if name != case}
            self._draw()

    def close(self) -> None:
        """Draw no more, whatever is told."""
        with self._lock:
            self._numbers = {}

    def _draw(self) -> None:
        if hasattr(self._bar, "detail"):
            self._bar.detail = f"; {self._in_words()}"
        self._bar.to(self._done + sum(map(_share, self._stages.values())))

    def _in_words(self) -> str:
        crew = f"{self._workers} worker{'s' * (self._workers != 1)}"
        parts = [f"{self._done} of {self._total} done", crew]
        for case, (stage, share) in sorted(self._stages.items(), key=lambda s: self._numbers[s[0]]):
            percent = "" if share is None else f" {100.0 * share:.0f} %"
            parts.append(f"case {self._numbers[case]} {stage}{percent}")
        return ", ".join(parts)


def _share(stage: tuple[str, float | None]) -> float:
    """How much of a case is done."""
    name, share = stage
    if name == _SOLVING:
        return _SOLVED * (share or 0.0)
    return _SOLVED if name in ("stress", "rivets") else 0.0
