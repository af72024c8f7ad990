"""Coordinates of a mesh in a pocket's own frame."""

from __future__ import annotations

from math import cos, pi, sin

import numpy as np


def in_pocket_frame(points: np.ndarray, pocket: float, pocket_count: int) -> np.ndarray:
    """Coordinates (n, 3) in a pocket's frame: axial x, radial y, tangential t [m].

    ``pocket`` may be a half: k - 1/2 is crossbeam k.
    """
    angle = 2.0 * pi * pocket / pocket_count
    x, y, z = np.asarray(points).T
    c, s = cos(angle), sin(angle)
    return np.column_stack([x, c * y + s * z, c * z - s * y])
