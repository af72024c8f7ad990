"""Products of tall matrices strip by strip, so that what lies between stays in the cache."""

from __future__ import annotations

import numpy as np

_STRIP = 4096  # rows


def subtract_product(fields: np.ndarray, basis: np.ndarray, coefficients: np.ndarray) -> None:
    """``fields`` (N, m) less ``basis`` (N, n) times ``coefficients`` (n, m), in place."""
    for first in range(0, len(fields), _STRIP):
        strip = slice(first, first + _STRIP)
        fields[strip] -= basis[strip] @ coefficients


def inner_products(left: np.ndarray, right: np.ndarray) -> np.ndarray:
    """``left`` (N, n), conjugated, times ``right`` (N, m): (n, m)."""
    shape = (left.shape[1], right.shape[1])
    total = np.zeros(shape, np.result_type(left, right))
    for first in range(0, len(left), _STRIP):
        strip = slice(first, first + _STRIP)
        total += left[strip].conj().T @ right[strip]
    return total
