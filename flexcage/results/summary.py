"""The summary of a run: an ordered list of figures, printed as an aligned table or kept as JSON."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, replace
from itertools import islice
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.core import html
from flexcage.core.binding import near_names
from flexcage.core.errors import InputError
from flexcage.core.listing import PAGE, aligned, wrapped
from flexcage.core.reading import json_of
from flexcage.core.warning import RunWarning
from flexcage.core.writing import replace as replace_file
from flexcage.results.figures.figure import BRIEF
from flexcage.results.figures.table import FIGURES, marked
from flexcage.results.row import SummaryRow, Value
from flexcage.results.statistics import Record

_WORD = 16  # characters: a longer text is no figure, and stands in no column
SUMMARY = "summary.json"  # in a run's folder
_WARNINGS = "warnings"  # their key in a summary's JSON


@dataclass(frozen=True)
class Section:
    title: str
    rows: tuple[SummaryRow, ...]

    @property
    def shown(self) -> tuple[SummaryRow, ...]:
        """The rows that are printed."""
        return tuple(row for row in self.rows if not row.idle)


def _cells(rows: Sequence[SummaryRow], *, brief: bool = False) -> list[Sequence[str]]:
    """Label, figure and note of some rows; the values, margins and units of all of them stand in
    columns. Words take the room of figure and note. ``brief`` notes are short."""
    numbers = [r for r in rows if len(r.text) <= _WORD]
    value = max((len(r.text) for r in numbers), default=0)
    margin = max((len(r.margin_text) for r in numbers), default=0)
    unit = max((len(r.shown) for r in numbers), default=0)
    found: list[Sequence[str]] = []
    for r in rows:
        if len(r.text) > _WORD:
            found.append((r.label, r.text))
            continue
        number = f"{r.text:>{value}} {r.margin_text:<{margin}} {r.shown:<{unit}}"
        found.append((r.label, number, r.brief_note if brief else r.note))
    return found


def _rows_html(rows: Iterable[SummaryRow], *, brief: bool = False) -> str:
    """Label, value, margin, unit and note of figures; ``brief`` notes are short."""
    cells = [
        (r.label, r.text, r.margin_text, r.shown, r.brief_note if brief else r.note) for r in rows
    ]
    return html.table(cells, sides="lrl")


class UnknownFigure(InputError, KeyError):
    """A figure that a summary has not; a KeyError too, as of any mapping."""

    __str__ = Exception.__str__

    def __init__(self, key: str, known: Sequence[str]) -> None:
        close = near_names(str(key), known, 1)
        hint = f"the nearest name is '{close[0]}'" if close else "'flexcage figures' lists all"
        super().__init__(f"The summary has no figure '{key}'; {hint}.", where="summary", value=key)


@dataclass(frozen=True, repr=False)
class Summary:
    """Figures of a run in sections, in order. ``summary["cage_speed"]`` is a value in SI.

    ``warnings`` is what the run's reader must know; None where nobody looked for any.
    """

    sections: tuple[Section, ...] = ()
    warnings: tuple[RunWarning, ...] | None = None

    def __iter__(self) -> Iterator[SummaryRow]:
        return (row for section in self.sections for row in section.rows)

    def __getitem__(self, key: str) -> Value:
        return self.row(key).value

    def row(self, key: str) -> SummaryRow:
        """The whole figure: value, margin, label and unit."""
        for row in self:
            if row.key == key:
                return row
        raise UnknownFigure(key, [row.key for row in self])

    def __contains__(self, key: str) -> bool:
        return any(row.key == key for row in self)

    def with_figures(self, rows: Sequence[SummaryRow], *, after: str = "") -> Summary:
        """A copy with the section of these figures, as ``FIGURES`` calls that of the first; without
        rows the summary itself."""
        if not rows:
            return self
        return self.with_section(FIGURES[rows[0].key].section, rows, after=after)

    def with_section(self, title: str, rows: Sequence[SummaryRow], *, after: str = "") -> Summary:
        """A copy with one more section, behind that of the figure ``after`` or at the end, or with
        that section replaced."""
        new = Section(title, tuple(rows))
        if any(s.title == title for s in self.sections):
            kept = tuple(new if s.title == title else s for s in self.sections)
            return replace(self, sections=kept)
        place = len(self.sections)
        for k, section in enumerate(self.sections, 1):
            if any(row.key == after for row in section.rows):
                place = k
        return replace(self, sections=(*self.sections[:place], new, *self.sections[place:]))

    def with_warnings(self, warnings: Sequence[RunWarning]) -> Summary:
        """A copy with these warnings."""
        return replace(self, warnings=tuple(warnings))

    def text(self, width: int = 0) -> str:
        """The warnings, then an aligned table: label, value (right-aligned), margin, unit, note;
        in lines of at most ``width`` characters (0: as the terminal is wide)."""
        shown = [section for section in self.sections if section.shown]
        cells = iter(_cells([row for section in shown for row in section.shown]))
        rows: list[Sequence[str]] = []
        for section in shown:
            rows += [*([()] if rows else []), (section.title,), *islice(cells, len(section.shown))]
        return self._text(rows, width)

    __str__ = text

    def brief(self, width: int = 0) -> str:
        """The warnings and the dozen figures that matter, as ``text`` prints them."""
        return self._text(_cells(self._brief_rows(), brief=True), width)

    def _text(self, rows: Sequence[Sequence[str]], width: int) -> str:
        table = aligned(rows, sides="lrl", indent=2, width=width)
        parts = ["\n".join(self._warning_lines(width)), table]
        return "\n\n".join(filter(None, parts)) or "(no figures)"

    def _brief_rows(self) -> list[SummaryRow]:
        wanted = marked(BRIEF)
        return [row for row in self if row.key in wanted and row.text != "-"]

    def __repr__(self) -> str:
        return f"Summary({self._size()})"

    def _size(self) -> str:
        figures = f"{sum(1 for _ in self)} figures in {len(self.sections)} sections"
        return figures if self.warnings is None else f"{figures}, warnings: {len(self.warnings)}"

    def _repr_html_(self) -> str:
        """For notebooks: ``brief_html``, and every section, which a click unfolds."""
        parts = [html.folded(s.title, _rows_html(s.shown)) for s in self.sections if s.shown]
        return html.block(f"Summary: {self._size()}", self.brief_html(), *parts)

    def brief_html(self) -> str:
        """The warnings and the dozen figures that matter, as HTML."""
        warned = html.bullets(f"Warning: {warning.text}" for warning in self.warnings or ())
        return warned + _rows_html(self._brief_rows(), brief=True)

    def _warning_lines(self, width: int) -> list[str]:
        if self.warnings is None:
            return []
        if not self.warnings:
            return ["Warnings: none"]
        return ["Warnings", *(wrapped(w.text, first="  - ", width=width) for w in self.warnings)]

    def to_dict(self) -> dict[str, Any]:
        """Warnings, if they were looked for, and every section's figures by their keys."""
        warned = {} if self.warnings is None else {_WARNINGS: [asdict(w) for w in self.warnings]}
        return warned | {
            s.title: {
                r.key: {
                    "label": r.label,
                    "value": _json_value(r.value),
                    "margin": _json_value(r.margin),
                    "unit": r.unit,
                    "shown": r.shown,
                    "note": r.note,
                    **({"idle": True} if r.idle else {}),
                }
                for r in s.rows
            }
            for s in self.sections
        }

    def to_json(self) -> str:
        return json.dumps(self.to_dict(), indent=2, ensure_ascii=False)

    @classmethod
    def from_json(cls, text: str, *, windows: Mapping[str, np.ndarray] | None = None) -> Summary:
        """The summary that ``to_json`` wrote; ``windows`` are its records' sums by key."""
        records = {key: Record(sums) for key, sums in (windows or {}).items()}
        stored = json_of(text)
        warned = stored.pop(_WARNINGS, None)
        return cls(
            tuple(
                Section(
                    title,
                    tuple(
                        SummaryRow(
                            key, r["label"], r["value"], r["shown"], r["note"], r.get("margin"),
                            records.get(key), r.get("idle", False))
                        for key, r in rows.items()
                    ),
                )
                for title, rows in stored.items()
            ),
            None if warned is None else tuple(RunWarning(**values) for values in warned),
        )  # fmt: skip

    @classmethod
    def read(
        cls,
        path: Path,
        *,
        windows: Mapping[str, np.ndarray] | None = None,
        vouched: Callable[[str, bytes], bool] = lambda _name, _content: True,
    ) -> Summary:
        """The summary in a file that ``write`` wrote; InputError if it holds none, or if
        ``vouched`` does not know its name and content."""
        try:
            content = path.read_bytes()
            summary = cls.from_json(content.decode(), windows=windows)
            wrong = "" if list(summary) else "it has no figures"
            if not wrong and not vouched(path.name, content):
                wrong = "it was changed afterwards"
        except OSError as error:
            raise InputError(
                f"The summary '{path}' cannot be read ({(error.strerror or str(error)).lower()}); "
                "make it a file that this user may read.",
                where="summary",
                value=str(path),
            ) from error
        except ValueError as error:
            wrong = str(error)
        except (AttributeError, KeyError, TypeError):
            wrong = "it is no table of figures"
        if wrong:
            raise InputError(
                f"The summary '{path}' cannot be read: {wrong}; delete it, and it is computed "
                "again from the results.",
                where="summary",
                value=str(path),
            )
        return summary

    def write(self, folder: str | Path) -> tuple[Path, Path]:
        """Write ``summary.txt`` and ``summary.json`` into ``folder``; returns their paths."""
        text, data = Path(folder) / "summary.txt", Path(folder) / SUMMARY
        replace_file(text, (self.text(PAGE) + "\n").encode())
        replace_file(data, self.content)
        return text, data

    @property
    def content(self) -> bytes:
        """What ``summary.json`` holds."""
        return (self.to_json() + "\n").encode()


def _json_value(v: Value) -> Value:
    if isinstance(v, np.generic):
        v = v.item()
    return None if isinstance(v, float) and not isfinite(v) else v
