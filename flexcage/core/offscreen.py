"""The way to draw off screen that worked last time, so that it is not looked for in every run.

VTK kills the process where it cannot draw, which ``environment`` finds out in another process. What
it found is kept in the cache folder for this machine. Whoever opens a window takes it away, and
puts it back once the window has drawn: after a crash it is looked for anew.
"""

from __future__ import annotations

import hashlib
import importlib.metadata
import os
import platform
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from flexcage.core import environment
from flexcage.core.cache import cache_root
from flexcage.core.errors import EnvironmentLacks
from flexcage.core.trust import make_private
from flexcage.core.writing import write_text

#: Parts of names of environment variables that bear on what VTK draws with.
_MATTERS = ("DISPLAY", "EGL", "MESA", "LIBGL", "GALLIUM", "VTK", "LD_LIBRARY_PATH", "CUDA")


@contextmanager
def opening_window() -> Iterator[None]:
    """Have VTK use a window that works here; in it, open one and draw something.

    Raises EnvironmentLacks if there is no way to draw.
    """
    note = cache_root() / "drawing" / _here()
    window = _taken(note) or environment.offscreen_backend()
    if window is None:
        raise EnvironmentLacks(
            "This machine cannot draw pictures off screen (no EGL, X or OSMesa library was found); "
            f"install one with: {environment.APT_RENDER}"
        )
    if window != "default":
        os.environ[environment.WINDOW_VARIABLE] = window
    yield
    with suppress(OSError):  # then it is looked for again
        make_private(note.parent)
        write_text(note, window)


def _taken(note: Path) -> str | None:
    try:
        window = note.read_text("utf-8")
        note.unlink()
    except OSError:
        return None
    return window if window in environment.WINDOWS else None


def _here() -> str:
    """This machine, its VTK, and what in its environment bears on drawing, as a file's name."""
    settings = {k: v for k, v in os.environ.items() if any(part in k for part in _MATTERS)}
    try:
        version = importlib.metadata.version("vtk")
    except importlib.metadata.PackageNotFoundError:
        version = ""
    what = (platform.node(), sys.executable, version, sorted(settings.items()))
    return hashlib.sha256(repr(what).encode()).hexdigest()[:16]
