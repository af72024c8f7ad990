"""Elastic modes of a free body by block Lanczos on its inertia-relieved flexibility."""

from __future__ import annotations

import logging
from collections.abc import Callable

import numpy as np
from scipy.linalg import eigh

from flexcage.core.errors import RunFailed
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import FEModel

log = logging.getLogger(__name__)

_BLOCK = 4
_TOLERANCE = 1e-11  # of the residual relative to the eigenvalue of the flexibility

_PAIR = 1e-6  # relative distance of omega^2 under which two modes are a pair


def free_modes(solver: FreeBodySolver, count: int) -> tuple[np.ndarray, np.ndarray]:
    """The first ``count`` elastic modes of a free body: (omega^2 (n,), shapes (3N, n)).

    Shapes are mass-orthonormal and orthogonal to the six rigid motions. Where ``count`` would
    cut a pair of equal frequencies in two, the partner is kept too: half a pair would single
    out a direction that a cyclic body does not have.
    """
    values, shapes = lowest_modes(solver.model, solver.solve, count + 1)
    if values[count] > values[count - 1] * (1.0 + _PAIR):
        values, shapes = values[:count], shapes[:, :count]
    return values, solver.model.remove_rigid(shapes)


def lowest_modes(
    model: FEModel,
    flexibility: Callable[[np.ndarray], np.ndarray],
    count: int,
    *,
    seed: int = 1,
) -> tuple[np.ndarray, np.ndarray]:
    """Lowest ``count`` modes K phi = omega^2 M phi of a (supported or free) body.

    ``flexibility`` maps loads (3N, m) to displacements, symmetric and positive on the space of
    admitted motions. Blocks find the double eigenvalues of a cyclic body, which a single vector
    cannot see in exact arithmetic. Full orthogonalisation; no restart is needed as the inverse
    separates the lowest modes well.
    """
    start = np.random.default_rng(seed).standard_normal((model.n_dof, min(_BLOCK, count + 2)))
    smooth = flexibility(model.mass_times(start))
    space = _MassSpace(model, smooth)
    limit = min(12 * count + 20 * _BLOCK, model.n_dof - 6)
    projected = np.zeros((0, 0))
    while True:
        block, size = space.last, space.size
        image = flexibility(space.mass_last)
        coefficients, remainder = space.append(image)
        grown = np.zeros((size, size))
        grown[: len(projected), : len(projected)] = projected
        grown[:, block] = coefficients[:size]
        grown[block, :] = coefficients[:size].T
        projected = grown
        if size < count + 2 * _BLOCK and size < limit:
            continue
        inverse_values, vectors = eigh(projected)
        wanted = slice(-1, -count - 1, -1)
        theta, vectors = inverse_values[wanted], vectors[:, wanted]
        error = np.linalg.norm(remainder @ vectors[block], axis=0)
        if np.all(error < _TOLERANCE * theta):
            break
        if size >= limit:
            raise RunFailed(f"the {count} lowest modes did not converge in {size} vectors")
    log.info("%d modes found in a space of %d vectors", count, size)
    return 1.0 / theta, space.basis(size) @ vectors


class _MassSpace:
    """A growing mass-orthonormal basis, stored in blocks with its products with the mass."""

    def __init__(self, model: FEModel, first: np.ndarray) -> None:
        self._model = model
        self._capacity = 0
        self._vectors = np.empty((model.n_dof, 0), order="F")
        self.size = 0
        self.append(first)

    @property
    def mass_last(self) -> np.ndarray:
        return self._mass_last

    def basis(self, size: int) -> np.ndarray:
        return self._vectors[:, :size]

    def append(self, image: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Orthonormalise ``image`` and add it.

        Returns the coefficients (size, b) on the vectors before, and the upper triangle (b, b)
        that turns the added vectors into what was left.
        """
        old = self._vectors[:, : self.size]
        total = np.zeros((self.size, image.shape[1]))
        triangle = np.eye(image.shape[1])
        block = image
        mass_block = self._model.mass_times(block)
        for _ in range(2):  # once more: the first pass loses digits where images are parallel
            part = old.T @ mass_block
            block = block - old @ part
            total += part @ triangle
            mass_block = self._model.mass_times(block)
            gram = block.T @ mass_block
            upper = np.linalg.cholesky(0.5 * (gram + gram.T)).T
            inverse = np.linalg.inv(upper)
            block, mass_block = block @ inverse, mass_block @ inverse
            triangle = upper @ triangle
        self._mass_last = mass_block
        self._store(block)
        return total, triangle

    def _store(self, block: np.ndarray) -> None:
        width = block.shape[1]
        if self.size + width > self._vectors.shape[1]:
            grown = np.empty((len(block), 2 * self._vectors.shape[1] + 8 * width), order="F")
            grown[:, : self.size] = self._vectors[:, : self.size]
            self._vectors = grown
        self._vectors[:, self.size : self.size + width] = block
        self.last = slice(self.size, self.size + width)
        self.size += width
