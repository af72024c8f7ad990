"""Figures of a flexible cage's stress, of its rivets, of fatigue and of wear.

The room of stress computes what they are taken from; each ``Protocol`` says what that has.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import partial
from math import isfinite
from typing import Any, Protocol

import numpy as np

from flexcage.results.figures.effort import add_wall
from flexcage.results.figures.figure import (
    BRIEF,
    CONVERGENCE,
    EFFORT,
    FATIGUE,
    FLEXIBLE,
    LARGE,
    RIVETED,
    STATISTIC,
    WEAR,
    Facts,
    Found,
    Table,
)
from flexcage.results.figures.part import pass_peak
from flexcage.results.statistics import Record, Windows


@dataclass(frozen=True, kw_only=True, eq=False)
class Stressed(Facts):
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

    @property
    def words(self) -> Mapping[str, str]:
        return {"walls": self.kind.walls, "place": f"a {self.kind.one}"}


STRESS = Table[Stressed]("Equivalent stress", needs=FLEXIBLE)


@STRESS.figure(
    "Peak stress, {walls} excluded", "MPa",
    "of the settled part, without the walls of pockets that contacts press on", BRIEF, LARGE,
)  # fmt: skip
def stress_peak(s: Stressed) -> Found:
    return Found(s.peak, f"{s.peak_place}; {s.kind.left_out} are never searched")


@STRESS.figure(
    "Stress, mean of the cage's peak", "MPa", "mean over time of the largest at each instant",
    STATISTIC, BRIEF, CONVERGENCE,
)  # fmt: skip
def stress_mean_peak(s: Stressed) -> Record:
    return s.windows.mean(s.at_sample)


@STRESS.figure(
    "Stress at {place}, peak of a pass", "MPa",
    "at pocket corners or edges: mean of the largest in each element pass",
    STATISTIC, LARGE, CONVERGENCE,
)  # fmt: skip
def stress_root_pass_peak(s: Stressed) -> Found:
    return Found(s.windows.peak(s.places.max(axis=1)), pass_peak(s.element))


@STRESS.figure("Stress at {place}, largest", "MPa", "at pocket corners or edges")
def stress_root(s: Stressed) -> Found:
    roots = s.places.max(axis=0)
    most = int(np.argmax(roots))
    return Found(float(roots[most]), s.place_names[most])


@STRESS.figure("Stress before settling, largest", "MPa", "largest of the part left out")
def stress_start(s: Stressed) -> float:
    return s.start


#: Wall time of these figures.
STRESS_TIME = Table[Any](STRESS.section, needs=FLEXIBLE)
add_wall(STRESS_TIME, "stress", EFFORT)


class Rivets(Protocol):
    """Loads of the rivets over a run (``stress.rivets``)."""

    def largest(self, figure: str = ...) -> tuple[float, int]:
        """The largest tension or shear [N], or nominal stress [Pa], and its rivet."""


@dataclass(frozen=True, eq=False)
class Riveted(Facts):
    """A cage with rivets."""

    rivets: Rivets


def _rivet(name: str, note: str, riveted: Riveted) -> Found:
    value, rivet = riveted.rivets.largest(name)
    return Found(value, f"rivet {rivet}{note}")


_ALONE = "; of a shank that bears all that goes from half to half, without its head's clamping"

RIVETS = Table[Riveted]("Rivets", needs=RIVETED)
for _name, _title, _unit, _meaning, _note in (
    ("tension", "Rivet tension, largest", "N", "of a rivet", ""),
    ("shear", "Rivet shear, largest", "N", "of a rivet", ""),
    ("stress", "Rivet stress, largest nominal", "MPa", "of a shank that bears all alone", _ALONE),
):
    RIVETS.add(f"rivet_{_name}", _title, _unit, _meaning, take=partial(_rivet, _name, _note))

RIVETS_TIME = Table[Any](RIVETS.section, needs=RIVETED)
add_wall(RIVETS_TIME, "rivets")


@dataclass(frozen=True, eq=False)
class Damaged(Facts):
    """Damage by time [1/s] at the worst place of a cage, by windows of the run."""

    rate: Record


DAMAGE = Table[Damaged]("Fatigue", needs=FATIGUE)


@DAMAGE.figure("Fatigue damage rate", "1/h", "at the worst named place", STATISTIC)
def fatigue_damage_rate(damaged: Damaged) -> Record:
    return damaged.rate


@DAMAGE.figure("Fatigue life", "h", "its inverse", STATISTIC)
def fatigue_life(damaged: Damaged) -> Found:
    rate, half = damaged.rate.value, damaged.rate.margin
    if not rate > 0.0:
        return Found(float("inf"))
    life = 1.0 / rate
    return Found(life, margin=life * half / rate if isfinite(half) else None)


class Worn(Protocol):
    """Rates of wear over a run (``stress.wear``)."""

    @property
    def volume_rate(self) -> float:
        """Of all pockets [m^3/s]."""

    @property
    def depth_rate(self) -> float:
        """Of the deepest track, at first [m/s]."""


@dataclass(frozen=True, eq=False)
class Rubbed(Facts):
    """A cage whose pockets wear."""

    wear: Worn


TRACKS = Table[Rubbed]("Wear", needs=WEAR)


@TRACKS.figure("Wear, volume", "mm^3/h", "of all pockets")
def wear_volume_rate(rubbed: Rubbed) -> float:
    return rubbed.wear.volume_rate


@TRACKS.figure("Wear, depth", "um/h", "of the deepest track, at first")
def wear_depth_rate(rubbed: Rubbed) -> float:
    return rubbed.wear.depth_rate
