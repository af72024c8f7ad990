"""pyYeti's readers of Nastran's files, imported without what they change for all of NumPy."""

from __future__ import annotations

import importlib
from typing import Any

import numpy as np

from flexcage.modes.door.contents import lacking


def nastran(module: str) -> Any:
    """A module of pyYeti's package ``nastran``; EnvironmentLacks without pyYeti.

    pyYeti makes NumPy write numbers with twelve digits, in every file that the process writes
    later; here that is undone.
    """
    try:
        with np.printoptions():
            return importlib.import_module(f"pyyeti.nastran.{module}")
    except ImportError as error:
        raise lacking("pyyeti", "Nastran's files (.op4, .pch, .bdf)") from error
