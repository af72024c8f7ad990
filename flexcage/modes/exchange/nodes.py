"""Nodes of a body from the deck of its program: Nastran GRID, Abaqus *NODE, Ansys NBLOCK."""

from __future__ import annotations

import re
from collections.abc import Callable
from io import StringIO
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.missing import no_file
from flexcage.mesh.files.abaqus import read_nodes
from flexcage.mesh.files.others import PACKED, known_reason
from flexcage.mesh.files.raw import Refused, lines_of, listed, text_of
from flexcage.modes.exchange.contents import FileNodes, unreadable
from flexcage.modes.exchange.nastran import nastran

_NOT_FOLLOWED = ("INCLUDE", "GRDSET", "GRIDB", "GRIDG", "EGRID", "GRIDA")
_COMMENT = re.compile(r"(?<=[^\n\r$])\$[^\n\r]*")  # after an entry
_END = re.compile(r"^ENDDATA\b", re.MULTILINE | re.IGNORECASE)  # what follows is no part of a deck
_SYSTEMS = ("CORD1R", "CORD1C", "CORD1S", "CORD3G")  # pyYeti reads CORD2R, CORD2C and CORD2S


def read_points(path: Path, *, where: str) -> FileNodes:
    """Nodes of a deck, by its ending; InputError for one of another kind, or without nodes."""
    ending = path.suffix.lower()
    if ending not in _READERS:
        listing = ", ".join(_READERS)
        raise InputError(
            f"{known_reason(path, PACKED, f'is no file of nodes that can be read: {listing}')}.",
            where=where,
            value=str(path),
        )
    if not path.is_file():
        raise InputError(f"{no_file('file of nodes', path)}.", where=where, value=str(path))
    found = _READERS[ending](path, where=where)
    assert found is not None, "a reader raises where a file has no nodes"
    return found


def read_grids(path: Path, *, where: str, needed: bool = True) -> FileNodes | None:
    """GRID entries of a Nastran bulk file; places in its basic coordinate system, and frames where
    grids move in systems of their own.

    None if there are none and they are not ``needed``. InputError, which names entry and line, for
    what changes grids and is not followed.
    """
    bulk = nastran("bulk")
    try:
        text = _END.split(bulk_text(path))[0]
        _refuse_out_of_columns(text)
        table = np.asarray(bulk.rdgrids(StringIO(text)), float)
        some = table.ndim == 2 and bool(table.size)
        systems = some and bool(table[:, [1, 5]].any())
        _refuse_entries(text, systems=systems)
        if some:
            table = np.unique(table, axis=0)  # grids that stand twice alike are one
            _refuse_twice(table[:, 0].astype(np.int64))
        if systems:
            return _grids_in_systems(text)
    except Exception as error:  # of all kinds on broken files
        raise unreadable(path, error, where=where) from error
    if not some:
        if needed:
            raise InputError(f"{path} has no GRID entries.", where=where, value=str(path))
        return None
    return FileNodes(numbers=table[:, 0].astype(np.int64), places=table[:, 2:5].copy())


def _refuse_entries(text: str, *, systems: bool) -> None:
    """Refuse bulk entries that give or move grids and that are not followed."""
    refused = (*_NOT_FOLLOWED, *(_SYSTEMS if systems else ()))
    for line, row in enumerate(lines_of(text), start=1):
        name = row.replace(",", " ").upper().split(maxsplit=1)[:1]
        if name and name[0].rstrip("*") in refused:
            raise Refused(
                f"line {line}: the entry {name[0]} is not followed, and gives, places or turns "
                "grids; write all GRID entries into one file, in the basic system"
            )


def bulk_text(path: Path) -> str:
    """Text of a bulk file with tabs as blanks, and without comments at the ends of entries: a comma
    in one makes pyYeti take the entry for one parted by commas."""
    text = text_of(path).expandtabs(8)
    return _COMMENT.sub("", text) if "$" in text else text


def _refuse_out_of_columns(text: str) -> None:
    """Refuse GRID entries of which pyYeti would make other numbers."""
    for line, row in enumerate(lines_of(text), start=1):
        if _out_of_columns(row):
            raise Refused(
                f"line {line}: '{row.strip()}' is no GRID entry, whose fields are eight columns "
                "wide (sixteen after GRID*) or parted by commas"
            )


def _out_of_columns(row: str) -> bool:
    """Is it a GRID entry whose fields do not stand in their columns, as where blanks part them?"""
    row = row.rstrip()
    if "," in row or row.upper().split()[:1] not in (["GRID"], ["GRID*"]) or row[0].isspace():
        return False
    wide = 16 if "*" in row[:8] else 8
    fields = [row[at : at + wide] for at in range(8, min(len(row), 72), wide)]
    return len(row[:8].split()) > 1 or any(len(field.split()) > 1 for field in fields)


def _refuse_twice(numbers: np.ndarray) -> None:
    found, count = np.unique(numbers, return_counts=True)
    if (count > 1).any():
        raise Refused(f"it numbers grids twice ({listed(found[count > 1])}); write each once")


def _grids_in_systems(text: str) -> FileNodes:
    """Grids with coordinate systems (CORD entries) of their own, by pyYeti's table of them."""
    bulk, n2p = nastran("bulk"), nastran("n2p")
    table = bulk.bulk2uset(StringIO(text))[0]
    first = table.iloc[::6]
    motions = n2p.rbgeom_uset(table, [0.0, 0.0, 0.0]).reshape(-1, 6, 6)
    return FileNodes(
        numbers=first.index.get_level_values("id").to_numpy(np.int64),
        places=first[["x", "y", "z"]].to_numpy(float),
        frames=motions[:, :3, :3],
    )


def _abaqus(path: Path, *, where: str) -> FileNodes:
    try:
        numbers, places, sets = read_nodes(path)
    except (ValueError, IndexError, KeyError, OSError) as error:
        raise unreadable(path, error, where=where) from error
    if not len(numbers):
        raise InputError(f"{path} has no *NODE block.", where=where, value=str(path))
    return FileNodes(numbers=numbers, places=places, sets=sets)


def _ansys(path: Path, *, where: str) -> FileNodes:
    from flexcage.mesh.files.ansys import read_archive, refuse_commands
    from flexcage.mesh.files.nblock import nodes_of, refuse_turned

    archive: Any = read_archive(path, where=where)
    text = text_of(path)
    try:
        refuse_commands(text, nodes_alone=True)
        refuse_turned(archive)
        numbers, places = nodes_of(text)
    except Refused as error:
        raise unreadable(path, error, where=where) from error
    sets = {str(n).lower(): np.asarray(v) for n, v in archive.node_components.items()}
    return FileNodes(numbers=numbers, places=places, sets=sets)


_READERS: dict[str, Callable[..., FileNodes | None]] = {
    ".bdf": read_grids, ".dat": read_grids, ".nas": read_grids, ".asm": read_grids,
    ".pch": read_grids,
    ".inp": _abaqus, ".cdb": _ansys,
}  # fmt: skip
