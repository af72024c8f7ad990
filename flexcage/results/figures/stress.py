"""Figures of a flexible cage's stress, of its rivets, of fatigue and of wear.

The room of stress computes what they are taken from: ``Stressed``, its ``Rivets``, damage by
windows, its ``Wear``.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from math import isfinite
from typing import Any

import numpy as np

from flexcage.core.timing import Stages
from flexcage.results.figures.effort import add_wall
from flexcage.results.figures.figure import FigureTable, Found
from flexcage.results.figures.part import pass_peak
from flexcage.results.row import SummaryRow
from flexcage.results.statistics import Record, Windows


@dataclass(frozen=True, kw_only=True, eq=False)
class Stressed:
    """The stress of a cage over a run, as ``stress.history`` has it: the largest of its ``peak``
    (nt,) [Pa] and where that is, in words; the largest at the samples of the settled part
    ``at_sample`` (n,), and of the part before ``start``; that at named ``places`` (n, n_places),
    and their names in words. ``kind`` is what the places are called (``stress.places``)."""

    element: str
    kind: Any
    peak: float
    peak_place: str
    at_sample: np.ndarray
    start: float
    places: np.ndarray
    place_names: tuple[str, ...]
    windows: Windows


def _root(s: Stressed) -> Found:
    roots = s.places.max(axis=0)
    most = int(np.argmax(roots))
    return Found(float(roots[most]), s.place_names[most])


# fmt: off
STRESS = FigureTable[Stressed]("Equivalent stress", "flexible cage")
STRESS.add("stress_peak", "Peak stress, {walls} excluded", "MPa",
           "of the settled part, without the walls of pockets that contacts press on",
           "brief", "large",
           take=lambda s: Found(s.peak, f"{s.peak_place}; {s.kind.left_out} are never searched"))
STRESS.add("stress_mean_peak", "Stress, mean of the cage's peak", "MPa",
           "mean over time of the largest at each instant", "statistic", "brief", "convergence",
           take=lambda s: s.windows.mean(s.at_sample))
STRESS.add("stress_root_pass_peak", "Stress at {place}, peak of a pass", "MPa",
           "at pocket corners or edges: mean of the largest in each element pass",
           "statistic", "large", "convergence",
           take=lambda s: Found(s.windows.peak(s.places.max(axis=1)), pass_peak(s.element)))
STRESS.add("stress_root", "Stress at {place}, largest", "MPa", "at pocket corners or edges",
           take=_root)
STRESS.add("stress_start", "Stress before settling, largest", "MPa",
           "largest of the part left out", take=lambda s: s.start)
#: Wall time of these figures.
STRESS_TIME = FigureTable[Stages](STRESS.section, "flexible cage")
add_wall(STRESS_TIME, "stress", "effort")
# fmt: on


def stress_rows(s: Stressed) -> tuple[SummaryRow, ...]:
    """The section of the stress."""
    return STRESS.rows(s, words={"walls": s.kind.walls, "place": f"a {s.kind.one}"})


def _rivet(name: str, note: str, rivets: Any) -> Found:
    value, rivet = rivets.largest(name)
    return Found(value, f"rivet {rivet}{note}")


_ALONE = "; of a shank that bears all that goes from half to half, without its head's clamping"

# fmt: off
RIVETS = FigureTable[Any]("Rivets", "riveted cage")
for _name, _title, _unit, _meaning, _note in (
    ("tension", "Rivet tension, largest", "N", "of a rivet", ""),
    ("shear", "Rivet shear, largest", "N", "of a rivet", ""),
    ("stress", "Rivet stress, largest nominal", "MPa", "of a shank that bears all alone", _ALONE),
):
    RIVETS.add(f"rivet_{_name}", _title, _unit, _meaning, take=partial(_rivet, _name, _note))
RIVETS_TIME = FigureTable[Stages](RIVETS.section, "riveted cage")
add_wall(RIVETS_TIME, "rivets")
# fmt: on


def _life(damage: Record) -> Found:
    rate, half = damage.value, damage.margin
    if not rate > 0.0:
        return Found(float("inf"))
    life = 1.0 / rate
    return Found(life, margin=life * half / rate if isfinite(half) else None)


# fmt: off
DAMAGE = FigureTable[Record]("Fatigue", "fatigue")
DAMAGE.add("fatigue_damage_rate", "Fatigue damage rate", "1/h", "at the worst named place",
           "statistic", take=lambda damage: damage)
DAMAGE.add("fatigue_life", "Fatigue life", "h", "its inverse", "statistic", take=_life)
TRACKS = FigureTable[Any]("Wear", "wear")
TRACKS.add("wear_volume_rate", "Wear, volume", "mm^3/h", "of all pockets",
           take=lambda wear: wear.volume_rate)
TRACKS.add("wear_depth_rate", "Wear, depth", "um/h", "of the deepest track, at first",
           take=lambda wear: wear.depth_rate)
