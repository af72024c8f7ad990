"""Cyclic symmetry of a model about the x axis: found from the nodes, proved on the matrices."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from flexcage.fem.model import FEModel
from flexcage.fem.sectors import rotation_x


@dataclass(frozen=True)
class CyclicSymmetry:
    """Node ``image[i]`` is node i turned by one sector (2 pi/count about x)."""

    count: int
    image: np.ndarray  # (N,)

    def rotate(self, fields: np.ndarray, sectors: int) -> np.ndarray:
        """Turn (3N, m) fields by a number of sectors: values move to the image nodes."""
        target = np.arange(len(self.image))
        for _ in range(sectors % self.count):
            target = self.image[target]
        matrix = rotation_x(2.0 * np.pi * sectors / self.count)
        nodal = fields.reshape(len(self.image), 3, -1)
        moved, turned = np.empty_like(nodal), np.empty_like(nodal)
        moved[:, 0] = nodal[:, 0]
        moved[:, 1] = matrix[1, 1] * nodal[:, 1] + matrix[1, 2] * nodal[:, 2]
        moved[:, 2] = matrix[2, 1] * nodal[:, 1] + matrix[2, 2] * nodal[:, 2]
        turned[target] = moved
        return turned.reshape(fields.shape)


def find_symmetry(model: FEModel, count: int, *, tolerance: float = 1e-8) -> CyclicSymmetry | None:
    """The model's symmetry of ``count`` sectors, or None where nodes or matrices do not repeat.

    ``tolerance`` bounds the misfit of nodes relative to the model's size and of K and M acting
    on a turned random field, relative to their action.
    """
    turned = model.nodes @ rotation_x(2.0 * np.pi / count).T
    distance, image = cKDTree(model.nodes).query(turned)
    size = np.abs(model.nodes).max()
    if distance.max() > tolerance * size or len(np.unique(image)) != len(image):
        return None
    symmetry = CyclicSymmetry(count=count, image=image)
    field = np.random.default_rng(0).standard_normal((model.n_dof, 1))
    moved = symmetry.rotate(field, 1)
    for operate in (lambda v: model.K @ v, model.mass_times):
        expected = symmetry.rotate(operate(field), 1)
        if np.abs(operate(moved) - expected).max() > tolerance * np.abs(expected).max():
            return None
    return symmetry
