"""pyYeti's readers of Nastran's files, imported without what they change for all of NumPy."""

from __future__ import annotations

import importlib
from typing import Any

import numpy as np

from flexcage.core.errors import package_lacks


def nastran(module: str) -> Any:
    """A module of pyYeti's package ``nastran``; EnvironmentLacks without pyYeti.

    pyYeti makes NumPy write numbers with twelve digits, in every file that the process writes
    later; here that is undone.
    """
    try:
        with np.printoptions():
            return importlib.import_module(f"pyyeti.nastran.{module}")
    except ImportError as error:
        work = "Nastran's files (.op4, .pch, .bdf) are read and written"
        raise package_lacks(work, "pyyeti", extra="bodies") from error
