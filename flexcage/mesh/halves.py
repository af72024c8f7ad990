"""Cages of two halves, at x > 0 and x < 0, that hold together at places of the middle plane."""

from __future__ import annotations

from math import pi

import numpy as np

from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.measure import in_pocket_frame


def shared_by_halves(
    points: np.ndarray, tets: np.ndarray, cells: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Which elements of such a cage lie at x > 0, by tetrahedra (n, 4); and of the nodes in
    ``cells`` (n, 4 or 10) those of elements on both sides, where the halves hold together."""
    ahead = points[tets].mean(axis=1)[:, 0] > 0.0
    return ahead, np.intersect1d(cells[ahead], cells[~ahead])


def joined_vertices(mesh: CageMesh, web: int) -> np.ndarray:
    """Vertices (n,) at one web by which a rivet holds the halves together."""
    _, shared = shared_by_halves(mesh.points, mesh.tets, mesh.tets)
    _, y, t = in_pocket_frame(mesh.points[shared], web - 0.5, mesh.pocket_count).T
    return shared[np.abs(np.arctan2(t, y)) < pi / mesh.pocket_count]
