"""Rank tests for figures of independent starts along an axis: does a figure rise, or turn?

Jonckheere and Terpstra's test asks whether samples rise along their order, Mack and Wolfe's whether
they rise to a named one and fall from there. Both count pairs of values in the claimed order, and
both have an exact distribution for samples without ties: that of a sum of independent
Mann-Whitney counts, whose generating functions are Gaussian binomials. With ties the distribution
is that of random permutations.

Sources: T. J. Terpstra, Indagationes Mathematicae 14 (1952) 327; A. R. Jonckheere, Biometrika 41
(1954) 133; G. A. Mack and D. A. Wolfe, J. Am. Stat. Assoc. 76 (1981) 175; the generating function,
E. F. Harding, Applied Statistics 33 (1984) 1.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import combinations

import numpy as np

from flexcage.core.errors import InputError

PERMUTATIONS = 20_000  # of samples with ties
Sample = Sequence[float] | np.ndarray
Groups = Sequence[Sample]


@dataclass(frozen=True)
class RankTest:
    """``count`` of ``pairs`` are in the claimed order; ``p`` is the probability of as many or more
    without any effect, ``p_contrary`` of as few or fewer."""

    count: float
    pairs: int
    p: float
    p_contrary: float

    @property
    def share(self) -> float:
        """Share of pairs in the claimed order: 1/2 without any effect, 1 if all are."""
        return self.count / self.pairs


def jonckheere(groups: Groups, *, rising: bool = True) -> RankTest:
    """Do samples rise (or fall) in the order in which they are given? InputError for fewer than
    two samples, an empty one, or a value that is no number."""
    samples = _samples(groups, at_least=2)
    ordered = samples if rising else samples[::-1]
    return _tested(ordered, list(combinations(range(len(ordered)), 2)), peak=None)


def mack_wolfe(groups: Groups, *, turn: int, lowest: bool = False) -> RankTest:
    """Do samples rise up to the one numbered ``turn``, from 0, and fall from there?

    ``lowest``: do they fall to it, and rise? InputError as for ``jonckheere``, and for a turn that
    is no sample within.
    """
    samples = _samples(groups, at_least=3)
    if not 0 < turn < len(samples) - 1:
        raise InputError(
            f"The turn is sample {turn} of {len(samples)}, counted from 0, but should be one with "
            "others on both sides.",
            where="turn",
            value=turn,
        )
    if lowest:
        samples = [-sample for sample in samples]
    up = combinations(range(turn + 1), 2)
    down = ((j, i) for i, j in combinations(range(turn, len(samples)), 2))
    return _tested(samples, [*up, *down], peak=turn)


def _samples(groups: Groups, *, at_least: int) -> list[np.ndarray]:
    samples = [np.asarray(group, float).ravel() for group in groups]
    if len(samples) < at_least or not all(map(len, samples)):
        sizes = ", ".join(str(len(sample)) for sample in samples) or "none"
        raise InputError(
            f"The samples have {sizes} values, but the test wants at least {at_least} samples of "
            "one or more.",
            where="groups",
        )
    if not all(np.isfinite(sample).all() for sample in samples):
        raise InputError("A sample holds a value that is no number; leave it out.", where="groups")
    return samples


def _tested(
    samples: list[np.ndarray], pairs: list[tuple[int, int]], *, peak: int | None
) -> RankTest:
    """The test that counts pairs of samples (lower, higher)."""
    sizes = tuple(map(len, samples))
    values = np.concatenate(samples)
    count, most = _count(samples, pairs), sum(sizes[i] * sizes[j] for i, j in pairs)
    if len(np.unique(values)) == len(values):
        chances = _chances(sizes, peak)
        return RankTest(count, most, float(chances[int(count) :].sum()),
                        float(chances[: int(count) + 1].sum()))  # fmt: skip
    rng, ends = np.random.default_rng(0), np.cumsum(sizes)[:-1]
    drawn = np.array([
        _count(np.split(rng.permutation(values), ends), pairs) for _ in range(PERMUTATIONS)
    ])  # fmt: skip
    p, contrary = ((1 + int(n)) / (1 + PERMUTATIONS) for n in ((drawn >= count).sum(),
                                                               (drawn <= count).sum()))  # fmt: skip
    return RankTest(count, most, p, contrary)


def _count(samples: Sequence[np.ndarray], pairs: Sequence[tuple[int, int]]) -> float:
    """Pairs of values in order, those that are equal by halves."""
    total = 0.0
    for i, j in pairs:
        apart = samples[j][None, :] - samples[i][:, None]
        total += float((apart > 0.0).sum()) + 0.5 * float((apart == 0.0).sum())
    return total


@lru_cache(maxsize=64)
def _chances(sizes: tuple[int, ...], peak: int | None) -> np.ndarray:
    """Probability of every count without any effect, samples of these sizes and no ties.

    With a peak, the orders among the samples before it, among those after it, and of the peak's
    values among all others are independent.
    """
    if peak is None:
        return _shares(_multinomial(sizes))
    before, after = sizes[:peak], sizes[peak + 1 :]
    others = sum(before) + sum(after)
    parts = (_multinomial(before), _multinomial(after), _multinomial((others, sizes[peak])))
    found = np.ones(1)
    for part in parts:
        found = np.convolve(found, _shares(part))
    return found


def _shares(ways: list[int]) -> np.ndarray:
    total = sum(ways)
    return np.array([way / total for way in ways])


def _multinomial(sizes: Sequence[int]) -> list[int]:
    """In how many ways samples of these sizes have 0, 1, 2, ... pairs in order: the coefficients
    of the Gaussian multinomial, the product of (1 - q^(m+i))/(1 - q^i)."""
    ways, before = [1], 0
    for size in sizes:
        for i in range(1, size + 1):
            power = before + i
            longer = ways + [0] * power
            for k, way in enumerate(ways):
                longer[k + power] -= way
            for k in range(i, len(longer)):
                longer[k] += longer[k - i]
            ways = longer[: len(longer) - i]
        before += size
    return ways
