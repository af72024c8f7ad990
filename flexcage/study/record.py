"""What a study has found: its cases as a tidy table, and statistics over the repetitions."""

from __future__ import annotations

import json
import logging
from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from math import nan, sqrt
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core import html
from flexcage.core.errors import InputError
from flexcage.core.listing import aligned, wrapped
from flexcage.core.units import format_si, parse
from flexcage.core.warning import RunWarning
from flexcage.results.export import frame_to_csv, frame_to_parquet
from flexcage.results.row import format_value
from flexcage.run import Run
from flexcage.simulate import load_run
from flexcage.study.case_row import CaseRow
from flexcage.study.folder import Folder
from flexcage.study.origin import Origin, origins_note
from flexcage.study.outputs import StudyFigure
from flexcage.study.plan import Plan, Planned
from flexcage.study.spec import Study, value_at

if TYPE_CHECKING:
    import pandas

log = logging.getLogger(__name__)

CONFIDENCE = 0.95  # of the intervals
_TOO_FEW = 2  # repetitions, of which Student's t makes an interval that says little
_SHOWN = 60  # points that a notebook shows


@dataclass(frozen=True)
class ResultRow:
    """One planned case and what became of it: ``state`` is "done", "failed" or "open", ``seconds``
    of processor time.

    ``warnings`` are those of its run, and ``origin`` is the flexcage that computed it; both of a
    case that is done alone.
    """

    planned: Planned
    state: str
    reason: str
    seconds: float
    figures: Mapping[str, StudyFigure]
    warnings: tuple[RunWarning, ...] = ()
    origin: Origin | None = None

    @property
    def warned(self) -> str:
        """Kinds of warnings that its run has, as a table shows them."""
        return ", ".join(dict.fromkeys(warning.key for warning in self.warnings))


class StudyRecord:
    """A study's folder: ``table``, ``statistics``, ``report()``, and ``run(point)`` of a case.

    Everything is read from the folders of the cases, also while others are still running. No code
    is run: ``plan`` and ``study`` alone, with which cases are built, need the user's own files.
    What is shown is the study as it was planned; a later edit of its study.toml is named and
    ignored.
    """

    def __init__(self, path: str | Path) -> None:
        self.folder = Folder(path)
        self.about, self.planned = self.folder.about()
        if self.about.edited:
            log.warning(self.about.edited)

    @cached_property
    def study(self) -> Study:
        """The study as it was planned, with its base case built."""
        return self.folder.planned_study(self.about)

    @property
    def plan(self) -> Plan:
        """The cases, to be built."""
        return Plan(self.study, self.planned)

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.about.name!r} in {self.folder.path}: {self.status()})"

    @cached_property
    def rows(self) -> list[ResultRow]:
        """One row a case, in the order of the plan."""
        return [self._row(planned) for planned in self.planned]

    def _row(self, planned: Planned) -> ResultRow:
        row, failure = self.stored.get(planned.hash), self.folder.failure(planned.hash)
        if row is not None:
            wanted = {k: row.figures[k] for k in self.about.outputs if k in row.figures}
            return ResultRow(planned, "done", "", row.seconds, wanted, row.warnings, row.origin)
        if failure is not None:
            return ResultRow(planned, "failed", failure.reason, nan, {})
        return ResultRow(planned, "open", "", nan, {})

    @cached_property
    def stored(self) -> dict[str, CaseRow]:
        """All figures of every finished case, by its hash."""
        rows = {planned.hash: self.folder.row(planned.hash) for planned in self.planned}
        return {name: row for name, row in rows.items() if row is not None}

    def count(self, state: str) -> int:
        """How many cases are "done", "failed" or "open"."""
        return sum(row.state == state for row in self.rows)

    @cached_property
    def table(self) -> pandas.DataFrame:
        """One row a case. Axes are in the unit of the case file, outputs in SI; headers say so."""
        import pandas as pd

        return pd.DataFrame([
            {"point": row.planned.number, "repetition": row.planned.repetition}
            | self.axes_of(row.planned)
            | {self.titles[name]: _value(row.figures.get(name)) for name in self.titles}
            | {"state": row.state, "reason": row.reason, "warnings": row.warned}
            | {"seconds": row.seconds}
            | {"version": str(row.origin or ""), "hash": row.planned.hash}
            for row in self.rows
        ])  # fmt: skip

    @cached_property
    def statistics(self) -> pandas.DataFrame:
        """One row a point: for every output its mean and the half width of its interval.

        The interval holds the mean with 95 % confidence (Student's t over the repetitions); a
        single repetition has none.
        """
        import pandas as pd

        points = []
        for number, group in self.table.groupby("point"):
            first = self.rows[group.index[0]].planned
            point: dict[str, Any] = {"point": number, **self.axes_of(first)}
            point["done"] = int((group["state"] == "done").sum())
            for title in self.titles.values():
                point[title], point[f"+- {title}"] = mean_and_half_width(group[title])
            points.append(point)
        return pd.DataFrame(points)

    def report(self) -> str:
        """The table over the points: mean ± half width of every output, then warnings and what
        failed."""
        lines = self._lines()
        table = aligned(lines, sides=_sides(lines), heads=True)
        last = filter(None, [*self._failures(), self.without_stress(), self.status()])
        return "\n".join([*map(wrapped, self.warning_lines()), table, *map(wrapped, last)])

    def _repr_html_(self) -> str:
        """For notebooks: what ``report`` says."""
        heads, *rows = self._lines()
        more = f"{len(rows) - _SHOWN} more points: statistics" if len(rows) > _SHOWN else ""
        return html.block(
            f"Study {self.about.name}: {self.status()}",
            html.bullets(self.warning_lines()),
            html.table(rows[:_SHOWN], heads=heads, sides="r"),
            html.paragraphs([more, *self._failures(), self.without_stress()]),
        )

    def _lines(self) -> list[list[str]]:
        """Heads, then a line for every point: its axes, and mean ± half width of every output."""
        first = ["point", *self.axes_of(self.rows[0].planned)]
        lines = [[*first, *(self._shown(name) for name in self.titles)]]
        for cells in self.statistics.to_dict("records"):
            lines.append([str(cells[head]) for head in first])
            for name, title in self.titles.items():
                lines[-1].append(self._text(name, cells[title], cells[f"+- {title}"]))
        return lines

    def _failures(self) -> list[str]:
        """Reasons of cases that failed, and how many failed so."""
        reasons = Counter(row.reason for row in self.rows if row.state == "failed")
        return [f"{times} failed: {reason}" for reason, times in reasons.items()]

    def without_stress(self) -> str:
        """A sentence where cases with a flexible cage left their stress out, else nothing."""
        flexible = [row.figures for row in self.stored.values() if "mode_count" in row.figures]
        count = sum("stress_peak" not in figures for figures in flexible)
        if not count:
            return ""
        return (
            f"Stress was not computed in {count} of {len(self.rows)} cases: no output needs it, "
            "and it surely stays below the proof stress; name one (stress_peak) to have it."
        )

    def warning_lines(self) -> list[str]:
        """One line for every kind of warning: how many cases have it, and what the first says."""
        done = [row for row in self.rows if row.state == "done"]
        found: dict[str, list[tuple[ResultRow, RunWarning]]] = {}
        for row in done:
            for warning in {w.key: w for w in reversed(row.warnings)}.values():
                found.setdefault(warning.key, []).append((row, warning))
        lines = self.cautions()
        for key, cases in found.items():
            first = cases[0][0].planned
            place = f"point {first.number}, repetition {first.repetition}"
            where = place if len(cases) == 1 else f"the first is {place}"
            lines.append(f"{len(cases)} of {len(done)} cases ({key}; {where}): {cases[0][1].text}")
        if self.about.repeat.count == _TOO_FEW:
            lines.append(
                f"Every point has {_TOO_FEW} repetitions, so that an interval is 12.7 times the "
                "standard error of its mean; 3 or more make it much narrower."
            )
        return lines

    def cautions(self) -> list[str]:
        """What to know before any of its figures: an edited study.toml, cases of different versions
        of flexcage."""
        note = origins_note(row.origin for row in self.rows if row.origin)
        return list(filter(None, [self.about.edited, note]))

    def status(self) -> str:
        """How many cases are done, failed and open, in one line."""
        begun = len(
            self.folder.running() & {r.planned.hash for r in self.rows if r.state == "open"}
        )
        running = f" ({begun} of them begun)" if begun else ""
        return (
            f"{len(self.rows)} cases: {self.count('done')} done, {self.count('failed')} failed, "
            f"{self.count('open')} open{running}"
        )

    def run(self, point: int = 0, repetition: int = 0) -> Run:
        """The run of one case; InputError if it is not there."""
        for row in self.rows:
            if (row.planned.number, row.planned.repetition) == (point, repetition):
                if row.state != "done" or not self.folder.has_run(row.planned.hash):
                    why = row.state if row.state != "done" else "kept as figures only"
                    raise InputError(f"Point {point}, repetition {repetition} has no run: {why}.")
                return load_run(self.folder.case(row.planned.hash))
        raise InputError(f"The study has no point {point} with repetition {repetition}.")

    def write(self) -> list[Path]:
        """Write ``table`` and ``statistics`` as CSV and Parquet into the folder; their paths."""
        paths = []
        for name, frame in (("table", self.table), ("statistics", self.statistics)):
            paths += [frame_to_csv(frame, self.folder.path / f"{name}.csv"),
                      frame_to_parquet(frame, self.folder.path / f"{name}.parquet")]  # fmt: skip
        return paths

    @cached_property
    def known(self) -> dict[str, StudyFigure]:
        """One figure of every output that any case has, for its units."""
        return {k: f for row in self.rows for k, f in row.figures.items()}

    @cached_property
    def titles(self) -> dict[str, str]:
        """Header of every output in tables, by its name."""
        units = {name: f" [{figure.unit}]" for name, figure in self.known.items()}
        return {name: f"{name}{units.get(name, '')}" for name in self.about.outputs}

    @cached_property
    def _paths(self) -> dict[str, str]:
        """Unit of every path that varies, in the order of the axes; "" for one without."""
        paths = (path for axis in self.about.axes for path in axis.paths)
        return {path: self.about.units.get(path, "") for path in paths}

    def axes_of(self, planned: Planned) -> dict[str, Any]:
        """Labels and axis values of a case, as tables show them."""
        values = {
            f"{path} [{unit}]" if unit else path: _cell(planned, path, unit, self.about.base)
            for path, unit in self._paths.items()
        }
        labels = {name: planned.point.labels.get(name, "") for name in self._labels}
        return {**labels, **values}

    @cached_property
    def _labels(self) -> list[str]:
        """Columns that show the labels of points."""
        return list(dict.fromkeys(name for p in self.planned for name in p.point.labels))

    def _shown(self, name: str) -> str:
        figure = self.known.get(name)
        unit = (figure.shown or figure.unit) if figure else ""
        return f"{name} [{unit}]" if unit else name

    def _text(self, name: str, mean: float, half: float) -> str:
        figure = self.known.get(name)
        shown = figure.shown if figure else ""
        return " ".join(format_value(mean, shown, half)).rstrip()


def mean_and_half_width(values: Any) -> tuple[float, float]:
    """Mean of a sample and half the width of its 95 % interval; NaN where there are too few."""
    from scipy.stats import t

    sample = np.asarray(values, float)
    sample = sample[np.isfinite(sample)]
    n = len(sample)
    if n < 2:
        return (float(sample[0]) if n else nan), nan
    half = t.ppf(0.5 + 0.5 * CONFIDENCE, n - 1) * sample.std(ddof=1) / sqrt(n)
    return float(sample.mean()), float(half)


def _value(figure: StudyFigure | None) -> Any:
    return None if figure is None else figure.value


def _cell(planned: Planned, path: str, unit: str, base: Mapping[str, Any]) -> Any:
    """Value of a path in a case: a number in ``unit``, or what the case file says."""
    value = planned.point.values[path] if path in planned.point.values else value_at(base, path)
    if unit and isinstance(value, str) and value != "none":
        return float(format_si(parse(value, unit, where=path), unit).split()[0])
    return json.dumps(value) if isinstance(value, (list, tuple, dict)) else value


def _sides(lines: list[list[str]]) -> str:
    """Columns of numbers to the right, those that hold any words to the left."""
    columns = list(zip(*lines[1:]))
    return "".join("l" if any(c[:1].isalpha() for c in column) else "r" for column in columns)
