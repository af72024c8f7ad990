"""Wall times of a run's stages, in order."""

from __future__ import annotations

import logging
import time
from collections.abc import Callable
from typing import ParamSpec, TypeVar

P = ParamSpec("P")
R = TypeVar("R")
log = logging.getLogger(__name__)


class Stages(dict[str, float]):
    """Stage name to wall seconds; calling it times one stage."""

    def __call__(
        self, name: str, function: Callable[P, R], /, *args: P.args, **kwargs: P.kwargs
    ) -> R:
        begin = time.perf_counter()
        try:
            return function(*args, **kwargs)
        finally:
            self[name] = self.get(name, 0.0) + time.perf_counter() - begin
            log.debug("%s: %.2f s", name, self[name])
