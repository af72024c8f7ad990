"""Products of tall matrices strip by strip, so that what lies between stays in the cache."""

from __future__ import annotations

import numpy as np

_STRIP = 8192  # rows


def subtract_product(fields: np.ndarray, basis: np.ndarray, coefficients: np.ndarray) -> None:
    """``fields`` (N, m) less ``basis`` (N, n) times ``coefficients`` (n, m), in place."""
    for first in range(0, len(fields), _STRIP):
        strip = slice(first, first + _STRIP)
        fields[strip] -= basis[strip] @ coefficients
