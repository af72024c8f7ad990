"""Lowest modes of a body by the block Lanczos method on its flexibility."""

from __future__ import annotations

import logging
from collections.abc import Callable, Iterator
from typing import Protocol

import numpy as np
from scipy.linalg import eigh

from flexcage.core.errors import RunFailed
from flexcage.fem.blocked_products import inner_products, subtract_product

log = logging.getLogger(__name__)

_BLOCK = 4
_GROUP = 8  # blocks stored together
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
    log.debug("%d modes found in a space of %d vectors", count, size)
    return 1.0 / theta, space.combined(vectors)


class _MassSpace:
    """A growing mass-orthonormal basis (3N, size), stored in groups of columns."""

    def __init__(self, model: Massive, first: np.ndarray) -> None:
        self._model = model
        self._groups: list[np.ndarray] = []
        self._room = 0  # columns in all groups
        self._recent: list[tuple[np.ndarray, np.ndarray]] = []  # last two blocks, and their mass
        self.size = 0
        self.append(first)

    @property
    def mass_last(self) -> np.ndarray:
        return self._recent[-1][1]

    def combined(self, coefficients: np.ndarray) -> np.ndarray:
        """The first vectors times their coefficients (n, m)."""
        total = np.zeros((self._model.n_dof, coefficients.shape[1]), self._groups[0].dtype)
        self._take_off(total, -coefficients)
        return total

    def _take_off(self, fields: np.ndarray, coefficients: np.ndarray) -> None:
        for columns, place in self._groups_of(len(coefficients)):
            subtract_product(fields, columns, coefficients[place])

    def append(self, image: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Orthonormalise ``image`` and add it.

        Returns the coefficients (size, b) on the vectors before, and the upper triangle (b, b)
        that turns the added vectors into what was left. All but rounding is on the last two blocks,
        as the flexibility is symmetric: they are taken off first, then what is left on any.
        """
        width = image.shape[1]
        total = np.zeros((self.size, width), image.dtype)
        block, mass_block = image, self._model.mass_times(image)
        for number, (vectors, mass) in enumerate(self._recent):
            part = inner_products(vectors, mass_block)
            block, mass_block = block - vectors @ part, mass_block - mass @ part
            total[self.size - (len(self._recent) - number) * width :][:width] = part
        block, mass_block, triangle = _normalised(block, mass_block)
        if self.size:
            against = self._groups_of(self.size)
            part = np.concatenate([inner_products(v, mass_block) for v, _ in against])
            total += part @ triangle
            self._take_off(block, part)
        block, mass_block, upper = _normalised(block, self._model.mass_times(block))
        self._recent = [*self._recent[-1:], (block, mass_block)]
        self._store(block)
        return total, upper @ triangle

    def _groups_of(self, count: int) -> Iterator[tuple[np.ndarray, slice]]:
        """The groups of the first vectors, and which of these each holds."""
        start = 0
        for group in self._groups:
            if start < count:
                own = group[:, : count - start]
                yield own, slice(start, start + own.shape[1])
            start += group.shape[1]

    def _store(self, block: np.ndarray) -> None:
        width = block.shape[1]
        if self.size + width > self._room:
            self._groups.append(np.empty((len(block), _GROUP * width), block.dtype))
            self._room += _GROUP * width
        place = self.size - (self._room - self._groups[-1].shape[1])
        self._groups[-1][:, place : place + width] = block
        self.last = slice(self.size, self.size + width)
        self.size += width


def _normalised(
    block: np.ndarray, mass_block: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """A mass-orthonormal block, its product with the mass, and the triangle that leads back."""
    gram = inner_products(block, mass_block)
    upper = np.linalg.cholesky(0.5 * (gram + gram.conj().T)).conj().T
    inverse = np.linalg.inv(upper)
    return block @ inverse, mass_block @ inverse, upper
