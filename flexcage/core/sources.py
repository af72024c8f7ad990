"""Fingerprints of flexcage's own source files: what kernels and results depend on.

A version is a name, which an edit does not change; a fingerprint is what was computed with.
"""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from functools import cache
from pathlib import Path

_PACKAGE = Path(__file__).resolve().parents[1]
_FEEDING = ("bearings", "cages", "contacts", "solve", "system")  # rooms
#: Rooms whose plain Python makes numbers of a run, from dimensions to steps of the solver. An edit
#: of a comment changes the fingerprint too: a question too many costs less than a seam unseen.
_PHYSICS = (*_FEEDING, "bodies", "fem", "geometry", "integrate", "mesh", "modes")


def kernel_sources() -> list[Path]:
    """Source files that define or feed kernels, in a fixed order.

    In some rooms kernels take in plain functions and constants of files that have no import to be
    known by; what a specification says reaches kernels as arguments.
    """
    return sorted(
        p
        for p in _PACKAGE.rglob("*.py")
        if (_package_of(p) in _FEEDING and p.name not in ("options.py", "spec.py"))
        or any(mark in p.read_text("utf-8") for mark in ("core.jit import", "from numba"))
    )


def _package_of(path: Path) -> str:
    return path.relative_to(_PACKAGE).parts[0]


def source_hash(files: Iterable[Path]) -> str:
    """16 digits that change with the files' names and contents."""
    digest = hashlib.sha256()
    for path in files:
        digest.update(path.name.encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


@cache
def physics() -> str:
    """16 digits that name the physics of this flexcage: kernels, and all of the rooms that make a
    run's numbers. Two releases, or an edited one, have others."""
    rooms = (p for p in _PACKAGE.rglob("*.py") if _package_of(p) in _PHYSICS)
    return source_hash(sorted({*kernel_sources(), *rooms}))
