"""What decides: shares of a plausible range, and how strongly each unknown moves an outcome.

SALib computes the indices of outputs: Morris' mean absolute elementary effect, Sobol's total index,
and, from a plain sample, Sobol's first-order index by random balance designs (RBD-FAST). An unknown
matters where its index exceeds the dummy's, which is what starts and a finite sample make of
nothing. Which unknowns decide a claim needs no SALib: points where it holds and where not are
compared along each unknown by the two-sample test of Kolmogorov and Smirnov (R. C. Spear, G. M.
Hornberger, Water Research 14 (1980) 43).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import nan
from typing import Any

import numpy as np
from scipy.stats import binomtest, ks_2samp

from flexcage.core.digits import percent_text
from flexcage.core.errors import InputError
from flexcage.study.decisions import holm
from flexcage.study.unknowns import LEVELS, problem, require_salib

CONFIDENCE = 0.95
#: What SALib's index of each design is called.
KINDS = {"morris": "mu*", "saltelli": "total index", "sample": "first-order index"}
FEWEST = 16  # points of a plain sample, below which no index is computed
_WAVES, _EACH = 10, 8  # harmonics of a plain sample's analysis, and points that each one wants


@dataclass(frozen=True)
class Share:
    """``holds`` of ``decided`` points of a map: the share of the plausible range, with its 95 %
    interval (exact binomial: that of independent points, so on the safe side of an even sample).

    ``open`` points decide nothing.
    """

    holds: int
    decided: int
    open: int
    low: float
    high: float

    @property
    def value(self) -> float:
        return self.holds / self.decided if self.decided else nan

    def __str__(self) -> str:
        if not self.decided:
            return "no point decides"
        value, low, high = map(percent_text, (self.value, self.low, self.high))
        return f"{value} ({low} to {high})"


@dataclass(frozen=True)
class Index:
    """How strongly an unknown moves an output: its index and half of the index's 95 % interval;
    ``matters`` says that it exceeds the dummy's beyond both."""

    name: str
    value: float
    margin: float
    matters: bool


@dataclass(frozen=True)
class Decider:
    """How far along an unknown the points where a claim holds lie from those where it does not:
    the largest distance of their distributions, its p by Holm over all unknowns, and whether it
    ``holds_above`` (by medians)."""

    name: str
    distance: float
    p: float
    holds_above: bool


def share(outcomes: Sequence[bool | None]) -> Share:
    """The share of points at which a claim holds."""
    decided = [bool(found) for found in outcomes if found is not None]
    holds, n = sum(decided), len(decided)
    low, high = 0.0, 1.0
    if n:
        interval = binomtest(holds, n).proportion_ci(CONFIDENCE, method="exact")
        low, high = float(interval.low), float(interval.high)
    return Share(holds, n, len(outcomes) - n, low, high)


def deciders(
    shares: np.ndarray, names: Sequence[str], outcomes: Sequence[bool | None]
) -> list[Decider]:
    """Unknowns by how clearly they decide a claim, the clearest first; none where the claim holds,
    or does not, at fewer than two points."""
    known = np.array([found is not None for found in outcomes])
    holds = np.array([bool(found) for found in outcomes])
    one, other = shares[known & holds], shares[known & ~holds]
    if min(len(one), len(other)) < 2:
        return []
    tests = [ks_2samp(a, b) for a, b in zip(one.T, other.T)]
    adjusted = holm([float(test.pvalue) for test in tests])
    found = [
        Decider(name, float(test.statistic), p, bool(np.median(a) > np.median(b)))
        for name, test, p, a, b in zip(names, tests, adjusted, one.T, other.T)
    ]
    return sorted(found, key=lambda d: (d.p, -d.distance))


def indices(
    design: str, shares: np.ndarray, names: Sequence[str], values: np.ndarray, *, seed: int = 1
) -> list[Index]:
    """Index of every column of a design, the dummy's last, for an output (points,).

    Trajectories or base points of which a value is missing are left out. Raises InputError where
    too few remain, and EnvironmentLacks without SALib.
    """
    require_salib()
    values = np.asarray(values, float)
    block = {"morris": len(names) + 1, "saltelli": len(names) + 2}.get(design, 1)
    whole = np.isfinite(values).reshape(-1, block).all(axis=1)
    kept = np.repeat(whole, block)
    fewest = FEWEST if block == 1 else 2
    if whole.sum() < fewest:
        raise InputError(
            f"{int(whole.sum())} of {len(whole)} parts of the design are complete, but an index "
            f"wants {fewest} or more.",
            where="outputs",
        )
    found = np.column_stack(_analysed(design, shares[kept], values[kept], seed))
    least, floor = found[-1]
    return [
        Index(name, float(v), float(m), bool(v - m > least + floor and k < len(names) - 1))
        for k, (name, (v, m)) in enumerate(zip(names, found))
    ]


def _analysed(
    design: str, shares: np.ndarray, values: np.ndarray, seed: int
) -> tuple[np.ndarray, np.ndarray]:
    """Index and margin of every column."""
    columns = shares.shape[1]
    if not np.ptp(values) > 0.0:
        return np.zeros(columns), np.zeros(columns)
    inputs: dict[str, Any] = problem(columns)
    if design == "morris":
        from SALib.analyze import morris

        result = morris.analyze(inputs, shares, values, num_levels=LEVELS, seed=seed)
        return np.asarray(result["mu_star"]), np.asarray(result["mu_star_conf"])
    if design == "saltelli":
        from SALib.analyze import sobol

        result = sobol.analyze(inputs, values, calc_second_order=False, seed=seed)
        return np.asarray(result["ST"]), np.asarray(result["ST_conf"])
    from SALib.analyze import rbd_fast

    waves = min(_WAVES, len(values) // _EACH)
    result = rbd_fast.analyze(inputs, shares, values, M=waves, seed=seed)
    return np.asarray(result["S1"]), np.asarray(result["S1_conf"])
