"""Reading the mesh of an Ansys archive (.cdb) through mapdl-archive: tetrahedra and components.

A surface is a node component (``CM, NAME, NODE``): the faces of tetrahedra at the boundary whose
three corners are in it, or an element component of surface triangles. Ansys has no + and - in
names: a name that ends in _px or _mx is one that ends in +x or -x.
"""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.core.errors import InputError, package_lacks
from flexcage.mesh.files.nblock import nodes_of
from flexcage.mesh.files.raw import RawMesh, Refused, group_name, lines_of, listed, text_of

_TEN = (87, 92, 98, 187, 227, 232, 237)  # element types that are ten-node tetrahedra
_FOUR = (285,)  # four-node ones
_BRICKS = (45, 62, 70, 95, 90, 185, 186, 226, 231, 236)  # tetrahedra as degenerate bricks
_SURFACES = (63, 93, 152, 154, 170, 173, 174, 181, 200, 281)
_NO_SOLIDS = (  # masses, springs, joints, beams, pipes, contacts: no part of the body
    14, 21, 39, 40, 61, 63, 93, 151, 153, 155, 156, 159, 169, 171, 172, 175, 176, 177, 178, 179,
    180, 184, 188, 189, 201, 202, 203, 204, 205, 208, 209, 288, 289, 290,
)  # fmt: skip
# commands that make, move or remove what an archive's blocks hold
_CHANGES = frozenset(
    "N E EN EMORE NGEN NFILL NSYM NSCALE NMODIF NMOVE NDELE MOVE EGEN ESYM ENSYM EMODIF EDELE "
    "EINTF NUMMRG CM CMEDIT CMGRP CMMOD CMDELE TRANSFER VMESH VSWEEP AMESH VGEN AGEN /INPUT "
    "CDREAD *USE *DO EMTGEN ESURF".split()
)
# those of them that say nothing of nodes
_OF_ELEMENTS = frozenset("E EN EMORE EGEN ESYM ENSYM EMODIF EDELE EINTF ESURF EMTGEN".split())
_TURNS = frozenset(("NROTAT", "NANG"))  # the axes along which nodes move
_COMMAND = re.compile(r"\s*([/*]?[A-Za-z]+)\s*,")
_LAST = re.compile(r"^\s*(N|EN)\s*,\s*(?:R\d|UNBL)[^,]*,[^,]*,\s*-1\s*,?\s*$", re.IGNORECASE)
_HEAD = 10  # numbers of an element before its nodes
_FACES = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
# of the 20 nodes of a brick whose corners are I J K K M M M M: those of ten of a tetrahedron
_FALLEN = (0, 1, 2, 4, 8, 9, 11, 16, 17, 18)
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


def read_cdb(path: Path) -> RawMesh:
    """The mesh of an archive. Raises ``Refused`` for what is not followed."""
    text = text_of(path)
    refuse_commands(text)
    archive = read_archive(path, where="mesh.file")
    node_numbers, points = nodes_of(text)
    _refuse_twice("node", node_numbers)
    _refuse_twice("element", archive.enum)
    row = {int(n): i for i, n in enumerate(node_numbers)}
    solids: dict[int, list[list[int]]] = {4: [], 10: []}
    numbers: dict[int, list[int]] = {4: [], 10: []}
    flat: dict[int, list[int]] = {}  # surface elements by number
    for number, kind, element in zip(archive.enum, archive.etype, archive.elem):
        nodes = [int(n) for n in element[_HEAD:] if n > 0]
        if lacking := [n for n in nodes if n not in row]:
            raise Refused(f"element {number} has node {listed(lacking)}, which is not in it")
        if int(kind) in _SURFACES:
            flat[int(number)] = [row[n] for n in dict.fromkeys(nodes[:4])]
        elif shape := _tetrahedron(int(kind), nodes):
            solids[len(shape)].append([row[n] for n in shape])
            numbers[len(shape)].append(int(number))
    blocks = [np.array(rows) for rows in solids.values() if rows]
    boundary = _boundary(np.vstack([b[:, :4] for b in blocks] or [np.empty((0, 4), int)]))
    by_nodes = {
        _name(name): np.asarray(np.isin(boundary, _rows(_name(name), nodes, row)).all(axis=1))
        for name, nodes in archive.node_components.items()
    }
    _part_corners(points, boundary, by_nodes)
    surfaces = {name: boundary[own] for name, own in by_nodes.items()}
    surfaces |= _by_elements(archive.element_components, flat)
    return RawMesh(
        points=points,
        solids=tuple(blocks),
        surfaces={name: triangles for name, triangles in surfaces.items() if len(triangles)},
        point_numbers=node_numbers,
        solid_numbers=np.array([n for of in numbers.values() for n in of], np.int64),
        no_surfaces={n: "a component without a face" for n, t in surfaces.items() if not len(t)},
    )


def refuse_commands(text: str, *, nodes_alone: bool = False) -> None:
    """Refuse commands that make, move or remove nodes, elements or components of surfaces."""
    changes = _CHANGES - _OF_ELEMENTS | _TURNS if nodes_alone else _CHANGES
    for line, row in enumerate(lines_of(text), start=1):
        found = _COMMAND.match(row)
        if not found or found[1].upper() not in changes or _LAST.search(row):
            continue
        component = found[1].upper().startswith("CM")
        if not component or group_name(_name(row.split(",")[1])):
            raise Refused(
                f"line {line}: the command {found[1].upper()} is not followed, and changes nodes, "
                "elements or components; run it in Ansys, and write the archive again with "
                "CDWRITE,DB in blocked format"
            )


def _refuse_twice(what: str, numbers: np.ndarray) -> None:
    found, count = np.unique(numbers, return_counts=True)
    if (count > 1).any():
        raise Refused(f"it numbers {what}s twice ({listed(found[count > 1])}); write one part")


def _rows(name: str, nodes: np.ndarray, row: dict[int, int]) -> list[int]:
    lacking = [int(n) for n in nodes if int(n) not in row]
    if lacking and group_name(name):
        raise Refused(f"the component '{name}' has node {listed(lacking)}, which is not in it")
    return [row[int(n)] for n in nodes if int(n) in row]


def _by_elements(
    components: Mapping[str, np.ndarray], flat: dict[int, list[int]]
) -> dict[str, np.ndarray]:
    """Triangles of the element components that have some."""
    found = {_name(n): _triangles(_name(n), [int(e) for e in v], flat)
             for n, v in components.items()}  # fmt: skip
    return {name: np.array(triangles) for name, triangles in found.items() if triangles}


def _triangles(name: str, elements: list[int], flat: dict[int, list[int]]) -> list[list[int]]:
    """Corners of the triangles of an element component; none of solids."""
    found = [flat[e] for e in elements if len(flat.get(e, ())) == 3]
    if found and len(found) < len(elements) and group_name(name):
        rest = [e for e in elements if len(flat.get(e, ())) != 3]
        raise Refused(
            f"the component '{name}' has {len(rest)} elements that are no triangles "
            f"({listed(rest)}); a surface has triangles alone"
        )
    return found


def _tetrahedron(kind: int, nodes: list[int]) -> list[int] | None:
    """Four or ten nodes of a tetrahedron; None for an element that is no solid."""
    if kind in _TEN:
        return nodes[:10] if len(nodes) >= 10 else nodes[:4]
    if kind in _FOUR:
        return nodes[:4]
    if kind in _NO_SOLIDS:
        return None
    corners = list(dict.fromkeys(nodes[:8]))
    if len(nodes) == 20 and nodes[2] == nodes[3] and len({*nodes[4:8]}) == 1:
        return [nodes[i] for i in _FALLEN]  # with its nodes on edges
    if kind not in _BRICKS or len(corners) != 4:
        raise Refused(
            f"it has elements of type {kind} that are no tetrahedra; mesh the cage with tetrahedra "
            "(SOLID285, SOLID187 or degenerate SOLID185) alone"
        )
    return corners


def _boundary(tets: np.ndarray) -> np.ndarray:
    """Triangles (n, 3) at the boundary of tetrahedra (m, 4)."""
    faces = tets[:, _FACES].reshape(-1, 3)
    _, where, count = np.unique(
        np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True
    )
    return faces[where[count == 1]]


def _part_corners(points: np.ndarray, boundary: np.ndarray, groups: dict[str, np.ndarray]) -> None:
    """Leave a triangle whose nodes are in two groups, as one in the corner between two faces, to
    that with whose own triangles next to it it lies flattest. ``groups``: masks of boundary."""
    mine = [name for name in groups if group_name(name)]
    if not mine:
        return
    masks = np.array([groups[name] for name in mine])
    alone = masks.sum(axis=0) == 1
    a, b, c = points[boundary].transpose(1, 0, 2)
    normal = np.cross(b - a, c - a)
    normal /= np.maximum(np.linalg.norm(normal, axis=1), 1e-300)[:, None]
    for i in np.flatnonzero(masks.sum(axis=0) > 1):
        neighbours = alone & (np.isin(boundary, boundary[i]).sum(axis=1) == 2)
        flat = [(normal[neighbours & m] @ normal[i]).max(initial=-1.0) for m in masks]
        for name, level in zip(mine, flat):
            groups[name][i] &= level == max(flat)


def _name(component: str) -> str:
    """Name of a group that a component's name stands for."""
    name = component.strip().lower()
    return name[:-3] + _SIGNS[name[-3:]] if name[-3:] in _SIGNS else name
