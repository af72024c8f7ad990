"""One picture of what is measured: the cage between its rings, five lasers, and the symbols."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from judging.panels import empty, note
from matplotlib.axes import Axes
from matplotlib.patches import Circle, Rectangle

from flexcage.render import sheet

STEEL, CAGE, BEAM = "0.85", "#d9c27a", sheet.VERMILION


def draw_sketch(path: Path) -> str:
    """Side and front of bearing, cage and lasers; the file's name."""
    with sheet.style():
        figure = sheet.new_figure(1180, 620)
        sheet.heading(figure, "Five lasers look at a cage that is wider than its rings",
                      "left: cut along the axis; right: from the cage's free end")  # fmt: skip
        _side(sheet.axes_at(figure, (40, 110, 600, 470)))
        _front(sheet.axes_at(figure, (690, 110, 460, 470)))
        sheet.save(figure, path)
    return path.name


def _beam(ax: Axes, start: tuple[float, float], end: tuple[float, float], name: str) -> None:
    ax.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "color": BEAM, "lw": 1.4})
    ax.annotate(name, start, color=BEAM, ha="center", va="bottom", fontsize=10)


def _side(ax: Axes) -> None:
    """The upper half of the bearing in mm, and the cage tilted by an exaggerated angle."""
    for low, high in ((25.0, 30.6), (34.5, 40.0)):
        ax.add_patch(Rectangle((-8.0, low), 16.0, high - low, fc=STEEL, ec="0.4"))
    ax.add_patch(Circle((0.0, 32.5), 4.76, fc="white", ec="0.3", lw=1.2))
    tilt = np.radians(4.0)
    turn = np.array([[np.cos(tilt), -np.sin(tilt)], [np.sin(tilt), np.cos(tilt)]])
    cage = np.array([(-10, 31.2), (10, 31.2), (10, 34.2), (-10, 34.2), (-10, 31.2)]) @ turn.T
    ax.fill(*cage.T, fc=CAGE, ec="0.3", alpha=0.8)
    ax.plot([-14, 20], [22, 22], color="0.3", lw=0.8, ls="-.")
    ends = np.array([(-14.0, 0.0), (20.0, 0.0)]) @ turn.T + (0.0, 22.0)
    ax.plot(*ends.T, color=sheet.BLUE, lw=0.9)
    ax.plot(0, 22, "o", ms=4, color=sheet.BLUE)
    note(ax, "O': cage's centre", (0, 21.0), ha="center", va="top", color=sheet.BLUE)
    note(ax, "bearing axis x", (-14, 22.4), ha="left", va="bottom")
    note(ax, r"tilt $\theta_y$", (20.2, 23.3), ha="left", va="center", color=sheet.BLUE)
    _beam(ax, (9.0, 47.0), (9.0, 35.2), "Y")
    _beam(ax, (23.0, 33.6), (12.0, 33.6), "")
    note(ax, r"$Z_1$", (23.4, 33.6), ha="left", va="center", color=BEAM)
    ax.annotate("", (0, 43), (9, 43), arrowprops={"arrowstyle": "<->", "lw": 0.8})
    note(ax, "l (not printed)", (4.3, 43.4), ha="center", va="bottom")
    ax.plot([0, 0], [22, 44], color="0.5", lw=0.6, ls=":")
    ax.annotate("", (-11.5, 22), (-11.5, 34.6), arrowprops={"arrowstyle": "<->", "lw": 0.8})
    note(ax, "R", (-12.0, 28.0), ha="right", va="center")
    for text, place in (("outer ring", (-7.5, 37.3)), ("inner ring", (-7.5, 27.5))):
        note(ax, text, place, ha="left", va="center")
    empty(ax, (-16.0, 27.0), (17.5, 50.0))


def _front(ax: Axes) -> None:
    """The end face: an oval rim, two radial and three axial lasers, one cage centre off O."""
    angle = np.linspace(0.0, 2.0 * np.pi, 300)
    radius = 34.75 + 2.0 * np.cos(2.0 * (angle - 0.5))
    rim = np.column_stack([radius * np.cos(angle) + 2.0, radius * np.sin(angle) - 1.5])
    ax.fill(*rim.T, fc=CAGE, ec="0.3", alpha=0.8)
    ax.add_patch(Circle((2.0, -1.5), 30.2, fc="white", ec="0.3"))
    ax.add_patch(Circle((0.0, 0.0), 34.75, fill=False, ec="0.4", ls="--", lw=0.8))
    ax.plot(0, 0, "+", ms=8, color=sheet.INK)
    ax.plot(2.0, -1.5, "o", ms=4, color=sheet.BLUE)
    note(ax, "O", (-1.5, 1.0), ha="right", va="bottom")
    note(ax, "O'", (3.4, -1.5), ha="left", va="top", color=sheet.BLUE)
    for k in range(3):
        spot = 32.5 * np.exp(1j * (np.pi / 2.0 + 2.0 * np.pi * k / 3.0))
        ax.plot(spot.real, spot.imag, "o", ms=7, color=BEAM)
        text = 0.82 * spot
        note(ax, rf"$Z_{k + 1}$", (text.real, text.imag), ha="center", va="center", color=BEAM)
    _beam(ax, (0.0, 50.0), (0.0, 36.5), "Y")
    _beam(ax, (52.0, 0.0), (38.0, 0.0), "X")
    note(ax, r"oval rim: $R + a\,\cos 2(\varphi - \varphi_0)$", (0.0, -45.0), ha="center",
          va="center")  # fmt: skip
    empty(ax, (-48.0, 58.0), (-50.0, 58.0))
