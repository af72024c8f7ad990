"""Two runs side by side: the ten figures that matter first, ratios, and what intervals can tell."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from math import hypot, isfinite, nan
from typing import Any

from flexcage.core import html
from flexcage.core.errors import InputError
from flexcage.core.listing import aligned, wrapped
from flexcage.results.figures.figure import BRIEF, TEXT
from flexcage.results.figures.table import FIGURES, marked
from flexcage.results.row import SummaryRow, resolution
from flexcage.results.summary import Summary

TEN = 10
#: What a comparison leads with: the first ten of these that both runs have.
FIRST = (
    "cage_speed", "cage_slip_ratio", "whirl_radius", "pocket_force_mean", "pocket_force_pass_peak",
    "pocket_force_peak", "race_force_inner", "drive_torque", "stress_mean_peak", "stress_peak",
    "orbital_speed", "orbital_slip_ratio", "neighbour_force_mean", "neighbour_force_pass_peak",
    "neighbour_force_peak", "slip_loaded", "contact_frequency_total", "contact_angle_inner",
    "race_force_outer",
)  # fmt: skip
HEADS = ("figure", "ratio", "beyond the intervals")
YES, NO, NO_INTERVAL = "yes", "no", "no interval"
_SENTENCE = 16  # characters from which a text is a sentence, which stands in no column
_MOST = 8  # values in which cases differ that are written out


@dataclass(frozen=True)
class ComparedPair:
    """One figure of both runs; None in place of a run that does not have it."""

    key: str
    first: SummaryRow | None
    second: SummaryRow | None

    @property
    def row(self) -> SummaryRow:
        """The figure of the first run that has it."""
        found = self.first or self.second
        assert found is not None
        return found

    @property
    def rows(self) -> tuple[SummaryRow | None, SummaryRow | None]:
        return self.first, self.second

    @property
    def title(self) -> str:
        """Label and unit."""
        return f"{self.row.label} [{self.row.shown}]" if self.row.shown else self.row.label

    @property
    def texts(self) -> tuple[str, str]:
        """Value and margin of both, as printed."""
        first, second = (" ".join(filter(None, (r.text, r.margin_text))) if r else "-"
                         for r in self.rows)  # fmt: skip
        return first, second

    @property
    def numbers(self) -> tuple[float, float] | None:
        """Both values in SI; None if one is lacking, a text, or not known."""
        values = [row.value if row else None for row in self.rows]
        if not all(isinstance(v, (int, float)) and not isinstance(v, bool) for v in values):
            return None
        first, second = (float(v or 0.0) for v in values)
        return (first, second) if isfinite(first) and isfinite(second) else None

    @property
    def ratio(self) -> float:
        """The second over the first; NaN where that means nothing: of a text, of zero, of values
        of different sign."""
        first, second = self.numbers or (nan, nan)
        nothing = not abs(first) > resolution(self.row.shown)
        return nan if nothing or first * second < 0.0 else second / first

    @property
    def ratio_text(self) -> str:
        if not isfinite(self.ratio):
            return "-"
        return f"{self.ratio:.3f}" if 0.1 <= self.ratio < 100.0 else f"{self.ratio:.3g}"

    @property
    def margin(self) -> float:
        """Half the width of the 95 % interval of the difference, of independent runs; NaN where
        one has no interval."""
        margins = [row.margin if row else None for row in self.rows]
        return hypot(*(nan if m is None else m for m in margins))

    @property
    def beyond(self) -> str:
        """Whether the difference is beyond its interval: "yes", "no", "no interval", or "" where
        there is no difference of numbers."""
        if self.numbers is None:
            return ""
        if not isfinite(self.margin):
            return NO_INTERVAL
        first, second = self.numbers
        return YES if abs(second - first) > self.margin else NO


@dataclass(frozen=True, repr=False)
class Comparison:
    """Two runs compared by their summaries, by name. ``print`` shows the ten figures that matter;
    ``text(every=True)`` has all. ``differences`` are the values in which their cases differ."""

    summaries: Mapping[str, Summary]
    differences: Mapping[str, tuple[Any, Any]] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if len(self.summaries) != 2:
            raise InputError(
                f"Two runs can be compared, not {len(self.summaries)}.",
                where="compare",
                value=len(self.summaries),
            )

    def __iter__(self) -> Iterator[ComparedPair]:
        return (pair for pairs in self.sections.values() for pair in pairs)

    def __getitem__(self, key: str) -> ComparedPair:
        """Both values of a figure, their ratio, and whether they differ beyond the intervals."""
        for pair in self:
            if pair.key == key:
                return pair
        raise InputError(f"Neither run has the figure '{key}'.", where="compare", value=key)

    def __repr__(self) -> str:
        return f"Comparison({' and '.join(map(repr, self.names))}: {len(list(self))} figures)"

    @property
    def names(self) -> tuple[str, str]:
        first, second = self.summaries
        return first, second

    @cached_property
    def sections(self) -> dict[str, list[ComparedPair]]:
        """Figures that one of the runs or both print, by section, in the order of a summary."""
        first, second = ({row.key: row for row in s} for s in self.summaries.values())
        found: dict[str, dict[str, ComparedPair]] = {}
        for summary in self.summaries.values():
            for section in summary.sections:
                for row in section.shown:
                    pair = ComparedPair(row.key, first.get(row.key), second.get(row.key))
                    found.setdefault(section.title, {})[row.key] = pair
        return {title: list(pairs.values()) for title, pairs in found.items()}

    @cached_property
    def leading(self) -> list[ComparedPair]:
        """The ten figures that matter, of those that both runs have."""
        pairs = {pair.key: pair for pair in self if pair.numbers is not None}
        brief = [key for key in marked(BRIEF) if TEXT not in FIGURES[key].marks]
        wanted = dict.fromkeys((*FIRST, *brief))
        chosen = [key for key in wanted if key in pairs][:TEN]
        return [pairs[key] for key in chosen]

    def text(self, *, every: bool = False, width: int = 0) -> str:
        """The ten figures that matter, or ``every`` one, then warnings and notes; in lines of at
        most ``width`` characters (0: as the terminal is wide)."""
        head = [HEADS[0], *self.names, *HEADS[1:]]
        rows: list[Sequence[str]] = [head, *map(_cells, self.leading)]
        if every:
            rows = [head]
            for title, pairs in self.sections.items():
                rows += [(), (title,), *map(_cells, pairs)]
        table = aligned(rows, sides="lrrrl", indent=2 if every else 0, heads=True, width=width)
        notes = [("Warnings", self.warnings), ("Notes", self.notes(every=every))]
        parts = [
            "\n".join([title, *(wrapped(line, first="  - ", width=width) for line in lines)])
            for title, lines in notes if lines
        ]  # fmt: skip
        return "\n\n".join([table, *parts])

    __str__ = text

    @property
    def warnings(self) -> list[str]:
        """Warnings of the runs, each with the names of those that have it."""
        return self._by_run({n: [w.text for w in s.warnings or ()]
                             for n, s in self.summaries.items()})  # fmt: skip

    def notes(self, *, every: bool = False) -> list[str]:
        """How to read the table, in what the cases differ, and remarks on its figures."""
        remarks = [f"{label}: {text}" for label, text in self.remarks(every=every)]
        return [*self.legend, *self.differ, *remarks]

    @property
    def legend(self) -> list[str]:
        """How to read the table."""
        first, second = self.names
        return [
            f"ratio: {second} over {first}; ±: half of the 95 % interval.",
            "beyond the intervals: yes where the difference is larger than its own 95 % interval, "
            "the root of the sum of both ± squared. A single largest value, a count and a figure "
            "of too short a run have no interval.",
        ]

    @property
    def differ(self) -> list[str]:
        """A sentence with the first values in which the cases differ; none if they are alike."""
        found = [
            f"{path} ({_written(a)}, {_written(b)})" for path, (a, b) in self.differences.items()
        ]
        more = [f"and {len(found) - _MOST} more values"] if len(found) > _MOST else []
        return [f"The cases differ in {', '.join([*found[:_MOST], *more])}."] if found else []

    def remarks(self, *, every: bool = False) -> list[tuple[str, str]]:
        """Labels of figures, and what their summaries remark on them."""
        found = []
        for pair in self if every else self.leading:
            notes = {n: [r.brief_note] for n, r in zip(self.names, pair.rows) if r and r.brief_note}
            found += [(pair.row.label, note) for note in self._by_run(notes)]
        return found

    def _by_run(self, texts: Mapping[str, Sequence[str]]) -> list[str]:
        """Texts of the runs, those that both have once, the others with the name of their run."""
        every = dict.fromkeys(text for lines in texts.values() for text in lines)
        owners = {text: [n for n, lines in texts.items() if text in lines] for text in every}
        return [
            text if len(names) == len(self.summaries) else f"{names[0]}: {text}"
            for text, names in owners.items()
        ]

    def _repr_html_(self) -> str:
        """For notebooks: the ten figures that matter, and warnings."""
        head = [HEADS[0], *self.names, *HEADS[1:]]
        return html.block(
            f"{self.names[0]} and {self.names[1]} compared",
            html.bullets(f"Warning: {text}" for text in self.warnings),
            html.table([_cells(pair) for pair in self.leading], heads=head, sides="lrrrl"),
        )

    def to_dict(self) -> dict[str, Any]:
        """Both summaries by name, and under ``figures`` values in SI, margins, ratio and verdict of
        every figure that is a number."""
        figures = {
            pair.key: {
                "label": pair.row.label,
                "unit": pair.row.unit,
                "values": pair.numbers,
                "margins": [row.margin if row else None for row in pair.rows],
                "ratio": pair.ratio if isfinite(pair.ratio) else None,
                "beyond": pair.beyond,
                "leading": pair in self.leading,
            }
            for pair in self if pair.numbers is not None
        }  # fmt: skip
        differ = {path: list(values) for path, values in self.differences.items()}
        runs = {name: summary.to_dict() for name, summary in self.summaries.items()}
        return {"runs": runs, "figures": figures, "differences": differ}

    def to_json(self) -> str:
        return json.dumps(self.to_dict(), indent=2, ensure_ascii=False)


def _cells(pair: ComparedPair) -> tuple[str, ...]:
    """A line of the table; sentences have the line for themselves."""
    first, second = pair.texts
    words = [row.value for row in pair.rows if row and isinstance(row.value, str)]
    if any(len(text) > _SENTENCE for text in words):
        return pair.title, first if first == second else f"{first} | {second}"
    return pair.title, first, second, pair.ratio_text, pair.beyond


def _written(value: Any) -> str:
    return "none" if value is None else str(value)
