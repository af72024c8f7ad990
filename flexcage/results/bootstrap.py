"""How far the mean of a correlated record may be off: stationary bootstrap with automatic blocks.

Sources: the bootstrap, Politis and Romano, J. Am. Stat. Assoc. 89 (1994) 1303; the block length,
Politis and White, Econometric Reviews 23 (2004) 53, as corrected by Patton, Politis and White,
Econometric Reviews 28 (2009) 372; a periodic mean under stationary noise, Dudek, Leskow,
Paparoditis and Politis, J. Time Series Analysis 35 (2014) 89.
"""

from __future__ import annotations

from collections.abc import Callable
from math import ceil, log10, sqrt

import numpy as np
from scipy.special import stdtrit

RESAMPLES = 500
FEWEST = 20  # entries, below which no margin is given
CONFIDENCE = 0.95

#: Why a table has no interval.
NO_INTERVAL = f"No interval (-): it needs {FEWEST} passes in the settled part; run longer."

Statistic = Callable[[np.ndarray], np.ndarray]


def block_length(x: np.ndarray) -> float:
    """Mean block length, in entries, that the stationary bootstrap of the mean of ``x`` needs."""
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


def influences(
    table: np.ndarray, statistic: Statistic, season: int = 0
) -> tuple[np.ndarray, float]:
    """What each row does to ``statistic``: entries (m,) whose mean errs as the statistic does, and
    the share of them that is free.

    ``table`` (n, columns) holds the record, and ``statistic`` maps sums over rows (..., columns)
    to (...,); entries are its jackknife values about their mean. If the record holds two or more
    whole seasons of ``season`` rows, what repeats from season to season is taken out of them: it
    does not make the mean over whole seasons uncertain.
    """
    n, total = len(table), table.sum(axis=0)
    with np.errstate(divide="ignore", invalid="ignore"):
        out = n * (statistic(total) - statistic(total - table))
    out = out - out.mean()
    seasons = n // season if season else 0
    if seasons < 2:
        return out, 1.0
    free = 1.0 - 1.0 / seasons
    phases = out[: seasons * season].reshape(seasons, season)
    return (phases - phases.mean(axis=0)).ravel() / sqrt(free), free


def margin(values: np.ndarray, free: float = 1.0) -> float:
    """Half the width of the 95 % interval of the mean of ``values`` (n,), of which a share is
    ``free``; NaN for fewer than ``FEWEST``.

    The interval is Student's over the bootstrap's standard deviation, with a degree of freedom
    less than there are free blocks.
    """
    n = len(values)
    if n < FEWEST or not np.isfinite(values).all():
        return float("nan")
    block = block_length(values)
    deviation = float(values[resampled(n, block, np.random.default_rng(n))].mean(axis=1).std())
    return float(stdtrit(max(n * free / block - 1.0, 1.0), 0.5 * (1.0 + CONFIDENCE))) * deviation
