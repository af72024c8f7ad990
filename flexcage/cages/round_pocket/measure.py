"""What round pockets and cracks measure on a mesh: walls fitted to the vertices, free faces."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi

import numpy as np

from flexcage.cages.round_pocket.shapes import PocketShapes
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.measure import in_pocket_frame

_OPPOSITE = np.array([[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]])
ENOUGH = 20e-6  # m, to which a user's mesh must agree with the case


def measure_pockets(
    mesh: CageMesh, pockets: Sequence[int], *, pitch_radius: float, spherical: bool = False
) -> PocketShapes:
    """Shapes of the walls of some pockets, in that order: the slots nearest to their vertices."""
    fits = [_fit(mesh, k, pitch_radius, float(spherical)) for k in pockets]
    return PocketShapes(
        np.array([f[:2] for f in fits]).reshape(-1, 2),
        np.array([f[2] for f in fits]),
        np.array([f[3:] for f in fits]).reshape(-1, 2),
    )


def _fit(mesh: CageMesh, pocket: int, pitch_radius: float, bulge: float) -> np.ndarray:
    """Axial shift, arc at pitch radius, radius, half straight lengths along x and psi (5,) [m]."""
    from scipy.optimize import least_squares

    count = mesh.pocket_count
    points = mesh.points[np.unique(mesh.groups[f"pocket{pocket}_wall"])]
    at = in_pocket_frame(points, pocket, count)
    middle = 0.5 * (at.max(axis=0) + at.min(axis=0))
    scale = 0.5 * np.ptp(at[:, 0])

    def misses(p: np.ndarray) -> np.ndarray:
        shift, arc, radius, *slot = p * scale
        turned = in_pocket_frame(points, pocket + arc / pitch_radius * count / (2.0 * pi), count)
        beyond = np.abs(turned[:, [0, 2]] - (shift, 0.0)) - slot
        level = bulge * (turned[:, 1] - pitch_radius)
        across = np.hypot(*np.maximum(beyond, 0.0).T)
        return np.hypot(across, level) / scale - radius / scale

    arc = np.arctan2(middle[2], middle[1]) * pitch_radius
    start = np.array([middle[0], arc, 0.9 * scale, 0.05 * scale, 0.05 * scale]) / scale
    low = [-np.inf, -np.inf, 0.0, 0.0, 0.0]
    found = least_squares(misses, start, bounds=(low, np.inf), xtol=1e-14, ftol=1e-14, gtol=1e-14)
    return found.x * scale


def crack_length(mesh: CageMesh, web: int, side: str) -> float:
    """Axial length [m] of a web's crack: of its free faces, which belong to no group."""
    _, y, t = in_pocket_frame(mesh.points, web - 0.5, mesh.pocket_count).T
    middle = np.abs(np.arctan2(t, y)) < 0.25 * pi / mesh.pocket_count
    faces = np.sort(mesh.tets[:, _OPPOSITE][middle[mesh.tets].any(axis=1)].reshape(-1, 3), axis=1)
    faces, times = np.unique(faces, axis=0, return_counts=True)
    free = faces[(times == 1) & middle[faces].all(axis=1)]
    named = np.sort(np.vstack(list(mesh.groups.values())), axis=1)
    n = len(mesh.points)
    x = mesh.points[free[~np.isin(_keys(free, n), _keys(named, n))], 0]
    sign = 1.0 if side == "+x" else -1.0
    end = float((sign * mesh.points[:, 0]).max())
    return end - float((sign * x).min(initial=end))


def _keys(faces: np.ndarray, n: int) -> np.ndarray:
    a, b, c = faces.astype(np.int64).T
    return (a * n + b) * n + c
