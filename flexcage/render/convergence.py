"""How far outputs move with tolerance, slices, modes and mesh: one panel an axis."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from math import isfinite
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.render import sheet

_LEFT, _PANEL, _GAP, _ROW, _TOP = 410, 330, 40, 44, 220
_WIDEST = 100.0  # % shown at most


def convergence_picture(
    records: Sequence[Mapping[str, Any]], path: str | Path, *, name: str = "", goal: float = 0.02
) -> Path:
    """Differences from the finest level in per cent, with 95 % intervals, by output and axis.

    A record holds ``axis``, ``level``, ``finest``, ``label``, ``difference`` and ``spread``
    (relative). The band is ``goal`` wide to each side.
    """
    axes = list(dict.fromkeys(r["axis"] for r in records))
    labels = list(dict.fromkeys(r["label"] for r in records))
    height = _ROW * max(len(labels), 1)
    with sheet.style():
        width = _LEFT + max(len(axes), 1) * (_PANEL + _GAP) + 20
        figure = sheet.new_figure(width, _TOP + height + 90)
        title = sheet.join(["Convergence", sheet.label(name)])
        sheet.heading(figure, title, "against the finest level")
        for i, axis in enumerate(axes):
            rect = (_LEFT + i * (_PANEL + _GAP), _TOP, _PANEL, height)
            panel = sheet.axes_at(figure, rect)
            _panel(panel, [r for r in records if r["axis"] == axis], labels, goal)
            if i:
                panel.set_yticklabels([])
        return sheet.save(figure, path)


def _panel(ax: Any, records: list[Mapping[str, Any]], labels: list[str], goal: float) -> None:
    levels = list(dict.fromkeys(r["level"] for r in records))
    reach = 2.0 * goal
    for k, level in enumerate(levels):
        found = [r for r in records if r["level"] == level and isfinite(r["difference"])]
        spread = np.array([r["spread"] if isfinite(r["spread"]) else 0.0 for r in found])
        difference = np.array([r["difference"] for r in found])
        at = np.array([labels.index(r["label"]) for r in found]) + 0.25 * (k - 0.5)
        ax.errorbar(
            100.0 * difference, at, xerr=100.0 * spread, fmt="o", ms=4, lw=1.2, capsize=2.5,
            color=sheet.CYCLE[k], label=level,
        )  # fmt: skip
        reach = max(reach, float((np.abs(difference) + spread).max(initial=0.0)))
    ax.axvspan(-100.0 * goal, 100.0 * goal, color=sheet.HAIR, alpha=0.5, lw=0)
    limit = min(110.0 * reach, _WIDEST)
    ax.set(xlim=(-limit, limit), ylim=(len(labels) - 0.4, -0.6), xlabel="difference [%]")
    ax.set_yticks(range(len(labels)), labels)
    ax.set_title(records[0]["axis"], loc="left", weight="bold", pad=50)
    ax.legend(
        loc="lower left", bbox_to_anchor=(-0.02, 1.0), borderpad=0.2, alignment="left",
        title=f"against {records[0]['finest']}", title_fontsize="medium",
    )  # fmt: skip
