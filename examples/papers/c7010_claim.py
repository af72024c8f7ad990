"""A claim of a paper on the 7010C: parts that are tested on figures of runs, and its verdict."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import isnan
from typing import Any

from flexcage.study.verdicts import (
    UNDECIDED,
    Estimate,
    Line,
    Verdict,
    every,
    monotone,
    pooled,
    range_of,
)

Found = Mapping[str, Sequence[Any]]  # figures of every start of every case, by label
Shown = Mapping[str, tuple[str, str, float]]  # of a figure: name, unit, factor from SI


class View:
    """Figures of one reading, pooled over starts."""

    def __init__(self, found: Found) -> None:
        self.found = found

    def has(self, labels: Sequence[str]) -> bool:
        return all(self.found.get(label) for label in labels)

    def __call__(self, key: str, label: str) -> Estimate:
        starts = [getattr(f, key) for f in self.found.get(label, ())]
        known = [s for s in starts if s is not None]
        margins = [None if isnan(k.margin) else k.margin for k in known]
        return pooled([k.value for k in known], margins)

    def all(self, key: str, labels: Sequence[str]) -> list[Estimate]:
        return [self(key, label) for label in labels]


def rising(key: str, labels: Sequence[str], *, up: bool = True) -> Callable[[View], str]:
    """Does a figure rise (or fall) along these cases?"""
    return lambda view: monotone(view.all(key, labels), rising=up)


@dataclass(frozen=True)
class Claim:
    """One statement: parts that must all hold, and the figures and cases that show it."""

    key: str
    text: str
    parts: Mapping[str, Callable[[View], str]]
    cases: tuple[str, ...]
    figures: tuple[str, ...]
    reason: str = ""

    def verdict(
        self, views: Mapping[str, View], base: str, *, shown: Shown, source: str
    ) -> Verdict:
        """The verdict by the view ``base``, and where else it holds; ``shown`` says how figures
        are."""
        known = {name: view for name, view in views.items() if view.has(self.cases)}
        outcomes = {
            part: {name: test(view) for name, view in known.items()}
            for part, test in self.parts.items()
        }
        whole = {name: every(o[name] for o in outcomes.values()) for name in known}
        texts = [range_of(whole)] if whole else ["not computed"]
        texts += [f"({part}) {range_of(found)}" for part, found in outcomes.items() if known]
        return Verdict(
            key=self.key,
            claim=self.text,
            outcome=whole.get(base, UNDECIDED),
            figures=tuple(
                _line(shown[key], label, views[base](key, label))
                for key in self.figures
                for label in self.cases
                if base in known
            ),
            range=". ".join(texts) if len(self.parts) > 1 else texts[0],
            source=source,
            reason="" if base in known else "not computed",
        )


def _line(shown: tuple[str, str, float], label: str, value: Estimate) -> Line:
    name, unit, factor = shown
    return Line(f"{label}: {name}", factor * value.value, factor * value.margin, unit)
