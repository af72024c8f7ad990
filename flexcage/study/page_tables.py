"""Tables and comparisons of a study's report."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite, nan
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.report.blocks import Cell, PageTable
from flexcage.report.comparison import Abscissa, Output
from flexcage.report.tables import figure_cell, filled, number, typeset
from flexcage.results.figures.figure import EFFORT
from flexcage.results.figures.table import FIGURES, marked
from flexcage.results.row import SHOWN, SummaryRow, format_value
from flexcage.study.axes import LatinHypercube, Points, Sobol, Zip
from flexcage.study.outputs import StudyFigure, never_negative
from flexcage.study.words import in_words

if TYPE_CHECKING:
    from flexcage.study.record import ResultRow, StudyRecord

MOST_ROWS = 1000  # of a table of cases
_NONE = "–"
_NO_FIGURE = (
    f"{_NONE}: these cases have no such figure (a rigid cage has no stress), failed or are open."
)


def first_rows(results: StudyRecord) -> list[ResultRow]:
    """The first case of every point, in order."""
    return list({row.planned.number: row for row in reversed(results.rows)}.values())[::-1]


def heads(results: StudyRecord) -> dict[str, str]:
    """In words, with their units: what the tables of a study call its axes by paths."""
    about = results.about
    paths = [path for axis in about.axes for path in axis.paths]
    found = {}
    for title in results.axes_of(results.rows[0].planned):
        path, bracket, unit = title.partition(" [")
        words = in_words(path, about.base, paths) if path in paths else path
        found[title] = f"{words}{bracket}{unit}"
    return found


def point_names(results: StudyRecord) -> list[str]:
    """What a reader calls every point: its labels and the values that vary."""
    words = heads(results)
    return [
        ", ".join(_set(words[t], v) for t, v in results.axes_of(row.planned).items())
        or "the base case"
        for row in first_rows(results)
    ]


def _set(head: str, value: Any) -> str:
    """A value of an axis with that head, as "radial load = 500 N"."""
    name, _, unit = head.partition(" [")
    return f"{name} = {_short(value)} {unit.rstrip(']')}".rstrip()


def _short(value: Any) -> str:
    return f"{value:g}" if isinstance(value, float) else str(value)


def _title(output: str) -> str:
    """Title of an output; a reduction stays as the study writes it."""
    return FIGURES[output].title if output in FIGURES else output


def _titles(results: StudyRecord) -> dict[str, str]:
    """Title of every output, with the unit that it is shown in."""
    units = {name: _unit(results.known.get(name)) for name in results.about.outputs}
    return {name: _headed(_title(name), unit) for name, unit in units.items()}


def _headed(title: str, unit: str) -> str:
    """Head of a column: a title, with the unit if there is one."""
    return f"{title} [{unit}]" if unit != "1" else title


def _unit(figure: StudyFigure | None) -> str:
    """Unit that an output is shown in; "1" for none."""
    return (typeset(figure.shown or figure.unit) if figure else "") or "1"


def _factor(figure: StudyFigure | None) -> float:
    return SHOWN[figure.shown][1] if figure else 1.0


def statistics_table(results: StudyRecord) -> PageTable:
    """A row a point: what varies, how many runs, and every output's mean and interval."""
    titles, frame = _titles(results), results.statistics
    axes = list(results.axes_of(results.rows[0].planned))
    si = results.titles
    rows = []
    for cells in frame[:MOST_ROWS].to_dict("records"):
        row = [number(int(cells["point"])), *(_value_cell(cells[a]) for a in axes)]
        row.append(number(int(cells["done"])))
        for name in titles:
            row.append(_mean_cell(results, name, cells[si[name]], cells[f"+- {si[name]}"]))
        rows.append(row)
    caption = "Means over the repetitions, ± half of the 95 % interval. A click on a heading sorts."
    if any(cell.text == _NONE for row in rows for cell in row):
        caption += f" {_NO_FIGURE}"
    if any(cells["done"] == 1 for cells in frame[:MOST_ROWS].to_dict("records")):
        caption += " One run alone gives no ±."
    if len(frame) > MOST_ROWS:
        caption += f" The first {MOST_ROWS:,} of {len(frame):,} points; statistics.csv has all."
    words = heads(results)
    head = ("point", *(words[axis] for axis in axes), "runs", *titles.values())
    return PageTable(head, rows, caption)


def _value_cell(value: Any) -> Cell:
    return number(value, _short(value)) if isinstance(value, (int, float)) else Cell(str(value))


def _mean_cell(results: StudyRecord, name: str, mean: Any, half: float) -> Cell:
    if not isinstance(mean, (int, float)) or not isfinite(mean):
        return Cell(_NONE)
    shown = results.known[name].shown if name in results.known else ""
    return number(float(mean), " ".join(format_value(float(mean), shown, half)).rstrip())


def cases_table(results: StudyRecord) -> PageTable:
    """A row a case: what varies, its outputs, and what became of it."""
    titles = _titles(results)
    rows = []
    for r in results.rows[:MOST_ROWS]:
        values = [_value_cell(v) for v in results.axes_of(r.planned).values()]
        figures = [_cell(r.figures.get(name)) for name in titles]
        rows.append([
            number(r.planned.number), number(r.planned.repetition), Cell(r.planned.hash),
            Cell(r.state), *values, *figures,
            number(r.seconds, f"{r.seconds:.1f}") if r.seconds == r.seconds else Cell(""),
            Cell(r.reason), Cell(r.warned),
        ])  # fmt: skip
    head = (
        "point", "repetition", "folder", "state", *heads(results).values(), *titles.values(),
        "processor time [s]", "reason", "warnings",
    )  # fmt: skip
    return filled(PageTable(head, rows, f"{_share(results)} Runs lie in the folder cases."))


def _share(results: StudyRecord) -> str:
    """Which of the cases a table holds."""
    if len(results.rows) <= MOST_ROWS:
        return "All cases."
    return f"The first {MOST_ROWS:,} of {len(results.rows):,} cases; table.csv has all."


def _cell(figure: StudyFigure | None, key: str = "") -> Cell:
    if figure is None:
        return Cell(_NONE)
    return figure_cell(SummaryRow(key, "", figure.value, figure.shown, margin=figure.margin))


def stored_figure(results: StudyRecord, row: ResultRow, key: str) -> Any:
    """Any figure of a finished case's summary, in SI; None if it has none."""
    stored = results.stored.get(row.planned.hash)
    figure = stored.figures.get(key) if stored else None
    return None if figure is None else figure.value


def audit_table(results: StudyRecord) -> PageTable:
    """Energy audit and the solver's work, a row a finished case."""
    rows, keys = [], marked(EFFORT)
    for r in results.rows[:MOST_ROWS]:
        stored = results.stored.get(r.planned.hash)
        if stored is None:
            continue
        found = [stored.figures.get(key) for key in keys]
        place = [number(r.planned.number), number(r.planned.repetition)]
        rows.append([*place, *map(_cell, found, keys)])
    heads = [_headed(FIGURES[key].title, FIGURES[key].shown or "1") for key in keys]
    caption = f"Energy audit and the solver's work. {_share(results)}"
    return filled(PageTable(("point", "repetition", *heads), rows, caption))


def outputs(results: StudyRecord) -> list[Output]:
    """Means and intervals of every output at every point, in the units that they are shown in."""
    frame = results.statistics
    found = []
    for name in results.about.outputs:
        unit = _unit(results.known.get(name))
        factor, si = _factor(results.known.get(name)), results.titles[name]
        mean = np.array([_float(v) for v in frame[si]]) * factor
        half = np.array(frame[f"+- {si}"], float) * factor
        found.append(Output(_title(name), unit, mean, half, positive=never_negative(name)))
    return found


def _float(value: Any) -> float:
    return float(value) if isinstance(value, (int, float)) else nan


def abscissas(results: StudyRecord) -> list[Abscissa]:
    """One for every axis, or for every range of a sampled axis; other axes make groups."""
    rows, axes = first_rows(results), results.about.axes
    values = [results.axes_of(row.planned) for row in rows]
    columns = {title.partition(" [")[0]: title for title in values[0]} if values else {}
    found: list[Abscissa] = []
    words = heads(results) if rows else {}
    for k, axis in enumerate(axes):
        others = [i for i in range(len(axes)) if i != k]
        group = [_group(axes, others, columns, v, words) for v in values]
        for name in _abscissa_columns(axis, columns):
            scattered = isinstance(axis, (LatinHypercube, Sobol)) and len(axis.paths) > 1
            at_points = [v[name] for v in values]
            found.append(Abscissa(words[name], at_points, group, joined=not scattered))
    return found


def _abscissa_columns(axis: Any, columns: dict[str, str]) -> list[str]:
    """Columns of the tables that an axis is drawn along."""
    if isinstance(axis, Points) and axis.name in columns:
        return [columns[axis.name]]
    paths = [columns[path] for path in axis.paths if path in columns]
    return paths[:1] if isinstance(axis, Zip) else paths


def _group(
    axes: Sequence[Any], others: list[int], columns: dict[str, str], values: Any,
    words: Mapping[str, str],
) -> str:  # fmt: skip
    titles = [title for i in others for title in _abscissa_columns(axes[i], columns)]
    return ", ".join(_set(words[title], values[title]) for title in titles)
