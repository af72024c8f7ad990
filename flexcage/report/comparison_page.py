"""The page of two runs compared."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from pathlib import Path

from flexcage.report.blocks import (
    Block,
    Cell,
    Gallery,
    Image,
    Notices,
    Page,
    PageSection,
    PageTable,
    Prose,
    Text,
)
from flexcage.report.tables import number, typeset
from flexcage.results.compared import HEADS, YES, ComparedPair, Comparison

FORCES = "Pocket forces of both runs: over time, how often they occur, and by pocket"


def comparison_page(
    found: Comparison,
    statements: Mapping[str, Sequence[str]],
    cases: Mapping[str, str],
    pictures: Sequence[Path],
    *,
    title: str,
) -> Page:
    """The page: the ten figures that matter and the pictures of cage forces first, all figures and
    both cases last.

    ``title`` names the case or both. By the runs' names, ``statements`` say what was computed and
    ``cases`` are their case files.
    """
    first, second = found.names
    differ = [[path, *map(_text, values)] for path, values in found.differences.items()]
    sections = [
        PageSection("The figures that matter", [
            _table(found, found.leading, " ".join(found.legend)),
            *([Prose(found.differ)] if found.differ else []),
            PageTable(("figure", "remark"), found.remarks(), fold="Remarks on these figures"),
        ]),
        PageSection("Warnings", [Notices(found.warnings, none="None.")]),
        *(
            PageSection("Cage forces", [Gallery([Image(path, FORCES, wide=True)])])
            for path in pictures
        ),
        PageSection("All figures", [
            _table(found, pairs, title) for title, pairs in found.sections.items() if pairs
        ]),
        PageSection("What was computed", [
            *([PageTable(("path in the case", first, second), differ, "Values that differ.")]
              if differ else []),
            *(_statement(name, texts) for name, texts in statements.items()),
        ]),
        PageSection("Cases", [Text(name, text) for name, text in cases.items()]),
    ]  # fmt: skip
    return Page(f"{title}: {first} and {second} compared", f"{second} against {first}", sections)


def _table(found: Comparison, pairs: Sequence[ComparedPair], caption: str = "") -> PageTable:
    head = (HEADS[0], *found.names, "unit", *HEADS[1:])
    return PageTable(head, [_cells(pair) for pair in pairs], caption)


def _cells(pair: ComparedPair) -> list[Cell | str]:
    values = pair.numbers or (None, None)
    figures = [Cell(text.replace("-", "–") if text == "-" else text, value)
               for text, value in zip(pair.texts, values)]  # fmt: skip
    ratio = number(pair.ratio, pair.ratio_text) if isfinite(pair.ratio) else Cell("–")
    tone = "bad" if pair.beyond == YES else ""
    return [pair.row.label, *figures, typeset(pair.row.shown), ratio, Cell(pair.beyond, tone=tone)]


def _statement(name: str, texts: Sequence[str]) -> Block:
    return Prose([f"{name}: {texts[0]}", *texts[1:]] if texts else [])


def _text(value: object) -> str:
    return "none" if value is None else str(value)
