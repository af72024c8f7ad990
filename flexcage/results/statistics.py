"""Statistics of a chaotic motion, and how far a run of this length leaves them open.

Samples are gathered in windows of one roller pass, the time in which rollers move on by one pitch
and a sound bearing looks the same again: sums for means and ratios, largest values for peaks. The
largest value of a whole run grows with its length; the mean of its windows' largest does not.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from flexcage.results import metrics
from flexcage.results.bootstrap import margin
from flexcage.results.metrics import BearingNumbers

if TYPE_CHECKING:
    import xarray


def _quotient(sums: np.ndarray) -> np.ndarray:
    return sums[..., 0] / sums[..., 1]


@dataclass(frozen=True)
class Windows:
    """Samples cut into windows of about one roller pass; ``first`` (m,) begins each."""

    samples: int
    first: np.ndarray

    def mean(self, values: np.ndarray) -> float:
        """Margin of the mean of ``values`` (n,)."""
        return self.ratio(values, np.ones(self.samples))

    def ratio(self, upper: np.ndarray, lower: np.ndarray) -> float:
        """Margin of the mean of ``upper`` (n,) over that of ``lower`` (n,)."""
        return margin(self._sums(upper, lower), _quotient)

    def deviation(self, values: np.ndarray) -> float:
        """Margin of the standard deviation of ``values`` (n,) over their mean."""
        table = self._sums(np.ones(self.samples), values, values**2)
        return margin(table, lambda s: np.sqrt(s[..., 0] * s[..., 2] / s[..., 1] ** 2 - 1.0))

    def peak(self, values: np.ndarray) -> tuple[float, float]:
        """Mean of the windows' largest of ``values`` (n,), and its margin."""
        largest = np.maximum.reduceat(values, self.first)
        table = np.stack([largest, np.ones(len(largest))], axis=1)
        return float(largest.mean()), margin(table, _quotient)

    def drift(self, values: np.ndarray) -> float:
        """Distance of the means of the first and the second half of ``values`` (n,), over the
        margin of that distance: above 1 the halves differ; NaN if they are too short to tell."""
        table = self._sums(values, np.ones(self.samples))
        halves = np.array_split(table, 2)
        means = [half[:, 0].sum() / half[:, 1].sum() for half in halves]
        margins = [margin(half, _quotient) for half in halves]
        both = float(np.hypot(*margins))
        rounding = 1e-12 * max(map(abs, means))
        return 0.0 if both <= rounding else abs(means[1] - means[0]) / both

    def _sums(self, *columns: np.ndarray) -> np.ndarray:
        return np.add.reduceat(np.stack(columns, axis=1).astype(float), self.first)


def roller_passes(ds: xarray.Dataset, bearing: BearingNumbers) -> Windows:
    """Windows of a (settled) run; a cage that stands still gives one window, and no margins."""
    n = ds.sizes["time"]
    passes = abs(np.ptp(metrics.cage_angle(ds))) * bearing.roller_count / (2.0 * np.pi)
    count = int(np.clip(round(passes), 1, n))
    return Windows(n, np.arange(count) * n // count)
