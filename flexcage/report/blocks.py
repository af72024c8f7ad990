"""What a page is made of: sections, and in them prose, notices, tables, pictures, charts, texts.

Values only. ``page`` turns them into HTML; nothing here is HTML, and every text is escaped there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, ClassVar


@dataclass(frozen=True)
class Cell:
    """A cell of a table: its text, and the number that it is sorted by (None: by its text)."""

    text: str
    number: float | None = None
    tone: str = ""  # "good", "bad" or "open" gives a verdict its colour

    @property
    def is_name(self) -> bool:
        """Whether it is one long word, which may be broken after its dots and lines."""
        return len(self.text) > 12 and not any(c.isspace() for c in self.text)

    @property
    def listed(self) -> bool:
        """Whether it holds short lines, which must not be broken."""
        lines = self.text.split("\n")
        return len(lines) > 1 and max(map(len, lines)) < 45

    @property
    def has_sentences(self) -> bool:
        """Whether it holds sentences, which need a broad column."""
        return len(self.text) > 90 and not self.listed


@dataclass(frozen=True)
class Prose:
    """Paragraphs of plain text."""

    kind: ClassVar[str] = "prose"
    paragraphs: Sequence[str]


@dataclass(frozen=True)
class Notices:
    """Warnings, one sentence each; ``none`` is what stands there if there are none."""

    kind: ClassVar[str] = "notices"
    items: Sequence[str]
    none: str = ""


@dataclass(frozen=True)
class Tile:
    """One figure that is shown large."""

    label: str
    value: str
    note: str = ""


@dataclass(frozen=True)
class Tiles:
    """The few figures that a reader looks for first."""

    kind: ClassVar[str] = "tiles"
    tiles: Sequence[Tile]


@dataclass(frozen=True)
class PageTable:
    """A table that its reader can sort by any column; folded away under a title, ``fold``."""

    kind: ClassVar[str] = "table"
    head: Sequence[str]
    rows: Sequence[Sequence[Cell | str]]
    caption: str = ""
    fold: str = ""

    @property
    def cells(self) -> list[list[Cell]]:
        """All rows, texts as cells."""
        return [[c if isinstance(c, Cell) else Cell(c) for c in row] for row in self.rows]

    @property
    def numeric(self) -> list[bool]:
        """Which columns hold numbers: those are set flush right."""
        columns = zip(*self.cells, strict=True) if self.rows else ()
        held = [any(c.number is not None for c in column) for column in columns]
        return held or [False] * len(self.head)


@dataclass(frozen=True)
class Image:
    """A picture, its caption, and its description for those who do not see it; a ``wide`` one has
    the whole width of the page."""

    path: Path
    caption: str
    alt: str = ""
    wide: bool = False


@dataclass(frozen=True)
class Gallery:
    """Pictures, side by side where there is room."""

    kind: ClassVar[str] = "gallery"
    images: Sequence[Image]


@dataclass(frozen=True)
class Chart:
    """A chart that can be zoomed or turned: one plotly figure, or several to choose from."""

    kind: ClassVar[str] = "chart"
    title: str
    figures: Sequence[tuple[str, Any]]  # name, plotly.graph_objects.Figure
    caption: str = ""
    height: int = 300  # pixels
    choose: str = "Case"  # what the choice between several figures is called


@dataclass(frozen=True)
class Charts:
    """Charts that stand side by side where there is room; folded away under a ``title``."""

    kind: ClassVar[str] = "charts"
    charts: Sequence[Chart]
    title: str = ""


@dataclass(frozen=True)
class Text:
    """A text as it is, such as a file; folded away unless ``open``."""

    kind: ClassVar[str] = "text"
    title: str
    text: str
    open: bool = False


@dataclass(frozen=True)
class SideBySide:
    """Paragraphs with a picture at their side, below them where there is no room."""

    kind: ClassVar[str] = "beside"
    prose: Prose
    image: Image


Block = SideBySide | Prose | Notices | Tiles | PageTable | Gallery | Chart | Charts | Text


@dataclass(frozen=True)
class PageSection:
    """A titled part of a page."""

    title: str
    blocks: Sequence[Block] = field(default=())

    @property
    def anchor(self) -> str:
        """Its name in links."""
        words = "".join(c if c.isalnum() else " " for c in self.title.lower()).split()
        return "-".join(words)


@dataclass(frozen=True)
class Page:
    """One report."""

    title: str
    subtitle: str
    sections: Sequence[PageSection]
