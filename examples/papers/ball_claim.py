"""A claim of a paper on ball bearings: parts tested on figures of runs, and its verdict."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from math import isfinite, isnan
from pathlib import Path
from typing import Any

import numpy as np
from scipy.special import stdtrit

from flexcage import Run, Study, StudyResults, run_study
from flexcage.core.progress import Progress
from flexcage.results.statistics import Record
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

PARTS = 3  # of a record, whose figures give those that have no other interval one
Found = Mapping[str, Sequence[Any]]  # figures of every start of every case, by label
Shown = Mapping[str, tuple[str, str, float]]  # of a figure: name, unit, factor from SI


def by_parts(figure: Callable[[slice], float], samples: int) -> Estimate:
    """A figure that windows of a ball pass cannot give: mean over ``PARTS`` equal parts of the
    record, and half of Student's 95 % interval."""
    ends = np.linspace(0, samples, PARTS + 1).astype(int)
    values = np.array([figure(slice(a, b)) for a, b in pairwise(ends)])
    half = float(stdtrit(PARTS - 1, 0.975)) * float(values.std(ddof=1)) / np.sqrt(PARTS)
    return Estimate(float(values.mean()), float(half))


def short(figure: Estimate, factor: float = 1.0) -> str:
    """A figure with its margin, to the digits that the margin leaves."""
    value, margin = factor * figure.value, factor * figure.margin
    if not isfinite(value):
        return "-"
    if not isfinite(margin) or margin <= 1e-9 * abs(value):
        return f"{value:,.4g}"
    digits = max(0, 1 - int(np.floor(np.log10(margin))))
    return f"{value:,.{digits}f} ± {margin:.2g}"


def percent(figure: Estimate) -> str:
    """The same of a ratio, in percent."""
    text = short(figure, 100.0)
    return text if text == "-" else f"{text} %"


def estimate(record: Record) -> Estimate:
    """A statistic by windows with its margin."""
    return Estimate(record.value, record.margin)


def finished(results: StudyResults) -> Iterator[tuple[Mapping[str, str], Run]]:
    """Labels and run of every finished case of a study; says why others failed."""
    for row in results.rows:
        if row.state == "done":
            run = results.run(row.planned.number, row.planned.repetition)
            yield row.planned.point.labels, run
        elif row.state == "failed":
            print(f"{results.study.name}: {row.planned.point} failed: {row.reason}")


def gathered(
    study: Study, out: Path, *, workers: int, evaluate: Callable[[str, Run], Any]
) -> Found:
    """A study computed as far as its folder lacks it, and the figures of every finished run, by its
    case's label; one entry a start."""
    run_study(study, out=out, workers=workers, progress=Progress)
    found: dict[str, list[Any]] = {}
    for labels, run in finished(StudyResults(out)):
        found.setdefault(labels["case"], []).append(evaluate(labels["case"], run))
    return found


def run_of(results: StudyResults, label: str) -> Run | None:
    """The first start of a case, None if it is not done."""
    for row in results.rows:
        if row.state == "done" and row.planned.point.labels["case"] == label:
            return results.run(row.planned.number, row.planned.repetition)
    return None


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


def tables(
    found: Mapping[str, Found], head: Sequence[str], cells: Callable[[View, str], Sequence[str]]
) -> str:
    """All figures of all readings as tables of Markdown: ``cells`` of a case, after its label."""
    texts = []
    for name, figures in found.items():
        view = View(figures)
        rows = [f"| {' | '.join((label, *cells(view, label)))} |" for label in figures]
        lines = [f"| {' | '.join(head)} |", "|" + " --- |" * len(head), *rows]
        texts.append("\n".join([f"### {name}", "", *lines]))
    return "\n\n".join(texts)


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
