"""The cage of several rows of elements: the cages of all rows, held together."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from flexcage.geometry.bearing import RowPlace
from flexcage.mesh.cage_mesh import CageMesh

_SWAPPED = {"side+x": "side-x", "side-x": "side+x", "end+x": "end-x", "end-x": "end+x"}


def mirror_image(mesh: CageMesh) -> CageMesh:
    """The mesh in a mirror in the plane x = 0."""
    return replace(
        mesh,
        points=_moved(mesh.points, RowPlace(), mirrored=True),
        tets=mesh.tets[:, [1, 0, 2, 3]],
        groups=MappingProxyType(
            {_in_mirror(name): triangles[:, ::-1] for name, triangles in mesh.groups.items()}
        ),
    )


def in_rows(mesh: CageMesh, places: Sequence[RowPlace]) -> CageMesh:
    """The mesh of a row's cage, once for every row; itself for one row in the middle. A second row
    has its mirror image, and pockets that count on from the first one's."""
    if len(places) == 1:
        return mesh
    count, size = len(mesh.points), mesh.pocket_count
    groups: dict[str, list[np.ndarray]] = {}
    for k in range(len(places)):
        for name, triangles in mesh.groups.items():
            turned = triangles[:, ::-1] if k else triangles
            groups.setdefault(_name(name, k, size), []).append(turned + k * count)
    tets = [
        (mesh.tets[:, [1, 0, 2, 3]] if k else mesh.tets) + k * count for k in range(len(places))
    ]
    return CageMesh(
        points=np.concatenate(
            [_moved(mesh.points, p, mirrored=k > 0) for k, p in enumerate(places)]
        ),
        tets=np.concatenate(tets),
        groups=MappingProxyType({name: np.concatenate(made) for name, made in groups.items()}),
        pocket_count=size,
    )


def _name(name: str, row: int, count: int) -> str:
    """What a group of a row's cage is called in the whole one."""
    if not row:
        return name
    pocket, _, part = name.partition("_")
    if pocket.startswith("pocket"):
        return f"pocket{int(pocket[6:]) + row * count}_{_SWAPPED.get(part, part)}"
    return _SWAPPED.get(name, name)


def _in_mirror(name: str) -> str:
    """What a group of a cage is called in its mirror image."""
    pocket, _, part = name.partition("_")
    return f"{pocket}_{_SWAPPED.get(part, part)}" if part else _SWAPPED.get(name, name)


def _moved(points: np.ndarray, place: RowPlace, *, mirrored: bool) -> np.ndarray:
    x, y, z = points.T
    c, s = np.cos(place.turned), np.sin(place.turned)
    along = -x if mirrored else x
    return np.stack([along + place.place, c * y - s * z, s * y + c * z], axis=1)
