"""How rolling elements rub on the walls of their pockets: what wear asks of a bearing family."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage
from flexcage.geometry.materials import contact_modulus

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True, eq=False)
class Rubbing:
    """Normal force times sliding speed on pocket faces: ``power`` (nt, z, face) [W].

    Of every cell of a track (z, face, cell): its mean ``cells`` [W], ``length`` and ``height`` [m].
    ``groove`` (face,) [m] is the radius that a groove takes, zero where its height stays, and
    ``friction`` (nt,) [W] what friction takes at those speeds.
    """

    power: np.ndarray
    cells: np.ndarray
    length: np.ndarray
    height: np.ndarray
    groove: np.ndarray
    friction: np.ndarray


def joined(parts: Sequence[Rubbing]) -> Rubbing:
    """That of the pockets of one cage after the other."""
    if len(parts) == 1:
        return parts[0]
    return Rubbing(
        np.concatenate([part.power for part in parts], axis=1),
        np.concatenate([part.cells for part in parts]),
        np.concatenate([part.length for part in parts]),
        np.concatenate([part.height for part in parts]),
        parts[0].groove,
        np.sum([part.friction for part in parts], axis=0),
    )


#: A family's rubbing, by the (settled) dataset of a run, its bearing and its cage.
Rub = Callable[["xarray.Dataset", Bearing, Cage], Rubbing]


def modulus(bearing: Bearing, cage: Cage) -> float:
    """2/((1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2) of element and cage [Pa]."""
    return contact_modulus(bearing.rolling_material, cage.warm_material)


def weighted(force: np.ndarray) -> np.ndarray:
    """Mean force (...) over time (nt, ...), weighted by itself: that of the samples that touch."""
    total = force.sum(axis=0, dtype=float)
    return np.divide(
        (force.astype(float) ** 2).sum(axis=0), total, out=np.zeros_like(total), where=total > 0.0
    )


def spread(place: np.ndarray, weight: np.ndarray) -> np.ndarray:
    """Width (...) of a uniform spread with the standard deviation of ``place`` (nt, ...) under
    ``weight`` (nt, ...)."""
    total = np.maximum(weight.sum(axis=0), 1e-300)
    mean = (weight * place).sum(axis=0) / total
    return np.sqrt(12.0 * (weight * (place - mean) ** 2).sum(axis=0) / total)
