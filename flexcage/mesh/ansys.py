"""Reading the mesh of an Ansys archive (.cdb) through mapdl-archive: tetrahedra and components.

A surface is a node component (``CM, NAME, NODE``): the faces of tetrahedra at the boundary whose
three corners are in it, or an element component of surface triangles. Ansys has no + and - in
names: a name that ends in _px or _mx is one that ends in +x or -x.
"""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from flexcage.core.errors import InputError, package_lacks

_TEN = (87, 92, 98, 187, 227, 232, 237)  # element types that are ten-node tetrahedra
_FOUR = (285,)  # four-node ones
_BRICKS = (45, 62, 70, 95, 90, 185, 186, 226, 231, 236)  # tetrahedra as degenerate bricks
_SURFACES = (63, 93, 152, 154, 170, 173, 174, 181, 200, 281)
_HEAD = 10  # numbers of an element before its nodes
_FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
_SIGNS = {"_px": "+x", "_mx": "-x"}


def read_archive(path: Path, *, where: str) -> Any:
    """The archive as mapdl-archive has it; InputError for a file that is none."""
    try:
        from mapdl_archive import Archive
    except ImportError as error:
        work = "Ansys archives (.cdb) are read"
        raise package_lacks(work, "mapdl-archive", extra="bodies") from error
    try:
        archive = Archive(str(path), parse_vtk=False)  # its VTK cells crash on odd elements
        if archive.n_node:
            return archive
    except Exception as error:  # of all kinds on broken files
        raise InputError(
            f"{path} cannot be read as an Ansys archive (.cdb): {error}.", where=where
        ) from error
    raise InputError(f"{path} has no NBLOCK of nodes.", where=where, value=str(path))


def read_cdb(path: Path) -> Any:
    """meshio's mesh of an archive: blocks of tetrahedra and triangles, and ``cell_sets`` of these.

    Raises ValueError for solid elements of other shapes.
    """
    import meshio

    archive = read_archive(path, where="mesh.file")
    row = {int(n): i for i, n in enumerate(archive.nnum)}
    solids: dict[str, list[list[int]]] = {"tetra": [], "tetra10": []}
    surfaces: dict[int, list[int]] = {}  # by element number
    for number, kind, element in zip(archive.enum, archive.etype, archive.elem):
        nodes = [int(n) for n in element[_HEAD:] if n > 0]
        if int(kind) in _SURFACES:
            surfaces[int(number)] = [row[n] for n in dict.fromkeys(nodes[:4])]
        elif shape := _tetrahedron(int(kind), nodes):
            solids["tetra10" if len(shape) == 10 else "tetra"].append([row[n] for n in shape])
    cells = [(kind, np.array(rows)) for kind, rows in solids.items() if rows]
    corners = np.vstack([rows[:, :4] for _, rows in cells] or [np.empty((0, 4), int)])
    sets = {_name(n): _boundary(corners, [row[int(v)] for v in nodes if int(v) in row])
            for n, nodes in archive.node_components.items()}  # fmt: skip
    for name, elements in archive.element_components.items():
        found = [surfaces[int(e)] for e in elements if len(surfaces.get(int(e), ())) == 3]
        if found:
            sets[_name(name)] = np.array(found)
    sets = {name: triangles for name, triangles in sets.items() if len(triangles)}
    first = len(cells)
    none = [np.empty(0, int)] * (first + len(sets))
    chosen = {}
    for i, (name, triangles) in enumerate(sets.items()):
        cells.append(("triangle", triangles))
        chosen[name] = [*none]
        chosen[name][first + i] = np.arange(len(triangles))
    return meshio.Mesh(np.asarray(archive.nodes[:, :3], float), cells, cell_sets=chosen)


def _tetrahedron(kind: int, nodes: list[int]) -> list[int] | None:
    """Four or ten nodes of a tetrahedron; None for an element that is no solid."""
    if kind in _TEN:
        return nodes[:10] if len(nodes) >= 10 else nodes[:4]
    if kind in _FOUR:
        return nodes[:4]
    if kind not in _BRICKS:
        return None
    corners = list(dict.fromkeys(nodes[:8]))
    if len(corners) != 4:
        raise ValueError(f"it has elements of type {kind} that are no tetrahedra")
    return corners


def _boundary(tets: np.ndarray, nodes: list[int]) -> np.ndarray:
    """Triangles (n, 3) at the boundary of tetrahedra (m, 4) whose corners are all among nodes."""
    faces = tets[:, _FACES].reshape(-1, 3)
    _, where, count = np.unique(
        np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True
    )
    outer = faces[where[count == 1]]
    return outer[np.isin(outer, nodes).all(axis=1)]


def _name(component: str) -> str:
    """Name of a group that a component's name stands for."""
    name = component.strip().lower()
    return name[:-3] + _SIGNS[name[-3:]] if name[-3:] in _SIGNS else name
