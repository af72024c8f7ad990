"""A ring numbered sector by sector: which node follows which, and which sectors are alike."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np

_ALIKE = 1e-12  # misfit of vertices turned back, relative to the ring's size


def rotation_x(angle: float) -> np.ndarray:
    """Rotation about x by ``angle``, y towards z."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


@dataclass(frozen=True)
class Sectors:
    """Numbering of a ring of ``count`` sectors about x that all have the same connections, but
    where it was cut open (cracks, missing rivets) and nodes have copies.

    ``image[i]`` is the node that has the place of node i in the next sector; turned by 2 pi/count
    it is node i, unless a defect moved either. Cell ``cells[k, c]`` follows ``cells[k - 1, c]``;
    those of sector 0 are around psi = 0.
    """

    cells: np.ndarray  # (count, n) of every sector
    image: np.ndarray  # (N,)
    place: np.ndarray  # (N,) the node itself, or for a copy the one that it was made of

    @property
    def count(self) -> int:
        return len(self.cells)

    @cached_property
    def doubled(self) -> np.ndarray:
        """The copies (n,) among the nodes."""
        return np.flatnonzero(self.place != np.arange(len(self.place)))

    def followed(self, nodes: np.ndarray) -> np.ndarray:
        """The nodes (n,) of sector 0 in all sectors: (count, n)."""
        rows = [np.asarray(nodes)]
        for _ in range(self.count - 1):
            rows.append(self.image[rows[-1]])
        return np.stack(rows)

    def turn(self, sectors: int) -> np.ndarray:
        """Rotation (3, 3) by a number of sectors."""
        return rotation_x(2.0 * np.pi * sectors / self.count)

    @cached_property
    def turns(self) -> np.ndarray:
        """Rotations (count, 3, 3) from the first sector's frame, the ring's, to all sectors'."""
        return np.stack([self.turn(k) for k in range(self.count)])

    def alike(self, points: np.ndarray, vertices: np.ndarray) -> list[list[int]]:
        """Sectors whose ``vertices`` (count, n) of ``points`` differ by a turn only, together."""
        placed = [points[own] @ self.turn(k) for k, own in enumerate(vertices)]
        return group_alike(placed, _ALIKE * np.abs(points).max())


def group_alike(values: Sequence[np.ndarray], tolerance: float) -> list[list[int]]:
    """Arrays of ``values`` that equal the first of their group to ``tolerance``; those of other
    shapes do not."""
    groups: list[list[int]] = []
    for k, own in enumerate(values):
        for group in groups:
            first = values[group[0]]
            if own.shape == first.shape and np.abs(own - first).max() <= tolerance:
                group.append(k)
                break
        else:
            groups.append([k])
    return groups


def find_sectors(
    info: Mapping[str, object], tets: np.ndarray, n_points: int, edges: np.ndarray
) -> Sectors | None:
    """The sectors that ``info`` of a mesh tells of, or None where there are none.

    ``tets`` (n_tets, 4) must follow the numbering that ``CageMesh`` describes; ``edges``
    (n_edges, 2) are sorted vertex pairs, whose midpoints are the nodes after the vertices.
    """
    doubled = np.asarray(info.get("doubled", ()), np.int64)
    n = n_points - len(doubled)
    sector_map = _sector_map(info, n)
    if sector_map is None:
        return None
    following, cells = sector_map
    place = np.append(np.arange(n), doubled)  # of vertices
    if len(cells) < 3 or cells.size != len(tets) or not _repeats(place[tets], following, cells):
        return None
    pairs = place[edges]
    keys, first, number = np.unique(edge_keys(pairs, n), return_index=True, return_inverse=True)
    after = first[np.searchsorted(keys, edge_keys(following[pairs[first]], n))]
    return Sectors(
        cells,
        image=np.concatenate([following[place], n_points + after[number]]),
        place=np.concatenate([place, n_points + first[number]]),
    )


def _sector_map(info: Mapping[str, object], n: int) -> tuple[np.ndarray, np.ndarray] | None:
    """Which of n vertices follows each (n,), and the cells of all sectors (count, .)."""
    following, cells = info.get("following"), info.get("sector_tets")
    if isinstance(following, np.ndarray) and isinstance(cells, np.ndarray):
        return (following, cells) if len(following) == n else None
    own, per_sector = info.get("sector_points"), info.get("sector_cells")
    if not isinstance(own, int) or not isinstance(per_sector, int) or n % own:
        return None
    return (np.arange(n) + own) % n, np.arange(n // own * per_sector).reshape(n // own, -1)


def edge_keys(pairs: np.ndarray, n_points: int) -> np.ndarray:
    """A number (...) for each pair of vertices (..., 2), in whatever order."""
    rising = np.sort(pairs, axis=-1).astype(np.int64)
    return rising[..., 0] * n_points + rising[..., 1]


def edges_of(cells: np.ndarray) -> np.ndarray:
    """Sorted vertex pairs (n, 2) of the edges of triangles (m, 3) or tetrahedra (m, 4), each once,
    in rising order."""
    base = int(cells.max(initial=0)) + 1
    pairs = cells[:, list(combinations(range(cells.shape[1]), 2))]
    return np.stack(np.divmod(np.unique(edge_keys(pairs, base)), base), axis=1)


def _repeats(tets: np.ndarray, following: np.ndarray, cells: np.ndarray) -> bool:
    """Whether the cells of every sector follow those of the one before."""
    rows = np.sort(tets, axis=1)[cells]
    wanted = np.sort(following[tets], axis=1)[cells]
    return bool(np.array_equal(wanted, np.roll(rows, -1, axis=0)))
