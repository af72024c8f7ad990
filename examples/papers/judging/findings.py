"""What a paper claims, as findings: a rule on the outputs of runs under the conditions compared.

A claim of several parts is several findings, each judged alone. A rule fits the words: "rises" asks
for a trend, not that every value exceeds the one before it; "unchanged" asks for a difference that
is small beside the quantity itself. Two more things belong to a rule:

- ``by_chance``: how often it holds if the labels of what it compares are permuted;
- ``example``: means for which it is true by construction, so that ``power`` shows that it can win.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import permutations, product
from math import factorial
from typing import ClassVar, Protocol

import numpy as np
from scipy.stats import kendalltau

from flexcage import InputError

At = Callable[[str, str], float]  # of an output and a condition: one number
Means = Mapping[tuple[str, str], float]  # the same of all outputs and conditions of a finding
ORDERS = 120  # permutations that are all tried; of more, so many at random


class Finding(Protocol):
    """One part of a claim."""

    beats: ClassVar[bool]  # must its share beat that by chance?

    @property
    def outputs(self) -> tuple[str, ...]:
        """Outputs that it reads."""
        ...

    @property
    def conditions(self) -> tuple[str, ...]:
        """Conditions that it compares, in order."""
        ...

    def holds(self, at: At) -> bool:
        """Does it hold by these numbers?"""
        ...

    def by_chance(self, at: At, conditions: Sequence[str]) -> float:
        """Share of permutations of its labels with which it holds; NaN where it compares nothing.
        ``conditions`` are all that there are."""
        ...

    def example(self, change: float) -> Means:
        """Means for which it is true by construction, with a relative ``change`` as printed."""
        ...


@dataclass(frozen=True)
class OfOne:
    """A finding on one output under ``conditions``."""

    output: str
    conditions: tuple[str, ...]

    beats: ClassVar[bool] = True
    fewest: ClassVar[int] = 2

    def __post_init__(self) -> None:
        _check(self.conditions, self.fewest)

    @property
    def outputs(self) -> tuple[str, ...]:
        return (self.output,)

    def holds(self, at: At) -> bool:
        return self.so([at(self.output, c) for c in self.conditions])

    def so(self, values: Sequence[float]) -> bool:
        """Does it hold by the output's values under the conditions?"""
        raise NotImplementedError

    def by_chance(self, at: At, conditions: Sequence[str]) -> float:
        found = [at(self.output, c) for c in self.conditions]
        return float(np.mean([self.so(order) for order in _orders(found, len(found))]))


@dataclass(frozen=True)
class Trend(OfOne):
    """An output rises (or falls) along the conditions: more pairs rise than fall (Kendall's tau),
    and the last exceeds the first by the share ``by`` of it."""

    rising: bool = True
    by: float = 0.0

    def so(self, values: Sequence[float]) -> bool:
        sign = 1.0 if self.rising else -1.0
        far = sign * (values[-1] - values[0]) > self.by * abs(values[0])
        return far and sign * _tau(values) > 0.0

    def example(self, change: float) -> Means:
        size = max(change, 2.0 * self.by)
        end = 1.0 + size if self.rising else 1.0 / (1.0 + size)
        return _means(self.output, self.conditions, np.linspace(1.0, end, len(self.conditions)))


@dataclass(frozen=True)
class Turn(OfOne):
    """An output has its largest value (or its least) within the conditions, which lie ``at``
    places: the quadratic through them bends that way, and neither end is the largest (least)."""

    highest: bool = True
    at: tuple[float, ...] = ()
    fewest: ClassVar[int] = 3

    @property
    def _places(self) -> np.ndarray:
        return np.array(self.at or range(len(self.conditions)), float)

    def so(self, values: Sequence[float]) -> bool:
        found = np.array(values) * (1.0 if self.highest else -1.0)
        bend = np.polyfit(self._places, found, 2)[0]
        return bool(bend < 0.0 and 0 < int(np.argmax(found)) < len(found) - 1)

    def example(self, change: float) -> Means:
        x = self._places
        bowl = 1.0 - (2.0 * (x - x.min()) / np.ptp(x) - 1.0) ** 2
        sign = 1.0 if self.highest else -1.0
        return _means(self.output, self.conditions, 1.0 + sign * change * bowl)


@dataclass(frozen=True)
class Same(OfOne):
    """An output is as good as the same under all conditions: the range of its values is less than
    ``within``, a share of their mean size (or a value in SI, where ``absolute``).

    By chance: of as many conditions, drawn from all. What nothing changes holds as often by
    chance, and is so all the same: the share need not beat it.
    """

    within: float = 0.1
    absolute: bool = False
    beats: ClassVar[bool] = False

    def so(self, values: Sequence[float]) -> bool:
        size = 1.0 if self.absolute else float(np.abs(values).mean())
        return bool(np.ptp(values) < self.within * size)

    def by_chance(self, at: At, conditions: Sequence[str]) -> float:
        found = [at(self.output, c) for c in conditions]
        known = [v for v in found if np.isfinite(v)]
        orders = _orders(known, len(self.conditions))
        return float(np.mean([self.so(order) for order in orders]))

    def example(self, change: float) -> Means:
        size = 10.0 * self.within if self.absolute else 1.0
        return _means(self.output, self.conditions, np.full(len(self.conditions), size))


@dataclass(frozen=True)
class Differs(OfOne):
    """An output under the second condition is apart from that under the first by more than the
    share ``by``, whichever way. Chance is that of pairs drawn from all conditions."""

    by: float = 0.1
    beats: ClassVar[bool] = False

    def so(self, values: Sequence[float]) -> bool:
        return abs(values[1] - values[0]) > self.by * abs(values[0])

    by_chance = Same.by_chance

    def example(self, change: float) -> Means:
        return _means(self.output, self.conditions, [1.0, 1.0 + max(change, 2.0 * self.by)])


@dataclass(frozen=True)
class Within(OfOne):
    """An output lies between two limits (SI) under every condition; either may be infinite. It
    compares nothing, so there is no share by chance."""

    low: float = -np.inf
    high: float = np.inf
    beats: ClassVar[bool] = False
    fewest: ClassVar[int] = 1

    def so(self, values: Sequence[float]) -> bool:
        return all(self.low < value < self.high for value in values)

    def by_chance(self, at: At, conditions: Sequence[str]) -> float:
        return np.nan

    def example(self, change: float) -> Means:
        ends = [v for v in (self.low, self.high) if np.isfinite(v)]
        value = float(np.mean(ends))
        if len(ends) == 1:
            away = change * (abs(value) or 1.0)
            value += away if np.isfinite(self.low) else -away
        return _means(self.output, self.conditions, np.full(len(self.conditions), value))


@dataclass(frozen=True)
class OfTwo:
    """A finding on two outputs under ``conditions``."""

    output: str
    other: str
    conditions: tuple[str, ...]

    beats: ClassVar[bool] = True
    fewest: ClassVar[int] = 1

    def __post_init__(self) -> None:
        _check(self.conditions, self.fewest)

    @property
    def outputs(self) -> tuple[str, ...]:
        return (self.output, self.other)

    def _both(self, at: At) -> tuple[list[float], list[float]]:
        one, other = ([at(o, c) for c in self.conditions] for o in self.outputs)
        return one, other


@dataclass(frozen=True)
class Below(OfTwo):
    """An output is less than another of the same unit, under every condition, by the share ``by``
    of itself. By chance: which of the two is which."""

    by: float = 0.0

    def holds(self, at: At) -> bool:
        return self._so(*self._both(at))

    def _so(self, one: Sequence[float], other: Sequence[float]) -> bool:
        return all(a + self.by * abs(a) < b for a, b in zip(one, other))

    def by_chance(self, at: At, conditions: Sequence[str]) -> float:
        pairs = list(zip(*self._both(at)))
        turned = product(*((pair, pair[::-1]) for pair in pairs))
        return float(np.mean([self._so(*zip(*orders)) for orders in turned]))

    def example(self, change: float) -> Means:
        above = 1.0 + max(change, 2.0 * self.by)
        pairs = ((self.output, 1.0), (self.other, above))
        return {(o, c): v for c in self.conditions for o, v in pairs}


@dataclass(frozen=True)
class Together(OfTwo):
    """Two outputs go up and down together over the conditions (Kendall's tau above zero)."""

    fewest: ClassVar[int] = 3

    def holds(self, at: At) -> bool:
        return self._so(*self._both(at))

    @staticmethod
    def _so(one: Sequence[float], other: Sequence[float]) -> bool:
        return float(np.nan_to_num(kendalltau(one, other).statistic)) > 0.0

    def by_chance(self, at: At, conditions: Sequence[str]) -> float:
        one, other = self._both(at)
        return float(np.mean([self._so(one, order) for order in _orders(other, len(other))]))

    def example(self, change: float) -> Means:
        steps = np.linspace(1.0, 1.0 + change, len(self.conditions))
        return {**_means(self.output, self.conditions, steps),
                **_means(self.other, self.conditions, steps)}  # fmt: skip


@dataclass(frozen=True)
class Claim:
    """A statement of a paper: a short paraphrase, the figure it is read from, its findings by name,
    and the relative ``change`` that the paper prints or that its words ask for."""

    key: str
    text: str
    where: str
    parts: Mapping[str, Finding]
    change: float = 0.25

    @property
    def outputs(self) -> tuple[str, ...]:
        """Outputs that it reads."""
        return tuple(dict.fromkeys(o for part in self.parts.values() for o in part.outputs))

    @property
    def conditions(self) -> tuple[str, ...]:
        """Conditions that it compares."""
        return tuple(dict.fromkeys(c for part in self.parts.values() for c in part.conditions))


def _check(conditions: Sequence[str], fewest: int) -> None:
    if isinstance(conditions, str) or len(set(conditions)) < max(len(conditions), fewest):
        raise InputError(
            f"The conditions are {conditions!r}, but should be {fewest} or more labels that "
            "differ, as in ('slow', 'fast').",
            where="conditions",
            value=conditions,
        )


def _tau(values: Sequence[float]) -> int:
    """Pairs that rise less those that fall."""
    return sum(int(np.sign(b - a)) for k, a in enumerate(values) for b in values[k + 1 :])


def _orders(values: Sequence[float], length: int) -> Iterator[Sequence[float]]:
    """Orders of so many of the values: all, or ``ORDERS`` at random."""
    if factorial(len(values)) // factorial(len(values) - length) <= ORDERS:
        yield from permutations(values, length)
        return
    rng = np.random.default_rng(0)
    for _ in range(ORDERS):
        yield rng.permutation(values)[:length].tolist()


def _means(output: str, conditions: Sequence[str], values: Sequence[float] | np.ndarray) -> Means:
    return {(output, c): float(v) for c, v in zip(conditions, values)}
