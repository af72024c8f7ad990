"""gmsh, imported late, opened quietly and always closed again."""

from __future__ import annotations

import importlib
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

from flexcage.core.errors import EnvironmentLacks, InputError

PACKAGES = (
    "libglu1-mesa libgl1 libxrender1 libxcursor1 libxfixes3 libxext6 libxft2 libfontconfig1 "
    "libxinerama1 libx11-6 libgomp1"
)
_LOCK = threading.Lock()  # gmsh keeps one global state a process


def load_gmsh() -> Any:
    """The gmsh module; EnvironmentLacks names the one command that supplies what is missing."""
    try:
        return importlib.import_module("gmsh")
    except ModuleNotFoundError as error:
        raise EnvironmentLacks(
            "the Python package gmsh is not installed; mend it with: python3 -m pip install gmsh"
        ) from error
    except OSError as error:
        raise EnvironmentLacks(
            f"gmsh cannot load a system library ({error}); "
            f"mend it with: sudo apt-get install -y {PACKAGES}"
        ) from error


@contextmanager
def gmsh_model(name: str) -> Iterator[Any]:
    """A fresh, silent gmsh model; an error inside becomes an InputError and nothing stays open."""
    gmsh = load_gmsh()
    with _LOCK:
        opened_here = not gmsh.isInitialized()
        if opened_here:  # interruptible would set a signal handler: impossible in a worker thread
            gmsh.initialize(interruptible=False, readConfigFiles=False)
        try:
            gmsh.option.setNumber("General.Verbosity", 0)
            gmsh.model.add(name)
            yield gmsh
        except Exception as error:
            if type(error) is not Exception:  # gmsh raises bare Exceptions, others pass through
                raise
            raise InputError(
                f"gmsh could not mesh the cage ({error}); try another mesh size or fineness, or "
                "check the cage's dimensions",
                where="mesh",
            ) from error
        finally:
            if opened_here:
                gmsh.finalize()
            else:
                gmsh.model.remove()
