"""Verdicts on findings by a sample of what a paper leaves open.

A sample has points (settings of all unknowns, drawn from the range that the paper's text allows)
and one or more starts at each, under all conditions. A finding holds at a point or not, by the
means of its starts. Four verdicts, whose limits stand here and nowhere else:

- reproduced: it holds at ``MOST`` of the points or more;
- reproduced under X: it holds at ``MOST`` or more of a region of at least ``SLIVER`` of the points,
  bounded by at most two unknowns, and points of the region differ from others beyond chance;
- contradicted by Y: it holds at ``LEAST`` of the points or fewer, no region is beyond that, and a
  mechanism Y, seen in the runs, is named;
- not testable: all else, with the reason.

A share must beat the share by chance, with the labels of what is compared permuted at every point.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from itertools import combinations, product
from math import nan

import numpy as np
from scipy.stats import binom, binomtest

from judging.findings import Finding

MOST, SLIVER, LEAST = 0.8, 0.1, 0.1
LEVEL = 0.001  # of one finding, of the fifty or so of a paper
KNOWN = 0.8  # of the points at which a finding is decided, below which it is not judged
CUTS = 8  # parts of an unknown's range at whose limits regions end
SHUFFLES = 2000  # of points, for the chance of a region
REPRODUCED, UNDER = "reproduced", "reproduced under"
CONTRADICTED, UNTESTABLE = "contradicted", "not testable"


@dataclass(frozen=True)
class Sample:
    """Outputs of runs: ``values`` (points, starts) by output and condition, SI, NaN where there is
    none; ``shares`` (points, unknowns) of their ranges, ``names`` of the unknowns, and shares at
    which each may be cut: an unknown that is a choice only between its choices."""

    names: Sequence[str]
    shares: np.ndarray
    values: Mapping[tuple[str, str], np.ndarray]
    conditions: Sequence[str]
    cuts: Mapping[str, Sequence[float]] = field(default_factory=dict)

    @cached_property
    def means(self) -> dict[tuple[str, str], np.ndarray]:
        """Means (points,) over the starts that there are."""
        found = {}
        for key, values in self.values.items():
            there = np.isfinite(values)
            sums = np.where(there, values, 0.0).sum(axis=1)
            found[key] = np.where(there.any(axis=1), sums / np.maximum(there.sum(axis=1), 1), nan)
        return found

    def at(self, point: int):
        """Numbers of one point."""
        return lambda output, condition: float(self.means[output, condition][point])

    def has(self, finding: Finding) -> np.ndarray:
        """At which points (points,) all numbers of a finding are there."""
        keys = [(o, c) for o in finding.outputs for c in finding.conditions]
        if not all(key in self.values for key in keys):
            return np.zeros(len(self.shares), bool)
        return np.isfinite([self.means[key] for key in keys]).all(axis=0)


@dataclass(frozen=True)
class Region:
    """A part of the range: limits (low, high) in shares by unknown, the points in it, and at how
    many of them a finding holds; ``p`` of a region as clear as this among points shuffled."""

    limits: Mapping[str, tuple[float, float]]
    points: int
    holds: int
    of: int  # points in all
    p: float

    @property
    def share(self) -> float:
        return self.holds / self.points

    @property
    def size(self) -> float:
        """Share of the range."""
        return self.points / self.of


@dataclass(frozen=True)
class Judged:
    """A finding's verdict: the share of points at which it holds with its 95 % interval, the share
    by chance with the p of one as large, the clearest region, and the reason in words."""

    verdict: str
    outcomes: Sequence[bool | None] = field(repr=False)
    low: float = 0.0
    high: float = 1.0
    chance: float = nan
    p: float = nan
    region: Region | None = None
    reason: str = ""

    @property
    def decided(self) -> int:
        return sum(o is not None for o in self.outcomes)

    @property
    def share(self) -> float:
        """Share of the decided points at which it holds; NaN if none is."""
        return sum(o is True for o in self.outcomes) / self.decided if self.decided else nan


def judge(finding: Finding, sample: Sample, mechanism: str = "") -> Judged:
    """The verdict on a finding; ``mechanism`` says what contradicts it, if the runs show it."""
    there = sample.has(finding)
    points = np.flatnonzero(there)
    outcomes: list[bool | None] = [None] * len(there)
    chances = []
    for k in points:
        outcomes[k] = finding.holds(sample.at(k))
        chances.append(finding.by_chance(sample.at(k), sample.conditions))
    if len(points) < max(KNOWN * len(there), 1.0):
        return Judged(UNTESTABLE, outcomes, reason=f"{len(points)} of {len(there)} points have it")
    holds = np.array([bool(outcomes[k]) for k in points])
    interval = binomtest(int(holds.sum()), len(holds)).proportion_ci(0.95, method="exact")
    chance, p = float(np.mean(chances)), at_least(chances, int(holds.sum()))
    best = None
    if holds.mean() < MOST:
        best = clearest(replace(sample, shares=sample.shares[points]), holds)
    verdict, reason = _verdict(finding, holds, chance, p, best, mechanism)
    return Judged(
        verdict, outcomes, float(interval.low), float(interval.high), chance, p, best, reason
    )


def _verdict(
    finding: Finding, holds: np.ndarray, chance: float, p: float, best: Region | None,
    mechanism: str,
) -> tuple[str, str]:  # fmt: skip
    share = float(holds.mean())
    if share >= MOST:
        if finding.beats and not p < LEVEL:
            return UNTESTABLE, f"chance alone gives {chance:.0%}"
        return REPRODUCED, ""
    clear = best is not None and best.share >= MOST and best.p < LEVEL
    if best is not None and clear and (np.isnan(chance) or best.share > chance):
        return UNDER, ""
    if share <= LEAST and (best is None or not _above(best, LEAST)):
        if mechanism:
            return CONTRADICTED, mechanism
        return UNTESTABLE, "it does not hold, but nothing in the runs says why"
    return UNTESTABLE, "no region of two unknowns decides it"


def _above(region: Region, limit: float) -> bool:
    """Does a finding hold in a region beyond a share, and the region stand out from chance?"""
    return region.p < LEVEL and binom.sf(region.holds - 1, region.points, limit) < LEVEL


def at_least(chances: Sequence[float], count: int) -> float:
    """Probability of ``count`` or more successes of independent trials with these chances; NaN
    where there are none (Poisson's binomial distribution, by convolution)."""
    if np.isnan(chances).any():
        return nan
    found = np.ones(1)
    for chance in chances:
        found = np.convolve(found, [1.0 - chance, chance])
    return float(found[count:].sum())


def regions(sample: Sample) -> tuple[list[dict[str, tuple[float, float]]], np.ndarray]:
    """All regions that are looked at (limits by unknown), and which points (regions, points) lie in
    each: intervals of one unknown, and halves of two, that end where unknowns may be cut."""
    shares, names = sample.shares, list(sample.names)
    even = np.linspace(0.0, 1.0, CUTS + 1)[1:-1]
    cuts = {name: tuple(sample.cuts.get(name, even)) for name in names}
    limits: list[dict[str, tuple[float, float]]] = []
    inside: list[np.ndarray] = []

    def add(parts: dict[str, tuple[float, float]]) -> None:
        found = np.ones(len(shares), bool)
        for name, (low, high) in parts.items():
            column = shares[:, names.index(name)]
            found &= (column >= low) & (column <= high)
        if SLIVER * len(shares) <= found.sum() < len(shares):
            limits.append(parts)
            inside.append(found)

    for name in names:
        for span in combinations((0.0, *cuts[name], 1.0), 2):
            add({name: span})
    for one, other in combinations(names, 2):
        for a, b in product(*([*((0.0, c) for c in cuts[n]), *((c, 1.0) for c in cuts[n])]
                              for n in (one, other))):  # fmt: skip
            add({one: a, other: b})
    return limits, np.array(inside).reshape(len(inside), len(shares))


def clearest(sample: Sample, holds: np.ndarray) -> Region | None:
    """The region whose share exceeds that of all points most clearly, of those with ``MOST`` of
    their points or, if there is none, of all; None where a finding holds at no point, or at all.

    Clear: standard deviations of a count among points that are shuffled. ``p`` is that of any
    region as clear after shuffling which points hold, so that looking at thousands is paid for.
    """
    total, n = int(holds.sum()), len(holds)
    limits, inside = regions(sample)
    if not limits or not 0 < total < n:
        return None
    sizes = inside.sum(axis=1)
    expected = sizes * total / n
    spread = np.sqrt(expected * (1.0 - total / n) * (n - sizes) / (n - 1.0))
    within = inside.astype(np.float32)
    counts = (within @ holds.astype(np.float32)).round()
    clear = (counts - expected) / spread
    good = counts >= MOST * sizes
    best = int(np.argmax(np.where(good, clear, -np.inf) if good.any() else clear))
    rng = np.random.default_rng(0)
    shuffled = np.array([rng.permutation(holds) for _ in range(SHUFFLES)], np.float32)
    most = np.concatenate([
        ((within @ part.T - expected[:, None]) / spread[:, None]).max(axis=0)
        for part in np.array_split(shuffled, 20)
    ])  # fmt: skip
    p = (1.0 + float((most > clear[best] - 1e-6).sum())) / (1.0 + SHUFFLES)
    return Region(limits[best], int(sizes[best]), int(counts[best]), n, p)
