"""Lowest modes of a body by the block Lanczos method on its flexibility."""

from __future__ import annotations

import logging
from collections.abc import Callable
from typing import Protocol

import numpy as np
from scipy.linalg import eigh

from flexcage.core.errors import RunFailed

log = logging.getLogger(__name__)

_BLOCK = 4
_TOLERANCE = 1e-11  # of the residual relative to the eigenvalue of the flexibility


class Massive(Protocol):
    """A body of which the mass is known."""

    @property
    def n_dof(self) -> int: ...

    def mass_times(self, fields: np.ndarray) -> np.ndarray: ...


def lowest_modes(
    model: Massive,
    flexibility: Callable[[np.ndarray], np.ndarray],
    count: int,
    *,
    seed: int = 1,
    block: int = _BLOCK,
    dtype: type = float,
) -> tuple[np.ndarray, np.ndarray]:
    """Lowest ``count`` modes K phi = omega^2 M phi of a (supported or free) body.

    ``flexibility`` maps loads (3N, m) to displacements, symmetric and positive on the space of
    admitted motions (Hermitian where ``dtype`` is complex). Blocks find the double eigenvalues of
    a cyclic body, which a single vector cannot see in exact arithmetic. Full orthogonalisation; no
    restart is needed as the inverse separates the lowest modes well.
    """
    start = np.random.default_rng(seed).standard_normal((model.n_dof, min(block, count + 2)))
    smooth = flexibility(model.mass_times(start.astype(dtype)))
    space = _MassSpace(model, smooth)
    limit = min(12 * count + 20 * block, model.n_dof - 6)
    projected: np.ndarray = np.zeros((0, 0), dtype)
    while True:
        last, size = space.last, space.size
        image = flexibility(space.mass_last)
        coefficients, remainder = space.append(image)
        grown: np.ndarray = np.zeros((size, size), dtype)
        grown[: len(projected), : len(projected)] = projected
        grown[:, last] = coefficients[:size]
        grown[last, :] = coefficients[:size].conj().T
        projected = grown
        if size < count + 2 * block and size < limit:
            continue
        inverse_values, vectors = eigh(projected)
        wanted = slice(-1, -count - 1, -1)
        theta, vectors = inverse_values[wanted], vectors[:, wanted]
        error = np.linalg.norm(remainder @ vectors[last], axis=0)
        if np.all(error < _TOLERANCE * theta):
            break
        if size >= limit:
            raise RunFailed(f"the {count} lowest modes did not converge in {size} vectors")
    log.info("%d modes found in a space of %d vectors", count, size)
    return 1.0 / theta, space.basis(size) @ vectors


class _MassSpace:
    """A growing mass-orthonormal basis, stored in blocks with its products with the mass."""

    def __init__(self, model: Massive, first: np.ndarray) -> None:
        self._model = model
        self._capacity = 0
        self._vectors = np.empty((model.n_dof, 0), first.dtype, order="F")
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
        total = np.zeros((self.size, image.shape[1]), image.dtype)
        triangle = np.eye(image.shape[1])
        block = image
        mass_block = self._model.mass_times(block)
        for _ in range(2):  # once more: the first pass loses digits where images are parallel
            part = old.conj().T @ mass_block
            block = block - old @ part
            total += part @ triangle
            mass_block = self._model.mass_times(block)
            gram = block.conj().T @ mass_block
            upper = np.linalg.cholesky(0.5 * (gram + gram.conj().T)).conj().T
            inverse = np.linalg.inv(upper)
            block, mass_block = block @ inverse, mass_block @ inverse
            triangle = upper @ triangle
        self._mass_last = mass_block
        self._store(block)
        return total, triangle

    def _store(self, block: np.ndarray) -> None:
        width = block.shape[1]
        if self.size + width > self._vectors.shape[1]:
            grown = np.empty(
                (len(block), 2 * self._vectors.shape[1] + 8 * width), block.dtype, order="F"
            )
            grown[:, : self.size] = self._vectors[:, : self.size]
            self._vectors = grown
        self._vectors[:, self.size : self.size + width] = block
        self.last = slice(self.size, self.size + width)
        self.size += width
