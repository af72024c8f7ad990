"""What a mesh file says, whatever its format, before units and checks."""

from __future__ import annotations

import codecs
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from flexcage.mesh.cage_mesh import POCKET_GROUPS, RING_GROUPS, WALL_GROUPS

_POCKET = re.compile(r"pocket(\d+)_")
_PARTS = {*POCKET_GROUPS, *WALL_GROUPS}
_MARKS = (
    (codecs.BOM_UTF8, "utf-8-sig"),
    (codecs.BOM_UTF16_LE, "utf-16"),
    (codecs.BOM_UTF16_BE, "utf-16"),
)
_NAMED = 5  # numbers that a sentence names


class Refused(ValueError):
    """A file that can be read, but says what is not followed: one sentence with place and remedy,
    to which the caller adds the file."""


@dataclass(frozen=True, kw_only=True)
class RawMesh:
    """Nodes, tetrahedra and named surfaces of a file, in its own unit and numbering.

    Tetrahedra come in blocks of one order; their first four nodes are the corners, and the nodes on
    edges follow as meshio orders them.
    """

    points: np.ndarray  # (n, 3)
    solids: tuple[np.ndarray, ...]  # blocks (m, 4, 10, 20 ...) of rows of points
    surfaces: Mapping[str, np.ndarray]  # name -> corners (k, 3), rows of points
    point_numbers: np.ndarray | None = None  # (n,) in the file; None: counted from 1
    solid_numbers: np.ndarray | None = None  # of all tetrahedra, block by block, likewise
    # names that the file has, but not as surfaces -> what they are
    no_surfaces: Mapping[str, str] = field(default_factory=dict)

    @property
    def tets(self) -> np.ndarray:
        """Corners (m, 4) of all tetrahedra."""
        return np.vstack([block[:, :4] for block in self.solids]).astype(np.int64)

    def points_named(self, rows: Iterable[int]) -> str:
        """Numbers of points in the file, the first few and how many there are."""
        return listed(_numbers(self.point_numbers, rows))

    def solids_named(self, rows: Iterable[int]) -> str:
        """The same of tetrahedra."""
        return listed(_numbers(self.solid_numbers, rows))


def _numbers(given: np.ndarray | None, rows: Iterable[int]) -> list[int]:
    return [int(row) + 1 if given is None else int(given[row]) for row in rows]


def listed(numbers: Iterable[int]) -> str:
    """The first few numbers and how many follow: "3, 4, 7 and 12 more"."""
    numbers = list(numbers)
    shown = ", ".join(map(str, numbers[:_NAMED]))
    return shown if len(numbers) <= _NAMED else f"{shown} and {len(numbers) - _NAMED} more"


def group_name(name: str) -> str | None:
    """The group that a name in a file stands for, whatever its capitals; None for any other."""
    low = name.strip().lower()
    return (
        low if low in RING_GROUPS or _POCKET.sub("", low) in _PARTS and _POCKET.match(low) else None
    )


def first_alike(rows: np.ndarray) -> np.ndarray:
    """For every row of integers (n, k), the number (n,) of the first that is equal to it."""
    order = np.lexsort(rows.T)
    new = np.ones(len(rows), bool)
    new[1:] = (rows[order[1:]] != rows[order[:-1]]).any(axis=1)
    first = np.empty(len(rows), int)
    first[order] = order[new][np.cumsum(new) - 1]
    return first


def text_of(path: Path) -> str:
    """Text of a file of another program: UTF-8 or UTF-16 by its mark, else UTF-8, else Latin-1."""
    content = path.read_bytes()
    for mark, encoding in _MARKS:
        if content.startswith(mark):
            return content.decode(encoding, errors="replace")
    try:
        return content.decode("utf-8")
    except UnicodeDecodeError:
        return content.decode("latin-1")


def lines_of(text: str) -> list[str]:
    """Lines, ended as on any system; a control character of a comment ends none."""
    return text.replace("\r\n", "\n").replace("\r", "\n").split("\n")
