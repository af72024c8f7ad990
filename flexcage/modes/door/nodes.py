"""Nodes of a body from the deck of its program: Nastran GRID, Abaqus *NODE, Ansys NBLOCK."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.mesh.abaqus import read_nodes
from flexcage.modes.door.contents import Points, lacking, unreadable


def read_points(path: Path, *, where: str) -> Points:
    """Nodes of a deck, by its ending; InputError for one of another kind, or without nodes."""
    ending = path.suffix.lower()
    if ending not in _READERS:
        raise InputError(
            f"{path} is no file of nodes that can be read: {', '.join(_READERS)}.",
            where=where,
            value=str(path),
        )
    if not path.is_file():
        raise InputError(f"There is no file of nodes '{path}'.", where=where, value=str(path))
    found = _READERS[ending](path, where=where)
    assert found is not None, "a reader raises where a file has no nodes"
    return found


def read_grids(path: Path, *, where: str, needed: bool = True) -> Points | None:
    """GRID entries of a Nastran bulk file, in its basic coordinate system.

    None if there are none and they are not ``needed``; InputError for grids in a coordinate system
    of their own.
    """
    try:
        from pyyeti.nastran import bulk
    except ImportError as error:
        raise lacking("pyyeti", "Nastran's files") from error
    try:
        table = np.asarray(bulk.rdgrids(str(path), follow_includes=False), float)
    except Exception as error:  # of all kinds on broken files
        raise unreadable(path, error, where=where) from error
    if table.size == 0 or table.ndim != 2:
        if needed:
            raise InputError(f"{path} has no GRID entries.", where=where, value=str(path))
        return None
    own = np.flatnonzero((table[:, 1] != 0) | (table[:, 5] != 0))
    if len(own):
        grid, place, way = table[own[0]][[0, 1, 5]].astype(int)
        raise InputError(
            f"{path}: grid {grid} stands in coordinate system {place} and moves in system {way}; "
            "flexcage reads the basic system 0 alone: write the grids in it.",
            where=where,
            value=int(grid),
        )
    return Points(numbers=table[:, 0].astype(np.int64), places=table[:, 2:5].copy())


def _abaqus(path: Path, *, where: str) -> Points:
    try:
        numbers, places, sets = read_nodes(path)
    except (ValueError, IndexError, KeyError, OSError) as error:
        raise unreadable(path, error, where=where) from error
    if not len(numbers):
        raise InputError(f"{path} has no *NODE block.", where=where, value=str(path))
    return Points(numbers=numbers, places=places, sets=sets)


def _ansys(path: Path, *, where: str) -> Points:
    from flexcage.mesh.ansys import read_archive

    archive: Any = read_archive(path, where=where)
    sets = {str(n).lower(): np.asarray(v) for n, v in archive.node_components.items()}
    return Points(
        numbers=np.asarray(archive.nnum, np.int64),
        places=np.asarray(archive.nodes[:, :3], float),
        sets=sets,
    )


_READERS: dict[str, Callable[..., Points | None]] = {
    ".bdf": read_grids, ".dat": read_grids, ".nas": read_grids, ".pch": read_grids,
    ".inp": _abaqus, ".cdb": _ansys,
}  # fmt: skip
