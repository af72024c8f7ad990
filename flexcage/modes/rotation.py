"""How far parts of a cage turn as its modes deform it: where that is no small angle, displacements
that are linear in the modes are off."""

from __future__ import annotations

import numpy as np

from flexcage.fem.model import FEModel
from flexcage.modes.pockets import pocket_frames


def sector_rotations(model: FEModel, shapes: np.ndarray, count: int) -> np.ndarray:
    """Mean rotations (count, 3, n) [rad] of a ring's sectors in shapes (N, 3, n), components x, r
    and psi of the sectors' frames: half of the curl of what vertices do, over the volume."""
    gradients, volumes = model.element_geometry
    middles = model.points[model.tets].mean(axis=1)
    azimuth = np.arctan2(middles[:, 2], middles[:, 1])
    sector = np.round(azimuth * count / (2.0 * np.pi)).astype(int) % count
    total = np.zeros((count, 3, shapes.shape[2]))
    for k in range(count):
        own = sector == k
        tets, weights = model.tets[own], volumes[own]
        moved = shapes[tets]  # (m, 4, 3, n)
        slope = np.einsum("m,mva,mvcn->acn", weights / weights.sum(), gradients[own], moved)
        for c in range(3):
            i, j = (c + 1) % 3, (c + 2) % 3
            total[k, c] = 0.5 * (slope[i, j] - slope[j, i])
    return np.einsum("kab,kbn->kan", pocket_frames(count), total)
