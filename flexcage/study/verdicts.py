"""Verdicts: does a claim hold by the figures of a study, and by which of them?

A comparison of figures with intervals has three outcomes: the claim holds beyond the intervals, it
does not hold beyond them, or they leave it undecided. ``verdicts.json`` in a study's folder keeps
the verdicts for a report.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import asdict, dataclass, field
from itertools import pairwise
from math import hypot, isfinite, isnan, nan
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.reading import read_json, table_of
from flexcage.core.writing import replace
from flexcage.study.record import mean_and_half_width

FORMAT = 1
FILE = "verdicts.json"

HOLDS, FAILS, UNDECIDED = "holds", "does not hold", "undecided"
OUTCOMES = (HOLDS, FAILS, UNDECIDED)


@dataclass(frozen=True)
class Estimate:
    """A figure and half the width of its 95 % interval; NaN where that is not known."""

    value: float
    margin: float = nan

    @property
    def low(self) -> float:
        return self.value - self.margin

    @property
    def high(self) -> float:
        return self.value + self.margin

    def __truediv__(self, other: Estimate) -> Estimate:
        """The quotient; its margin by first order, of two figures that err independently."""
        ratio = self.value / other.value
        return Estimate(
            ratio,
            abs(ratio) * hypot(self.margin / self.value, other.margin / other.value)
            if self.value and other.value
            else nan,
        )

    def __sub__(self, other: Estimate) -> Estimate:
        """The difference of two figures that err independently."""
        return Estimate(self.value - other.value, hypot(self.margin, other.margin))


def pooled(values: Sequence[float], margins: Sequence[float | None]) -> Estimate:
    """Mean of one figure over repetitions, with the wider of two intervals: that of the runs' own
    margins pooled, and Student's over the repetitions where there are three or more.

    Two repetitions have Student's alone if the runs give no margins; one has only its own.
    """
    sample = np.asarray(values, float)
    if not len(sample):
        return Estimate(nan)
    own = np.array([nan if m is None else m for m in margins], float)
    within = float(np.sqrt(np.sum(own**2))) / len(sample)
    mean, between = mean_and_half_width(sample)
    if isnan(within):
        return Estimate(mean, between)
    if len(sample) < 3:
        return Estimate(mean, within)
    return Estimate(mean, max(within, between))


def above(figure: Estimate, limit: float) -> str:
    """Is the figure above the limit, beyond its interval?"""
    if isnan(figure.value) or isnan(figure.margin):
        return UNDECIDED
    if figure.low > limit:
        return HOLDS
    return FAILS if figure.high < limit else UNDECIDED


def less(one: Estimate, other: Estimate, *, by: float = 0.0) -> str:
    """Is ``one`` less than ``other``, beyond both intervals and by at least the share ``by``?

    Says that it does not hold where the largest difference the intervals allow is smaller than
    asked for.
    """
    wanted = by * abs(one.value)
    if any(map(isnan, (one.low, other.low))):
        return UNDECIDED
    if one.high + wanted < other.low:
        return HOLDS
    return FAILS if one.low + wanted > other.high else UNDECIDED


def unchanged(one: Estimate, other: Estimate, *, within: float) -> str:
    """Does ``other`` differ from ``one`` by no more than the share ``within`` of ``one``?"""
    change = other - one
    wide = within * abs(one.value)
    if isnan(change.value) or isnan(change.margin):
        return UNDECIDED
    if max(abs(change.low), abs(change.high)) <= wide:
        return HOLDS
    return FAILS if change.low > wide or change.high < -wide else UNDECIDED


def monotone(figures: Sequence[Estimate], *, rising: bool = True, by: float = 0.0) -> str:
    """Does every figure along an axis exceed the one before it (or fall short of it)?"""
    pairs = pairwise(figures if rising else list(figures)[::-1])
    return every(less(one, other, by=by) for one, other in pairs)


def every(outcomes: Iterable[str]) -> str:
    """A claim of several parts holds if all do, and does not if one does not."""
    found = set(outcomes)
    if FAILS in found:
        return FAILS
    return HOLDS if found == {HOLDS} else UNDECIDED


def opposite(outcome: str) -> str:
    """The outcome of the contrary claim."""
    return {HOLDS: FAILS, FAILS: HOLDS}.get(outcome, outcome)


def range_of(outcomes: Mapping[str, str]) -> str:
    """Where a claim holds, where it does not and where it is open, in words."""
    parts = []
    for outcome in OUTCOMES:
        where = [label for label, found in outcomes.items() if found == outcome]
        if where:
            parts.append(f"{outcome}: {', '.join(where)}")
    return "; ".join(parts)


def range_along(name: str, outcomes: Mapping[float, str], *, unit: str = "") -> str:
    """Where along an axis a claim holds, in words: its values by outcome, neighbours together."""
    values = sorted(outcomes)
    runs = [[values[0]]]
    for last, value in pairwise(values):
        if outcomes[value] == outcomes[last]:
            runs[-1].append(value)
        else:
            runs.append([value])
    parts = []
    for run in runs:
        between = " to " if len(run) > 2 else " and "
        ends = between.join(f"{value:g}" for value in dict.fromkeys((run[0], run[-1])))
        parts.append(f"{outcomes[run[0]]} at {ends} {unit}".rstrip())
    return f"{name}: {', '.join(parts)}"


@dataclass(frozen=True)
class EvidenceLine:
    """One figure that a verdict rests on, in the unit it is shown in."""

    label: str
    value: float
    margin: float = nan
    unit: str = ""


@dataclass(frozen=True, kw_only=True)
class Verdict:
    """What became of a claim: the outcome, the figures, where it holds, and why."""

    key: str
    claim: str
    outcome: str
    figures: tuple[EvidenceLine, ...] = field(default=())
    range: str = ""
    reason: str = ""
    source: str = ""

    def __post_init__(self) -> None:
        if self.outcome not in OUTCOMES:
            raise InputError(
                f"The outcome of verdict '{self.key}' is '{self.outcome}', but should be one of "
                f"{', '.join(OUTCOMES)}.",
                where="outcome",
                value=self.outcome,
            )


def write_verdicts(folder: str | Path, verdicts: Iterable[Verdict]) -> Path:
    """Write ``verdicts.json`` into a study's folder; its path. Numbers not known become null."""
    table = [asdict(verdict) for verdict in verdicts]
    path = Path(folder) / FILE
    text = json.dumps(_plain({"format": FORMAT, "verdicts": table}), indent=1, ensure_ascii=False)
    replace(path, (text + "\n").encode())
    return path


def read_verdicts(folder: str | Path) -> list[Verdict]:
    """Verdicts of a study's folder, none if it holds none; InputError for another format."""
    path = Path(folder) / FILE
    if not path.is_file():
        return []
    try:
        stored = table_of(read_json(path))
        if stored["format"] != FORMAT:
            raise InputError(
                f"'{path}' has format {stored['format']}, and this flexcage reads format {FORMAT}.",
                where="format",
                value=stored["format"],
            )
        return [_verdict(table) for table in stored["verdicts"]]
    except (KeyError, TypeError, ValueError) as exc:
        raise InputError(f"'{path}' does not hold verdicts ({exc}); write it anew.") from exc


def _verdict(table: Mapping[str, Any]) -> Verdict:
    lines = [
        EvidenceLine(line["label"], _number(line["value"]), _number(line["margin"]), line["unit"])
        for line in table["figures"]
    ]
    return Verdict(**{**table, "figures": tuple(lines)})


def _number(value: float | None) -> float:
    return nan if value is None else float(value)


def _plain(value: Any) -> Any:
    """Nested values with null in place of numbers that are not finite, which JSON lacks."""
    if isinstance(value, dict):
        return {key: _plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(item) for item in value]
    if isinstance(value, (float, np.floating)):
        return float(value) if isfinite(value) else None
    return value
