"""Solids of revolution and rotations, for rings and rollers."""

from __future__ import annotations

from math import pi
from typing import TYPE_CHECKING

import numpy as np

from flexcage.render.scene import load_pyvista

if TYPE_CHECKING:
    import pyvista


def rotation(q: np.ndarray) -> np.ndarray:
    """Matrix of a quaternion, scalar first, body to space."""
    w, x, y, z = q / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def revolved(profile: list[tuple[float, float]], *, segments: int = 144) -> pyvista.PolyData:
    """A closed profile of (x, r) points, counter-clockwise, turned about the x axis."""
    pv = load_pyvista()
    p = np.asarray(profile, float)
    angle = 2.0 * pi * np.arange(segments) / segments
    x = np.broadcast_to(p[:, 0], (segments, len(p)))
    points = np.stack([x, np.outer(np.cos(angle), p[:, 1]), np.outer(np.sin(angle), p[:, 1])], -1)
    i, j = np.meshgrid(np.arange(segments), np.arange(len(p)), indexing="ij")
    i2, j2 = (i + 1) % segments, (j + 1) % len(p)
    corners = [i * len(p) + j, i * len(p) + j2, i2 * len(p) + j2, i2 * len(p) + j]
    quads = np.stack([np.full_like(i, 4), *corners], axis=-1).reshape(-1, 5)
    keep = (p[j.ravel(), 1] > 0.0) | (p[j2.ravel(), 1] > 0.0)
    return pv.PolyData(points.reshape(-1, 3), quads[keep].ravel())
