"""Tables of a page from summaries, data frames and mappings."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from math import isfinite
from typing import TYPE_CHECKING, Any

from flexcage.report.blocks import Cell, PageTable
from flexcage.results.audit import EXCEEDED, PASSED
from flexcage.results.row import SummaryRow
from flexcage.results.summary import Section

if TYPE_CHECKING:
    import pandas

#: Figures that are verdicts: the word that is good, and the one that is bad.
_TONES = {"energy_audit": (PASSED, EXCEEDED)}


def number(value: Any, text: str | None = None) -> Cell:
    """Cell of a number, by which its column is sorted; a dash for none."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return Cell(text if text is not None else str(value))
    if not isfinite(value):
        return Cell("–")
    shown = f"{value:,}" if isinstance(value, int) else f"{value:.5g}"
    return Cell(text if text is not None else shown, float(value))


def figure_cell(row: SummaryRow) -> Cell:
    """Value of a figure of a summary, as its text shows it."""
    value = row.value
    if row.text == "-":
        return Cell("–")
    if row.key in _TONES:
        good, bad = _TONES[row.key]
        return Cell(row.text, tone="good" if value == good else "bad" if value == bad else "")
    return number(value if not isinstance(value, str) else str(value), row.text)


def summary_table(sections: Iterable[Section], caption: str = "", *, fold: str = "") -> PageTable:
    """Figures of a summary's sections, with their intervals."""
    rows: list[list[Cell | str]] = [
        [row.label, figure_cell(row), _margin(row), typeset(row.shown), section.title, row.note]
        for section in sections
        for row in section.shown
    ]
    return filled(
        PageTable(("figure", "value", "± 95 %", "unit", "part", "remark"), rows, caption, fold)
    )


def filled(table: PageTable) -> PageTable:
    """The table without columns that are empty in every row."""
    if not table.rows:
        return table
    kept = [k for k in range(len(table.head)) if any(row[k].text for row in table.cells)]
    rows = [[row[k] for k in kept] for row in table.cells]
    return replace(table, head=[table.head[k] for k in kept], rows=rows)


def typeset(unit: str) -> str:
    """A unit as print writes it."""
    return unit.replace("um", "µm").replace("us", "µs").replace("deg", "°").replace("*", "·")


def _margin(row: SummaryRow) -> Cell:
    return Cell("") if row.margin is None else number(row.margin, row.margin_text)


def rows_table(rows: Sequence[SummaryRow], caption: str = "") -> PageTable:
    """A few figures of a summary."""
    cells: list[list[Cell | str]] = [
        [row.label, figure_cell(row), typeset(row.shown), row.note] for row in rows
    ]
    return filled(PageTable(("figure", "value", "unit", "remark"), cells, caption))


def mapping_table(
    head: tuple[str, str], values: Mapping[str, Any], caption: str = "", *, fold: str = ""
) -> PageTable:
    """Names and texts."""
    return PageTable(head, [[str(k), str(v)] for k, v in values.items()], caption, fold)


def assumption_table(assumptions: Mapping[str, tuple[str, str]], *, fold: str) -> PageTable:
    """Paths of a case, their values, and the reasons for them; folded away."""
    rows = [[path, value, reason] for path, (value, reason) in assumptions.items()]
    return PageTable(("path in the case", "value", "why it was chosen"), rows, fold=fold)


def frame_table(frame: pandas.DataFrame, caption: str = "") -> PageTable:
    """A data frame; its numbers keep five digits."""
    rows = [[_frame_cell(v) for v in values] for values in frame.itertuples(index=False)]
    return PageTable([str(name) for name in frame.columns], rows, caption)


def _frame_cell(value: Any) -> Cell:
    plain = value.item() if hasattr(value, "item") else value
    if plain is None:
        return Cell("–")
    return number(plain)
