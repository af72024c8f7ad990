"""Wall times of a run's stages, in order."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from typing import Any, ParamSpec, TypeVar

from flexcage.core.progress import Silent

P = ParamSpec("P")
R = TypeVar("R")
log = logging.getLogger(__name__)


class Stages(dict[str, float]):
    """Stage name to wall seconds; calling it times one stage.

    ``progress`` is what long stages show themselves with, a context like
    ``core.progress.Progress``; ``begun`` is when the first began, by ``time.perf_counter``.
    """

    def __init__(self, progress: Callable[..., Any] | None = None) -> None:
        super().__init__()
        self.progress = progress or Silent
        self.begun = time.perf_counter()

    @property
    def total(self) -> float:
        """Wall seconds since ``begun``, what lies between stages included."""
        return time.perf_counter() - self.begun

    def named(self, name: str, function: Callable[P, R], /, *args: P.args, **kwargs: P.kwargs) -> R:
        """Time one stage and show its name meanwhile: one of unknown length."""
        with self.progress(None, name):
            return self(name, function, *args, **kwargs)

    def __call__(
        self, name: str, function: Callable[P, R], /, *args: P.args, **kwargs: P.kwargs
    ) -> R:
        begin = time.perf_counter()
        try:
            return function(*args, **kwargs)
        finally:
            self[name] = self.get(name, 0.0) + time.perf_counter() - begin
            log.debug("%s: %.2f s", name, self[name])
