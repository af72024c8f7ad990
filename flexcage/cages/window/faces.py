"""The four faces of a window cage's pockets, and where they are in a mesh."""

from __future__ import annotations

import numpy as np

from flexcage.cages.window.windowed import FACE_SIGN, WindowedCage
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.measure import in_pocket_frame


def face_position(
    mesh: CageMesh, pocket: int, face: str, *, pitch_radius: float,
    cage: WindowedCage | None = None,
) -> float:  # fmt: skip
    """Distance [m] of a face (front, rear, side+x, side-x) from the pocket's centre.

    Taken on the line through the face's middle at ``pitch_radius`` [m] (or the nearest height
    that the face has), along the tangent for crossbeam faces and along x for side-beam faces; in
    the frame and at the height that the ``cage`` has of its own.
    """
    triangles = mesh.groups[f"pocket{pocket}_{face}"]
    local_of = in_pocket_frame if cage is None else cage.in_pocket
    local = local_of(mesh.points[triangles.ravel()], pocket, mesh.pocket_count)
    x, y, t = local.reshape(-1, 3, 3).transpose(2, 0, 1)  # each (n_triangles, 3)
    along, across = (x, t) if face.startswith("side") else (t, x)
    height = pitch_radius if cage is None else cage.measured_at(pitch_radius)
    weights = _barycentric(across, y, (0.0, height))
    best = int(np.argmax(weights.min(axis=1)))  # the triangle that holds the point, or nearly
    inside = np.clip(weights[best], 0.0, None)
    return FACE_SIGN[face] * float(along[best] @ inside / inside.sum())


def _barycentric(u: np.ndarray, v: np.ndarray, point: tuple[float, float]) -> np.ndarray:
    """Barycentric coordinates (n, 3) of a point in plane triangles with corners u, v (n, 3)."""
    du, dv = u - point[0], v - point[1]
    areas = np.stack(
        [du[:, i] * dv[:, j] - du[:, j] * dv[:, i] for i, j in ((1, 2), (2, 0), (0, 1))], axis=1
    )
    total = areas.sum(axis=1, keepdims=True)
    return areas / np.where(total == 0.0, 1.0, total)


def pocket_size(
    mesh: CageMesh, pocket: int, *, pitch_radius: float, cage: WindowedCage | None = None
) -> tuple[float, float]:
    """Width and length [m] of a pocket at the pitch radius, mid-pocket, measured as a face."""
    at = {
        face: face_position(mesh, pocket, face, pitch_radius=pitch_radius, cage=cage)
        for face in FACE_SIGN
    }
    return at["front"] + at["rear"], at["side+x"] + at["side-x"]
