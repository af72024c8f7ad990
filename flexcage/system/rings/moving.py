"""Rings that bend in a run, from those of the static solution at its start."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from flexcage.modes.ring import natural_frequencies
from flexcage.system.layout import Layout
from flexcage.system.rings.low_modes import (
    left_over,
    low_modes,
    modes_of_ring,
    ring_coordinates,
)
from flexcage.system.rings.modes import RingModes, no_modes
from flexcage.system.rings.races import C11, C22, POINTS, RacesData, rigid_rings
from flexcage.system.statics.rings import BentRing, Rings
from flexcage.system.statics.solution import StaticSolution

SIDES = ("inner", "outer")
_FAINT = 1e-4  # share of a deflection that elements far away make and may be left out
_LOW = 3  # waves around a ring up to which its frequencies are looked at
_STIFF = 10e3  # [Hz] assumption: rings with lower frequencies have modes
_OVAL = 2  # waves from which on a ring's motion is no rigid one, and couples with none


@dataclass(frozen=True, eq=False)
class MovingRings:
    """The rings that bend in a run: what kernels read, and the static solution at the start."""

    data: RacesData
    modes: tuple[RingModes, RingModes]  # of inner and outer ring
    at_start: tuple[np.ndarray, np.ndarray]  # (M,) of each: where they are
    start: StaticSolution
    warnings: tuple[str, ...] = ()  # sentences

    @property
    def counts(self) -> tuple[int, int]:
        """So many modes of inner and outer ring."""
        return len(self.at_start[0]), len(self.at_start[1])

    def begun(self, y: np.ndarray, layout: Layout) -> np.ndarray:
        """A copy of y, with the modes where they are at the start."""
        begun = y.copy()
        for name, at in zip(SIDES, self.at_start):
            layout.q(begun)[f"{name}_modes"][:] = at
        return begun


def moving_rings(rings: Rings, solution: StaticSolution, *, stands: bool = True) -> MovingRings:
    """Rings as they are asked for, reduced as in the static ``solution`` of the run's start: its
    heaviest contact says over what extent, and its contact angles where, races are pressed.
    ``stands``: does the seat of the outer ring stand? A ring that is soft has modes: on a seat that
    moves those that are no rigid motion."""
    count = len(solution.elements.azimuth)
    data, nothing = rigid_rings(count), np.zeros(0)
    found, at_start = [no_modes(count), no_modes(count)], [nothing, nothing]
    told: list[str] = []
    for bent in solution.rings:
        side, reduction = SIDES.index(bent.side), bent.seated.reduction
        spec, least = (rings.inner, rings.outer)[side], 0 if side and stands else _OVAL
        yields = reduction.compliance
        if len(bent.bears) or _lowest(bent, least, _LOW)[1] < _STIFF:
            low = low_modes(reduction, least=least)
            made = ring_coordinates(bent, low)
            found[side] = modes_of_ring(bent.seated, low, made, spec.relaxation)
            yields, at_start[side] = left_over(reduction, low), made.at_start
        n, lowest = _lowest(bent, 0, least - 1) if least else (0, _STIFF)
        if lowest < _STIFF:
            told.append(_too_soft(bent.side, n, lowest))
        _put(data, bent, yields, spec.relaxation)
    return MovingRings(
        data, (found[0], found[1]), (at_start[0], at_start[1]), solution, tuple(told)
    )


def _put(data: RacesData, bent: BentRing, yields: np.ndarray, relaxation: float) -> None:
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


def _lowest(ring: BentRing, least: int, most: int) -> tuple[int, float]:
    """Waves around a ring on its seat, of ``least`` to ``most``, and frequency [Hz], of its lowest
    mode."""
    reduction = ring.seated.reduction
    waves = range(least, most + 1)
    found = [natural_frequencies(reduction.model, reduction.held, n, 1)[0] for n in waves]
    lowest = int(np.argmin(found))
    return waves[lowest], float(found[lowest]) / (2.0 * np.pi)


def _too_soft(side: str, n: int, lowest: float) -> str:
    """Of a ring that would need its inertia in motions that couple with those of its seat."""
    return (
        f"the {side} ring vibrates on its seat as a whole at {lowest / 1e3:.2g} kHz ({n} waves "
        "around it), but in a run the seat moves, and the ring's mass moves with it: vibrations "
        "above a third of that are not right."
    )


def held_rings(moving: MovingRings) -> RacesData:
    """Data of races that stay bent as they are at the start, whatever presses."""
    held = rigid_rings(moving.data.moment.shape[1])
    held.way[:] = moving.data.way
    for bent in moving.start.rings:
        held.given[SIDES.index(bent.side)] = bent.deflection @ bent.seated.to_v
    return held


def _entries(compliance: np.ndarray) -> np.ndarray:
    """11, 12 and 22 of symmetric matrices (2, 2, ...), last."""
    return np.moveaxis(compliance[[0, 0, 1], [0, 1, 1]], 0, -1)
