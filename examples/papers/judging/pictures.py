"""Pictures that repeated papers have in common."""

from __future__ import annotations

import shutil
from collections.abc import Callable, Mapping
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes

from flexcage.render import sheet

if TYPE_CHECKING:
    from flexcage import Run
    from judging.judge import Sample
    from judging.readings import Reading

Curve = Callable[["Run"], tuple[np.ndarray, np.ndarray]]  # of a run: time [s] and values
COLOURS = (sheet.INK, sheet.BLUE, sheet.VERMILION, sheet.GREEN, "#b07aa1")


def rendered(run: Run, picture: str, path: Path) -> str:
    """A picture of a run by its name, as ``Run.draw`` makes it; the file's name."""
    with TemporaryDirectory() as made:
        run.draw(made, only=[picture])
        shutil.copy(Path(made) / f"{picture}.png", path)
    return path.name


def overlaid(
    ax: Axes, reading: Reading, conditions: Mapping[str, str], curve: Curve, *, start: int = 0
) -> None:
    """One curve a condition on one axis, as papers overlay them; ``conditions`` with their names in
    the legend."""
    for colour, (condition, name) in zip(COLOURS, conditions.items()):
        time, values = curve(reading.run(condition, start))
        ax.plot(time, values, lw=0.9, color=colour, label=name)
    ax.legend(loc="best", fontsize=8, frameon=False)


def bands(
    ax: Axes, sample: Sample, output: str, axis: Mapping[str, float], factor: float, *,
    against: str = "", colour: str = sheet.BLUE, label: str = "settings that the text allows",
) -> None:  # fmt: skip
    """Median and middle 80 % of the settings over an axis of conditions, which lie at its values;
    over what each setting has at the condition ``against``, if one is given.

    A claim of a trend is a claim on each setting, not on this band: see the verdict.
    """
    at = np.array(list(axis.values()))
    values = np.array([sample.means[output, c] for c in axis]) * factor
    if against:
        values = values / (sample.means[output, against] * factor)
    low, mid, high = np.nanpercentile(values, (10.0, 50.0, 90.0), axis=1)
    ax.fill_between(at, low, high, color=colour, alpha=0.18, lw=0)
    ax.plot(at, mid, color=colour, lw=1.6, label=label)


def starts(
    ax: Axes, reading: Reading, output: str, axis: Mapping[str, float], factor: float, *,
    colour: str, label: str, marker: str = "o", shift: float = 0.0, against: str = "",
) -> None:  # fmt: skip
    """Mean of a reading's starts over an axis of conditions, with a bar from least to largest; over
    the mean at the condition ``against``, if one is given."""
    if against:
        factor = 1.0 / float(np.mean(reading.values(output, against)))
    for k, (condition, at) in enumerate(axis.items()):
        found = reading.values(output, condition) * factor
        if not len(found):
            continue
        ax.plot([at + shift] * 2, [found.min(), found.max()], lw=1.2, color=colour)
        ax.plot(at + shift, found.mean(), marker, ms=5.0, color=colour,
                label=label if k == 0 else None)  # fmt: skip
