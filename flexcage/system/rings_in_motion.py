"""Rings that bend in a run, from those of the static solution at its start."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from flexcage.modes.ring import natural_frequencies
from flexcage.system.bending import C11, C22, POINTS, RingsData, rigid_rings
from flexcage.system.statics.rings import BentRing, Rings, SeatedRing
from flexcage.system.statics.solution import StaticSolution

SIDES = ("inner", "outer")
_FAINT = 1e-4  # share of a deflection that elements far away make and may be left out
_LOW = 3  # waves around a ring up to which its frequencies are looked at
_STIFF = 10e3  # [Hz] assumption: rings with lower frequencies are told of


@dataclass(frozen=True, eq=False)
class MovingRings:
    """The rings that bend in a run: what kernels read, and the static solution at the start."""

    data: RingsData
    start: StaticSolution
    warnings: tuple[str, ...] = ()  # sentences


def moving_rings(rings: Rings, solution: StaticSolution) -> MovingRings:
    """Rings as they are ``asked`` for, reduced as in the static ``solution`` of the run's start:
    its heaviest contact says over what extent, and its contact angles where, races are pressed."""
    data = rigid_rings(len(solution.elements.azimuth))
    for bent in solution.rings:
        side = SIDES.index(bent.side)
        spec = (rings.inner, rings.outer)[side]
        reduction = bent.seated.reduction
        data.bends[side] = 1
        table, own = _table(bent.seated), reduction.between(np.array(0.0))
        near = data.near[side] = _reach(table, own, len(solution.elements.azimuth))
        table[near + 1 : POINTS - near] = 0.0
        data.table[side] = table
        data.own[side] = _entries(own)
        data.half_space[side] = _entries(own - reduction.local)
        data.rate[side] = 1.0 / spec.relaxation
        line = reduction.raceway.line
        data.reach[side] = 1.0, reduction.raceway.extent if line else 1.0
        data.way[:] = np.argmax(bent.seated.to_v, axis=0)
    return MovingRings(data, solution, tuple(_warnings(solution.rings)))


def _reach(table: np.ndarray, own: np.ndarray, elements: int) -> int:
    """Points of a table (POINTS, 6) up to which ``elements`` round a ring feel each other: those
    beyond, all with the same force, would make ``_FAINT`` of the deflection under their ``own``."""
    size = np.abs(table[: POINTS // 2, [C11, C22]]) / np.diag(own)
    beyond = np.cumsum(size.max(axis=1)[::-1])[::-1] * 2.0 * elements / POINTS
    return int(np.count_nonzero(beyond > _FAINT))


def _warnings(rings: tuple[BentRing, ...]) -> Iterator[str]:
    """Of rings whose own frequencies are so low that a run would need their inertia."""
    for ring in rings:
        reduction = ring.seated.reduction
        found = [
            natural_frequencies(reduction.model, reduction.held, n, 1)[0] for n in range(_LOW + 1)
        ]
        n, lowest = int(np.argmin(found)), float(min(found))
        if lowest < 2.0 * np.pi * _STIFF:
            yield (
                f"the {ring.side} ring on its seat has a frequency of "
                f"{lowest / (2e3 * np.pi):.2g} kHz ({n} waves around it), but in a run a ring "
                "bends without inertia of its own: vibrations above a third of that are not right."
            )


def held_rings(data: RingsData, rings: tuple[BentRing, ...]) -> RingsData:
    """The same with races that are bent as ``rings`` are, whatever presses on them."""
    held = rigid_rings(data.moment.shape[1])
    held.way[:] = data.way
    for bent in rings:
        held.given[SIDES.index(bent.side)] = bent.deflection @ bent.seated.to_v
    return held


def _entries(compliance: np.ndarray) -> np.ndarray:
    """11, 12 and 22 of symmetric matrices (2, 2, ...), last."""
    return np.moveaxis(compliance[[0, 0, 1], [0, 1, 1]], 0, -1)


def _table(ring: SeatedRing) -> np.ndarray:
    """Compliances and their slopes over the azimuth (POINTS, 6) round a ring."""
    azimuth = 2.0 * np.pi * np.arange(POINTS) / POINTS
    r = ring.reduction
    return np.hstack([_entries(r.between(azimuth)), _entries(r.between(azimuth, slope=True))])
