"""A helper process ends with the process that started it, also if that one is killed."""

from __future__ import annotations

import os
import threading
import time
from collections.abc import Callable

_LOOK = 0.25  # s between two looks at the parent


def end_with(parent: int, then: Callable[[], object] | None = None) -> None:
    """From now on end this process, whatever it does, once its parent is no longer ``parent``;
    ``then`` is called before.

    Where a process keeps the number of a dead parent (Windows) nothing ends it.
    """
    if os.name == "posix":
        threading.Thread(target=_watch, args=(parent, then), daemon=True).start()


def _watch(parent: int, then: Callable[[], object] | None) -> None:
    while os.getppid() == parent:
        time.sleep(_LOOK)
    try:
        if then is not None:
            then()
    finally:
        os._exit(1)
