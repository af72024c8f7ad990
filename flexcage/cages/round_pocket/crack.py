"""Cracks through the webs of a cage's mesh."""

from __future__ import annotations

import numpy as np

from flexcage.cages.round_pocket.cage import BallCage
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.doubling import opened_at
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

    def behind(centres: np.ndarray) -> np.ndarray:
        """Do they lie on the side of pocket k-1 of web k, within half a turn?"""
        return in_pocket_frame(centres, web - 0.5, count)[:, 2] < 0.0

    return opened_at(sound, mesh, np.flatnonzero(faces), behind)
