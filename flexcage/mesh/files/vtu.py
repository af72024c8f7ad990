"""Reading a VTK file (.vtu): tetrahedra, and triangles with arrays that name their groups."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from flexcage.mesh.cage_mesh import POCKET_GROUPS, RING_GROUPS, WALL_GROUPS, group_names
from flexcage.mesh.files.raw import RawMesh, Refused, group_name
from flexcage.mesh.files.shapes import TRIANGLES, solids_of

ARRAYS = {POCKET_GROUPS: "group", WALL_GROUPS: "round_group"}
_HEAD = 1024  # bytes, in which the compression is named


def read_vtu(path: Path) -> RawMesh:
    """The mesh of a file, with surfaces by ``ARRAYS`` or arrays named as groups. Raises
    ``Refused``, or any error for a damaged file."""
    import meshio

    with path.open("rb") as file:
        if b"vtkLZ4DataCompressor" in file.read(_HEAD):
            raise Refused(
                "its data are compressed by LZ4, which is not read; write them with ZLib or "
                "without compression"
            )
    found = meshio.vtu.read(path)
    solids = solids_of(found)
    flat = [i for i, block in enumerate(found.cells) if TRIANGLES.fullmatch(block.type)]
    surfaces: dict[str, list[np.ndarray]] = {}
    others: dict[str, str] = {}

    def add(name: str, block: int, chosen: np.ndarray) -> None:
        if len(triangles := np.asarray(found.cells[block].data)[chosen][:, :3]):
            surfaces.setdefault(name, []).append(triangles.astype(np.int64))

    for name, values in found.cell_data.items():
        if group_name(name):
            others[name] = "an array of zeros on the triangles"
            for i in flat:
                add(name, i, np.flatnonzero(values[i]))
    for parts, array in ARRAYS.items():
        values = found.cell_data.get(array)
        for i in flat if values is not None else ():
            for code, name in _code_names(values, flat, parts).items():
                add(name, i, np.flatnonzero(np.asarray(values[i]) == code))
    return RawMesh(
        points=np.asarray(found.points, float),
        solids=solids,
        surfaces={name: np.vstack(parts) for name, parts in surfaces.items()},
        no_surfaces={name: what for name, what in others.items() if name not in surfaces},
    )


def _code_names(group: Any, flat: list[int], parts: tuple[str, ...]) -> dict[int, str]:
    """Names of the integers in an array of groups."""
    top = max((int(np.max(group[i], initial=0)) for i in flat), default=0)
    pockets = -(-max(top - len(RING_GROUPS), 0) // len(parts))
    return {i + 1: name for i, name in enumerate(group_names(pockets, parts=parts))}
