"""A helper process ends with the process that started it, also if that one is killed."""

from __future__ import annotations

import os
import threading
import time

_LOOK = 0.25  # s between two looks at the parent


def end_with(parent: int) -> None:
    """From now on end this process, whatever it does, once its parent is no longer ``parent``.

    Where a process keeps the number of a dead parent (Windows) nothing ends it.
    """
    if os.name == "posix":
        threading.Thread(target=_watch, args=(parent,), daemon=True).start()


def _watch(parent: int) -> None:
    while os.getppid() == parent:
        time.sleep(_LOOK)
    os._exit(1)
