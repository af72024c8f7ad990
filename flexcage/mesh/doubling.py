"""Slits in a mesh: vertices that are there twice, once for the cells on either side."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from flexcage.mesh.cage_mesh import CageMesh

Behind = Callable[[np.ndarray], np.ndarray]


def opened_at(sound: CageMesh, mesh: CageMesh, old: np.ndarray, behind: Behind) -> CageMesh:
    """``mesh``, numbered as ``sound`` but for earlier slits, with copies of the vertices ``old``
    for the cells and triangles whose centres (n, 3) in the sound mesh are ``behind``."""
    copy = np.arange(len(mesh.points))
    copy[old] = len(copy) + np.arange(len(old))

    def renumbered(cells: np.ndarray, was: np.ndarray) -> np.ndarray:
        return np.where(behind(sound.points[was].mean(axis=1))[:, None], copy[cells], cells)

    return replace(
        mesh,
        points=np.vstack([mesh.points, mesh.points[old]]),
        tets=renumbered(mesh.tets, sound.tets),
        groups=MappingProxyType(
            {name: renumbered(part, sound.groups[name]) for name, part in mesh.groups.items()}
        ),
        info=with_doubled(mesh, old),
    )


def with_doubled(mesh: CageMesh, old: np.ndarray) -> Mapping[str, object]:
    """The mesh's info when copies of the vertices ``old``, no copies themselves, were added."""
    return MappingProxyType({**mesh.info, "doubled": (*doubled(mesh), *old.tolist())})


def doubled(mesh: CageMesh) -> tuple[int, ...]:
    """The vertices of which the mesh's last ones are copies."""
    before: tuple[int, ...] = mesh.info.get("doubled", ())  # type: ignore[assignment]
    return before
