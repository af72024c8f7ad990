"""Log lines of a long step: what it will take, then every few seconds how far it is."""

from __future__ import annotations

import logging
import time
from types import TracebackType

from flexcage.core.progress import clock

log = logging.getLogger(__name__)

_EVERY = 10.0  # s between two lines
_EARLY = 0.05  # share before which an estimate of the rest misleads


class Pace:
    """Context of one long step that is expected to take ``seconds``; None for one that says
    nothing.

    >>> with Pace("modes of cage.msh", 25.0) as pace:
    ...     pace.to(0.4)
    """

    def __init__(self, label: str, seconds: float | None) -> None:
        self._label, self._seconds = label, seconds
        self._begun = self._said = time.monotonic()

    def __enter__(self) -> Pace:
        self._begun = self._said = time.monotonic()
        if self._seconds is not None:
            log.info("%s: about %s, once", self._label, clock(max(self._seconds, 1.0)))
        return self

    def to(self, share: float) -> None:
        """State which share of the step is done."""
        now = time.monotonic()
        if self._seconds is None or now - self._said < _EVERY:
            return
        self._said = now
        share = min(share, 0.99)
        left = ""
        if share > _EARLY:
            left = f", about {clock((now - self._begun) * (1.0 - share) / share)} left"
        log.info("%s: %.0f %%%s", self._label, 100.0 * share, left)

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        tb: TracebackType | None,
    ) -> None:
        elapsed = time.monotonic() - self._begun
        if self._seconds is not None and kind is None and elapsed >= _EVERY:
            log.info("%s: done after %s", self._label, clock(elapsed))
