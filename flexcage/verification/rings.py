"""Rings of solid elements about the x axis, as meshes."""

from __future__ import annotations

import numpy as np

from flexcage.mesh.cage_mesh import CageMesh


def ring(
    inner: float, outer: float, width: float, cells: tuple[int, int, int]
) -> tuple[CageMesh, np.ndarray]:
    """A ring of radii and width [m], cells in (x, r, psi); and every point's radius (n,)."""
    import skfem

    nx, nr, nt = cells
    axes = [np.linspace(-width / 2, width / 2, nx + 1), np.linspace(inner, outer, nr + 1)]
    mesh = skfem.MeshTet.init_tensor(*axes, np.arange(nt + 1.0))
    x, r, turn = mesh.p
    keys = np.round(np.stack([x / width * nx, (r - inner) / (outer - inner) * nr, turn % nt]), 3)
    _, first, weld = np.unique(keys, axis=1, return_index=True, return_inverse=True)
    angle = 2.0 * np.pi * turn / nt
    points = np.stack([x, r * np.cos(angle), r * np.sin(angle)], axis=1)[first]
    return CageMesh(points, weld[mesh.t.T]), r[first]
