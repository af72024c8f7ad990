"""Outputs of a study against its axes: a chart each, with intervals and the cases' names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from flexcage.core.digits import texts_with_margin
from flexcage.render.sheet import CYCLE
from flexcage.report.blocks import Chart
from flexcage.report.plots import new_figure, plain

MOST_LINES = len(CYCLE)  # lines in a chart; with more combinations only points are drawn
_GROUP_OFFSET = 0.1  # of the distance between two words: between groups, if there are few
_SPREAD = 0.8  # of that distance: how far all groups may reach
_SYMBOLS = ("circle", "square", "diamond", "triangle-up", "x", "star")
MOST_NAMED = 2 * len(_SYMBOLS) * len(CYCLE)  # kinds of marks; with more groups, pointing names one


@dataclass(frozen=True)
class Abscissa:
    """What an output is drawn against: a value or a word for every point of the study.

    ``group`` names for every point the values of all other axes; points of one group are joined.
    """

    title: str
    values: Sequence[Any]
    group: Sequence[str]
    joined: bool = True  # whether lines join a group: not where points are scattered

    @property
    def name(self) -> str:
        """The title without its unit."""
        return self.title.partition(" [")[0]


@dataclass(frozen=True)
class Output:
    """Means of an output over the repetitions of every point, and half widths of their intervals.

    Both (n_points,); NaN where there is none. A ``positive`` output is never below zero, and
    neither are its intervals.
    """

    title: str
    unit: str
    mean: np.ndarray
    half: np.ndarray
    positive: bool = False


def comparison_charts(
    outputs: Sequence[Output], abscissas: Sequence[Abscissa], names: Sequence[str]
) -> list[Chart]:
    """A chart for every output, with a choice of what it is drawn against; pointing at a mark
    shows one of ``names`` (n_points,)."""
    return [
        Chart(
            output.title,
            [(a.name, _figure(output, a, names)) for a in abscissas],
            choose="Against",
        )
        for output in outputs
        if abscissas and np.isfinite(output.mean).any()
    ]


def mark(group: int) -> dict[str, Any]:
    """Colour and symbol of a group; no two of the first ``MOST_NAMED`` are alike."""
    turn, colour = divmod(group, len(CYCLE))
    symbol = _SYMBOLS[(colour + turn) % len(_SYMBOLS)]
    hollow = "-open" if turn % (2 * len(_SYMBOLS)) >= len(_SYMBOLS) else ""
    return {"color": CYCLE[colour], "symbol": symbol + hollow}


def _figure(output: Output, abscissa: Abscissa, names: Sequence[str]) -> Any:
    figure = new_figure(plain(abscissa.title), f"[{plain(output.unit)}]")
    numeric = all(_is_number(v) for v in abscissa.values)
    words = [] if numeric else list(dict.fromkeys(map(str, abscissa.values)))
    if words:
        ticks, texts = list(range(len(words))), [plain(word) for word in words]
        figure.update_xaxes(tickvals=ticks, ticktext=texts, range=[-0.5, len(words) - 0.5])
    groups = list(dict.fromkeys(abscissa.group))
    if len(groups) > MOST_NAMED:
        groups, member = [""], np.zeros(len(abscissa.values), int)
    else:
        member = np.array([groups.index(g) for g in abscissa.group])
    shown = np.isfinite(output.mean)
    for k, group in enumerate(groups):
        points = [i for i in range(len(member)) if member[i] == k and shown[i]]
        if numeric:
            points.sort(key=lambda i: abscissa.values[i])
        once = len({str(abscissa.values[i]) for i in points}) == len(points)
        offset = min(_GROUP_OFFSET, _SPREAD / len(groups))
        values, shift = abscissa.values, offset * (k - 0.5 * (len(groups) - 1))
        few = len(groups) <= MOST_LINES
        lines = abscissa.joined and numeric and once and few and len(points) > 1
        figure.add_scatter(
            x=[words.index(str(values[i])) + shift if words else float(values[i]) for i in points],
            y=output.mean[points].tolist(),
            error_y=_bars(output, points, mark(k)["color"]),
            mode="lines+markers" if lines else "markers",
            line={"color": mark(k)["color"], "width": 1.3},
            marker={**mark(k), "size": 8},
            name=plain(group),
            text=[_hover(names[i], output, i) for i in points],
            hovertemplate="%{text}<extra></extra>",
            showlegend=len(groups) > 1,
        )
    return figure


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float, np.number)) and not isinstance(value, bool)


def _bars(output: Output, points: Sequence[int], colour: str) -> dict[str, Any] | None:
    """Bars of the intervals; those of a positive output end at zero."""
    half = output.half[points]
    if not np.isfinite(half).any():
        return None
    above = np.where(np.isfinite(half), half, 0.0)
    below = np.minimum(above, output.mean[points]) if output.positive else above
    return {
        "type": "data", "array": above.tolist(), "arrayminus": below.tolist(),
        "symmetric": False, "color": colour, "thickness": 1.2, "width": 5,
    }  # fmt: skip


def _hover(name: str, output: Output, point: int) -> str:
    texts = texts_with_margin(output.mean[point], output.half[point])
    value = " ± ".join(filter(None, texts))
    return f"{plain(name)}<br>{plain(output.title)}: {value} {plain(output.unit)}"
