"""A ring numbered sector by sector: which node follows which, and which sectors are alike."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

_ALIKE = 1e-12  # misfit of vertices turned back, relative to the ring's size


def rotation_x(angle: float) -> np.ndarray:
    """Rotation about x by ``angle``, y towards z."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])


@dataclass(frozen=True)
class Sectors:
    """Numbering of a ring of ``count`` sectors about x that all have the same connections.

    ``image[i]`` is the node that has the place of node i in the next sector; turned by 2 pi/count
    it is node i, unless a defect moved either. Cell c of sector k is ``c + k cells``.
    """

    count: int
    cells: int  # in a sector
    image: np.ndarray  # (N,)

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
        placed = np.stack([points[own] @ self.turn(k) for k, own in enumerate(vertices)])
        return group_alike(placed, _ALIKE * np.abs(points).max())


def group_alike(values: np.ndarray, tolerance: float) -> list[list[int]]:
    """Rows of ``values`` (n, ...) that equal the first of their group to ``tolerance``."""
    groups: list[list[int]] = []
    for k, row in enumerate(values):
        for group in groups:
            if np.abs(row - values[group[0]]).max() <= tolerance:
                group.append(k)
                break
        else:
            groups.append([k])
    return groups


def find_sectors(
    info: Mapping[str, object], tets: np.ndarray, n_points: int, edges: np.ndarray
) -> Sectors | None:
    """The sectors that ``info`` of a built mesh tells of, or None where there are none.

    ``tets`` (n_tets, 4) must follow the numbering that ``CageMesh`` describes; ``edges``
    (n_edges, 2) are sorted vertex pairs, whose midpoints are the nodes after the vertices.
    """
    own, cells = info.get("sector_points"), info.get("sector_cells")
    if not isinstance(own, int) or not isinstance(cells, int) or n_points % own:
        return None
    count = n_points // own
    if count < 3 or len(tets) != count * cells or not _repeats(tets, own, count, n_points):
        return None
    vertices = (np.arange(n_points) + own) % n_points
    midpoints = np.sort(vertices[edges], axis=1).reshape(-1, 2)
    keys, wanted = (pairs[:, 0] * np.int64(n_points) + pairs[:, 1] for pairs in (edges, midpoints))
    order = np.argsort(keys)
    image = np.concatenate([vertices, n_points + order[np.searchsorted(keys[order], wanted)]])
    return Sectors(count, cells, image.astype(np.int64))


def _repeats(tets: np.ndarray, own: int, count: int, n_points: int) -> bool:
    shift = own * np.arange(count)[:, None, None]
    first = tets[: len(tets) // count]
    wanted = np.sort((first[None] + shift) % n_points, axis=2)
    return bool(np.array_equal(wanted, np.sort(tets, axis=1).reshape(wanted.shape)))
