"""A rivet that is missing, on the mesh."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.doubling import with_doubled
from flexcage.mesh.halves import joined_vertices


def without_rivet(mesh: CageMesh, web: int, gap: float) -> CageMesh:
    """``mesh`` of a ribbon cage whose halves are free of each other at one web, ``gap`` [m] off the
    middle plane each."""
    old = joined_vertices(mesh, web)
    copy = np.arange(len(mesh.points))
    copy[old] = len(copy) + np.arange(len(old))
    under = mesh.points[mesh.tets].mean(axis=1)[:, 0] < 0.0
    tets = np.where(under[:, None], copy[mesh.tets], mesh.tets)
    points = np.vstack([mesh.points, mesh.points[old]])
    points[old, 0], points[len(copy) :, 0] = gap, -gap
    info = with_doubled(mesh, old)
    return replace(mesh, points=points, tets=tets, info=info)  # no group has a face on that plane
