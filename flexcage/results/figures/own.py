"""Figures that a user's own file adds: numbers of a run in its summary, among all others."""

from __future__ import annotations

import inspect
from collections.abc import Callable, Collection, Mapping
from math import isfinite
from typing import Any

import numpy as np

from flexcage.core.binding import did_you_mean
from flexcage.core.errors import InputError, mistake_in
from flexcage.core.registry import check_free, check_word
from flexcage.core.warning import RunWarning
from flexcage.results.figures.figure import (
    BRIEF,
    CAGED,
    CONVERGENCE,
    FULL,
    LARGE,
    SETTLING,
    SIGNED,
    STATISTIC,
    Figure,
    Found,
    Given,
)
from flexcage.results.figures.part import SettledRun
from flexcage.results.figures.table import FIGURES
from flexcage.results.row import SummaryRow, check_shown
from flexcage.results.statistics import Record
from flexcage.results.summary import Summary

SECTION = "Own figures"
WHAT, WARNING, SIZE = "figure", "own_figure", "size"
#: Names that are taken by outputs of studies, which a user's file adds as well.
OUTPUTS: dict[str, Any] = {}
_NEEDS, _MARKS = (CAGED, FULL), (SIZE, STATISTIC, BRIEF, LARGE, SETTLING, CONVERGENCE)


def register_figure(
    key: str, take: Callable[[SettledRun], float | Record | Found | None], *, title: str, unit: str,
    meaning: str, marks: Collection[str] = (),
) -> None:  # fmt: skip
    """Add a figure: summaries of all runs have it, with pages, comparisons and studies.

    ``take(part)`` gives its value in SI by the settled part of a run (``figures.part.SettledRun``:
    ``part.ds`` is its dataset): a number, a statistic of ``part.windows``, which has an interval,
    or None where a run has none. ``unit`` is the unit that it is shown in, "" for none. ``marks``
    say more: it needs "a cage" or a "full complement"; it is a "size", never below zero, or a
    "statistic", with an interval; the terminal shows it after a run ("brief"), and a page at its
    head ("large"); halves of a run are compared by it ("settling"), and levels of a study of
    convergence ("convergence"). Where ``take`` fails, or gives what is no number, the run has a
    warning. What a study has stored is not computed again when ``take`` changes: give a changed
    one another name.

    Raises InputError for a name or a title that is taken, and for what is not as said here.
    """
    _check_free(key, title)
    check_shown(WHAT, key, unit)
    for name, text in (("title", title), ("meaning", meaning)):
        if not isinstance(text, str) or not text.strip():
            raise _wrong(key, f"has the {name} {text!r}, but should have words")
    given = _checked_marks(key, {marks} if isinstance(marks, str) else set(marks))
    try:
        inspect.signature(take).bind(None)
    except (TypeError, ValueError) as error:
        raise _wrong(key, f"needs a function of one value, the settled part ({error})") from error
    needs = next((mark for mark in _NEEDS if mark in given), "")
    kept = frozenset(given if SIZE in given else {*given, SIGNED}).difference(_NEEDS)
    pattern = title.replace("{", "{{").replace("}", "}}")
    FIGURES.add(key, Figure(key, pattern, unit, meaning, SECTION, take, needs, kept))


def _check_free(key: str, title: str) -> None:
    """Raise InputError for a name that is no word, and for a name or a title that is taken."""
    check_word(key, what=WHAT)
    check_free(FIGURES, key, what=WHAT)
    check_free(OUTPUTS, key, what="study output")
    for other in FIGURES.values():
        if other.title == title:
            raise _wrong(key, f"has the title '{title}', which is that of '{other.key}'")


def _checked_marks(key: str, marks: set[str]) -> set[str]:
    """These marks. InputError for one that is not known."""
    for mark in sorted(marks.difference(_NEEDS, _MARKS), key=str):
        hint = did_you_mean(str(mark), (*_NEEDS, *_MARKS), "choose from")
        raise _wrong(key, f"has the mark {mark!r}, which is not known; {hint}")
    return marks


def _wrong(key: str, what: str) -> InputError:
    return InputError(f"The figure '{key}' {what}.", where=key)


def own_figures() -> Mapping[str, Figure]:
    """Those that users' files have added, by name."""
    return FIGURES.added


def own_rows(part: SettledRun) -> tuple[SummaryRow, ...]:
    """Their rows; the note of one without a value says why."""
    return tuple(
        figure.row(_value_of(figure, part), **part.words)
        for figure in own_figures().values()
        if figure.needs != part.lacks
    )


def _value_of(figure: Figure, part: SettledRun) -> Given:
    """What a user's function gives, as a value that a row may have."""
    try:
        given = figure.take(part.each[0] if figure.needs == CAGED else part)
        found = given if isinstance(given, Found) else Found(given)
        if found.value is None:
            return found
        number = found.value.value if isinstance(found.value, Record) else found.value
        shape = np.shape(number)
    except Exception as error:
        return Found(None, mistake_in(figure.take, error))
    if shape or isinstance(number, (str, bool)):
        what = f"an array of shape {shape}" if shape else repr(number)
        return Found(None, f"its function gave {what}, but should give one number")
    try:
        value = number if isinstance(number, int) else float(number)
    except (TypeError, ValueError):
        kind = type(number).__name__
        return Found(None, f"its function gave a {kind}, but should give one number")
    if not isfinite(value):
        return Found(None, f"its function gave {value}, but should give a number, or None")
    record = found.value if isinstance(found.value, Record) else found.record
    return Found(value, found.note, record, found.margin, found.idle)


def own_warnings(summary: Summary) -> tuple[RunWarning, ...]:
    """One for every figure of users' files that has no value, but should have one."""
    return tuple(
        RunWarning(WARNING, f"The figure '{row.key}' of your own has no value: {row.note}.")
        for row in summary
        if row.key in own_figures() and row.value is None and row.note
    )


def with_own(summary: Summary, part: Callable[[], SettledRun]) -> Summary:
    """A stored summary with the figures that users' files have added since, and all of theirs
    anew."""
    if not own_figures():
        return summary
    rows = {row.key: row for s in summary.sections if s.title == SECTION for row in s.rows}
    rows |= {row.key: row for row in own_rows(part())}
    if not rows:
        return summary
    found = summary.with_section(SECTION, tuple(rows.values()), after="energy_audit")
    known = [w for w in summary.warnings or () if w.key != WARNING]
    return found.with_warnings((*known, *own_warnings(found)))
