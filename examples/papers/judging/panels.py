"""Sheets of panels as papers lay out their figures: rows, some on one scale, orbits square."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from matplotlib.axes import Axes

from flexcage.render import sheet
from judging.readings import NoRuns

WIDE, HIGH, SQUARE, LEFT, TOP, GAP_X, GAP_Y = 440, 220, 230, 110, 110, 105, 115  # px, of panels


@dataclass(frozen=True)
class Panel:
    """One panel: its title, axis names, what draws it, and with which panels it shares a scale."""

    title: str
    below: str
    unit: str
    draw: Callable[[Axes], None]
    scale: str = ""
    square: bool = False


def sheet_of(path: Path, title: str, rows: Sequence[Sequence[Panel]]) -> str:
    """Rows of panels, those of one scale on it; the file's name."""
    sides = [SQUARE if row[0].square else WIDE for row in rows]
    highs = [SQUARE if row[0].square else HIGH for row in rows]
    wide = max(len(row) * (side + GAP_X) for row, side in zip(rows, sides))
    groups: dict[str, list[Axes]] = {}
    with sheet.style():
        figure = sheet.new_figure(LEFT + wide, TOP + sum(high + GAP_Y for high in highs))
        sheet.heading(figure, title, "")
        top = TOP
        for row, side, high in zip(rows, sides, highs):
            for k, panel in enumerate(row):
                ax = sheet.axes_at(figure, (LEFT + k * (side + GAP_X), top, side, high))
                panel.draw(ax)
                ax.set_title(panel.title, loc="left", fontsize=10)
                ax.set(xlabel=panel.below, ylabel=panel.unit)
                groups.setdefault(panel.scale or str(id(ax)), []).append(ax)
            top += high + GAP_Y
        for axes in groups.values():
            same_scale(axes)
        sheet.save(figure, path)
    return path.name


def sheets_of(
    folder: Path, rows: Mapping[str, Callable[[], Sequence[Sequence[Panel]]]]
) -> dict[str, str]:
    """Sheets of a paper's figures by key, as "7_9" for Figures 7 to 9; names of their files."""
    found = {}
    for key, panels in rows.items():
        path = folder / f"figure_{key}.png"
        title = titled(key)
        found[key] = kept(path, lambda path=path, title=title, panels=panels: sheet_of(
            path, title, panels()))  # fmt: skip
    return found


def titled(key: str) -> str:
    """The title of a sheet of figures, as "Figures 7 to 9" of "7_9"."""
    first, _, last = key.partition("_")
    if not last:
        return f"Figure {first}"
    return f"Figures {first} {'and' if int(last) == int(first) + 1 else 'to'} {last}"


def kept(path: Path, draw: Callable[[], str]) -> str:
    """What ``draw`` makes; where it needs runs that are not there, the picture that is."""
    try:
        return draw()
    except NoRuns:
        if not path.is_file():
            raise
        return path.name


def same_scale(axes: Sequence[Axes]) -> None:
    """Give axes the limits that all of them need."""
    low, high = zip(*(ax.get_ylim() for ax in axes))
    for ax in axes:
        ax.set_ylim(min(low), max(high))


def empty(ax: Axes, x: tuple[float, float], y: tuple[float, float]) -> None:
    """Make an axis a sheet to sketch on, in equal units between limits."""
    ax.set(xlim=x, ylim=y, aspect="equal")
    ax.axis("off")


def note(ax: Axes, text: str, place: tuple[float, float], **how: Any) -> None:
    """A text of a sketch."""
    ax.text(*place, text, **{"fontsize": 10, "ha": "center", "va": "center", **how})


def arrow(ax: Axes, start, end, text: str, *, colour: str = sheet.INK) -> None:
    """An arrow with its symbol at its beginning."""
    ax.annotate("", end, start, arrowprops={"arrowstyle": "->", "color": colour, "lw": 1.4})
    ax.text(*start, text, color=colour, fontsize=10, ha="center", va="bottom")
