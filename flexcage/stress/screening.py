"""Bounds on the equivalent stress at many points, by which few of them are evaluated.

A search keeps the largest stress of a place, of an instant or of a vertex, and throws away all
else. Near one corner of a pocket the stress has few shapes: a dozen tell it to some thousandths. So
the fields of a group of neighbouring points are split into few shapes and a remainder, T = U B + R:
with loads x the stress at a point is within sum_j max |R_j| |x_j| of that of U B x, which costs a
twentieth. Where this bound lies below what stands already, nothing is evaluated.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

_SHAPES = 15  # of a group
ROUNDING = 4e-6  # of sum_j |T_j| |x_j|: what sums in single precision may be off by, and more


#: Deviators (n parts, m) per unit load, ``parts`` rows of every one of points (n,), the columns
#: (m,) alone that are named: of a point, and of all columns, that others are numbered by.
Rows = Callable[[np.ndarray, np.ndarray | None], np.ndarray]


@dataclass(frozen=True, eq=False)
class _Group:
    """Points (m,) from number ``first`` on to before ``end``: their shapes (m, parts, r), and what
    loads have of these (r, columns)."""

    first: int
    end: int
    shapes: np.ndarray
    share: np.ndarray


class Screen:
    """Equivalent stress at points under loads, and bounds on it; all in single precision.

    ``rows`` gives the points' deviators per unit load; ``sizes`` are those of groups of points,
    numbered one after the other. ``typical`` (nt, columns) are loads whose stress the shapes are to
    hold best; for others the bounds are as right, but wider.
    """

    def __init__(self, rows: Rows, sizes: Sequence[int], typical: np.ndarray) -> None:
        self._rows = rows
        mixed = np.random.default_rng(0).standard_normal((_SHAPES, len(typical))) @ typical
        mixed = mixed.T.astype(np.float32)
        self._groups: list[_Group] = []
        margins, first = [], 0
        for size in sizes:
            end = first + size
            own = rows(np.arange(first, end), None)
            shapes = np.linalg.qr(own @ mixed)[0]
            share = shapes.T @ own
            rounding = np.float32(ROUNDING) * _largest(own, size)
            own -= shapes @ share
            margins.append(_largest(own, size) + rounding)
            by_point = shapes.reshape(size, -1, shapes.shape[1])
            self._groups.append(_Group(first, end, by_point, share))
            first = end
        self._margins = np.stack(margins)  # (groups, columns)

    def __len__(self) -> int:
        return self._groups[-1].end

    def stress(
        self, points: np.ndarray, loads: np.ndarray, columns: np.ndarray | None = None
    ) -> np.ndarray:
        """Equivalent stress (n_points, nt) at points (n_points,) under loads (nt, columns), or
        (nt, n) of some columns, without which there are none."""
        if columns is None:
            columns = np.flatnonzero(loads.any(axis=0))
            loads = loads[:, columns]
        return _norms(self._rows(points, columns) @ loads.T, len(points))

    def bounds(
        self, loads: np.ndarray, points: np.ndarray | None = None
    ) -> tuple[np.ndarray, np.ndarray]:
        """Lower and upper bounds (n_points, nt) on the stress at points (n_points,), rising, all by
        default."""
        used = np.flatnonzero(loads.any(axis=0))
        own = np.ascontiguousarray(loads[:, used].T)
        margins = self._margins[:, used] @ np.abs(own)
        every = np.arange(len(self)) if points is None else points
        low = np.empty((len(every), len(loads)), np.float32)
        high = np.empty_like(low)
        for group, margin in zip(self._groups, margins):
            some = slice(*np.searchsorted(every, [group.first, group.end]))
            if some.start < some.stop:
                shapes = group.shapes[every[some] - group.first]
                flat = shapes.reshape(-1, shapes.shape[2])
                middle = _norms(flat @ (group.share[:, used] @ own), len(shapes))
                np.subtract(middle, margin, out=low[some])
                np.add(middle, margin, out=high[some])
        return low, high


def _norms(parts: np.ndarray, points: int) -> np.ndarray:
    """Norms (n_points, nt) of deviators (n_points * parts, nt), whose place is taken."""
    if not points:
        return parts
    np.square(parts, out=parts)
    return np.sqrt(parts.reshape(points, -1, parts.shape[1]).sum(axis=1))


def _largest(rows: np.ndarray, points: int) -> np.ndarray:
    """Largest norm (columns,) among the points of rows (points * parts, columns)."""
    return np.sqrt(np.square(rows).reshape(points, -1, rows.shape[1]).sum(axis=1).max(axis=0))
