"""Rings that bend in a run, from those of the static solution at its start."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from flexcage.geometry.bearing import Bearing
from flexcage.modes.ring import natural_frequencies
from flexcage.system.layout import Layout
from flexcage.system.rings.low_modes import (
    Coordinates,
    low_modes,
    modes_of_ring,
    residual_compliance,
    ring_coordinates,
    ring_with_modes,
)
from flexcage.system.rings.modes_data import RingModes, no_modes
from flexcage.system.rings.races import C11, C22, POINTS, RacesData, rigid_rings
from flexcage.system.statics.rings import BentRing, Rings
from flexcage.system.statics.solution import StaticSolution

SIDES = ("inner", "outer")
_FAINT = 1e-4  # share of a deflection that elements far away make and may be left out
_LOW = 3  # waves around a ring up to which its frequencies are looked at
_OVAL = 2  # waves from which on a ring's motion is no rigid one, and couples with none
#: What lets a ring move as a whole on its seat.
_WANTS = {
    "inner": 'load.shaft_mass gives that, and with load.tilt = "held" the ring moves by itself',
    "outer": "mount.mass gives that",
}
_STIFF = 2.0 * np.pi * 10e3  # [rad/s] assumption: rings with lower frequencies have modes


@dataclass(frozen=True, eq=False)
class MovingRings:
    """The rings that bend in a run: what kernels read, and the static solution at the start."""

    data: RacesData
    modes: tuple[RingModes, RingModes]  # of inner and outer ring
    coordinates: tuple[Coordinates | None, Coordinates | None]  # where they have any
    start: StaticSolution
    warnings: tuple[str, ...] = ()  # sentences

    @property
    def at_start(self) -> tuple[np.ndarray, np.ndarray]:
        """Where the modes (M,) of either ring are."""
        inner, outer = (np.zeros(0) if c is None else c.at_start for c in self.coordinates)
        return inner, outer

    @property
    def counts(self) -> tuple[int, int]:
        """So many modes of inner and outer ring."""
        inner, outer = self.at_start
        return len(inner), len(outer)

    def begun(self, y: np.ndarray, layout: Layout) -> np.ndarray:
        """A copy of y, with the modes where they are at the start."""
        begun = y.copy()
        for name, at in zip(SIDES, self.at_start):
            layout.q(begun)[f"{name}_modes"][:] = at
        return begun

    def with_inertia(self, model: Any, bearing: Bearing) -> Any:
        """The ``model`` of a bearing, whose rings have the inertia of their finite elements where
        these have modes."""
        made = {}
        for name, modes in zip(SIDES, self.coordinates):
            if modes is not None:
                key = f"{name}_ring"
                rigid = [getattr(bearing, f"{key}_mass"), *getattr(bearing, f"{key}_inertia")]
                made[key] = ring_with_modes(getattr(model, key), np.array(rigid), modes)
        return model._replace(**made)


def moving_rings(
    rings: Rings, solution: StaticSolution, *, whole: tuple[bool, bool] = (False, True)
) -> MovingRings:
    """Rings as they are asked for, reduced as in the static ``solution`` of the run's start: its
    heaviest contact says over what extent, and its contact angles where, races are pressed. A ring
    that is soft on its seat has modes; ``whole``: those in which it moves as a whole as well, as it
    does on a seat that stands, or is not lighter than itself (of inner, outer ring)?"""
    count = len(solution.elements.azimuth)
    data, modes, sentences = rigid_rings(count), [no_modes(count), no_modes(count)], []
    found: list[Coordinates | None] = [None, None]
    for bent in solution.rings:
        side, reduction = SIDES.index(bent.side), bent.seated.reduction
        spec, yields = (rings.inner, rings.outer)[side], reduction.compliance
        least = 0 if whole[side] else _OVAL
        if len(bent.bears) or _lowest(bent, range(least, _LOW + 1)) < _STIFF:
            low = low_modes(reduction, least=least)
            made = found[side] = ring_coordinates(bent, low)
            modes[side] = modes_of_ring(bent.seated, low, made, spec.relaxation)
            yields = residual_compliance(reduction, low)
        if not whole[side] and (lowest := _lowest(bent, range(_OVAL))) < _STIFF:
            sentences.append(_moves_with_seat(bent.side, lowest))
        _put(data, bent, yields, spec.relaxation)
    return MovingRings(data, (modes[0], modes[1]), (found[0], found[1]), solution, tuple(sentences))


def _put(data: RacesData, bent: BentRing, yields: np.ndarray, relaxation: float) -> None:
    """A ring among the data, with a compliance (N + 1, 3, 3) that follows at once."""
    reduction, side = bent.seated.reduction, SIDES.index(bent.side)
    azimuth = 2.0 * np.pi * np.arange(POINTS) / POINTS
    compliance, slope = (
        reduction.series(reduction.weight, yields[:, :2, :2], azimuth, slope=slope)
        for slope in (False, True)
    )
    table, own = np.hstack([_entries(compliance), _entries(slope)]), compliance[:, :, 0]
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


def _lowest(ring: BentRing, waves: range) -> float:
    """Frequency [rad/s] of the lowest mode of a ring on its seat with so many waves around it."""
    reduction = ring.seated.reduction
    return min(natural_frequencies(reduction.model, reduction.held, n, 1)[0] for n in waves)


def _moves_with_seat(side: str, lowest: float) -> str:
    """Of a ring that is soft on a light seat."""
    return (
        f"the {side} ring vibrates on its seat as a whole at {lowest / (2e3 * np.pi):.2g} kHz, but "
        "in this run its mass moves with the seat, as nothing there is known to be as heavy as the "
        f"ring; {_WANTS[side]}."
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
