"""Statistics of a chaotic motion, and how far a run of this length leaves them open.

Samples are gathered in windows of one roller pass, the time in which rollers move on by one pitch
and a sound bearing looks the same again: sums for means and ratios, largest values for peaks. The
largest value of a whole run grows with its length; the mean of its windows' largest does not.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from flexcage.results import metrics
from flexcage.results.bootstrap import FEWEST, influences, margin
from flexcage.results.slip import BearingNumbers

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True, eq=False)
class Record:
    """A statistic by windows: ``sums`` (m, 2) whose quotient it is, or (m, 3) sums of 1, x and x^2
    of a standard deviation over a mean. ``turn`` windows make a turn of the cage.

    A turn brings every roller and a bent crossbeam once through the load. What repeats with it
    belongs to the motion and is no uncertainty; ``margin`` leaves it out from two turns on.
    """

    sums: np.ndarray
    turn: int = 0

    @cached_property
    def value(self) -> float:
        with np.errstate(divide="ignore", invalid="ignore"):
            return float(_statistic(self.sums.sum(axis=0)))

    @cached_property
    def margin(self) -> float:
        """Half the width of the 95 % interval of ``value``; NaN for too few windows."""
        return margin(*influences(self.sums, _statistic, self.turn))

    @cached_property
    def drift(self) -> float:
        """Distance of the first half from the second, over the margin of that distance: above 1
        the halves differ; NaN if they are too short to tell.

        Halves of whole turns of the cage where there is room for them, so that what repeats with
        the turn is in both alike.
        """
        count = len(self.sums) // 2
        if count < FEWEST:
            return float("nan")
        whole = count - count % self.turn if self.turn else count
        count = whole if whole >= FEWEST else count
        halves = self.sums[-2 * count : -count], self.sums[-count:]
        one, other = (Record(sums, self.turn) for sums in halves)
        if np.isnan(one.value) != np.isnan(other.value):
            return float("inf")  # such as a force while in contact, without any in one half
        both = float(np.hypot(one.margin, other.margin))
        difference = abs(one.value - other.value)
        rounding = np.isfinite(both) and difference <= 1e-12 * abs(self.value)
        return 0.0 if rounding else difference / both


def spread(one: Record, other: Record) -> float:
    """Margin of ``one.value/other.value`` of two runs, from windows at the same times.

    What both runs do alike, such as one turn of the cage that loads it more than the next, drops
    out; what chaos makes them do apart remains.
    """
    m, columns = min(len(one.sums), len(other.sums)), one.sums.shape[1]
    pairs = np.hstack([one.sums[:m], other.sums[:m]])

    def ratio(s: np.ndarray) -> np.ndarray:
        return _statistic(s[..., :columns]) / _statistic(s[..., columns:])

    return margin(*influences(pairs, ratio))


def _statistic(sums: np.ndarray) -> np.ndarray:
    if sums.shape[-1] == 2:
        return sums[..., 0] / sums[..., 1]
    count, first, second = np.moveaxis(sums, -1, 0)
    return np.sqrt(np.maximum(count * second / first**2 - 1.0, 0.0))


@dataclass(frozen=True)
class Windows:
    """Samples cut into windows of about one roller pass; ``first`` (m,) begins each, and ``turn``
    of them make a turn of the cage."""

    samples: int
    first: np.ndarray
    turn: int = 0

    def mean(self, values: np.ndarray) -> Record:
        """Mean of ``values`` (n,)."""
        return self.ratio(values, np.ones(self.samples))

    def ratio(self, upper: np.ndarray, lower: np.ndarray) -> Record:
        """Mean of ``upper`` (n,) over that of ``lower`` (n,)."""
        return self._record(upper, lower)

    def deviation(self, values: np.ndarray) -> Record:
        """Standard deviation of ``values`` (n,) over their mean."""
        return self._record(np.ones(self.samples), values, values**2)

    def peak(self, values: np.ndarray) -> Record:
        """Mean of the windows' largest of ``values`` (n,)."""
        largest = np.maximum.reduceat(values, self.first).astype(float)
        return Record(np.stack([largest, np.ones(len(largest))], axis=1), self.turn)

    def drifts(self, values: np.ndarray, *, beyond: float = 1.0, by: float = 0.0) -> bool:
        """Do the halves of ``values`` (n,) differ: by more than ``beyond`` times the 95 % margin of
        their distance (``Record.drift``), and by more than the share ``by`` of the mean?"""
        one, other = (half.mean() for half in np.array_split(values, 2))
        far = abs(other - one) > by * values.mean()
        return bool(far and self.mean(values).drift > beyond)

    def _record(self, *columns: np.ndarray) -> Record:
        sums = np.add.reduceat(np.stack(columns, axis=1).astype(float), self.first)
        return Record(sums, self.turn)


def element_passes(ds: xarray.Dataset, bearing: BearingNumbers) -> Windows:
    """Windows of a (settled) run; a cage that stands still gives one window, and no margins."""
    n = ds.sizes["time"]
    passes = abs(np.ptp(metrics.carrier_angle(ds))) * bearing.element_count / (2.0 * np.pi)
    count = int(np.clip(round(passes), 1, n))
    return Windows(n, np.arange(count) * n // count, bearing.element_count)
