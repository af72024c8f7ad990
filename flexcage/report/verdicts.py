"""Verdicts on claims, as a study's folder may hold them in ``verdicts.json``: read, and a table."""

from __future__ import annotations

from collections.abc import Mapping
from math import isfinite
from pathlib import Path
from typing import Any

from flexcage.core.digits import texts_with_margin
from flexcage.core.errors import InputError
from flexcage.core.reading import read_json
from flexcage.report.blocks import Cell, PageTable

FILE, FORMAT = "verdicts.json", 1
#: Outcomes, how they are shown (readable without colour), and their tone.
OUTCOMES = {
    "holds": ("✔ holds", "good"),
    "does not hold": ("✘ does not hold", "bad"),
    "undecided": ("? undecided", "open"),
}
_HEAD = ("claim", "verdict", "figures", "reason", "where it holds", "source")


def read_verdicts(folder: str | Path) -> PageTable | None:
    """Table of the verdicts in a folder; None if it has none, InputError if they are none."""
    path = Path(folder) / FILE
    if not path.is_file():
        return None
    try:
        stored = read_json(path)
    except (OSError, ValueError) as exc:
        raise InputError(f"'{path}' cannot be read as JSON ({exc}).", where=FILE) from exc
    found = stored.get("format") if isinstance(stored, Mapping) else None
    if found != FORMAT:
        raise InputError(
            f"'{path}' is of format {found!r}, and this flexcage reads format {FORMAT}.",
            where=FILE,
            value=found,
        )
    verdicts = stored.get("verdicts")
    if not isinstance(verdicts, list) or not all(isinstance(v, Mapping) for v in verdicts):
        raise InputError(f"'{path}' lacks its list of verdicts.", where=FILE)
    rows = [_row(verdict, path) for verdict in verdicts]
    sources = {row[-1].text for row in rows}
    if len(sources) > 1:
        return PageTable(_HEAD, rows, f"{_count(verdicts)}.")
    source = f" Source: {sources.pop()}." if any(sources) else ""
    return PageTable(_HEAD[:-1], [row[:-1] for row in rows], f"{_count(verdicts)}.{source}")


def _count(verdicts: list[Mapping[str, Any]]) -> str:
    counts = {name: sum(v["outcome"] == name for v in verdicts) for name in OUTCOMES}
    return f"{len(verdicts)} claims: " + ", ".join(f"{n} {name}" for name, n in counts.items())


def _row(verdict: Mapping[str, Any], path: Path) -> list[Cell]:
    key, outcome = str(verdict.get("key", "")), verdict.get("outcome")
    if outcome not in OUTCOMES:
        raise InputError(
            f"'{path}': verdict '{key}' has the outcome {outcome!r}; choose from "
            f"{', '.join(OUTCOMES)}.",
            where=FILE,
            value=outcome,
        )
    shown, tone = OUTCOMES[outcome]
    claim = ": ".join(part for part in (key, str(verdict.get("claim", ""))) if part)
    given = verdict.get("figures") or []
    if not isinstance(given, list) or not all(isinstance(f, Mapping) for f in given):
        raise InputError(
            f"'{path}': the figures of verdict '{key}' should be a list of tables with label and "
            "value.",
            where=FILE,
        )
    figures = "\n".join(map(_figure, given))
    where, reason, source = (str(verdict.get(k) or "") for k in ("range", "reason", "source"))
    where = where.replace(". ", ".\n")  # a line a parameter
    return [Cell(claim), Cell(shown, tone=tone), Cell(figures), *map(Cell, (reason, where, source))]


def _figure(figure: Mapping[str, Any]) -> str:
    value, margin, unit = (figure.get(name) for name in ("value", "margin", "unit"))
    text = _text(value, margin)
    label = figure.get("label")
    return f"{label}: {text} {unit or ''}".strip() if label else f"{text} {unit or ''}".strip()


def _text(value: Any, margin: Any = None) -> str:
    """A value with the digits that its margin leaves, or four."""
    if margin is None or not all(isinstance(x, (int, float)) for x in (value, margin)):
        text = f"{value:.4g}" if isinstance(value, (int, float)) else str(value)
        return text if margin is None else f"{text} ± {margin}"
    if not isfinite(margin):
        return f"{value:.4g}"
    return " ± ".join(texts_with_margin(value, margin))
