"""Fewer samples of a curve, with every peak of it kept."""

from __future__ import annotations

import numpy as np

BUCKETS = 700  # stretches of time of which the least and the largest sample are kept


def thinned(values: np.ndarray, buckets: int = BUCKETS) -> np.ndarray:
    """Indices, ascending, of samples that draw ``values`` (n,) as all would.

    The samples are cut into ``buckets`` runs of equal length, and the least and the largest of
    each are kept, and the first and the last of all. A bucket of NaN keeps its first sample, so
    that a gap stays one.
    """
    n = len(values)
    if n <= 2 * buckets:
        return np.arange(n)
    edges = np.linspace(0, n, buckets + 1).astype(int)
    bad = np.isnan(values)
    low, high = np.where(bad, np.inf, values), np.where(bad, -np.inf, values)
    kept = [0, n - 1]
    for a, b in zip(edges[:-1], edges[1:]):
        kept += [a + int(low[a:b].argmin()), a + int(high[a:b].argmax())]
    return np.unique(kept)
