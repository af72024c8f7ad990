"""Rings that bend in a run, from those of the static solution at its start."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from flexcage.modes.ring import natural_frequencies
from flexcage.system.bending import C11, C22, POINTS, RingsData, rigid_rings
from flexcage.system.layout import Layout
from flexcage.system.ring_modes import (
    left_over,
    low_modes,
    ring_coordinates,
    swings_of_ring,
)
from flexcage.system.statics.rings import BentRing, Rings
from flexcage.system.statics.solution import StaticSolution
from flexcage.system.swinging import Swings, no_swings

SIDES = ("inner", "outer")
_FAINT = 1e-4  # share of a deflection that elements far away make and may be left out
_LOW = 3  # waves around a ring up to which its frequencies are looked at
_STIFF = 10e3  # [Hz] assumption: rings with lower frequencies are told of


@dataclass(frozen=True, eq=False)
class MovingRings:
    """The rings that bend in a run: what kernels read, and the static solution at the start."""

    data: RingsData
    swings: Swings  # coordinates of the outer ring on supports
    at_start: np.ndarray  # (M,) where they are
    start: StaticSolution
    warnings: tuple[str, ...] = ()  # sentences

    def begun(self, y: np.ndarray, layout: Layout) -> np.ndarray:
        """y, without coordinates or with any, with those of the start."""
        start = np.zeros(layout.size)
        start[: min(len(y), layout.size)] = y
        layout.ring_coordinates(start)[:] = np.stack([self.at_start, 0.0 * self.at_start])
        return start


def moving_rings(rings: Rings, solution: StaticSolution, *, stands: bool = True) -> MovingRings:
    """Rings as they are asked for, reduced as in the static ``solution`` of the run's start: its
    heaviest contact says over what extent, and its contact angles where, races are pressed.
    ``stands``: does the seat of the outer ring stand? Then that ring swings where it is soft."""
    count = len(solution.elements.azimuth)
    data, swings, at_start = rigid_rings(count), no_swings(count), np.zeros(0)
    told: list[str] = []
    for bent in solution.rings:
        spec = (rings.inner, rings.outer)[SIDES.index(bent.side)]
        yields = bent.seated.reduction.compliance
        n, lowest = _lowest(bent)
        if len(bent.bears) or (bent.side == "outer" and stands and lowest < _STIFF):
            modes = low_modes(bent.seated.reduction)
            made = ring_coordinates(bent, modes)
            swings = swings_of_ring(bent.seated, modes, made, spec.relaxation)
            yields, at_start = left_over(bent.seated.reduction, modes), made.at_start
        elif lowest < _STIFF:
            told.append(_too_soft(bent.side, n, lowest))
        _put(data, bent, yields, spec.relaxation)
    return MovingRings(data, swings, at_start, solution, tuple(told))


def _put(data: RingsData, bent: BentRing, yields: np.ndarray, relaxation: float) -> None:
    """A ring among the data, with a compliance (N + 1, 3, 3) that follows at once."""
    reduction, side = bent.seated.reduction, SIDES.index(bent.side)
    azimuth = 2.0 * np.pi * np.arange(POINTS) / POINTS
    apart, slope = (
        reduction.series(reduction.weight, yields[:, :2, :2], azimuth, slope=slope)
        for slope in (False, True)
    )
    table, own = np.hstack([_entries(apart), _entries(slope)]), apart[:, :, 0]
    near = data.near[side] = _reach(table, own, len(bent.azimuth))
    table[near + 1 : POINTS - near] = 0.0
    data.bends[side], data.table[side], data.own[side] = 1, table, _entries(own)
    data.half_space[side] = _entries(reduction.between(np.array(0.0)) - reduction.local)
    data.rate[side] = 1.0 / relaxation
    line = reduction.raceway.line
    data.reach[side] = 1.0, reduction.raceway.extent if line else 1.0
    data.way[:] = np.argmax(bent.seated.to_v, axis=0)


def _reach(table: np.ndarray, own: np.ndarray, elements: int) -> int:
    """Points of a table (POINTS, 6) up to which ``elements`` round a ring feel each other: those
    beyond, all with the same force, would make ``_FAINT`` of the deflection under their ``own``."""
    size = np.abs(table[: POINTS // 2, [C11, C22]]) / np.diag(own)
    beyond = np.cumsum(size.max(axis=1)[::-1])[::-1] * 2.0 * elements / POINTS
    return int(np.count_nonzero(beyond > _FAINT))


def _lowest(ring: BentRing) -> tuple[int, float]:
    """Waves around a ring on its seat, and frequency [Hz], of its lowest mode."""
    reduction = ring.seated.reduction
    found = [natural_frequencies(reduction.model, reduction.held, n, 1)[0] for n in range(_LOW + 1)]
    n = int(np.argmin(found))
    return n, float(found[n]) / (2.0 * np.pi)


def _too_soft(side: str, n: int, lowest: float) -> str:
    """Of a ring that would need its inertia."""
    return (
        f"the {side} ring on its seat has a frequency of {lowest / 1e3:.2g} kHz ({n} waves around "
        "it), but in a run a ring bends without inertia of its own: vibrations above a third of "
        "that are not right."
    )


def held_rings(moving: MovingRings) -> RingsData:
    """Data of races that stay bent as they are at the start, whatever presses."""
    held = rigid_rings(moving.data.moment.shape[1])
    held.way[:] = moving.data.way
    for bent in moving.start.rings:
        held.given[SIDES.index(bent.side)] = bent.deflection @ bent.seated.to_v
    return held


def _entries(compliance: np.ndarray) -> np.ndarray:
    """11, 12 and 22 of symmetric matrices (2, 2, ...), last."""
    return np.moveaxis(compliance[[0, 0, 1], [0, 1, 1]], 0, -1)
