"""Tables for people: as text, no wider than the terminal, and as Markdown."""

from __future__ import annotations

import re
import shutil
from collections.abc import Sequence
from dataclasses import dataclass, replace

PAGE = 100  # characters of a line in files, and where no terminal says how wide it is
_NARROWEST = 40  # characters of a line that a terminal has at least
_GAP = 2  # blanks between columns
_WORDS = 12  # characters to which a column of words shrinks, unless one word is longer
_TEXT = 24  # the same of the last column, and of words that may be broken after their marks
_HANG = "  "  # before further lines of a first column
_DEEPER = 4  # blanks before a last column that stands below its row
_MARKS = re.compile(r"(?<=[._/=,;\]+-])")  # a long word is broken after one of them

Rows = Sequence[Sequence[str]]


def line_width() -> int:
    """Characters that a line may have: as the terminal is wide, or ``PAGE``."""
    return max(shutil.get_terminal_size((PAGE, 24)).columns, _NARROWEST)


def wrapped(text: str, *, first: str = "", rest: str | None = None, width: int = 0) -> str:
    """A text in lines of at most ``width`` characters (0: the terminal's); ``first`` stands before
    the first line and ``rest`` before the others (by default as many blanks)."""
    rest = " " * len(first) if rest is None else rest
    space = (width or line_width()) - max(len(first), len(rest))
    first_line, *others = _lines(text, max(space, 1))
    return "\n".join([f"{first}{first_line}", *(f"{rest}{line}" for line in others)])


def aligned(
    rows: Rows, *, sides: str = "l", indent: int = 0, heads: bool = False, width: int = 0
) -> str:
    """Rows in columns, in lines of at most ``width`` characters (0: as the terminal is wide).

    ``sides`` has for every column "l" (words, to the left, wrapped where there is no room) or "r"
    (numbers, to the right, in one piece); its last letter stands for all further columns.
    ``heads``: the first row holds the columns' heads, which wrap at blanks. A row with fewer cells
    than the table has columns: its last cell takes the room of the others. A row of one cell is a
    title, without ``indent``; one of none is an empty line.

    Where all columns together are too wide even with wrapped words, a last column of words stands
    below its row, or the columns stand in several tables, one below the other, which all begin with
    the first column.
    """
    count = max(map(len, rows), default=0)
    full = sides[:count] + sides[-1] * (count - len(sides))
    lines = [_Line(tuple(row), whole=len(row) == count) for row in rows]
    table = _Table(lines, full, indent, heads, width or line_width())
    return "\n".join(line.rstrip() for line in table.text())


@dataclass(frozen=True)
class _Line:
    """A row; ``whole`` if it has a cell for every column. ``below``: a cell that stands below."""

    cells: tuple[str, ...]
    whole: bool
    below: str = ""

    def with_last_below(self) -> _Line:
        return _Line(self.cells[:-1], True, self.cells[-1]) if self.whole else self

    def of(self, columns: Sequence[int]) -> _Line:
        return _Line(tuple(self.cells[k] for k in columns), True) if self.whole else self


@dataclass(frozen=True)
class _Table:
    lines: Sequence[_Line]
    sides: str
    indent: int
    heads: bool
    width: int

    def text(self) -> list[str]:
        """Lines of the table, laid out in the first way that fits."""
        for least in (self._least(broken=False), self._least(broken=True)):
            if widths := self._widths(least):
                return self._laid(widths)
            if len(self.sides) > 2 and self.sides[-1] == "l":
                lines = [line.with_last_below() for line in self.lines]
                narrower = replace(self, lines=lines, sides=self.sides[:-1])
                if widths := narrower._widths(least[:-1]):
                    return narrower._laid(widths)
        return self._in_parts(self._least(broken=True))

    def _columns(self) -> list[list[str]]:
        """Cells of every column, without those that stretch over several."""
        rows = [line.cells if line.whole else line.cells[:-1] for line in self.lines]
        return [[row[k] for row in rows if len(row) > k] for k in range(len(self.sides))]

    def _natural(self, *, wrap_heads: bool) -> list[int]:
        """Widths [characters] of the columns as they are; of heads, of their words alone."""
        found = []
        for column in self._columns():
            head, body = column[: int(wrap_heads)], column[int(wrap_heads) :]
            found.append(max(map(len, [*body, *" ".join(head).split()]), default=0))
        return found

    def _least(self, *, broken: bool) -> list[int]:
        """Widths [characters] to which the columns shrink, with long words whole or ``broken``."""
        found = []
        natural, last = self._natural(wrap_heads=self.heads), len(self.sides) - 1
        for k, (column, side) in enumerate(zip(self._columns(), self.sides)):
            words = " ".join(column).split() if side == "l" else column[int(self.heads) :]
            least = max(_TEXT if k == last else _WORDS, *map(len, words), 0)
            if side == "r":
                least = max(map(len, words), default=0) if broken else natural[k]
                least = max(least, min(natural[k], _WORDS))
            elif broken:
                least = min(least, _TEXT)
            found.append(min(least, natural[k]))
        return found

    def _widths(self, least: Sequence[int]) -> list[int]:
        """Widths of the columns, the widest ones shrunk until all fit; none if they do not."""
        space = self.width - self.indent - _GAP * (len(self.sides) - 1)
        natural = self._natural(wrap_heads=False)
        if sum(natural) <= space:
            return natural
        natural = self._natural(wrap_heads=self.heads)
        for cap in range(max(natural, default=0), 0, -1):
            widths = [min(n, max(low, cap)) for n, low in zip(natural, least)]
            if sum(widths) <= space:
                return widths
        return []

    def _laid(self, widths: Sequence[int]) -> list[str]:
        found: list[str] = []
        for k, line in enumerate(self.lines):
            found += self._row(line, widths, is_head=self.heads and k == 0)
            if line.below:
                start = " " * (self.indent + _DEEPER)
                found += wrapped(line.below, first=start, width=self.width).split("\n")
        return found

    def _row(self, line: _Line, widths: Sequence[int], *, is_head: bool) -> list[str]:
        cells, widths, sides = line.cells, list(widths[: len(line.cells)]), self.sides
        if not line.whole:
            if len(cells) < 2:
                return wrapped(cells[0], width=self.width).split("\n") if cells else [""]
            before = self.indent + sum(widths[:-1]) + _GAP * (len(cells) - 1)
            widths[-1], sides = max(self.width - before, 1), sides[: len(cells) - 1] + "l"
        hangs = [_HANG, *[""] * len(cells)]
        wraps = [_lines(*each) for each in zip(cells, widths, hangs)]
        high = max(map(len, wraps))
        found = []
        for k in range(high):
            parts = []
            for lines, width, side in zip(wraps, widths, sides):
                at = k - (high - len(lines) if is_head else 0)
                text = lines[at] if 0 <= at < len(lines) else ""
                parts.append(text.rjust(width) if side == "r" else text.ljust(width))
            found.append(" " * self.indent + (" " * _GAP).join(parts))
        return found

    def _in_parts(self, least: Sequence[int]) -> list[str]:
        """Several tables, each with the first column and as many others as have room."""
        space, parts = self.width - self.indent - least[0], [[0]]
        used = 0
        for k in range(1, len(self.sides)):
            used += _GAP + least[k]
            if used > space and len(parts[-1]) > 1:
                parts.append([0])
                used = _GAP + least[k]
            parts[-1].append(k)
        found: list[str] = []
        for columns in parts:
            lines = [line.of(columns) for line in self.lines]
            kept = lines if not found else [line for line in lines if line.whole]
            sides = "".join(self.sides[k] for k in columns)
            table = replace(self, lines=kept, sides=sides)
            widths = table._widths([least[k] for k in columns])
            forced = [least[0], max(space - _GAP, 1)][: len(columns)]
            found += [*([""] if found else []), *table._laid(widths or forced)]
        return found


def _lines(text: str, width: int, hang: str = "") -> list[str]:
    """A text in lines of at most ``width`` characters; its own line breaks stay. ``hang`` stands
    before lines that go on with the one before, where there is room."""
    hang = hang if len(hang) < width // 2 else ""
    return [
        f"{hang if k else ''}{line}"
        for paragraph in text.split("\n")
        for k, line in enumerate(_filled(paragraph, width, width - len(hang)))
    ]


def _filled(text: str, first: int, others: int) -> list[str]:
    """A paragraph in lines of at most so many characters."""
    if len(text) <= first:
        return [text]
    found: list[str] = []
    line = ""
    for word in text.split():
        longer = f"{line} {word}" if line else word
        if len(longer) <= (others if found else first):
            line = longer
            continue
        found += [line] if line else []
        *full, line = _pieces(word, others)
        found += full
    return [*found, line]


def _pieces(word: str, width: int) -> list[str]:
    """A word in pieces of at most ``width`` characters, broken after its marks where it has any."""
    found = [""]
    for part in _MARKS.split(word):
        if len(found[-1]) + len(part) <= width:
            found[-1] += part
            continue
        cut = [part[k : k + width] for k in range(0, len(part), width)]
        found = [*filter(None, found), *cut]
    return found


@dataclass(frozen=True)
class Listing:
    """A table with a title; its cells hold words."""

    title: str
    heads: Sequence[str]
    rows: Sequence[Sequence[str]]

    def text(self, width: int = 0) -> str:
        """The table for a terminal, as wide as that is, or in lines of ``width`` characters."""
        rows = [[self.title], self.heads, *self.rows]
        return aligned(rows, indent=2, width=width)

    def markdown(self) -> str:
        """The table as a section of a page; the first column is code."""
        rows = [[f"`{row[0]}`", *row[1:]] for row in self.rows]
        table = [self.heads, ["---"] * len(self.heads), *rows]
        lines = ["| " + " | ".join(c.replace("|", "\\|") for c in row) + " |" for row in table]
        return "\n".join([f"**{self.title}**", "", *lines, ""])
