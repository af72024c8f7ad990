"""Nodes of an Ansys archive, of whatever FORTRAN format its NBLOCK is.

mapdl-archive reads rows that begin with three whole numbers, as CDWRITE writes them. Workbench
writes one, (1i9,3e20.9e3), and the library then reads every z as zero; of rows that do not stand in
the columns of their format it makes numbers that nobody wrote. So rows are read here.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import Any

import numpy as np

from flexcage.mesh.files.raw import Refused, lines_of, listed

_BLOCK = re.compile(r"\s*NBLOCK\b", re.IGNORECASE)
_FORMAT = re.compile(r"\s*\((\d*)i(\d+),(\d*)[efg](\d+)\.", re.IGNORECASE)


def nodes_of(text: str) -> tuple[np.ndarray, np.ndarray]:
    """Numbers (n,) and places (n, 3) of the nodes of an archive, by its text; Refused for rows that
    are none."""
    lines = lines_of(text)
    rows = [row for begin in _blocks(lines) for row in _rows(lines, begin)]
    numbers, places = zip(*rows) if rows else ((), ())
    return np.array(numbers, np.int64), np.array(places, float).reshape(-1, 3)


def refuse_turned(archive: Any) -> None:
    """Refuse nodes that move along axes of their own (NROTAT): matrices are along these."""
    turned = np.flatnonzero(np.asarray(archive.node_angles).any(axis=1))
    if len(turned):
        raise Refused(
            f"its nodes {listed(np.asarray(archive.nnum)[turned])} have axes of their own (THXY, "
            "THYZ, THZX of NROTAT), along which Ansys writes matrices; turn them back by "
            "NROTAT, write matrices and archive again"
        )


def _blocks(lines: list[str]) -> list[int]:
    return [i for i, line in enumerate(lines) if _BLOCK.match(line)]


def _rows(lines: list[str], begin: int) -> Iterator[tuple[int, list[float]]]:
    """Number and place of every node of the block that begins in a line, by its format."""
    found = _FORMAT.match(lines[begin + 1])
    if not found:
        raise Refused(
            f"line {begin + 2}: '{lines[begin + 1].strip()}' stands where NBLOCK has its format, "
            "as (3i9,6e21.13e3)"
        )
    whole, count, wide = int(found[2]), int(found[1] or 1), int(found[4])
    for number, line in enumerate(lines[begin + 2 :], begin + 3):
        if not line.strip() or line.strip().startswith(("-1", "N,", "n,")):
            return
        row = line.rstrip()
        first = whole * count
        fields = [row[at : at + wide] for at in range(first, first + 3 * wide, wide)]
        try:
            yield int(row[:whole]), [float(text) if text.strip() else 0.0 for text in fields]
        except ValueError:
            raise Refused(
                f"line {number}: '{row.strip()}' is no node by the format "
                f"{lines[begin + 1].strip()}"
            ) from None
