"""Fatigue of a cage at its named places: signed stress, rainflow cycles, damage and life.

Equivalent stress is never negative and would count a reversal twice. What is counted instead is the
normal stress on a plane fixed in the material, at the point and on the plane where half the range
plus the mean stress sensitivity times the middle is largest: the critical plane of materials that
crack under tension (D. F. Socie and G. B. Marquis, Multiaxial Fatigue, SAE 2000). Von Mises' stress
with the sign of the trace is an alternative, but jumps from plus to minus where the trace passes
through zero, and counts cycles that are not there. Shear governs the first cracks of ductile
metals: for them this choice needs a curve of the same kind of stress, such as that of bending.

The cage is linear elastic, surfaces are those of the S-N curve's specimens, and neither size nor
stress gradient helps: nothing but the local stress and the curve enters.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from math import isfinite

import numpy as np

from flexcage.core.binding import did_you_mean
from flexcage.core.digits import texts_with_margin
from flexcage.core.errors import InputError
from flexcage.core.listing import aligned, wrapped
from flexcage.results.bootstrap import NO_INTERVAL
from flexcage.results.statistics import Record, Windows
from flexcage.stress.counting import (
    Loops,
    corrected_amplitude,
    count,
    damage,
    equivalent_amplitude,
    joined,
    require_pylife,
)
from flexcage.stress.sn_curves import SNCurve, of_other

_DIRECTIONS = 64  # planes looked at first, spread evenly
_STEPS = np.radians([10.0, 5.0, 2.5, 1.25])  # by which the best one is turned then
_HOUR = 3600.0
_HEADS = (
    "place", "damage/h", "±", "life, h", "cycles/s", "from MPa", "to MPa", "once a turn, MPa",
)  # fmt: skip
_LONG = 1e9  # hours that no cage is asked for


@dataclass(frozen=True, eq=False)
class CountedStress:
    """The normal stress that is counted: ``point`` (a row of the place's), the plane's normal (3,)
    in the cage's frame, and its history (nt,) [Pa]."""

    point: int
    normal: np.ndarray
    stress: np.ndarray


@dataclass(frozen=True, eq=False)
class PlaceFatigue:
    """What the cycles at one place amount to.

    ``rate`` holds damage per second by windows of the run; ``largest`` are the ends of the cycle of
    the largest range [Pa] and ``dominance`` the share of damage that the worst single cycle does.
    ``amplitude`` [Pa] at R = -1, once a turn of the cage, does the same damage.
    """

    place: str
    vertex: int  # of the mesh, nearest to the point
    normal: np.ndarray  # (3,) of the plane, cage frame
    rate: Record = field(repr=False)
    cycles: float  # per second
    largest: tuple[float, float]
    amplitude: float
    dominance: float

    @property
    def damage_rate(self) -> float:
        """Damage per second; the place is taken to crack at the sum 1 (Miner)."""
        return self.rate.value

    @cached_property
    def margin(self) -> float:
        """Half the width of the 95 % interval of ``damage_rate`` by the run's windows; NaN for too
        few. Few cycles do most of the damage, so that it is wide, and blind to rarer ones."""
        return self.rate.margin

    @property
    def life_hours(self) -> float:
        """Hours of such operation until the damage is 1; infinite without damage."""
        return 1.0 / (_HOUR * self.damage_rate) if self.damage_rate > 0.0 else float("inf")

    @property
    def largest_range(self) -> float:
        """Range of the largest cycle [Pa]."""
        return self.largest[1] - self.largest[0]


@dataclass(frozen=True, eq=False)
class Fatigue:
    """Fatigue at the places of a cage over ``duration`` [s] of settled motion, with the S-N curve
    used. Mean stress counts by the Haigh diagram of the FKM guideline with the curve's M. ``cage``
    names the cage's material, if it is known."""

    curve: SNCurve
    duration: float
    places: tuple[PlaceFatigue, ...]
    cage: str = ""

    def __iter__(self) -> Iterator[PlaceFatigue]:
        return iter(self.places)

    def __getitem__(self, place: str) -> PlaceFatigue:
        return next(p for p in self.places if p.place == place)

    @property
    def worst(self) -> PlaceFatigue:
        """The place of the largest damage."""
        return max(self.places, key=lambda p: (p.damage_rate, p.largest_range))

    def table(self, rows: int | None = None) -> str:
        """An aligned table of the places (the worst ``rows`` of them), and what stands behind."""
        if rows is not None and rows < 1:
            raise InputError(f"rows is {rows}, but must be at least 1.", where="rows", value=rows)
        order = sorted(self.places, key=lambda p: (-p.damage_rate, -p.largest_range))[:rows]
        lines: list[tuple[str, ...]] = [_HEADS]
        for p in order:
            rate, half = texts_with_margin(p.damage_rate * _HOUR, p.margin * _HOUR)
            lines.append((
                p.place, rate, half or "-", _hours(p.life_hours), f"{p.cycles:.0f}",
                *(f"{stress / 1e6:.2f}" for stress in p.largest),
                f"{p.amplitude / 1e6:.2f}" if isfinite(p.amplitude) else "-",
            ))  # fmt: skip
        said = [aligned(lines, sides="lr", heads=True)]
        if not all(isfinite(p.margin) for p in order):
            said.append(wrapped(NO_INTERVAL))
        if not all(isfinite(p.amplitude) for p in order):
            said.append("No stress once a turn (-): the cage does not turn.")
        return "\n".join([*said, wrapped(self.grounds())])

    def grounds(self) -> str:
        """The S-N curve with its source and what it assumes, and how mean stress counts."""
        c = self.curve
        words = [
            f"{c.material}: {c.amplitude / 1e6:.4g} MPa at {c.cycles:g} cycles (R = -1), slope "
            f"{c.slope:g}, probability of survival {100.0 * c.survival:g} %",
            f"mean stress: FKM Haigh diagram, M = {c.mean_stress_sensitivity:.3g}",
            f"source: {c.source or 'the user'}",
            *of_other(c.material, self.cage),
        ]
        return "\n".join([*words, *([f"assumption: {c.assumption}"] if c.assumption else [])])

    __str__ = table


def _hours(life: float) -> str:
    """A life in hours; beyond any use it is only said to be long."""
    return f"{life:.3g}" if life < _LONG else f"> {_LONG:.0e}"


def normal_stresses(tensors: np.ndarray, normals: np.ndarray) -> np.ndarray:
    """Normal stresses (m, ...) of tensors (6, ...), xx, yy, zz, xy, yz, xz, on planes with the
    unit normals (m, 3)."""
    x, y, z = normals.T
    weights = np.stack([x * x, y * y, z * z, 2 * x * y, 2 * y * z, 2 * x * z], axis=1)
    return np.tensordot(weights.astype(tensors.dtype), tensors, 1)


def counted_stress(tensors: np.ndarray, sensitivity: float) -> CountedStress:
    """The normal stress to count among tensors (6, n, nt) [Pa] at n points of a place, for a
    material of that mean stress sensitivity."""

    def badness(point: int, normals: np.ndarray) -> np.ndarray:
        values = normal_stresses(tensors[:, point], normals)
        low, high = values.min(axis=1), values.max(axis=1)
        return 0.5 * (high - low) + 0.5 * sensitivity * (high + low)

    planes = half_sphere(_DIRECTIONS)
    found = np.stack([badness(p, planes) for p in range(tensors.shape[1])])
    point, best = np.unravel_index(int(np.argmax(found)), found.shape)
    normal = planes[best]
    for step in _STEPS:
        around = _turned(normal, step)
        normal = around[int(np.argmax(badness(int(point), around)))]
    history = normal_stresses(tensors[:, point], normal[None])[0]
    return CountedStress(int(point), normal, history.astype(float))


def half_sphere(count: int) -> np.ndarray:
    """Unit vectors (count, 3) spread evenly over half a sphere (a Fibonacci spiral)."""
    k = np.arange(count) + 0.5
    z, angle = 1.0 - k / count, np.pi * (1.0 + np.sqrt(5.0)) * k
    r = np.sqrt(1.0 - z * z)
    return np.stack([r * np.cos(angle), r * np.sin(angle), z], axis=1)


def _turned(normal: np.ndarray, angle: float) -> np.ndarray:
    """The normal itself and eight others (9, 3), turned from it by an angle [rad]."""
    side = np.cross(normal, np.eye(3)[int(np.argmin(np.abs(normal)))])
    side /= np.linalg.norm(side)
    other, azimuth = np.cross(normal, side), 0.25 * np.pi * np.arange(8)[:, None]
    ring = np.cos(azimuth) * side + np.sin(azimuth) * other
    return np.vstack([normal, np.cos(angle) * normal + np.sin(angle) * ring])


def place_fatigue(
    stresses: dict[str, tuple[int, CountedStress]],
    curve: SNCurve,
    windows: Windows,
    *,
    samples: np.ndarray,
    step: float,
    turn: float,
) -> Fatigue:
    """Fatigue by the counted stresses of places, each with its mesh vertex.

    ``windows`` cut the samples, ``step`` [s] apart; ``samples`` (nt,) are those at or after each
    instant of the stresses; ``turn`` [s] is the time of a turn of the cage.
    """
    require_pylife()
    loops = [count(counted.stress) for _, counted in stresses.values()]
    amplitudes = corrected_amplitude(*joined(loops), curve.mean_stress_sensitivity)
    damages = np.split(damage(amplitudes, curve), np.cumsum([len(one) for one in loops])[:-1])
    time = windows.samples * step
    totals = np.array([each.sum() for each in damages])
    even = equivalent_amplitude(totals / time * turn, curve)
    places = [
        _place(name, at, cycles, each, amplitude, windows, samples[cycles.sample], time)
        for (name, at), cycles, each, amplitude in zip(stresses.items(), loops, damages, even)
    ]
    return Fatigue(curve, time, tuple(places))


def _place(
    name: str, at: tuple[int, CountedStress], loops: Loops, each: np.ndarray, amplitude: float,
    windows: Windows, begun: np.ndarray, time: float,
) -> PlaceFatigue:  # fmt: skip
    vertex, counted = at
    rate = np.bincount(begun, each, windows.samples) * (windows.samples / time)
    largest = int(np.argmax(loops.high - loops.low)) if len(loops) else -1
    ends = (loops.low[largest], loops.high[largest]) if len(loops) else (counted.stress[0],) * 2
    total = float(each.sum())
    return PlaceFatigue(
        place=name,
        vertex=vertex,
        normal=counted.normal,
        rate=windows.mean(rate),
        cycles=len(loops) / time,
        largest=(float(ends[0]), float(ends[1])),
        amplitude=float(amplitude),
        dominance=float(each.max()) / total if total > 0.0 else float("nan"),
    )


def chosen_places(place: str | None, names: tuple[str, ...]) -> tuple[str, ...]:
    """All places, or the one asked for; InputError with the nearest name for one not there."""
    if place is None:
        return names
    if place not in names:
        raise InputError(
            f"There is no place '{place}' on this cage; "
            f"{did_you_mean(place, names, 'places are named like')}.",
            where="place",
            value=place,
        )
    return (place,)
