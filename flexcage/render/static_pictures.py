"""The static solution as polar diagrams: loads and contact angles of the rolling elements."""

from __future__ import annotations

from math import pi
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.render import sheet

_SIDE, _TOP, _LEFT, _GAP = 560, 230, 100, 190
_NAMES = ("inner race", "outer race")
_MARKS = ("o", "^")  # of elements of one row and another


def static_picture(
    azimuth: np.ndarray,
    force: np.ndarray,
    angle: np.ndarray,
    pressure: np.ndarray,
    path: str | Path,
    *,
    load: np.ndarray,
    title: str = "",
    note: str = "",
    speed: float = 0.0,
) -> Path:
    """Forces (Z, 2) [N] and contact angles (Z, 2) [rad] at azimuths (Z,), inner race first.

    Where no angle differs from 0, as in roller bearings, pressures [Pa] take their place. ``load``
    (5,) is drawn as an arrow if it has a radial part.
    """
    angles = bool(np.nanmax(np.abs(angle), initial=0.0) > 0.0)
    with sheet.style():
        figure = sheet.new_figure(2 * _LEFT + 2 * _SIDE + _GAP, _TOP + _SIDE + 140)
        facts = [sheet.label(note), f"axial load {load[0]:.5g} N" if load[0] else ""]
        radial = float(np.hypot(load[1], load[2]))
        facts.append(f"radial load {radial:.5g} N" if radial else "")
        facts.append(f"inner ring at {speed * 30.0 / pi:.5g} rpm")
        sheet.heading(figure, f"Static solution: {sheet.label(title)}", sheet.join(facts))
        left = _panel(figure, 0, "Load of a rolling element [N]")
        _curves(left, azimuth, force)
        if radial:
            _arrow(left, float(np.arctan2(load[2], load[1])))
        right = _panel(figure, 1, "Contact angle [deg]" if angles else "Largest pressure [MPa]")
        _curves(right, azimuth, np.degrees(angle) if angles else 1e-6 * pressure)
        left.legend(
            loc="upper center", bbox_to_anchor=(0.5 + 0.5 * (1.0 + _GAP / _SIDE), -0.10), ncols=3
        )
        return sheet.save(figure, path)


def _panel(figure: Any, k: int, label: str) -> Any:
    """Polar axes seen against the x axis: y upwards, azimuth from y towards z, to the left."""
    from matplotlib.patheffects import Normal, Stroke
    from matplotlib.ticker import MaxNLocator

    rect = (_LEFT + k * (_SIDE + _GAP), _TOP, _SIDE, _SIDE)
    ax = sheet.axes_at(figure, rect, projection="polar")
    ax.set_theta_zero_location("N")  # type: ignore[attr-defined]
    ax.set_title(label, pad=16, weight="bold")
    marks = [f"{45 * k}°" for k in range(8)]
    marks[0], marks[2] = "y, 0°", "z, 90°"
    ax.set_xticks(np.arange(8) * pi / 4.0, marks)
    ax.tick_params(axis="x", pad=11)
    ax.set_rlabel_position(202.5)  # type: ignore[attr-defined]
    ax.yaxis.set_major_locator(MaxNLocator(5))
    halo = [Stroke(linewidth=2.5, foreground="white"), Normal()]
    for text in ax.get_yticklabels():
        text.set_path_effects(halo)
    return ax


def _curves(ax: Any, azimuth: np.ndarray, values: np.ndarray) -> None:
    """One curve a race and row; the outer dashed, so that one shows where both are alike."""
    most, least = float(np.nanmax(values)), min(float(np.nanmin(values)), 0.0)
    starts = [0, *(np.flatnonzero(np.diff(azimuth) < 0.0) + 1), len(azimuth)]
    for row, (first, last) in enumerate(zip(starts[:-1], starts[1:])):
        place = "" if len(starts) == 2 else f", row {row + 1}"
        own = np.append(np.arange(first, last), first)
        ends = azimuth[own] + np.append(np.zeros(last - first), 2.0 * pi)
        styles = ((sheet.BLUE, f"{_MARKS[row]}-", 6.5, 1.4),
                  (sheet.VERMILION, f"{_MARKS[row]}--", 3.5, 1.1))  # fmt: skip
        for side, (colour, form, size, width) in enumerate(styles):
            label = f"{_NAMES[side]}{place}"
            ax.plot(ends, values[own, side], form, color=colour, ms=size, lw=width, label=label)
    ax.set_ylim(1.08 * least, 1.08 * most if most > 0.0 else 1.0)
    ax.spines["polar"].set_edgecolor(sheet.HAIR)


def _arrow(ax: Any, direction: float) -> None:
    """The radial load, as an arrow at the rim, with a line in the legend."""
    from matplotlib.lines import Line2D

    reach = ax.get_ylim()[1]
    form = {"arrowstyle": "-|>", "color": sheet.INK, "lw": 1.8, "shrinkA": 0, "shrinkB": 0}
    ax.annotate(
        "", (direction, 1.10 * reach), (direction, reach), arrowprops=form, annotation_clip=False
    )
    ax.add_line(Line2D([], [], color=sheet.INK, marker="^", ls="none", label="radial load"))
