"""What all plotly figures of a page share: layout, colours, and curves thinned to what is seen."""

from __future__ import annotations

from html import escape
from typing import Any

import numpy as np

from flexcage.render.sheet import CYCLE, FAINT, INK
from flexcage.report.thinning import thinned

FONT = {"family": 'system-ui, "DejaVu Sans", Arial, sans-serif', "size": 13, "color": INK}
_AXIS = {
    "gridcolor": "#e4e4e4", "zerolinecolor": "#c9c9c9", "linecolor": INK, "showline": True,
    "ticks": "outside", "automargin": True, "exponentformat": "none",
    "separatethousands": True,
}  # fmt: skip


def plain(text: str) -> str:
    """Text as plotly shows it, which reads a few HTML tags in names and titles."""
    return escape(text, quote=False)


def new_figure(x: str, y: str, **layout: Any) -> Any:
    """An empty plotly figure with titled axes, its legend above; the page's script makes a chart
    higher by what its legend takes beyond one line, up to ``maxheight`` pixels."""
    import plotly.graph_objects as go

    figure = go.Figure()
    figure.update_layout(
        template="none",
        font=FONT,
        margin={"l": 58, "r": 40, "t": 30, "b": 46},  # right: the buttons stand beside the plot
        legend={
            "orientation": "h", "x": 0.0, "y": 1.02, "yanchor": "bottom", "maxheight": 320,
        },
        hovermode="closest",
        hoverlabel={"bgcolor": "white", "font": FONT},
        modebar={"orientation": "v", "color": FAINT},
        xaxis={**_AXIS, "title": {"text": x, "standoff": 8}},
        yaxis={**_AXIS, "title": {"text": y, "standoff": 8}},
        colorway=list(CYCLE),
    )  # fmt: skip
    return figure.update_layout(**layout)


def add_curve(figure: Any, x: np.ndarray, y: np.ndarray, name: str, **line: Any) -> None:
    """Add ``y`` over ``x`` as a line, thinned; more of ``line`` goes to plotly."""
    kept = thinned(np.asarray(y, float))
    figure.add_scatter(
        x=_short(x[kept]),
        y=_short(y[kept]),
        name=plain(name),
        mode="lines",
        line={"width": 1.3, **line},
    )


def add_band(
    figure: Any, x: np.ndarray, low: np.ndarray, high: np.ndarray, name: str, colour: str
) -> None:
    """Add the band between two curves, thinned."""
    for values, fill in ((low, None), (high, "tonexty")):
        kept = thinned(np.asarray(values, float))
        figure.add_scatter(
            x=_short(x[kept]), y=_short(values[kept]), mode="lines", fill=fill, fillcolor=colour,
            line={"width": 0}, name=plain(name), legendgroup=name, showlegend=fill is not None,
            hoverinfo="skip",
        )  # fmt: skip


def _short(values: np.ndarray) -> np.ndarray:
    """Single precision: more digits than a screen shows, in half the bytes."""
    return np.asarray(values, np.float32)
