"""Reading a gmsh mesh (.msh): by meshio, and where that cannot, by gmsh itself.

meshio keeps the physical groups of format 2.2 element by element (its elements stand once a group),
and those of 4.1 as sets, of which a face may be in several. Formats 1 and 4.0, nodes with
parameters of their surfaces, and partitions, which meshio does not read or not whole, gmsh itself
reads, in a process of its own, because damaged files can end it.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.core.arrays import read_arrays
from flexcage.core.reading import json_of
from flexcage.mesh.files.raw import RawMesh, Refused, first_alike, group_name
from flexcage.mesh.files.shapes import OTHER_SHAPE, SOLIDS, TRIANGLES, solids_of

_BEGINS = (b"$MeshFormat", b"$Comments", b"$NOD", b"$PhysicalNames")
_FLUENT = (b"(0 ", b"(1 ", b"(2 ")
_HEAD = 4096  # bytes, in which the version stands after comments
_VERSION = re.compile(rb"\$MeshFormat\s+(\d(?:\.[1-9])?)")
_SECONDS = 600
_AS_MESHIO = [0, 1, 2, 3, 4, 5, 6, 7, 9, 8]  # of ten nodes
_BY_GMSH = """
import sys, json, gmsh, numpy
gmsh.initialize(interruptible=False, readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.merge(sys.argv[1])
mesh, model, blocks, arrays = gmsh.model.mesh, gmsh.model, [], {}
for dim, tag in model.getEntities():
    groups = [model.getPhysicalName(dim, g) for g in model.getPhysicalGroupsForEntity(dim, tag)]
    for kind, numbers, nodes in zip(*mesh.getElements(dim, tag)):
        if dim > 1:
            shape = mesh.getElementProperties(kind)[0].split()[0].lower()
            arrays[f"numbers{len(blocks)}"] = numbers
            arrays[f"nodes{len(blocks)}"] = nodes.reshape(len(numbers), -1)
            blocks.append([shape, groups])
numbers, places, _ = mesh.getNodes()
numbers, first = numpy.unique(numbers, return_index=True)
numpy.savez(sys.argv[2], numbers=numbers, points=places.reshape(-1, 3)[first],
            blocks=json.dumps(blocks), **arrays)
"""


def read_msh(path: Path) -> RawMesh:
    """The mesh of a file of any version. Raises ``Refused``, or ValueError for a damaged file."""
    import meshio

    with path.open("rb") as file:
        first = file.read(_HEAD).lstrip()
    if first.startswith(_FLUENT):
        raise Refused("it is a mesh of Ansys Fluent; write an archive by CDWRITE (.cdb) instead")
    if not first.startswith(_BEGINS):  # gmsh would run anything else as a script
        raise ValueError("it does not begin with $MeshFormat")
    version = _VERSION.search(first)
    if version is None or version[1] == b"4":  # of which meshio takes one group of a face alone
        return _by_gmsh(path, None)
    try:
        found = meshio.gmsh.read(path)
    except (Exception, SystemExit) as error:  # of all kinds on broken files
        return _by_gmsh(path, error)
    return _raw(found)


def _by_gmsh(path: Path, error: BaseException | None) -> RawMesh:
    """What gmsh reads of a file, with its numbers."""
    with tempfile.TemporaryDirectory() as folder:
        plain = Path(folder) / "plain.npz"
        command = [sys.executable, "-c", _BY_GMSH, str(path.resolve()), str(plain)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=_SECONDS)
        if done.returncode != 0 or not plain.is_file():
            reason = done.stderr.strip().splitlines()[-1:] or ["gmsh: it stopped"]
            raise ValueError(f"gmsh cannot read it: {reason[0].partition(': ')[2]}") from error
        return _from_gmsh(read_arrays(plain))


def _from_gmsh(arrays: dict[str, np.ndarray]) -> RawMesh:
    numbers = arrays["numbers"]
    solids: dict[int, list[np.ndarray]] = {}
    of: dict[int, list[np.ndarray]] = {}
    surfaces: dict[str, list[np.ndarray]] = {}
    others: dict[str, str] = {}
    for i, (shape, groups) in enumerate(json_of(str(arrays["blocks"]))):
        nodes = np.searchsorted(numbers, arrays[f"nodes{i}"])
        if shape == "tetrahedron":
            size = nodes.shape[1]
            solids.setdefault(size, []).append(nodes[:, _AS_MESHIO] if size == 10 else nodes)
            of.setdefault(size, []).append(arrays[f"numbers{i}"])
        elif shape == "triangle":
            for name in groups:
                surfaces.setdefault(name, []).append(nodes[:, :3])
        elif shape in ("hexahedron", "prism", "pyramid"):
            raise Refused(OTHER_SHAPE.format(shape))
        else:
            others |= {name: f"a physical group of {shape} elements" for name in groups}
    return RawMesh(
        points=arrays["points"],
        solids=tuple(np.vstack(blocks) for blocks in solids.values()),
        surfaces=_unmixed(surfaces, others),
        point_numbers=numbers.astype(np.int64),
        solid_numbers=np.concatenate([np.empty(0), *(n for b in of.values() for n in b)]),
        no_surfaces=others,
    )


def _unmixed(
    surfaces: dict[str, list[np.ndarray]], others: dict[str, str]
) -> dict[str, np.ndarray]:
    """Triangles of every name; Refused where a group has elements of other shapes as well."""
    joined = {name: np.vstack(parts).astype(np.int64) for name, parts in surfaces.items()}
    joined = {name: triangles for name, triangles in joined.items() if len(triangles)}
    for name in joined.keys() & others.keys():
        if group_name(name):
            raise Refused(
                f"the name '{name}' is also {others[name]}; a surface has triangles alone"
            )
    return joined


def _raw(found: Any) -> RawMesh:
    """Nodes, tetrahedra and physical surfaces of a mesh that meshio read from a .msh."""
    solids = solids_of(found)
    sets = {n: c for n, c in found.cell_sets.items() if not n.startswith("gmsh:")}
    tags = found.cell_data.get("gmsh:physical") if not sets else None
    if tags is not None:
        bodies = [t for b, t in zip(found.cells, tags) if SOLIDS.fullmatch(b.type)]
        solids = _once(solids, bodies)
    names = {int(v[0]): n for n, v in found.field_data.items() if len(v) > 1 and v[1] == 2}
    surfaces: dict[str, list[np.ndarray]] = {}
    others: dict[str, str] = {}
    for i, block in enumerate(found.cells):
        chosen = {n: c[i] for n, c in sets.items() if c[i] is not None and len(c[i])}
        if tags is not None:
            chosen |= {n: np.flatnonzero(tags[i] == tag) for tag, n in names.items()}
        for name, rows in chosen.items():
            if TRIANGLES.fullmatch(block.type):
                surfaces.setdefault(name, []).append(np.asarray(block.data)[rows][:, :3])
            elif group_name(name) and len(rows):
                others[name] = f"a physical group of {block.type} elements"
    return RawMesh(
        points=np.asarray(found.points, float),
        solids=solids,
        surfaces=_unmixed(surfaces, others),
        no_surfaces=others,
    )


def _once(solids: tuple[np.ndarray, ...], tags: list[np.ndarray]) -> tuple[np.ndarray, ...]:
    """Tetrahedra without those that format 2.2 repeats because they are in several physical groups;
    ``tags``: of every block."""
    if not solids or len(np.unique(np.concatenate(tags))) < 2:
        return solids
    corners = np.sort(np.vstack([block[:, :4] for block in solids]), axis=1)
    tag = np.concatenate(tags)
    own = tag == tag[first_alike(corners)]
    parts = np.split(own, np.cumsum([len(block) for block in solids])[:-1])
    return tuple(block[part] for block, part in zip(solids, parts))
