"""Nodes of a body from the deck of its program: Nastran GRID, Abaqus *NODE, Ansys NBLOCK."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.mesh.abaqus import read_nodes
from flexcage.modes.door.contents import Points, unreadable
from flexcage.modes.door.nastran import nastran


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
    """GRID entries of a Nastran bulk file; places in its basic coordinate system, and frames where
    grids move in systems of their own.

    None if there are none and they are not ``needed``.
    """
    bulk = nastran("bulk")
    try:
        table = np.asarray(bulk.rdgrids(str(path), follow_includes=False), float)
        if table.size and table.ndim == 2 and table[:, [1, 5]].any():
            return _grids_in_systems(path)
    except Exception as error:  # of all kinds on broken files
        raise unreadable(path, error, where=where) from error
    if table.size == 0 or table.ndim != 2:
        if needed:
            raise InputError(f"{path} has no GRID entries.", where=where, value=str(path))
        return None
    numbers, first = np.unique(table[:, 0].astype(np.int64), return_index=True)
    return Points(numbers=numbers, places=table[first, 2:5].copy())


def _grids_in_systems(path: Path) -> Points:
    """Grids with coordinate systems (CORD entries) of their own, by pyYeti's table of them."""
    bulk, n2p = nastran("bulk"), nastran("n2p")
    table = bulk.bulk2uset(str(path), follow_includes=False)[0]
    first = table.iloc[::6]
    motions = n2p.rbgeom_uset(table, [0.0, 0.0, 0.0]).reshape(-1, 6, 6)
    return Points(
        numbers=first.index.get_level_values("id").to_numpy(np.int64),
        places=first[["x", "y", "z"]].to_numpy(float),
        frames=motions[:, :3, :3],
    )


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
    ".bdf": read_grids, ".dat": read_grids, ".nas": read_grids, ".asm": read_grids,
    ".pch": read_grids,
    ".inp": _abaqus, ".cdb": _ansys,
}  # fmt: skip
