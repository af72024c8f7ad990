"""Claims of a paper as parts that must all hold: each part has a rule and a test.

The rule says whether the part holds at one point of a map, by the means of an output under the
conditions that the claim compares. The test says what independent starts speak for and against it.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import nan
from typing import Protocol

import numpy as np
from scipy.stats import kendalltau

from flexcage.core.errors import InputError
from flexcage.study.decisions import NOTHING, Evidence, above, all_of, equal, less, trend, turning

At = Callable[[str, str], float]  # of an output and a condition: one number
Values = Callable[[str, str], np.ndarray]  # the same: (starts,) numbers


class Part(Protocol):
    """One part of a claim."""

    def holds(self, at: At) -> bool:
        """Does it hold by these numbers?"""
        ...

    def evidence(self, values: Values) -> Evidence:
        """What these starts say of it."""
        ...


class _OfConditions:
    """A part that compares conditions, each by its label."""

    conditions: tuple[str, ...]

    def __post_init__(self) -> None:
        given = self.conditions
        if isinstance(given, str) or len(set(given)) < len(given):
            raise InputError(
                f"The conditions are {given!r}, but should be labels that differ, as in "
                "('slow', 'fast').",
                where="conditions",
                value=given,
            )


@dataclass(frozen=True)
class Trend(_OfConditions):
    """An output rises (or falls) from each condition to the next; a change of less than the share
    ``least`` from first to last speaks against it."""

    output: str
    conditions: tuple[str, ...]
    rising: bool = True
    least: float = 0.0

    def holds(self, at: At) -> bool:
        found = [at(self.output, c) for c in self.conditions]
        return all(b > a if self.rising else b < a for a, b in pairwise(found))

    def evidence(self, values: Values) -> Evidence:
        groups = [values(self.output, c) for c in self.conditions]
        return trend(groups, rising=self.rising, least=self.least)


@dataclass(frozen=True)
class Turn(_OfConditions):
    """An output falls to the condition numbered ``turn``, from 0, and rises from there; with
    ``lowest`` false it rises and falls."""

    output: str
    conditions: tuple[str, ...]
    turn: int
    lowest: bool = True

    def holds(self, at: At) -> bool:
        found = [at(self.output, c) for c in self.conditions]
        first, last = found[: self.turn + 1], found[self.turn :]
        down = all(b < a for a, b in pairwise(first if self.lowest else last))
        return down and all(b > a for a, b in pairwise(last if self.lowest else first))

    def evidence(self, values: Values) -> Evidence:
        groups = [values(self.output, c) for c in self.conditions]
        return turning(groups, turn=self.turn, lowest=self.lowest)


@dataclass(frozen=True)
class Between(_OfConditions):
    """An output lies between two limits under every condition; either may be infinite."""

    output: str
    conditions: tuple[str, ...]
    low: float = -np.inf
    high: float = np.inf

    def holds(self, at: At) -> bool:
        return all(self.low < at(self.output, c) < self.high for c in self.conditions)

    def evidence(self, values: Values) -> Evidence:
        parts = []
        for c in self.conditions:
            found = values(self.output, c)
            if np.isfinite(self.low):
                parts.append(above(found, self.low))
            if np.isfinite(self.high):
                parts.append(above(found, self.high).contrary)
        return all_of(parts)


@dataclass(frozen=True)
class Unchanged(_OfConditions):
    """An output is as good as the same under every condition: apart from that under the first by
    less than the share ``within`` of it. Its test is that of equivalence (``decisions.equal``)."""

    output: str
    conditions: tuple[str, ...]
    within: float

    def holds(self, at: At) -> bool:
        first, *others = (at(self.output, c) for c in self.conditions)
        return all(abs(found - first) < self.within * abs(first) for found in others)

    def evidence(self, values: Values) -> Evidence:
        first, *others = (values(self.output, c) for c in self.conditions)
        return all_of([equal(first, found, within=self.within) for found in others])


@dataclass(frozen=True)
class Below:
    """An output is less than another, under one condition, by the share ``by`` of itself."""

    output: str
    other: str
    condition: str
    by: float = 0.0

    def holds(self, at: At) -> bool:
        one = at(self.output, self.condition)
        return one + self.by * abs(one) < at(self.other, self.condition)

    def evidence(self, values: Values) -> Evidence:
        return less(
            values(self.output, self.condition), values(self.other, self.condition), by=self.by
        )


@dataclass(frozen=True)
class Together(_OfConditions):
    """Two outputs go up and down together over the conditions: Kendall's rank correlation is above
    zero. Its test is Student's over the correlations of single starts."""

    output: str
    other: str
    conditions: tuple[str, ...]

    def holds(self, at: At) -> bool:
        return (
            self._tau([[at(o, c) for c in self.conditions] for o in (self.output, self.other)]) > 0
        )

    def evidence(self, values: Values) -> Evidence:
        one, other = (
            np.array([values(o, c) for c in self.conditions]) for o in (self.output, self.other)
        )
        return above([self._tau(pair) for pair in zip(one.T, other.T)], 0.0)

    @staticmethod
    def _tau(pair: Sequence[Sequence[float]]) -> float:
        found = float(kendalltau(*pair).statistic)
        return 0.0 if np.isnan(found) else found


@dataclass(frozen=True)
class Claim:
    """A statement of a paper: where it stands, its parts by name, and the outputs that show it."""

    key: str
    text: str
    where: str
    parts: dict[str, Part]
    outputs: tuple[str, ...]

    def holds(self, at: At) -> bool:
        """Do all its parts hold by these numbers?"""
        return all([part.holds(at) for part in self.parts.values()])

    def evidence(self, values: Values) -> Evidence:
        """What starts say of it; nothing where a figure is missing."""
        try:
            return all_of(part.evidence(complete(values)) for part in self.parts.values())
        except MissingFigure:
            return NOTHING

    def contrary(self, at: At) -> tuple[str, ...]:
        """Parts that do not hold by these numbers."""
        return tuple(name for name, part in self.parts.items() if not part.holds(at))


class MissingFigure(Exception):
    """An output that a claim wants is not there for every start."""


def complete(values: Values) -> Values:
    """The same values; MissingFigure where one is not a number."""

    def checked(output: str, condition: str) -> np.ndarray:
        found = np.asarray(values(output, condition), float)
        if len(found) < 2 or not np.isfinite(found).all():
            raise MissingFigure(f"{output} at {condition}")
        return found

    return checked


def mean_of(values: Values) -> At:
    """Means over the starts; NaN where there are none."""

    def at(output: str, condition: str) -> float:
        found = values(output, condition)
        found = found[np.isfinite(found)]
        return float(found.mean()) if len(found) else nan

    return at
