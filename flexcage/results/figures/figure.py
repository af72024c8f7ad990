"""What a figure of a run is: one row of a table, with the function that takes it from a run.

A section of a summary is a ``FigureTable``; one call adds a figure::

    SPEEDS.add("tilt_max", "Cage tilt, largest", "deg", "largest such angle", "a cage",
               take=lambda part: float(part.tilt.max()))

The function takes what the section's figures have in common, its facts, and gives the value in SI,
or a ``Found`` that says more.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any, Final, Generic, Literal, TypeVar, get_args

from flexcage.results.row import SummaryRow, Value
from flexcage.results.statistics import Record

#: What a run must have or compute for a figure.
FLEXIBLE: Final = "flexible cage"
RIVETED: Final = "riveted cage"
FATIGUE: Final = "fatigue"
WEAR: Final = "wear"
CAGED: Final = "a cage"
FULL: Final = "full complement"
FITTED: Final = "section [fit]"
QUOTED: Final = "section [life]"
Need = Literal[
    "flexible cage", "riveted cage", "fatigue", "wear", "a cage", "full complement",
    "section [fit]", "section [life]",
]  # fmt: skip
NEEDS: frozenset[str] = frozenset(get_args(Need))

#: What a figure is: may it be below zero, is it a mean or a peak over windows of the run (and so
#: has an interval), is it a text instead of a number, does only a run read or drawn later have it.
SIGNED: Final = "signed"
STATISTIC: Final = "statistic"
TEXT: Final = "text"
LATER: Final = "later"
#: Where a figure is not printed: it is zero, as a run had no use for it.
RARE: Final = "rare"
#: Where a figure is shown among few: in the terminal after a run, large on a run's page, in a
#: study's table of energy and solver. What else is done with it: halves of a run are compared to
#: see whether it has settled, levels of a study of convergence are compared.
BRIEF: Final = "brief"
LARGE: Final = "large"
EFFORT: Final = "effort"
SETTLING: Final = "settling"
CONVERGENCE: Final = "convergence"
Mark = Literal[
    Need, "signed", "statistic", "text", "later", "rare", "brief", "large", "effort", "settling",
    "convergence",
]  # fmt: skip

#: Title of a figure that pictures of spectra have as well, which no table of figures may import.
CAGE_SPEED: Final = "Cage speed"

#: Words of titles that depend on the bearing or its cage, and what stands for them in a list.
WORDS = {"Element": "Element", "element": "element", "Faces": "Pocket faces",
         "place": "a corner or edge", "walls": "pocket walls"}  # fmt: skip


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


F = TypeVar("F")
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

    def row(self, given: Given, **words: str) -> SummaryRow:
        """The row of a value in a run's summary, with the words of its title."""
        found = given if isinstance(given, Found) else Found(given)
        record = found.value if isinstance(found.value, Record) else found.record
        value = found.value.value if isinstance(found.value, Record) else found.value
        margin = found.margin
        if record is not None and isinstance(value, float) and isfinite(value):
            margin = record.margin if isfinite(record.margin) else None
        label = self.titled(**words)
        return SummaryRow(
            self.key, label, value, self.shown, found.note, margin, record, found.idle
        )


class FigureTable(Generic[F]):
    """The figures of a section of a summary, in order, and what each needs if it does not say."""

    def __init__(self, section: str, needs: Need | Literal[""] = "") -> None:
        self.section, self.needs = section, needs
        self.figures: dict[str, Figure] = {}

    def add(
        self, key: str, pattern: str, shown: str, meaning: str, *marks: Mark,
        take: Callable[[F], Given],
    ) -> None:  # fmt: skip
        """Add a figure, as ``Figure`` has it; what it needs is one of its marks."""
        needs = next((mark for mark in marks if mark in NEEDS), self.needs)
        kept = frozenset[str](marks) - NEEDS
        self.figures[key] = Figure(key, pattern, shown, meaning, self.section, take, needs, kept)

    def rows(
        self, facts: F, lacks: str = "", words: Mapping[str, str] = {}
    ) -> tuple[SummaryRow, ...]:
        """Rows of a run's figures, as ``rows_of`` has them."""
        return rows_of(self.figures.values(), facts, lacks, words)


def rows_of(
    figures: Iterable[Figure], facts: Any, lacks: str = "", words: Mapping[str, str] = {}
) -> tuple[SummaryRow, ...]:
    """Rows of those figures that a run has, which lacks what some need; ``words`` are its
    ``WORDS``."""
    given = ((f, f.take(facts)) for f in figures if not f.needs or f.needs != lacks)
    return tuple(figure.row(value, **words) for figure, value in given if value is not None)
