"""Triangles in the section of a ring: a closed outline of named edges, meshed by gmsh."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from flexcage.mesh.gmsh_session import gmsh_model


@dataclass(frozen=True, eq=False)
class SectionMesh:
    """Straight triangles in (x, r), SI; ``edges``: pairs of points (k, 2) of every named edge."""

    points: np.ndarray  # (n, 2)
    triangles: np.ndarray  # (m, 3)
    edges: Mapping[str, np.ndarray]


def mesh_section(
    outline: Sequence[tuple[float, float]],
    names: Sequence[str],
    size: Callable[[float, float], float],
) -> SectionMesh:
    """Mesh of a closed outline (x, r) [m], without its first point repeated.

    ``names``: of the straight edge from every point to the next, "" for none; ``size``: of
    triangles at a place (x, r) [m]. Raises InputError where gmsh finds no mesh.
    """
    with gmsh_model("section") as gmsh:
        geo = gmsh.model.geo
        corners = [geo.addPoint(x, r, 0.0) for x, r in outline]
        lines = [geo.addLine(a, b) for a, b in zip(corners, [*corners[1:], corners[0]])]
        geo.addPlaneSurface([geo.addCurveLoop(lines)])
        geo.synchronize()
        _generate(gmsh, size)
        tags, places, _ = gmsh.model.mesh.getNodes()
        number = np.zeros(int(tags.max()) + 1, np.int64)
        number[tags] = np.arange(len(tags))
        _, _, triangles = gmsh.model.mesh.getElements(2)
        edges: dict[str, list[np.ndarray]] = {}
        for line, name in zip(lines, names):
            _, _, pairs = gmsh.model.mesh.getElements(1, line)
            if name:
                edges.setdefault(name, []).append(number[pairs[0]].reshape(-1, 2))
        return SectionMesh(
            points=places.reshape(-1, 3)[:, :2].copy(),
            triangles=number[triangles[0]].reshape(-1, 3),
            edges={name: np.concatenate(found) for name, found in edges.items()},
        )


def _generate(gmsh: Any, size: Callable[[float, float], float]) -> None:
    """Mesh the model's surface with triangles of a size (x, r), and leave gmsh's options alone."""
    option = "Mesh.MeshSizeExtendFromBoundary"
    before = gmsh.option.getNumber(option)
    gmsh.option.setNumber(option, 0)
    gmsh.model.mesh.setSizeCallback(lambda dim, tag, x, r, z, least: size(x, r))
    try:
        gmsh.model.mesh.generate(2)
    finally:
        gmsh.model.mesh.removeSizeCallback()
        gmsh.option.setNumber(option, before)
