"""Places and postures of bodies from their coordinates."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation


def orientation(azimuth: np.ndarray, angles: np.ndarray) -> np.ndarray:
    """Unit quaternions (..., 4), scalar first, of bodies at ``azimuth`` (...,) about x, turned by
    ``angles`` (..., 3): skew about the radial, tilt about the tangential axis, and spin [rad]."""
    half = 0.5 * np.stack([azimuth, *np.moveaxis(angles, -1, 0)])
    (c1, c2, c3, c4), (s1, s2, s3, s4) = np.cos(half), np.sin(half)
    w, x, y, z = c1 * c2, s1 * c2, c1 * s2, s1 * s2
    w, x, y, z = w * c3 - z * s3, x * c3 + y * s3, y * c3 - x * s3, z * c3 + w * s3
    return np.stack([w * c4 - x * s4, x * c4 + w * s4, y * c4 + z * s4, z * c4 - y * s4], axis=-1)


def to_body(quaternion: np.ndarray, vectors: np.ndarray) -> np.ndarray:
    """Space vectors (..., 3) in the body frames of unit quaternions (..., 4), scalar first."""
    w, v = quaternion[..., :1], -quaternion[..., 1:]
    t = 2.0 * np.cross(v, vectors)
    return vectors + w * t + np.cross(v, t)


def seen_from_cages(q: dict[str, np.ndarray], places: np.ndarray) -> np.ndarray:
    """Places (n, Z, 3) of elements in space from the frames of their cages, of which ``q`` has the
    coordinates (``system.layout.Layout.q``): one, or one for each row."""
    centre, quaternion = q["cage"], q["quaternion"]
    if centre.ndim == 2:
        centre, quaternion = centre[:, None], quaternion[:, None]
    turned = Rotation.from_quat(quaternion.reshape(-1, 4), scalar_first=True).as_matrix()
    n, cages = centre.shape[:2]
    away = places.reshape(n, cages, places.shape[1] // cages, 3) - centre[:, :, None]
    seen = np.einsum("nkzc,nkcd->nkzd", away, turned.reshape(n, cages, 3, 3))
    return seen.reshape(places.shape)
