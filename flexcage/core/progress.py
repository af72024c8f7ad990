"""Progress of a long step on a terminal: percentage and an estimate of the time that remains."""

from __future__ import annotations

import shutil
import sys
import time
from types import TracebackType
from typing import TextIO

_INTERVAL = 0.2  # s between two drawings
_PATIENCE = 1.0  # s before the first estimate: earlier ones mislead

_OPEN: list[Progress] = []  # those that are drawn now


class Progress:
    """Context of one long step of ``total`` units; draws on a terminal and is quiet elsewhere.

    Where ``total`` is None nobody knows how long it takes: its name is shown, and no estimate.

    >>> with Progress(0.1, "solving") as progress:
    ...     progress.to(0.05)
    """

    def __init__(
        self,
        total: float | None,
        label: str,
        *,
        stream: TextIO | None = None,
        enabled: bool | None = None,
    ) -> None:
        self.total = None if total is None else float(total)
        self.label = label
        self.done = 0.0
        self.detail = ""  # drawn behind the estimate, as far as the terminal is wide
        self._stream = stream if stream is not None else sys.stderr
        isatty = getattr(self._stream, "isatty", lambda: False)
        self._enabled = bool(isatty()) if enabled is None else enabled
        self._start = time.monotonic()
        self._begun_at = 0.0
        self._drawn = 0.0
        self._width = 0

    def __enter__(self) -> Progress:
        self._start = time.monotonic()
        self._draw()
        _OPEN.append(self)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        tb: TracebackType | None,
    ) -> None:
        _OPEN.remove(self)
        if not self._enabled:
            return
        if kind is None and self.total is not None:
            self.done = self.total
        elapsed = clock(time.monotonic() - self._start)
        word = "done" if kind is None else "stopped"
        share = "" if self.total is None else f" at {self._percent():.0f} %"
        self._put(f"{self.label}: {word}{share} after {elapsed}")
        self._stream.write("\n")
        self._stream.flush()

    def begin_at(self, done: float) -> None:
        """State what was done before this process began, so that a resumed run estimates right."""
        self._begun_at = self.done = float(done)

    def to(self, done: float) -> None:
        """State how much is done in all."""
        self.done = float(done)
        if self._enabled and time.monotonic() - self._drawn >= _INTERVAL:
            self._draw()

    __call__ = to

    def advance(self, amount: float = 1.0) -> None:
        """State that ``amount`` more is done."""
        self.to(self.done + amount)

    def note(self, text: str) -> None:
        """Write one line of its own, such as that kernels are being compiled for the first time."""
        if self._enabled:
            self._put(text)
            self._stream.write("\n")
            self._width = 0
            self._draw()

    def clear(self) -> None:
        """Empty the line drawn on, for others to write there; the next drawing comes below."""
        if self._enabled:
            self._put("")
            self._stream.write("\r")
            self._stream.flush()

    def remaining(self) -> float | None:
        """Estimate of the remaining time [s], or None while it would mislead."""
        elapsed = time.monotonic() - self._start
        advanced = self.done - self._begun_at
        if self.total is None or elapsed < _PATIENCE or advanced <= 0.0:
            return None
        return elapsed * max(self.total - self.done, 0.0) / advanced

    def _percent(self) -> float:
        return 100.0 * min(self.done / self.total, 1.0) if self.total else 100.0

    def _draw(self) -> None:
        if not self._enabled:
            return
        self._drawn = time.monotonic()
        if self.total is None:
            self._put(f"{self.label} ...")
            return
        left = self.remaining()
        estimate = f", about {clock(left)} left" if left is not None else ""
        text = f"{self.label}: {self._percent():3.0f} %{estimate}{self.detail}"
        self._put(text[: shutil.get_terminal_size().columns - 1] if self.detail else text)

    def _put(self, text: str) -> None:
        self._stream.write("\r" + text.ljust(self._width))
        self._stream.flush()
        self._width = len(text)


def clear_line() -> None:
    """Empty the line on which progress is drawn, if any is."""
    for progress in _OPEN:
        progress.clear()


class Silent(Progress):
    """Progress that nobody wants to see."""

    def __init__(self, total: float | None = None, label: str = "") -> None:
        super().__init__(total, label, enabled=False)


def clock(seconds: float) -> str:
    """A duration as people say it: 12 s, 3 min 05 s, 2 h 10 min."""
    if seconds < 60:
        return f"{seconds:.0f} s"
    minutes, rest = divmod(int(seconds + 0.5), 60)
    return (
        f"{minutes} min {rest:02d} s" if minutes < 60 else f"{minutes // 60} h {minutes % 60} min"
    )
