"""Pictures that repeated papers have in common."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from shutil import copyfile
from typing import TYPE_CHECKING

import numpy as np
from matplotlib.axes import Axes
from paper_page import Picture

from flexcage.render.claim_map import draw_claim_map

if TYPE_CHECKING:
    from repeat import Computed

STRESS = "stress"  # folder of the pictures of one run


def stress(computed: Computed, folder: Path, title: str, caption: str) -> list[Picture]:
    """The flexible cage's stress at its peak, if that run's pictures are there."""
    found = computed.out / STRESS / "stress_peak.png"
    if not found.is_file():
        return []
    copyfile(found, folder / "stress.png")
    return [Picture("stress.png", title, caption)]


def claim_map(
    computed: Computed, column: str, key: str, path: Path, title: str, of: str = "the map"
) -> Path:
    """Points of a map, ``of`` in words, by whether a claim holds there."""
    joined, found = computed.maps[column], computed.found[column][key]
    return draw_claim_map(
        path, title=title, subtitle=f"claim {key}, {found.share} of {of}", names=joined.names[:-1],
        ranges=joined.ranges, shares=joined.shares, outcomes=found.outcomes,
    )  # fmt: skip


def bands(
    ax: Axes, computed: Computed, output: str, axis: Mapping[str, float], factor: float, *,
    colours: Mapping[str, str], marks: Mapping[str, tuple[str, str]], shift: float,
) -> None:  # fmt: skip
    """Middle 80 % of every map over an axis of conditions, and the starts of every reading.

    ``colours`` of maps, ``marks`` (marker, colour) of readings; ``shift``: of the first reading to
    the left, of the second to the right.
    """
    at = np.array(list(axis.values()))
    for column, joined in computed.maps.items():
        values = np.array([joined.means(output, c) for c in axis]) * factor
        low, mid, high = np.nanpercentile(values, (10.0, 50.0, 90.0), axis=1)
        ax.fill_between(at, low, high, color=colours[column], alpha=0.18, lw=0)
        ax.plot(at, mid, color=colours[column], lw=1.4, label=column)
    for aside, (column, reading) in zip((-shift, shift), computed.readings.items()):
        marker, colour = marks[column]
        for k, c in enumerate(axis):
            found = reading.values(output, c) * factor
            ax.plot(np.full(len(found), at[k] + aside), found, marker, ms=3.0, color=colour,
                    alpha=0.7, ls="none", label=column if k == 0 else None)  # fmt: skip
