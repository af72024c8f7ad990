"""What a figure of a run is: one row of a table, with the function that takes it from a run.

A section of a summary is a ``Table``. A figure is added to it by a function of its name::

    @SPEEDS.figure("Cage speed", "rpm", "mean over whole turns of the cage", CAGED, STATISTIC)
    def cage_speed(part: Part) -> Found: ...

The function takes what the section's figures have in common, its ``Facts``, and gives the value in
SI, or a ``Found`` that says more.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any, Generic, TypeVar

from flexcage.results.row import Row, Value
from flexcage.results.statistics import Record

#: What a run must have or compute for a figure.
FLEXIBLE, RIVETED, FATIGUE, WEAR = "flexible cage", "riveted cage", "fatigue", "wear"
CAGED, FULL = "a cage", "full complement"
NEEDS = frozenset({FLEXIBLE, RIVETED, FATIGUE, WEAR, CAGED, FULL})

#: What a figure is: may it be below zero, is it a mean or a peak over windows of the run (and so
#: has an interval), is it a text instead of a number, does only a run read or drawn later have it.
SIGNED, STATISTIC, TEXT, LATER = "signed", "statistic", "text", "later"
#: Where a figure is not printed: it is zero, as a run had no use for it.
RARE = "rare"
#: Where a figure is shown among few: in the terminal after a run, large on a run's page, in a
#: study's table of energy and solver. What else is done with it: halves of a run are compared to
#: see whether it has settled, levels of a study of convergence are compared.
BRIEF, LARGE, EFFORT = "brief", "large", "effort"
SETTLING, CONVERGENCE = "settling", "convergence"

#: Words of titles that depend on the bearing or its cage, and what stands for them in a list.
WORDS = {"Element": "Element", "element": "element", "Faces": "Pocket faces",
         "place": "a corner or edge", "walls": "pocket walls"}  # fmt: skip


class Facts:
    """What the figures of a section are taken from."""

    @property
    def words(self) -> Mapping[str, str]:
        """``WORDS`` of this bearing and its cage."""
        return {}

    def has(self, need: str) -> bool:
        """Whether the run has or computes what a figure needs."""
        return True


@dataclass(frozen=True)
class Found:
    """A figure of one run: its ``value`` in SI, a text or a statistic, None where it has none, and
    a ``note`` beside it. ``record`` holds the windows of a value that is given as well; ``margin``
    is half of its 95 % interval, if not theirs. ``idle``: zero because the bearing has nothing
    that makes it."""

    value: Value | Record = None
    note: str = ""
    record: Record | None = None
    margin: float | None = None
    idle: bool = False


F = TypeVar("F", bound=Facts)
Given = Value | Record | Found
Take = Callable[[Any], Given]


@dataclass(frozen=True)
class Figure:
    """One figure of a run. ``pattern`` is its title, with the ``WORDS`` in braces; ``needs`` is
    what a run must have or compute for it; ``marks`` say what it is and where it is shown
    (``SIGNED`` ...). ``take`` gives it by the facts of its section; None: the run has no such
    figure."""

    key: str
    pattern: str
    shown: str  # unit that it is printed in, "" for none
    meaning: str
    section: str
    take: Take
    needs: str = ""
    marks: frozenset[str] = frozenset()

    def titled(self, **words: str) -> str:
        """Its title, with these words in place of the general ones."""
        return self.pattern.format(**WORDS | words)

    @property
    def title(self) -> str:
        """Its title for any bearing and cage."""
        return self.titled()

    @property
    def quantity(self) -> str:
        """What it is a mean or a peak of: its title up to a comma, as part of a sentence."""
        return self.title.partition(",")[0].lower()

    def row(self, facts: Facts) -> Row | None:
        """Its row of a run's summary; None where the run has no such figure."""
        if self.needs and not facts.has(self.needs):
            return None
        given = self.take(facts)
        return None if given is None else self.row_of(given, facts.words)

    def row_of(self, given: Given, words: Mapping[str, str] | None = None) -> Row:
        """The row of a value, with the words of its title."""
        found = given if isinstance(given, Found) else Found(given)
        record = found.value if isinstance(found.value, Record) else found.record
        value = found.value.value if isinstance(found.value, Record) else found.value
        margin = found.margin
        if record is not None and isinstance(value, float) and isfinite(value):
            margin = record.margin if isfinite(record.margin) else None
        label = self.titled(**(words or {}))
        return Row(self.key, label, value, self.shown, found.note, margin, record, found.idle)


class Table(Generic[F]):
    """The figures of a section of a summary, in order, and what each needs if it does not say."""

    def __init__(self, section: str, *, needs: str = "") -> None:
        self.section, self.needs = section, needs
        self.figures: dict[str, Figure] = {}

    def add(
        self, key: str, pattern: str, shown: str, meaning: str, *marks: str,
        take: Callable[[F], Given],
    ) -> None:  # fmt: skip
        """Add a figure, as ``Figure`` has it; what it needs is one of its marks."""
        needs = next((mark for mark in marks if mark in NEEDS), self.needs)
        kept = frozenset(marks) - NEEDS
        self.figures[key] = Figure(key, pattern, shown, meaning, self.section, take, needs, kept)

    def figure(
        self, pattern: str, shown: str, meaning: str, *marks: str
    ) -> Callable[[Callable[[F], Given]], Callable[[F], Given]]:
        """Add the figure that a function takes from the section's facts, by the function's name."""

        def added(take: Callable[[F], Given]) -> Callable[[F], Given]:
            self.add(take.__name__, pattern, shown, meaning, *marks, take=take)
            return take

        return added

    def rows(self, facts: F) -> tuple[Row, ...]:
        """Rows of a run's figures."""
        return rows_of(self.figures.values(), facts)


def rows_of(figures: Iterable[Figure], facts: Facts) -> tuple[Row, ...]:
    """Rows of those figures that a run has."""
    return tuple(row for row in (figure.row(facts) for figure in figures) if row is not None)
