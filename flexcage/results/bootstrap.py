"""How far the mean of a correlated record may be off: stationary bootstrap with automatic blocks.

Sources: the bootstrap, Politis and Romano, J. Am. Stat. Assoc. 89 (1994) 1303; the block length,
Politis and White, Econometric Reviews 23 (2004) 53, as corrected by Patton, Politis and White,
Econometric Reviews 28 (2009) 372.
"""

from __future__ import annotations

from collections.abc import Callable
from math import ceil, log10, sqrt

import numpy as np
from scipy.special import stdtrit

RESAMPLES = 500
FEWEST = 20  # rows, below which no margin is given
CONFIDENCE = 0.95

Statistic = Callable[[np.ndarray], np.ndarray]


def block_length(x: np.ndarray) -> float:
    """Mean block length, in entries, that the stationary bootstrap of the mean of ``x`` wants."""
    n = len(x)
    x = x - x.mean()
    run = max(5, ceil(sqrt(log10(n))))
    longest = min(ceil(sqrt(n)) + run, n - 1)
    R = np.array([x[: n - k] @ x[k:] / n for k in range(longest + 1)])
    if R[0] <= 0.0:
        return 1.0
    small = np.abs(R[1:] / R[0]) < 2.0 * sqrt(log10(n) / n)
    quiet = [m for m in range(len(small) - run + 1) if small[m : m + run].all()]
    M = min(2 * max(quiet[0] if quiet else longest, 1), longest)
    k = np.arange(1, M + 1)
    weighted = np.minimum(1.0, 2.0 * (1.0 - k / M)) * R[1 : M + 1]
    spectrum, slope = R[0] + 2.0 * weighted.sum(), 2.0 * (k * weighted).sum()
    if spectrum == 0.0:
        return 1.0
    b = (slope**2 / spectrum**2) ** (1.0 / 3.0) * n ** (1.0 / 3.0)
    return float(np.clip(b, 1.0, ceil(min(3.0 * sqrt(n), n / 3.0))))


def resampled(n: int, block: float, rng: np.random.Generator) -> np.ndarray:
    """Entries (RESAMPLES, n) of 0 ... n-1 in blocks of geometric length, wrapped around."""
    start = rng.integers(n, size=(RESAMPLES, n))
    begins = rng.random((RESAMPLES, n)) < 1.0 / block
    begins[:, 0] = True
    place = np.arange(n)
    since = place - np.maximum.accumulate(np.where(begins, place, 0), axis=1)
    return (np.take_along_axis(start, place - since, axis=1) + since) % n


def margin(table: np.ndarray, statistic: Statistic) -> float:
    """Half the width of the 95 % interval of ``statistic``; NaN for fewer than ``FEWEST`` rows.

    ``table`` (n, columns) holds the record, and ``statistic`` maps sums over rows (..., columns)
    to (...,). The interval is Student's over the bootstrap's standard deviation, with a degree of
    freedom less than there are blocks; blocks fit the statistic's jackknife values.
    """
    n = len(table)
    if n < FEWEST:
        return float("nan")
    total = table.sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        influence = -statistic(total - table)
        if not np.isfinite(influence).all():
            return float("nan")
        block = block_length(influence)
        rows = resampled(n, block, np.random.default_rng(n))
        deviation = float(np.nanstd(statistic(table[rows].sum(axis=1))))
    return float(stdtrit(max(n / block - 1.0, 1.0), 0.5 * (1.0 + CONFIDENCE))) * deviation
