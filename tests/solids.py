"""Structured meshes of simple solids, in metres."""

from __future__ import annotations

import numpy as np
import skfem

from flexcage.mesh.cage_mesh import CageMesh


def box(size: tuple[float, float, float], cells: tuple[int, int, int]) -> CageMesh:
    """A box from the origin with groups 'x0' and 'x1' on its two x faces."""
    axes = [np.linspace(0.0, s, n + 1) for s, n in zip(size, cells)]
    mesh = skfem.MeshTet.init_tensor(*axes)
    points = mesh.p.T.copy()
    groups = {}
    for name, at in (("x0", 0.0), ("x1", size[0])):
        facets = mesh.facets[:, mesh.boundary_facets()].T
        groups[name] = facets[np.all(np.abs(points[facets, 0] - at) < 1e-12, axis=1)]
    return CageMesh(points, mesh.t.T.copy(), groups)


def ring(
    inner: float, outer: float, width: float, cells: tuple[int, int, int]
) -> tuple[CageMesh, np.ndarray]:
    """A ring about x of radii and width, cells in (x, r, psi); and every point's radius (n,)."""
    nx, nr, nt = cells
    axes = [np.linspace(-width / 2, width / 2, nx + 1), np.linspace(inner, outer, nr + 1)]
    mesh = skfem.MeshTet.init_tensor(*axes, np.arange(nt + 1.0))
    x, r, turn = mesh.p
    keys = np.round(np.stack([x / width * nx, (r - inner) / (outer - inner) * nr, turn % nt]), 3)
    _, first, weld = np.unique(keys, axis=1, return_index=True, return_inverse=True)
    angle = 2.0 * np.pi * turn / nt
    points = np.stack([x, r * np.cos(angle), r * np.sin(angle)], axis=1)[first]
    return CageMesh(points, weld[mesh.t.T]), r[first]
