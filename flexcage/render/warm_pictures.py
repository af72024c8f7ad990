"""How a bearing warms up: temperatures and losses over the iterations, side by side."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.geometry.heat.network import TITLES
from flexcage.render import sheet

_SIDE, _HEIGHT, _TOP, _LEFT, _GAP = 620, 470, 130, 100, 120
_KEY = 300  # pixels for the names beside the bars
_MARKS = "osD^v<>"


def warm_picture(
    temperatures: Mapping[str, Sequence[float]], losses: Mapping[str, Sequence[float]],
    path: str | Path, *, title: str = "", note: str = "",
) -> Path:  # fmt: skip
    """Temperatures [degC] by body and losses [W] by place, one value an iteration."""
    with sheet.style():
        width = _LEFT + 2 * _SIDE + _GAP + _KEY
        figure = sheet.new_figure(width, _TOP + _HEIGHT + 150)
        sheet.heading(figure, f"Warming up: {sheet.label(title)}", note.replace("$", r"\$"))
        left = sheet.axes_at(figure, (_LEFT, _TOP, _SIDE, _HEIGHT))
        _temperatures(left, temperatures)
        right = sheet.axes_at(figure, (_LEFT + _SIDE + _GAP, _TOP, _SIDE, _HEIGHT))
        _losses(right, losses)
        return sheet.save(figure, path)


def _temperatures(ax: Any, temperatures: Mapping[str, Sequence[float]]) -> None:
    for k, (body, values) in enumerate(temperatures.items()):
        at, colour = np.arange(1, len(values) + 1), sheet.CYCLE[k % len(sheet.CYCLE)]
        name = TITLES.get(body, body)
        style = "-" if k < len(sheet.CYCLE) else "--"
        ax.plot(at, values, style, color=colour, marker=_MARKS[k % len(_MARKS)], ms=4.0, label=name)
    _iterations(ax, max(map(len, temperatures.values())))
    ax.set_title("Temperature [°C]", loc="left")
    ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=4)


def _losses(ax: Any, losses: Mapping[str, Sequence[float]]) -> None:
    count = max(map(len, losses.values()))
    base, at = np.zeros(count), np.arange(1, count + 1)
    for k, (place, values) in enumerate(losses.items()):
        colour = sheet.CYCLE[k % len(sheet.CYCLE)]
        ax.bar(at, values, bottom=base, color=colour, width=0.7, label=place)
        base = base + np.array(values)
    _iterations(ax, count)
    ax.set_title("Losses by place [W]", loc="left")
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0))


def _iterations(ax: Any, count: int) -> None:
    from matplotlib.ticker import MaxNLocator

    ax.xaxis.set_major_locator(MaxNLocator(integer=True))
    ax.set_xlim(0.5, count + 0.5)
    ax.set_xlabel("iteration")
