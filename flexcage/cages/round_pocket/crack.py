"""Cracks through the webs of a cage's mesh: vertices that are there twice."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from types import MappingProxyType

import numpy as np

from flexcage.cages.round_pocket.cage import BallCage
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.measure import in_pocket_frame


def open_crack(
    sound: CageMesh, mesh: CageMesh, cage: BallCage, web: int, side: str, share: float
) -> CageMesh:
    """``mesh``, numbered as ``sound`` but for earlier cracks, with a web cracked as well, from the
    end ``side`` ("+x", "-x") over ``share`` of the cage's width."""
    count = mesh.pocket_count
    sign = 1.0 if side == "+x" else -1.0
    tip = sign * 0.5 * cage.width - sign * share * cage.width
    x, y, t = in_pocket_frame(sound.points, web - 0.5, count).T
    tiny = 1e-6 * cage.width
    faces = (np.abs(t) < tiny) & (y > 0.0) & (sign * (x - tip) > tiny)
    old = np.flatnonzero(faces)
    copy = np.arange(len(mesh.points))
    copy[old] = len(copy) + np.arange(len(old))
    behind = _behind(sound, sound.tets, web)
    tets = np.where(behind[:, None], copy[mesh.tets], mesh.tets)
    groups = {
        name: np.where(_behind(sound, sound.groups[name], web)[:, None], copy[part], part)
        for name, part in mesh.groups.items()
    }
    points = np.vstack([mesh.points, mesh.points[old]])
    info = with_doubled(mesh, old)
    return replace(mesh, points=points, tets=tets, groups=MappingProxyType(groups), info=info)


def with_doubled(mesh: CageMesh, old: np.ndarray) -> Mapping[str, object]:
    """The mesh's info when copies of the vertices ``old``, no copies themselves, were added."""
    before: tuple[int, ...] = mesh.info.get("doubled", ())  # type: ignore[assignment]
    return MappingProxyType({**mesh.info, "doubled": (*before, *old.tolist())})


def _behind(sound: CageMesh, cells: np.ndarray, web: int) -> np.ndarray:
    """Which cells (n, .) lie on the side of pocket k-1 of web k, within half a turn."""
    centres = sound.points[cells].mean(axis=1)
    return in_pocket_frame(centres, web - 0.5, sound.pocket_count)[:, 2] < 0.0
