"""Structured meshes of simple bodies, in metres."""

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
