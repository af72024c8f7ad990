"""Response surfaces of a study: curves over one axis, maps over two, sections through more."""

from __future__ import annotations

from pathlib import Path
from typing import Any, Protocol

import numpy as np

from flexcage.render import sheet

_LEFT, _TOP, _WIDE, _HIGH, _GAP = 120, 170, 560, 460, 150
_CURVE = 101  # places along a section


class DrawnSamples(Protocol):
    """Values of a study's output over its axes (``study.samples``)."""

    @property
    def output(self) -> str: ...
    @property
    def unit(self) -> str: ...
    @property
    def titles(self) -> tuple[str, ...]: ...
    @property
    def x(self) -> np.ndarray: ...
    @property
    def y(self) -> np.ndarray: ...
    def scaled(self, x: np.ndarray) -> np.ndarray: ...
    def unscaled(self, z: np.ndarray) -> np.ndarray: ...


class DrawnSurface(Protocol):
    """What is drawn (``study.surface``)."""

    @property
    def samples(self) -> Any: ...
    @property
    def places(self) -> np.ndarray: ...
    @property
    def models(self) -> Any: ...
    @property
    def optima(self) -> Any: ...
    @property
    def highest(self) -> bool: ...
    def values(self, model: str) -> tuple[np.ndarray, np.ndarray]: ...


def surface_picture(surface: DrawnSurface, path: str | Path) -> Path:
    """One row of panels a model: values, 95 % intervals, the optimum and its region."""
    s = surface.samples
    columns = 1 if len(s.titles) == 2 else len(s.titles)
    rows = list(surface.optima)
    with sheet.style():
        across = len(rows) if columns == 1 else columns
        down = 1 if columns == 1 else len(rows)
        figure = sheet.new_figure(
            _LEFT + across * (_WIDE + _GAP), _TOP + down * (_HIGH + _GAP)
        )  # fmt: skip
        way = "highest" if surface.highest else "least"
        words = f"{len(s.y)} values; where the {way} lies, with 95 % confidence"
        sheet.heading(figure, f"Surface of {s.output}", words)
        for i, model in enumerate(rows):
            for k in range(columns):
                along, below = (i, 0) if columns == 1 else (k, i)
                place = (_LEFT + along * (_WIDE + _GAP), _TOP + below * (_HIGH + _GAP))
                ax = sheet.axes_at(figure, (*place, _WIDE - 40, _HIGH))
                if len(s.titles) == 2:
                    _map(figure, ax, (*place, _WIDE, _HIGH), surface, model)
                else:
                    _section(ax, surface, model, k)
                ax.set_title(model, loc="left", weight="bold")
        return sheet.save(figure, path)


def _section(ax: Any, surface: DrawnSurface, model: str, axis: int) -> None:
    """The surface along one axis through the optimum, the values, and the region's extent."""
    s, fit, optimum = surface.samples, surface.models[model], surface.optima[model]
    z = np.repeat(s.scaled(optimum.place[None]), _CURVE, axis=0)
    z[:, axis] = np.linspace(-1.0, 1.0, _CURVE)
    x, sign = s.unscaled(z)[:, axis], -1.0 if surface.highest else 1.0
    mean, half = sign * fit.mean(z), fit.half(z)
    ax.axvspan(*optimum.box[:, axis], color=sheet.HAIR, alpha=0.5, lw=0, label="95 % region")
    ax.fill_between(x, mean - half, mean + half, color=sheet.SKY, alpha=0.4, lw=0)
    ax.plot(x, mean, color=sheet.BLUE, label="surface, 95 %")
    if len(s.titles) == 1:
        ax.plot(s.x[:, axis], s.y, ".", ms=4, color=sheet.INK, label="values")
    ax.plot(optimum.place[axis], optimum.value, "D", ms=5, color=sheet.VERMILION, label="optimum")
    ax.set(xlabel=s.titles[axis], ylabel=f"{s.output} [{s.unit}]")
    ax.legend(loc="best")


def _map(figure: Any, ax: Any, rect: sheet.Rect, surface: DrawnSurface, model: str) -> None:
    """The surface over two axes as a map, the region hatched."""
    s, optimum = surface.samples, surface.optima[model]
    n = round(len(surface.places) ** 0.5)
    x, y = (column.reshape(n, n) for column in s.unscaled(surface.places).T)
    mean = surface.values(model)[0].reshape(n, n)
    colours = sheet.colour_map("viridis")
    ax.contourf(x, y, mean, 12, cmap=colours)
    ax.contourf(x, y, optimum.inside.reshape(n, n).astype(float), [0.5, 1.5], colors="none",
                hatches=["////"])  # fmt: skip
    (x0, y0), (x1, y1) = optimum.box
    ax.plot([x0, x1, x1, x0, x0], [y0, y0, y1, y1, y0], lw=0.8, color=sheet.VERMILION)
    ax.plot(*s.x.T, ".", ms=3, color="white")
    ax.plot(*optimum.place, "D", ms=6, color=sheet.VERMILION)
    ax.set(xlabel=s.titles[0], ylabel=s.titles[1])
    ax.grid(False)
    left, top, width, high = rect
    sheet.colour_bar(
        figure, (left + width - 25, top, 14, high), cmap=colours, vertical=True,
        limits=(float(mean.min()), float(mean.max())), label=f"{s.output} [{s.unit}]",
    )  # fmt: skip
