"""Meshes to and from files: .msh and .vtu with the same group names, and what ``files`` reads.

* .msh: physical surfaces named as the groups and a physical volume ``cage`` (written as binary
  gmsh 2.2, which keeps one physical tag an element).
* .vtu: triangles beside the tetrahedra, with an integer cell array ``group``: 0 for none and
  1 + the position in ``group_names(Z)``: 1 land_inner, 2 land_outer, 3 end+x, 4 end-x, and
  5 + 5 k + (0 front, 1 rear, 2 side+x, 3 side-x, 4 fillet) for pocket k. With round pockets the
  array is ``round_group``, and 5 + k is the wall of pocket k. A cell array that has itself the
  name of a group, non-zero on its triangles, is read as well.

Tetrahedra and triangles of any order are read by their corners. Where their edges are curved, faces
become flat, and a warning says how far the nodes on edges lie off.
"""

from __future__ import annotations

import logging
import re
from collections.abc import Callable, Mapping
from dataclasses import replace
from os import SEEK_END
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np

from flexcage.core.binding import path_of
from flexcage.core.errors import FlexcageError, InputError, unwritable
from flexcage.core.missing import POINTER, is_pointer, no_file
from flexcage.core.writing import written
from flexcage.mesh.cage_mesh import (
    CageMesh,
    group_names,
    pocket_groups,
)
from flexcage.mesh.files.abaqus import read_inp
from flexcage.mesh.files.ansys import read_cdb
from flexcage.mesh.files.frame import check_axis
from flexcage.mesh.files.msh import read_msh
from flexcage.mesh.files.others import no_mesh
from flexcage.mesh.files.raw import RawMesh, Refused, first_alike, group_name
from flexcage.mesh.files.sound import (
    faces_counted,
    in_one_place,
    refuse_shared,
    sound_tetrahedra,
    warn_of_curves,
)
from flexcage.mesh.files.vtu import ARRAYS, read_vtu
from flexcage.mesh.quality import check_mesh, nearest_hint
from flexcage.mesh.repetition import find_repetition
from flexcage.mesh.sector import orient_outward

log = logging.getLogger(__name__)

_MARKS = {
    ".msh": b"$Comments\nwritten by flexcage\n$EndComments\n",
    ".vtu": b"<!-- written by flexcage -->\n",
}
_READERS: dict[str, Callable[[Path], RawMesh]] = {
    ".msh": read_msh, ".inp": read_inp, ".cdb": read_cdb, ".vtu": read_vtu,
}  # fmt: skip
_POCKET = re.compile(r"pocket(\d+)_")


def write_mesh(mesh: CageMesh, path: str | Path) -> Path:
    """Write a mesh with its groups as .msh or .vtu, in metres; returns the path."""
    import meshio

    path = path_of(path, "path")
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
        out = meshio.Mesh(mesh.points, cells, cell_data={ARRAYS[parts]: data})
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
    path = path_of(path, "path")
    raw = _read_raw(path)
    tets = _tetrahedra(raw, path)
    warn_of_curves(raw, path)
    found = _named_triangles(raw, path)
    count = _pocket_count(found, pocket_count, path)
    number = np.full(len(raw.points), -1)
    used = np.unique(tets)
    number[used] = np.arange(len(used))
    points, tets = raw.points[used] * {"m": 1.0, "mm": 1e-3}[unit], number[tets]
    wanted = group_names(count, parts=pocket_groups(found))
    groups = {name: number[found[name]] for name in wanted if name in found}
    groups = _on_boundary(groups, points, tets, path)
    none = np.empty((0, 3), int)
    groups = {n: groups.get(n, none) for n in wanted if n in groups or n.endswith("fillet")}
    unknown = {n: t for n, t in found.items() if n not in wanted}
    info: dict[str, Any] = {"source": str(path), "defects": []}
    if open_at := in_one_place(raw, used):
        info["in_one_place"] = open_at
    mesh = CageMesh(points, tets, MappingProxyType(groups), count, MappingProxyType(info))
    _refuse_missing(mesh, unknown, raw.no_surfaces, path)
    check_axis(mesh, str(path))
    check_mesh(mesh, where=str(path))
    _check_size(mesh, path, unit)
    return _with_sectors(mesh)


def _on_boundary(
    groups: Mapping[str, np.ndarray], points: np.ndarray, tets: np.ndarray, path: Path
) -> dict[str, np.ndarray]:
    """The triangles of every group, each once, seen from outside; refused unless each is a face of
    one tetrahedron alone, and in one group alone."""
    owner = np.repeat(np.arange(len(groups)), [len(t) for t in groups.values()])
    rows = np.vstack([np.empty((0, 3), int), *groups.values()])
    first = first_alike(np.column_stack([np.sort(rows, axis=1), owner]))
    once = first == np.arange(len(rows))
    rows, owner, names = rows[once], owner[once], list(groups)
    count = faces_counted(tets, rows)
    for wrong, what in (
        ((rows < 0).any(axis=1) | (count == 0), "are no face of a tetrahedron"),
        (count > 1, "lie inside the body, between two tetrahedra"),
    ):
        if wrong.any():
            name = names[owner[wrong][0]]
            own = owner == owner[wrong][0]
            raise InputError(
                f"{path}: group {name!r} has triangles that {what} ({(own & wrong).sum()} of "
                f"{own.sum()})",
                where="mesh.file",
                value=name,
            )
    refuse_shared(rows, owner, names, path)
    rows = orient_outward(points, tets, rows)
    return {name: rows[owner == i] for i, name in enumerate(names)}


def _with_sectors(mesh: CageMesh) -> CageMesh:
    """The mesh with what repeats in it, if all does."""
    found = find_repetition(mesh.points, mesh.tets, mesh.pocket_count)
    if found is None:
        return mesh
    info = {**mesh.info, "following": found.following, "sector_tets": found.cells}
    return replace(mesh, points=found.points, info=MappingProxyType(info))


def _read_raw(path: Path) -> RawMesh:
    if path.is_dir():
        raise InputError(f"{path} is a folder; name a mesh file", where="mesh.file")
    reader = _READERS.get(path.suffix.lower())
    if reader is None:
        raise InputError(
            no_mesh(path, ".msh, .inp, .cdb or .vtu"),
            where="mesh.file",
            value=str(path),
        )
    if not path.is_file():
        raise InputError(no_file("mesh file", path), where="mesh.file", value=str(path))
    try:
        return reader(path)
    except FlexcageError:
        raise
    except Refused as error:
        raise InputError(f"{path}: {error}", where="mesh.file", value=str(path)) from error
    except (Exception, SystemExit) as error:  # readers raise all kinds of errors on broken files
        reason = str(error).strip().splitlines()[0] if str(error).strip() else type(error).__name__
        reason = POINTER if is_pointer(path) else reason
        raise InputError(
            f"{path} cannot be read as a mesh: it is empty, cut short, or not what its name says "
            f"({reason})",
            where="mesh.file",
            value=str(path),
        ) from error


def _tetrahedra(raw: RawMesh, path: Path) -> np.ndarray:
    """Corners (m, 4) of the tetrahedra, all of positive volume, each once in its place."""
    if not any(len(block) for block in raw.solids):
        raise InputError(
            f"{path} has no tetrahedra; a cage's mesh has tetrahedra alone",
            where="mesh.file",
            value=str(path),
        )
    return sound_tetrahedra(raw, path)


def _named_triangles(raw: RawMesh, path: Path) -> Mapping[str, np.ndarray]:
    """Triangles (n, 3) of every surface name that the file carries, groups by their own names."""
    found: dict[str, list[np.ndarray]] = {}
    for name, triangles in raw.surfaces.items():
        if len(triangles) and name.strip():
            found.setdefault(group_name(name) or name, []).append(triangles)
    if not found:
        others = [(n, w) for n, w in raw.no_surfaces.items() if group_name(n)]
        what = "".join(f"; '{name}' is {text}" for name, text in others[:1])
        if any(len(triangles) for triangles in raw.surfaces.values()):
            what = "; its groups have numbers alone (gmsh's format 1 keeps no names: save as 4.1)"
        raise InputError(
            f"{path} has no named surfaces; name the pocket faces, lands and end faces "
            f"(pocket0_front or pocket0_wall, ..., land_inner, end+x){what}",
            where="mesh.file",
            value=str(path),
        )
    return {name: np.vstack(parts) for name, parts in found.items()}


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


def _refuse_missing(
    mesh: CageMesh, unknown: Mapping[str, Any], others: Mapping[str, str], path: Path
) -> None:
    """Name the group that is missing, and what the file has of that name or of one like it."""
    if mesh.pocket_count == 0:
        raise InputError(
            f"{path} has no group 'pocket0_front' or 'pocket0_wall'; it names "
            + ", ".join(sorted(unknown)[:5]),
            where="mesh.file",
        )
    parts = pocket_groups({**mesh.groups, **unknown})
    what = {group_name(name) or name: text for name, text in others.items()}
    for name in group_names(mesh.pocket_count, fillets=False, parts=parts):
        if name not in mesh.groups:
            near = f"; what has this name is {what[name]}" if name in what else ""
            raise InputError(
                f"{path} has no surface group {name!r}{near or nearest_hint(name, unknown)}",
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
