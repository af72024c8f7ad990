"""A ring with pockets, cut from a structured grid: no mesh generator needed."""

from __future__ import annotations

from types import MappingProxyType

import numpy as np

from flexcage.mesh.cage_mesh import CageMesh

Z = 12
PER = 6  # cells of a pitch around: the middle four are the pocket
AXIAL, RADIAL = 6, 2  # the middle four axial layers are the pocket's
_CUBE = ((0, 1, 3, 7), (0, 3, 2, 7), (0, 2, 6, 7), (0, 6, 4, 7), (0, 4, 5, 7), (0, 5, 1, 7))


def ring_mesh() -> CageMesh:
    around = Z * PER
    psi = 2 * np.pi * (np.arange(around) - PER / 2) / around
    x, r = np.linspace(-8e-3, 8e-3, AXIAL + 1), np.linspace(39e-3, 43e-3, RADIAL + 1)
    grid = np.stack(np.meshgrid(psi, x, r, indexing="ij"), -1).reshape(-1, 3)
    a, points_x, radius = grid.T
    points = np.column_stack([points_x, radius * np.cos(a), radius * np.sin(a)])
    node = np.arange(len(points)).reshape(around, AXIAL + 1, RADIAL + 1)
    tets, walls = [], {name: {k: [] for k in range(Z)} for name in ("front", "rear")}
    walls |= {name: {k: [] for k in range(Z)} for name in ("side+x", "side-x")}
    for i in range(around):
        for j in range(AXIAL):
            inside = 1 <= i % PER <= PER - 2 and 1 <= j <= AXIAL - 2
            for k in range(RADIAL):
                n = [
                    node[(i + u) % around, j + v, k + w]
                    for u in (0, 1)
                    for v in (0, 1)
                    for w in (0, 1)
                ]
                pocket = i // PER
                if inside:
                    if i % PER == 1:
                        walls["rear"][pocket] += [(n[0], n[1], n[3]), (n[0], n[3], n[2])]
                    if i % PER == PER - 2:
                        walls["front"][pocket] += [(n[4], n[7], n[5]), (n[4], n[6], n[7])]
                    if j == 1:
                        walls["side-x"][pocket] += [(n[0], n[5], n[1]), (n[0], n[4], n[5])]
                    if j == AXIAL - 2:
                        walls["side+x"][pocket] += [(n[2], n[3], n[7]), (n[2], n[7], n[6])]
                else:
                    tets += [[n[c] for c in t] for t in _CUBE]
    tets = np.array(tets)
    used, flat = np.unique(tets, return_inverse=True)
    number = np.full(len(points), -1)
    number[used] = np.arange(len(used))
    tets, points = flat.reshape(-1, 4), points[used]
    p = points[tets]
    volume = np.einsum(
        "ij,ij->i", np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), p[:, 3] - p[:, 0]
    )
    tets[volume < 0] = tets[volume < 0][:, [0, 2, 1, 3]]
    groups = {
        f"pocket{k}_{name}": number[np.array(t)]
        for name, by in walls.items()
        for k, t in by.items()
    }
    return CageMesh(points, tets, MappingProxyType(groups), Z)


def quadratic(points: np.ndarray, tets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Nodes and 10-node cells: edge midpoints in the order 01 12 02 03 13 23."""
    pairs = np.sort(
        np.stack([tets[:, e] for e in ([0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3])], axis=1), -1
    )
    edges, index = np.unique(pairs.reshape(-1, 2), axis=0, return_inverse=True)
    cells = np.hstack([tets, len(points) + index.reshape(-1, 6)])
    return np.vstack([points, points[edges].mean(axis=1)]), cells
