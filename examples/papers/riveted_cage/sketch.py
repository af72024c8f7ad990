"""The rig of the riveted cage, and its bearing, in one picture with the symbols."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from judging.panels import empty, note
from matplotlib.axes import Axes
from matplotlib.patches import Arc, Circle, Rectangle

from flexcage.render import sheet

STEEL, CAGE, LOAD = "0.85", "#d9c27a", sheet.VERMILION


def draw_sketch(path: Path) -> str:
    """The lever of the rig, the bearing's section and a pocket; the file's name."""
    with sheet.style():
        figure = sheet.new_figure(1240, 470)
        sheet.heading(figure, "A lever loads two bearings; a ball sits in two riveted sheets",
                      "left: rig (after Figure 11, its numbers are not printed); middle: section; "
                      "right: pocket from outside")  # fmt: skip
        _rig(sheet.axes_at(figure, (20, 100, 520, 340)))
        _section(sheet.axes_at(figure, (570, 100, 320, 340)))
        _pocket(sheet.axes_at(figure, (910, 100, 320, 340)))
        sheet.save(figure, path)
    return path.name


def _arrow(ax: Axes, start: tuple[float, float], end: tuple[float, float], **how) -> None:
    ax.annotate("", end, start, arrowprops={"arrowstyle": "-|>", "lw": 1.5, "color": LOAD, **how})


def _rig(ax: Axes) -> None:
    ax.add_patch(Rectangle((0, 4.4), 17, 1.2, fc=STEEL, ec="0.4"))
    for x, name in ((4.0, "test"), (8.0, "bearings"), (15.2, "loading bearing")):
        for y in (5.7, 2.9):
            ax.add_patch(Rectangle((x, y), 1.3, 1.4, fc="white", ec="0.3"))
            ax.plot([x, x + 1.3], [y, y + 1.4], color="0.3", lw=0.7)
            ax.plot([x, x + 1.3], [y + 1.4, y], color="0.3", lw=0.7)
        note(ax, name, (x + 0.65, 2.3), fontsize=9)
    _arrow(ax, (15.85, 10.4), (15.85, 7.3))
    note(ax, "F", (16.6, 9.6), color=LOAD)
    _arrow(ax, (8.65, 0.3), (8.65, 1.8))
    _arrow(ax, (4.65, 1.8), (4.65, 0.3))
    ax.annotate("", (8.65, 8.2), (15.85, 8.2), arrowprops={"arrowstyle": "<->", "lw": 0.8})
    note(ax, "lever a", (12.2, 8.7))
    note(ax, r"$F a$ = 82.5 N m;  a = 0.1 m: F = 825 N", (9.0, 11.0))
    ax.annotate("", (1.2, 7.2), (1.2, 2.8), arrowprops={"arrowstyle": "->", "lw": 1.2,
                "connectionstyle": "arc3,rad=-0.5"})  # fmt: skip
    note(ax, "9000 rpm", (1.2, 7.8), fontsize=9)
    empty(ax, (-1.0, 18.5), (-0.3, 11.8))


def _section(ax: Axes) -> None:
    """Upper half in mm: rings, ball, two half sheets of width w, tilted by the moment."""
    ax.add_patch(Rectangle((-5, 7.5), 10, 3.0, fc=STEEL, ec="0.4"))
    ax.add_patch(Rectangle((-5, 15.5), 10, 3.0, fc=STEEL, ec="0.4"))
    ax.add_patch(Circle((0, 13), 3.37, fc="white", ec="0.3", lw=1.3))
    for side in (-1, 1):
        angle = np.linspace(np.radians(68), np.radians(112), 30)
        for turn in (0.0, np.pi):
            at = angle + turn
            x, y = np.cos(at), np.sin(at)
            ax.plot(3.46 * x, 13 + 3.46 * y, color=CAGE, lw=0)
        ax.fill_between([side * 2.0, side * 3.1], [11.1, 11.1], [14.9, 14.9], color=CAGE, lw=0.5)
    ax.annotate("", (-3.1, 19.6), (3.1, 19.6), arrowprops={"arrowstyle": "<->", "lw": 0.8})
    note(ax, "w", (0, 20.2))
    note(ax, r"$D_w$", (0, 13.0))
    note(ax, r"$f_e D_w$", (3.5, 17.0), fontsize=9)
    note(ax, r"$f_i D_w$", (3.5, 9.0), fontsize=9)
    ax.plot([-6, 6], [4.5, 4.5], color="0.3", ls="-.", lw=0.8)
    ax.add_patch(Arc((0, 4.5), 5, 5, theta1=-35, theta2=35, color=LOAD, lw=1.5))
    note(ax, "moment", (4.4, 5.4), color=LOAD, fontsize=9)
    ax.annotate("", (-5.6, 4.5), (-5.6, 13), arrowprops={"arrowstyle": "<->", "lw": 0.8})
    note(ax, r"$d_m/2$", (-6.9, 8.7))
    empty(ax, (-8.0, 8.0), (3.4, 21.0))


def _pocket(ax: Axes) -> None:
    """Two half sheets from outside, a ball, two rivets."""
    for sign in (-1, 1):
        angle = np.linspace(0.0, np.pi, 60)
        inner = np.column_stack([3.46 * np.cos(angle), sign * 3.46 * np.sin(angle)])
        outer = np.column_stack([4.26 * np.cos(angle), sign * 4.26 * np.sin(angle)])
        ax.fill(*np.vstack([inner, outer[::-1]]).T, fc=CAGE, ec="0.3")
        for x in (-7.4, 4.15):
            ax.add_patch(Rectangle((x, min(0.0, sign * 0.8)), 3.25, 0.8, fc=CAGE, ec="0.3"))
    ax.add_patch(Circle((0.05, 0), 3.37, fc="white", ec="0.3"))
    for x in (-5.9, 5.9):
        ax.add_patch(Rectangle((x - 0.6, -0.8), 1.2, 1.6, fc=STEEL, ec="0.3"))
        for y in (-1.5, 0.8):
            ax.add_patch(Rectangle((x - 1.05, y), 2.1, 0.7, fc=STEEL, ec="0.3"))
    ax.annotate("", (-2.45, 2.45), (0, 0), arrowprops={"arrowstyle": "->", "lw": 0.8})
    note(ax, r"$R_p$", (-0.4, 1.4))
    _arrow(ax, (2.0, 0), (3.4, 0))
    note(ax, r"$Q_c$", (2.2, 0.7), color=LOAD)
    note(ax, "rivet 1.2 mm: weak at its head's root", (0, -5.6), fontsize=8)
    note(ax, "t", (-8.0, 0.4))
    empty(ax, (-8.6, 8.6), (-6.5, 6.0))
