"""Outputs of a study against its axes: a chart each, with intervals and the cases' names."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from flexcage.render.sheet import CYCLE
from flexcage.report.blocks import Chart
from flexcage.report.plots import new_figure, plain

MOST_LINES = len(CYCLE)  # lines in a chart; with more combinations only points are drawn
_BESIDE = 0.1  # of the distance between two words: how far groups stand apart
_SYMBOLS = ("circle", "square", "diamond", "triangle-up", "x", "star")


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

    Both (n_points,); NaN where there is none.
    """

    title: str
    unit: str
    mean: np.ndarray
    half: np.ndarray


def comparison_charts(
    outputs: Sequence[Output], abscissas: Sequence[Abscissa], names: Sequence[str]
) -> list[Chart]:
    """Every output against every abscissa; ``names`` (n_points,) are what pointing at one shows."""
    return [
        Chart(f"{output.title}, against {abscissa.name}", [("", _figure(output, abscissa, names))])
        for output in outputs
        for abscissa in abscissas
        if np.isfinite(output.mean).any()
    ]


def _figure(output: Output, abscissa: Abscissa, names: Sequence[str]) -> Any:
    figure = new_figure(plain(abscissa.title), f"[{plain(output.unit)}]")
    numeric = all(_is_number(v) for v in abscissa.values)
    words = [] if numeric else list(dict.fromkeys(map(str, abscissa.values)))
    if words:
        ticks, texts = list(range(len(words))), [plain(word) for word in words]
        figure.update_xaxes(tickvals=ticks, ticktext=texts, range=[-0.5, len(words) - 0.5])
    groups = list(dict.fromkeys(abscissa.group))
    if len(groups) > MOST_LINES:
        groups, member = [""], np.zeros(len(abscissa.values), int)
    else:
        member = np.array([groups.index(g) for g in abscissa.group])
    shown = np.isfinite(output.mean)
    for k, group in enumerate(groups):
        points = [i for i in range(len(member)) if member[i] == k and shown[i]]
        if numeric:
            points.sort(key=lambda i: abscissa.values[i])
        once = len({str(abscissa.values[i]) for i in points}) == len(points)
        values, beside = abscissa.values, _BESIDE * (k - 0.5 * (len(groups) - 1))
        lines = abscissa.joined and numeric and once and len(points) > 1
        figure.add_scatter(
            x=[words.index(str(values[i])) + beside if words else float(values[i]) for i in points],
            y=output.mean[points].tolist(),
            error_y=_bars(output.half[points], CYCLE[k]),
            mode="lines+markers" if lines else "markers",
            line={"color": CYCLE[k], "width": 1.3},
            marker={"color": CYCLE[k], "size": 8, "symbol": _SYMBOLS[k]},
            name=plain(group),
            text=[_hover(names[i], output, i) for i in points],
            hovertemplate="%{text}<extra></extra>",
            showlegend=len(groups) > 1,
        )
    return figure


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float, np.number)) and not isinstance(value, bool)


def _bars(half: np.ndarray, colour: str) -> dict[str, Any] | None:
    if not np.isfinite(half).any():
        return None
    known = np.where(np.isfinite(half), half, 0.0).tolist()
    return {"type": "data", "array": known, "color": colour, "thickness": 1.2, "width": 5}


def _hover(name: str, output: Output, point: int) -> str:
    half = output.half[point]
    margin = f" ± {half:.2g}" if np.isfinite(half) else ""
    value = f"{output.mean[point]:.5g}{margin} {plain(output.unit)}"
    return f"{plain(name)}<br>{plain(output.title)}: {value}"
