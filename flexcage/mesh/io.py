"""Meshes to and from files, through meshio: .msh, .vtu and .inp with the same group names.

* .msh: physical surfaces named as the groups and a physical volume ``cage`` (written as binary
  gmsh 2.2, which keeps one physical tag an element; 4.1 is read as well).
* .vtu: triangles beside the tetrahedra, with an integer cell array ``group``: 0 for none and
  1 + the position in ``group_names(Z)``: 1 land_inner, 2 land_outer, 3 end+x, 4 end-x, and
  5 + 5 k + (0 front, 1 rear, 2 side+x, 3 side-x, 4 fillet) for pocket k. With round pockets the
  array is ``round_group``, and 5 + k is the wall of pocket k. A cell array that has itself the
  name of a group, non-zero on its triangles, is read as well.
* .inp (read only): surfaces (``*SURFACE, TYPE=ELEMENT``) or element sets of triangles, named as
  the groups, in capitals or not.
* .cdb (read only): node components, or element components of surface triangles (``mesh.ansys``).

Ten-node tetrahedra and six-node triangles are read by their corners. Where their edges are curved,
faces become flat, and a warning says how far the nodes at the middle of edges lie off.
"""

from __future__ import annotations

import logging
import re
from collections.abc import Mapping
from dataclasses import replace
from os import SEEK_END
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from flexcage.core.errors import FlexcageError, InputError, unwritable
from flexcage.core.writing import written
from flexcage.mesh.abaqus import read_inp
from flexcage.mesh.ansys import read_cdb
from flexcage.mesh.cage_mesh import (
    POCKET_GROUPS,
    RING_GROUPS,
    WALL_GROUPS,
    CageMesh,
    group_names,
    pocket_groups,
    signed_volumes,
)
from flexcage.mesh.quality import check_mesh, nearest_hint
from flexcage.mesh.repetition import find_repetition
from flexcage.mesh.sector import orient_outward

log = logging.getLogger(__name__)

_ARRAYS = {POCKET_GROUPS: "group", WALL_GROUPS: "round_group"}  # of a .vtu
_MARKS = {
    ".msh": b"$Comments\nwritten by flexcage\n$EndComments\n",
    ".vtu": b"<!-- written by flexcage -->\n",
}
_READABLE = (".msh", ".inp", ".cdb", ".vtu")
_OTHER_SOLIDS = ("hexahedron", "wedge", "pyramid")
# ends of the edges on whose middles a ten-node tetrahedron has nodes, in meshio's order
_EDGES = np.array([(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)])
_STRAIGHT = 1e-3  # of an edge's length, that a node may lie off its middle by rounding
_POCKET = re.compile(r"pocket(\d+)_")
_PARTS = {*POCKET_GROUPS, *WALL_GROUPS}
_TETS, _TRIANGLES = ("tetra", "tetra10"), ("triangle", "triangle6")


def write_mesh(mesh: CageMesh, path: str | Path) -> Path:
    """Write a mesh with its groups as .msh or .vtu, in metres; returns the path."""
    import meshio

    path = Path(path)
    if path.suffix not in (".msh", ".vtu"):
        raise InputError(f"{path}: a mesh is written as .msh or .vtu", where="path")
    parts = pocket_groups(mesh.groups)
    every = group_names(mesh.pocket_count, parts=parts)
    code = {name: i + 1 for i, name in enumerate(every)}
    names = [n for n in every if len(mesh.groups.get(n, ()))]
    triangles = np.vstack([np.empty((0, 3), mesh.tets.dtype), *(mesh.groups[n] for n in names)])
    tags = np.repeat([code[n] for n in names], [len(mesh.groups[n]) for n in names])
    cells = [("tetra", mesh.tets), ("triangle", triangles)]
    body = len(every) + 1  # tag of the physical volume
    if path.suffix == ".vtu":
        data = [np.zeros(len(mesh.tets), np.int32), tags.astype(np.int32)]
        out = meshio.Mesh(mesh.points, cells, cell_data={_ARRAYS[parts]: data})
        how: dict[str, Any] = {}
    else:
        data = [np.full(len(mesh.tets), body, np.int32), tags.astype(np.int32)]
        fields = {n: np.array([code[n], 2]) for n in names}
        fields["cage"] = np.array([body, 3])
        both = {"gmsh:physical": data, "gmsh:geometrical": data}
        out = meshio.Mesh(mesh.points, cells, cell_data=both, field_data=fields)
        how = {"file_format": "gmsh22", "binary": True}
    try:
        with written(path) as temporary:
            meshio.write(temporary, out, **how)
            with temporary.open("ab") as file:
                file.write(_MARKS[path.suffix])
    except OSError as error:
        raise unwritable(f"The mesh '{path}'", error, path=path) from error
    return path


def is_written_by_us(path: Path) -> bool:
    """Whether a file is a mesh that ``write_mesh`` wrote and no other program changed since: it
    ends in a comment that others do not write."""
    mark = _MARKS.get(path.suffix, b"")
    try:
        with path.open("rb") as file:
            size = file.seek(0, SEEK_END)
            file.seek(max(size - len(mark), 0))
            return bool(mark) and file.read() == mark
    except OSError:
        return False


def read_mesh(path: str | Path, *, pocket_count: int | None = None, unit: str = "m") -> CageMesh:
    """Read and check a cage mesh with named groups; lengths in the file are in ``unit`` (m, mm)."""
    path = Path(path)
    raw = _read_raw(path)
    points, tets = _tetrahedra(raw, path)
    found = _named_triangles(raw, path)
    count = _pocket_count(found, pocket_count, path)
    number = np.full(len(raw.points), -1)
    used = np.unique(tets)
    number[used] = np.arange(len(used))
    points, tets = points[used] * {"m": 1.0, "mm": 1e-3}[unit], number[tets]
    tets = _positive(points, tets, path)
    groups: dict[str, np.ndarray] = {}
    for name in group_names(count, parts=pocket_groups(found)):
        triangles = orient_outward(points, tets, number[found.get(name, np.empty((0, 3), int))])
        if (triangles < 0).any():
            raise InputError(
                f"{path}: group {name!r} has triangles that are no face of a tetrahedron",
                where="mesh.file",
                value=name,
            )
        groups[name] = triangles
    named = {n: t for n, t in groups.items() if len(t) or n.endswith("fillet")}
    unknown = {n: t for n, t in found.items() if n not in groups}
    info = {"source": str(path), "defects": []}
    mesh = CageMesh(points, tets, MappingProxyType(named), count, MappingProxyType(info))
    _refuse_missing(mesh, unknown, path)
    check_mesh(mesh, where=str(path))
    _check_size(mesh, path, unit)
    return _with_sectors(mesh)


def _with_sectors(mesh: CageMesh) -> CageMesh:
    """The mesh with what repeats in it, if all does."""
    found = find_repetition(mesh.points, mesh.tets, mesh.pocket_count)
    if found is None:
        return mesh
    info = {**mesh.info, "following": found.following, "sector_tets": found.cells}
    return replace(mesh, points=found.points, info=MappingProxyType(info))


def _read_raw(path: Path) -> Any:
    import meshio

    if path.suffix.lower() not in _READABLE:
        raise InputError(
            f"{path} is no mesh file that can be read: .msh, .inp, .cdb or .vtu",
            where="mesh.file",
            value=str(path),
        )
    if not path.is_file():
        raise InputError(f"there is no mesh file {path}", where="mesh.file", value=str(path))
    readers = {
        ".inp": read_inp,
        ".cdb": read_cdb,
        ".msh": meshio.gmsh.read,
        ".vtu": meshio.vtu.read,
    }
    try:
        return readers[path.suffix.lower()](path)
    except FlexcageError:
        raise
    except (Exception, SystemExit) as error:  # readers raise all kinds of errors on broken files
        reason = str(error).strip().splitlines()[0] if str(error).strip() else type(error).__name__
        raise InputError(
            f"{path} cannot be read as a mesh: it is empty, cut short, or not what its name says "
            f"({reason})",
            where="mesh.file",
            value=str(path),
        ) from error


def _tetrahedra(raw: Any, path: Path) -> tuple[np.ndarray, np.ndarray]:
    blocks = [np.asarray(b.data)[:, :4] for b in raw.cells if b.type in _TETS]
    others = sorted({b.type for b in raw.cells if b.type.startswith(_OTHER_SOLIDS)})
    if others or not blocks:
        more = f"elements of another shape ({', '.join(others)})" if others else "no tetrahedra"
        raise InputError(
            f"{path} has {more}; a cage's mesh has tetrahedra alone",
            where="mesh.file",
            value=str(path),
        )
    points = np.asarray(raw.points, float)
    _warn_of_curves(points, [np.asarray(b.data) for b in raw.cells if b.type == "tetra10"], path)
    return points, np.vstack(blocks).astype(np.int64)


def _warn_of_curves(points: np.ndarray, quadratic: list[np.ndarray], path: Path) -> None:
    """Say how far nodes lie off the middle of their edges, if that is more than rounding."""
    for tets in quadratic:
        ends = points[tets[:, _EDGES]]  # (n, 6, 2, 3)
        length = np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=-1)
        off = np.linalg.norm(points[tets[:, 4:]] - ends.mean(axis=2), axis=-1)
        curved = off > _STRAIGHT * length
        if curved.any():
            log.warning(
                "%s: edges of elements are curved, with nodes up to %.2g %% of an edge off its "
                "middle; elements are read by their corners, so that curved faces become flat",
                path, 100.0 * float((off / length).max()),
            )  # fmt: skip
            return


def _positive(points: np.ndarray, tets: np.ndarray, path: Path) -> np.ndarray:
    """A file in which all elements are numbered the other way round is turned; a few are not."""
    volumes = signed_volumes(points, tets)
    if (volumes < 0.0).all():
        return tets[:, [0, 2, 1, 3]]
    if (volumes <= 0.0).any():
        raise InputError(
            f"{path} has {int((volumes <= 0.0).sum())} inverted or flat elements of {len(tets)}; "
            "repair it",
            where="mesh.file",
            value=str(path),
        )
    return tets


def _named_triangles(raw: Any, path: Path) -> Mapping[str, np.ndarray]:
    """Triangles (n, 3) of every surface name that the file carries, in the file's numbering."""
    blocks = [np.asarray(b.data) for b in raw.cells]
    surface = [i for i, b in enumerate(raw.cells) if b.type in _TRIANGLES]
    collected: dict[str, list[np.ndarray]] = {}

    def add(name: str, block: int, chosen: np.ndarray) -> None:
        low = name.lower()
        name = low if low in RING_GROUPS or _POCKET.sub("", low) in _PARTS else name
        if len(triangles := blocks[block][chosen][:, :3]):
            collected.setdefault(name, []).append(triangles.astype(np.int64))

    tagged = raw.cell_data.get("gmsh:physical")
    surfaces = {int(v[0]): n for n, v in raw.field_data.items() if len(v) > 1 and v[1] == 2}
    coded = [
        (_code_names(raw.cell_data.get(array), surface, parts), raw.cell_data.get(array))
        for parts, array in _ARRAYS.items()
    ]
    for i in surface:
        for name, chosen in raw.cell_sets.items():
            if not name.startswith("gmsh:") and chosen[i] is not None and tagged is None:
                add(name, i, np.asarray(chosen[i], np.int64))
        for name, values in raw.cell_data.items():
            if name in RING_GROUPS or _POCKET.match(name):
                add(name, i, np.flatnonzero(values[i]))
        for table, tags in ((surfaces, tagged), *coded):
            if tags is not None:
                for tag in np.unique(tags[i]):
                    if int(tag) in table:
                        add(table[int(tag)], i, np.flatnonzero(tags[i] == tag))
    if not collected:
        raise InputError(
            f"{path} has no named surfaces; name the pocket faces, lands and end faces "
            "(pocket0_front or pocket0_wall, ..., land_inner, end+x)",
            where="mesh.file",
            value=str(path),
        )
    return {name: np.vstack(parts) for name, parts in collected.items()}


def _code_names(group: Any, surface: list[int], parts: tuple[str, ...]) -> dict[int, str]:
    """Names of the integers in a .vtu's array of groups."""
    if group is None:
        return {}
    top = max((int(np.max(group[i], initial=0)) for i in surface), default=0)
    pockets = -(-max(top - len(RING_GROUPS), 0) // len(parts))
    return {i + 1: name for i, name in enumerate(group_names(pockets, parts=parts))}


def _pocket_count(found: Mapping[str, Any], wanted: int | None, path: Path) -> int:
    numbers = [int(m.group(1)) for m in map(_POCKET.match, found) if m]
    count = max(numbers, default=-1) + 1
    if wanted is not None and numbers and count != wanted:
        raise InputError(
            f"{path} names {count} pockets, but the bearing has {wanted} rolling elements",
            where="mesh.file",
            value=count,
        )
    return wanted or count


def _refuse_missing(mesh: CageMesh, unknown: Mapping[str, Any], path: Path) -> None:
    """Name the group that is missing and the file's own name that is most like it."""
    if mesh.pocket_count == 0:
        raise InputError(
            f"{path} has no group 'pocket0_front' or 'pocket0_wall'; it names "
            + ", ".join(sorted(unknown)[:5]),
            where="mesh.file",
        )
    parts = pocket_groups({**mesh.groups, **unknown})
    for name in group_names(mesh.pocket_count, fillets=False, parts=parts):
        if name not in mesh.groups:
            near = nearest_hint(name, unknown)
            raise InputError(
                f"{path} has no surface group {name!r}{near}",
                where="mesh.file",
                value=name,
            )


def _check_size(mesh: CageMesh, path: Path, unit: str) -> None:
    """A cage of more than 10 m or less than 1 mm is one whose unit was forgotten."""
    radius = float(np.hypot(mesh.points[:, 1], mesh.points[:, 2]).max())
    if not 0.5e-3 < radius < 5.0:
        other = "mm" if unit == "m" else "m"
        raise InputError(
            f"{path}: the cage would have a diameter of {2 * radius:g} m in {unit!r}; "
            f'set mesh.file_unit = "{other}"',
            where="mesh.file_unit",
            value=unit,
        )
