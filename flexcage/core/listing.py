"""Short tables for people: the same rows as text for a terminal and as Markdown."""

from __future__ import annotations

import shutil
import textwrap
from collections.abc import Sequence
from dataclasses import dataclass

_LEAST = 24  # characters of the last column, however narrow the terminal is


@dataclass(frozen=True)
class Listing:
    """A table with a title; its last column holds sentences, which text wraps."""

    title: str
    heads: Sequence[str]
    rows: Sequence[Sequence[str]]

    def text(self) -> str:
        """The table for a terminal, as wide as that is."""
        lines = [self.heads, *self.rows]
        widths = [max(len(line[k]) for line in lines) for k in range(len(self.heads) - 1)]
        used = 2 + sum(widths) + 2 * len(widths)
        room = max(shutil.get_terminal_size((100, 24)).columns - used, _LEAST)
        found = [self.title]
        for line in lines:
            first = "  ".join(cell.ljust(w) for cell, w in zip(line, widths))
            wrapped = textwrap.wrap(line[-1], room) or [""]
            found.append(f"  {first}  {wrapped[0]}".rstrip())
            found += [f"{'':<{used}}{more}" for more in wrapped[1:]]
        return "\n".join(found)

    def markdown(self) -> str:
        """The table as a section of a page; the first column is code."""
        rows = [[f"`{row[0]}`", *row[1:]] for row in self.rows]
        table = [self.heads, ["---"] * len(self.heads), *rows]
        lines = ["| " + " | ".join(c.replace("|", "\\|") for c in row) + " |" for row in table]
        return "\n".join([f"**{self.title}**", "", *lines, ""])
