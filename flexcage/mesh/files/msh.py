"""Reading a gmsh mesh (.msh): by meshio, and where that cannot, from what gmsh itself makes of it.

meshio keeps the physical groups of format 2.2 element by element (its elements stand once a group),
and those of 4.1 as sets, of which a face may be in several. Formats 1 and 4.0, nodes with
parameters of their surfaces, and partitions, which meshio does not read or not whole, gmsh writes
again in plain 4.1; it does so in a process of its own, because damaged files can end it.
"""

from __future__ import annotations

import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.mesh.files.raw import RawMesh, Refused, first_alike, group_name
from flexcage.mesh.files.shapes import SOLIDS, TRIANGLES, solids_of

_BEGINS = (b"$MeshFormat", b"$Comments", b"$NOD", b"$PhysicalNames")
_HEAD = 4096  # bytes, in which the version stands after comments
_VERSION = re.compile(rb"\$MeshFormat\s+(\d(?:\.[1-9])?)")
_SECONDS = 600
_REWRITE = """
import sys, gmsh
gmsh.initialize(interruptible=False, readConfigFiles=False)
gmsh.option.setNumber("General.Terminal", 0)
gmsh.merge(sys.argv[1])
gmsh.model.mesh.unpartition()
gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
gmsh.option.setNumber("Mesh.SaveParametric", 0)
gmsh.option.setNumber("Mesh.SaveAll", 0)
gmsh.option.setNumber("Mesh.Binary", 1)
gmsh.write(sys.argv[2])
"""


def read_msh(path: Path) -> RawMesh:
    """The mesh of a file of any version. Raises ``Refused``, or ValueError for a damaged file."""
    import meshio

    with path.open("rb") as file:
        first = file.read(_HEAD).lstrip()
    if not first.startswith(_BEGINS):  # gmsh would run anything else as a script
        raise ValueError("it does not begin with $MeshFormat")
    version = _VERSION.search(first)
    if version is None or version[1] == b"4":  # of which meshio takes one group of a face alone
        return _raw(_rewritten(path, None))
    try:
        found = meshio.gmsh.read(path)
    except (Exception, SystemExit) as error:  # of all kinds on broken files
        found = _rewritten(path, error)
    return _raw(found)


def _rewritten(path: Path, error: BaseException | None) -> Any:
    """What gmsh makes of a file that meshio cannot read, as meshio reads it then."""
    import meshio

    with tempfile.TemporaryDirectory() as folder:
        plain = Path(folder) / "plain.msh"
        command = [sys.executable, "-c", _REWRITE, str(path.resolve()), str(plain)]
        done = subprocess.run(command, capture_output=True, text=True, timeout=_SECONDS)
        if done.returncode != 0 or not plain.is_file():
            reason = done.stderr.strip().splitlines()[-1:] or ["gmsh stopped"]
            raise ValueError(f"gmsh cannot read it: {reason[0].partition(': ')[2]}") from error
        return meshio.gmsh.read(plain)


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
    joined = {name: np.vstack(parts).astype(np.int64) for name, parts in surfaces.items()}
    joined = {name: triangles for name, triangles in joined.items() if len(triangles)}
    for name in joined.keys() & others.keys():
        raise Refused(f"the name '{name}' is also {others[name]}; a surface has triangles alone")
    return RawMesh(
        points=np.asarray(found.points, float),
        solids=solids,
        surfaces=joined,
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
