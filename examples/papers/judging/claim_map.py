"""A claim's map as a picture: along every unknown, where the claim holds and where not."""

from __future__ import annotations

from collections.abc import Sequence
from math import ceil
from pathlib import Path
from textwrap import wrap

import numpy as np

from flexcage.render import sheet

_COLUMNS, _WIDE, _HIGH, _GAP_X, _GAP_Y = 4, 330.0, 150.0, 60.0, 118.0
_LEFT, _TOP = 100.0, 130.0
_LETTERS, _LINES = 38, 3  # in a line of a range in words, and lines of it
_PARTS = 4  # of a range, over each of which a share is drawn


def draw_claim_map(
    path: str | Path,
    *,
    title: str,
    subtitle: str,
    names: Sequence[str],
    ranges: Sequence[str],
    shares: np.ndarray,
    outcomes: Sequence[bool | None],
) -> Path:
    """Draw a panel for every unknown (points, unknowns) of ``shares`` 0 ... 1 of its range: points
    where the claim holds above, those where it does not below, and the share of the former over
    quarters of the range. Points that decide nothing are left out."""
    known = np.array([found is not None for found in outcomes])
    holds = np.array([bool(found) for found in outcomes])[known]
    rows = ceil(len(names) / _COLUMNS)
    width = _LEFT + min(len(names), _COLUMNS) * (_WIDE + _GAP_X)
    with sheet.style():
        figure = sheet.new_figure(max(width, 900.0), _TOP + rows * (_HIGH + _GAP_Y))
        sheet.heading(figure, title, subtitle)
        for k, (name, words) in enumerate(zip(names, ranges)):
            row, column = divmod(k, _COLUMNS)
            place = (_LEFT + column * (_WIDE + _GAP_X), _TOP + row * (_HIGH + _GAP_Y), _WIDE, _HIGH)
            ax = sheet.axes_at(figure, place)
            _panel(ax, shares[known, k], holds)
            ax.set_title(name, loc="left")
            ax.set_xlabel(_in_lines(words), fontsize=8)
            if column == 0:
                ax.set_ylabel("share")
        return sheet.save(figure, path)


def _in_lines(words: str) -> str:
    """A range in words, broken between its parts; the last line says that there is more."""
    words = words.replace(" %", "\N{NO-BREAK SPACE}%")
    return "\n".join(wrap(words, _LETTERS, max_lines=_LINES, placeholder=" ..."))


def _panel(ax, x: np.ndarray, holds: np.ndarray) -> None:
    """Points of one unknown, and the share of those at which the claim holds."""
    jitter = 0.04 * np.random.default_rng(0).uniform(-1.0, 1.0, len(x))
    for found, colour, at in ((True, sheet.BLUE, 1.12), (False, sheet.VERMILION, -0.12)):
        chosen = holds == found
        ax.plot(x[chosen], at + jitter[chosen], "o", ms=2.6, color=colour, alpha=0.7)
    edges = np.linspace(0.0, 1.0, _PARTS + 1)
    for low, high in zip(edges[:-1], edges[1:]):
        inside = (x >= low) & ((x < high) | (high == 1.0))
        if inside.any():
            ax.plot([low, high], [holds[inside].mean()] * 2, color=sheet.INK, lw=1.6)
    ax.set(xlim=(-0.03, 1.03), ylim=(-0.25, 1.25), xticks=[], yticks=(0.0, 0.5, 1.0))
