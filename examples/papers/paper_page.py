"""The page of a repeated paper: what it says, a matrix of claims by readings, its figures, tables.

One machinery for all papers. It refuses a page that nobody would read: more than 250 lines, or a
cell of more than 25 words. What is left out stands in CSV files beside the page.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import isfinite
from pathlib import Path
from textwrap import wrap

from flexcage.core.digits import texts_with_margin
from flexcage.render import sheet
from flexcage.study.sensitivity import Share
from flexcage.study.verdicts import FAILS, HOLDS, UNDECIDED

MOST_LINES, MOST_WORDS, WIDE = 250, 25, 110
MARKS = {HOLDS: "✓", FAILS: "✗", UNDECIDED: "?"}
LEGEND = """✓ holds, ✗ does not, ? undecided. Columns of starts: tests at the planned looks, Holm
over all claims, 5 % of error in all. Columns of maps: share of the plausible range in which the
claim holds, with its 95 % interval; ✓ and ✗ where that lies above or below one half."""
MOST_OF_IT = 0.5  # of a plausible range, over which a claim must hold (or not) beyond the interval


@dataclass(frozen=True)
class Cell:
    """What one reading says of a claim: an outcome, and a few words such as a share."""

    outcome: str
    note: str = ""

    def __str__(self) -> str:
        return f"{MARKS[self.outcome]} {self.note}".rstrip()


@dataclass(frozen=True)
class Line:
    """One claim: its cells by reading, which of the readings is the verdict's, and the reason in
    one line."""

    key: str
    claim: str
    where: str
    cells: Mapping[str, Cell]
    decided_by: str
    reason: str

    @property
    def verdict(self) -> Cell:
        """The cell of the reading that decides."""
        return self.cells[self.decided_by]


@dataclass(frozen=True)
class Table:
    """A table of the page."""

    title: str
    head: Sequence[str]
    rows: Sequence[Sequence[str]]


@dataclass(frozen=True)
class Picture:
    """A picture beside the page, which figure of the paper it is, and what is in it."""

    file: str
    title: str
    caption: str


@dataclass(frozen=True, kw_only=True)
class Page:
    """All that a page holds, in order."""

    title: str
    summary: str  # what the paper says, what was found, how sure
    lines: Sequence[Line]
    pictures: Sequence[Picture]
    tables: Sequence[Table]
    decides: Sequence[str]
    readings: Sequence[str]
    unknowns: Table
    weighed: Table | None = None  # indices of sensitivity, below what decides
    files: Sequence[str] = field(default=())


def by_share(found: Share) -> Cell:
    """A claim over a map: it holds (or does not) where the interval of its share lies above (or
    below) half of the plausible range."""
    outcome = UNDECIDED
    if found.decided and found.low > MOST_OF_IT:
        outcome = HOLDS
    elif found.decided and found.high < MOST_OF_IT:
        outcome = FAILS
    return Cell(outcome, str(found))


def number(value: float, margin: float | None = None, *, factor: float = 1.0) -> str:
    """A number with its margin, in the digits that the margin leaves; without one, in two, or in
    whole numbers from 100 on."""
    if not isfinite(value):
        return "-"
    if margin is None or not isfinite(margin):
        plain = value * factor
        return f"{plain:,.0f}" if abs(plain) >= 99.5 else f"{plain:.2g}"  # not 1e+02
    text, half = texts_with_margin(value * factor, margin * factor)
    return f"{text} ± {half}" if half else text


def compose(page: Page) -> str:
    """The page as Markdown. Raises ValueError for one that is too long, or a cell of too many
    words."""
    columns = list(page.lines[0].cells)
    matrix = Table(
        "Claims by readings",
        ("", "claim", *columns, "why"),
        [(line.key, f"{line.claim} ({line.where})", *map(str, line.cells.values()), line.reason)
         for line in page.lines],
    )  # fmt: skip
    parts = [
        f"# {page.title}", _wrapped(page.summary), "![Claims by readings](matrix.png)",
        _table(matrix),
        _wrapped(LEGEND),
        "## The paper's figures",
        *map(_picture, page.pictures),
        "## Tables side by side", *(_table(t) for t in page.tables),
        "## What decides", _bullets(page.decides),
        *([_table(page.weighed)] if page.weighed else []),
        "## Readings and assumptions", _bullets(page.readings), _table(page.unknowns),
    ]  # fmt: skip
    if page.files:
        parts += ["All numbers: " + ", ".join(f"[{file}]({file})" for file in page.files) + "."]
    text = "\n\n".join(parts) + "\n"
    if text.count("\n") > MOST_LINES:
        raise ValueError(f"the page has {text.count(chr(10))} lines, more than {MOST_LINES}")
    return text


def draw_matrix(page: Page, path: Path) -> Path:
    """The matrix of claims by readings as a picture."""
    columns = list(page.lines[0].cells)
    colours = {HOLDS: sheet.GREEN, FAILS: sheet.VERMILION, UNDECIDED: "#9a9a9a"}
    left, top, wide, high = 760.0, 150.0, 280.0, 58.0
    with sheet.style():
        figure = sheet.new_figure(
            left + len(columns) * wide + 30.0, top + len(page.lines) * high + 30
        )
        sheet.heading(
            figure, page.title, "claims by readings; the frame marks the reading that decides"
        )
        for k, column in enumerate(columns):
            sheet.text_at(
                figure, left + (k + 0.5) * wide, top - 44.0, column, ha="center", fontsize=9
            )
        for i, line in enumerate(page.lines):
            y = top + i * high
            name = sheet.text_at(
                figure, 30.0, y + 0.28 * high, f"{line.key}  {line.claim}", fontsize=8
            )
            sheet.fit_width(figure, name, left - 50.0)
            for k, column in enumerate(columns):
                cell = line.cells[column]
                box = (left + k * wide + 4.0, y + 3.0, wide - 8.0, high - 6.0)
                ax = sheet.axes_at(figure, box, facecolor=colours[cell.outcome])
                ax.set(xticks=[], yticks=[])
                ax.grid(False)
                decides = column == line.decided_by
                for spine in ax.spines.values():
                    spine.set(visible=decides, linewidth=2.4, edgecolor=sheet.INK)
                ax.text(0.5, 0.5, str(cell), ha="center", va="center", color="white", fontsize=8,
                        weight="bold", transform=ax.transAxes)  # fmt: skip
        return sheet.save(figure, path)


def _picture(picture: Picture) -> str:
    image = f"![{picture.title}]({picture.file})"
    return f"### {picture.title}\n\n{image}\n\n{_wrapped(picture.caption)}"


def _wrapped(text: str) -> str:
    return "\n".join(wrap(" ".join(text.split()), WIDE, break_long_words=False))


def _bullets(items: Sequence[str]) -> str:
    return "\n".join(
        "\n".join(wrap(" ".join(item.split()), WIDE, initial_indent="- ", subsequent_indent="  ",
                       break_long_words=False)) for item in items
    )  # fmt: skip


def _table(table: Table) -> str:
    for row in table.rows:
        for cell in row:
            if len(str(cell).split()) > MOST_WORDS:
                raise ValueError(
                    f"a cell of '{table.title}' has more than {MOST_WORDS} words: {cell}"
                )
    lines = [f"| {' | '.join(table.head)} |", "|" + " --- |" * len(table.head)]
    lines += [f"| {' | '.join(map(str, row))} |" for row in table.rows]
    return f"**{table.title}**\n\n" + "\n".join(lines)
