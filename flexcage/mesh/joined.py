"""Two halves of a common cage as one body: they share the vertices of the middle plane, in which
both have the same grid (``joint``). Sector k of the whole is sector k of both."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from types import MappingProxyType

import numpy as np
from scipy.spatial import cKDTree

from flexcage.core.errors import RunFailed
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.doubling import doubled
from flexcage.mesh.rows import ENDS, RowFrame, cells_in, groups_in, info_of

_SAME = 1e-6  # misfit of vertices that are one, over the ring's size


def joined(halves: Sequence[CageMesh], sound: CageMesh, frames: Sequence[RowFrame]) -> CageMesh:
    """Two ``halves`` with their defects, each in its row's frame, as one body; ``sound`` is a half
    without defects. RunFailed where they do not meet node by node."""
    pair = [_Half(k, *parts, sound) for k, parts in enumerate(zip(halves, frames))]
    shared = _shared(pair)
    numbers = _numbers(pair, shared)
    points = np.zeros((numbers.total, 3))
    for half, own in zip(pair, numbers.own):
        points[own] = half.frame.out_of(half.mesh.points)
    points[numbers.own[0][shared[0]]] = _in_middle(pair, shared)
    tets = np.concatenate([cells_in(h.mesh, h.frame, own) for h, own in zip(pair, numbers.own)])
    order, info = _by_sectors(halves), dict(info_of(halves, frames))
    if order is not None:
        tets = tets[order]
        info |= {"sector_points": numbers.per_sector, "doubled": tuple(numbers.doubled.tolist())}
        info |= {"sector_cells": len(tets) // sound.pocket_count}
    groups = groups_in(halves, frames, numbers.own, without=[half.middle for half in pair])
    return CageMesh(points, tets, groups, sound.pocket_count, MappingProxyType(info))


@dataclass(frozen=True)
class _Half:
    """A half of the cage, of the row at -x (0) or +x (1), and one without defects."""

    row: int
    mesh: CageMesh
    frame: RowFrame
    sound: CageMesh

    @property
    def count(self) -> int:
        """How many of its vertices are no copies."""
        return len(self.mesh.points) - len(doubled(self.mesh))

    @property
    def per_sector(self) -> int:
        return self.count // self.mesh.pocket_count

    @property
    def middle(self) -> str:
        """The group of its end in the middle plane."""
        return ENDS[self.frame.sign * (-1.0 if self.row else 1.0)]

    @property
    def on_middle(self) -> np.ndarray:
        """Vertices (m,) there, without copies."""
        every = np.unique(self.mesh.groups[self.middle])
        return every[every < self.count]

    def undamaged(self, vertices: np.ndarray) -> np.ndarray:
        """Where vertices (m,) of the middle plane were (m, 3) [m] without defects, in the cage's
        frame. A half that was meshed otherwise for its defects has the same grid there, each vertex
        nearest to the sound one."""
        if len(self.sound.points) == self.count:
            return self.frame.out_of(self.sound.points[vertices])
        grid = self.sound.points[np.unique(self.sound.groups[self.middle])]
        _, nearest = cKDTree(grid).query(self.mesh.points[vertices])
        return self.frame.out_of(grid[nearest])


def _shared(pair: Sequence[_Half]) -> tuple[np.ndarray, np.ndarray]:
    """Vertices (m,) of the first half in the middle plane, and of the second that these are."""
    on = [half.on_middle for half in pair]
    around = [half.undamaged(own)[:, 1:] for half, own in zip(pair, on)]
    distance, nearest = cKDTree(around[0]).query(around[1])
    far = distance.max() > _SAME * np.abs(around[0]).max()
    if far or len(on[0]) != len(on[1]) or len(np.unique(nearest)) != len(on[0]):
        raise RunFailed("the halves of the cage do not meet node by node in the middle plane")
    return on[0][nearest], on[1]


@dataclass(frozen=True)
class _Numbers:
    """Numbers in the whole of both halves' vertices, and of which ones the last are copies."""

    own: tuple[np.ndarray, np.ndarray]
    per_sector: int
    total: int
    doubled: np.ndarray


def _numbers(pair: Sequence[_Half], shared: tuple[np.ndarray, np.ndarray]) -> _Numbers:
    first, second = pair
    free = np.ones(second.per_sector, bool)  # of a sector: not the first half's
    free[shared[1][shared[1] < second.per_sector]] = False
    both = first.per_sector + int(free.sum())
    sector, local = np.divmod(np.arange(first.count), first.per_sector)
    one = sector * both + local
    sector, local = np.divmod(np.arange(second.count), second.per_sector)
    two = sector * both + first.per_sector + np.cumsum(free)[local] - 1
    two[shared[1]] = one[shared[0]]
    total = both * first.mesh.pocket_count
    own, behind = [], [np.zeros(0, int)]
    for half, number, middle in zip(pair, (one, two), shared):
        copies = np.array(doubled(half.mesh), int)
        new = ~np.isin(copies, middle)  # a crack ends in the middle plane
        places = np.where(new, total + np.cumsum(new) - 1, number[copies])
        own.append(np.append(number, places))
        behind.append(number[copies[new]])
        total += int(new.sum())
    return _Numbers((own[0], own[1]), both, total, np.concatenate(behind))


def _in_middle(pair: Sequence[_Half], shared: tuple[np.ndarray, np.ndarray]) -> np.ndarray:
    """Places (m, 3) [m] of the shared vertices: in the middle plane, moved by all defects."""
    was = [half.undamaged(own) for half, own in zip(pair, shared)]
    now = [half.frame.out_of(half.mesh.points[own]) for half, own in zip(pair, shared)]
    return was[0] * (0.0, 1.0, 1.0) + (now[0] - was[0]) + (now[1] - was[1])


def _by_sectors(halves: Sequence[CageMesh]) -> np.ndarray | None:
    """Order of the tetrahedra of both halves by sectors; None where a sector lost some."""
    rows, first = [], 0
    for half in halves:
        per_sector: int = half.info.get("sector_cells", 0)  # type: ignore[assignment]
        if len(half.tets) != per_sector * half.pocket_count:
            return None
        rows.append(first + np.arange(len(half.tets)).reshape(half.pocket_count, -1))
        first += len(half.tets)
    return np.concatenate(rows, axis=1).ravel()
