"""Outer rings that sit in one elastic housing: what the others do to each.

A housing without mass answers with K o + C o' to the displacements o of all its rings; K is the
inverse of the compliance between the seats. A ring's own springs (``system.ring``) are the blocks
K_bb and C_bb. Here are the others:

    f_b = - sum over c of (K_bc o_c + C_bc o_c'),  c other than b

Of the energy o K o/2 each bearing holds o_b (K o)_b/2. What is handed on from seat to seat is a
load in the bearings' books, (o_b K_bc o_c' - o_b' K_bc o_c)/2, which sums up to nothing; what C_bc
takes is a loss of the mount.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from flexcage.contacts.state import Q_TILT
from flexcage.core.jit import part
from flexcage.system.data import IN_MOUNT, LOAD, MASS, MOUNT, TRANSVERSE

if TYPE_CHECKING:
    from flexcage.system.problem import BearingSystem

MOTIONS = 5  # of a ring that a seat holds: x, y, z, skew, tilt
_SKEW = 3  # among them


class HousingData(NamedTuple):
    """The seats of b bearings in one housing, or none: all arrays are empty then. Motions are
    those of each bearing's own frame."""

    q: np.ndarray  # (b,) places of each outer ring's first coordinate in y
    u: np.ndarray  # (b,) and of its first velocity
    inertia: np.ndarray  # (b, 3) of each outer ring
    stiffness: np.ndarray  # (b, b, 5, 5) of forces on a ring over the motions of another one
    damping: np.ndarray  # (b, b, 5, 5)
    # workspace
    pull: np.ndarray  # (b, 5) what the others' places do to each ring
    drag: np.ndarray  # (b, 5) and their velocities


def housing_data(
    bearings: Sequence[BearingSystem], stiffness: np.ndarray, late: Sequence[float]
) -> HousingData:
    """The arrays of seats with a ``stiffness`` (b, b, 5, 5) between all bearings, zero where one
    sits elsewhere, which damps by ``late`` [s] times itself; of seats that differ, by the
    geometric mean, so that no motion gains energy."""
    first = np.concatenate([[0], np.cumsum([b.layout.size for b in bearings])])[:-1]
    at = [b.layout.places for b in bearings]
    others = stiffness * (1.0 - np.eye(len(bearings)))[:, :, None, None]
    mean = np.sqrt(np.outer(late, late))
    empty = np.zeros((len(bearings), MOTIONS))
    return HousingData(
        q=first + [a.outer_q for a in at], u=first + [a.outer_u for a in at],
        inertia=np.array([b.data.model.outer_ring.inertia for b in bearings]),
        stiffness=others, damping=mean[:, :, None, None] * others, pull=empty, drag=empty.copy(),
    )  # fmt: skip


def no_housing() -> HousingData:
    """That of a machine in which every outer ring has a seat of its own."""
    none, pairs, z = np.zeros(0, np.int64), (0, 0, MOTIONS, MOTIONS), np.zeros
    return HousingData(none, none, z((0, 3)), z(pairs), z(pairs), z((0, MOTIONS)), z((0, MOTIONS)))


@part
def _velocity(c):
    """Where motion c is among a ring's velocities, in which spin comes before skew and tilt."""
    return c if c < _SKEW else c + 1


@part
def push_rings(y, h):
    """What all rings do to each other, by their places and velocities in y."""
    many = h.q.shape[0]
    for b in range(many):
        for i in range(MOTIONS):
            pull = drag = 0.0
            for c in range(many):
                for k in range(MOTIONS):
                    pull -= h.stiffness[b, c, i, k] * y[h.q[c] + k]
                    drag -= h.damping[b, c, i, k] * y[h.u[c] + _velocity(k)]
            h.pull[b, i], h.drag[b, i] = pull, drag


@part
def move_ring(b, y, yd, h):
    """Accelerations of ring b in yd, with what the others do to it."""
    if b >= h.q.shape[0]:
        return
    for i in range(MOTIONS):
        pull = h.pull[b, i]
        if i == _SKEW:  # the ring's own axis turns slower than skew
            pull /= cos(y[h.q[b] + Q_TILT])
        mass = h.inertia[b, MASS if i < _SKEW else TRANSVERSE]
        yd[h.u[b] + _velocity(i)] += (pull + h.drag[b, i]) / mass


@part
def _rate(b, i, y, h):
    """Rate of ring b's coordinate i."""
    rate = y[h.u[b] + _velocity(i)]
    return rate / cos(y[h.q[b] + Q_TILT]) if i == _SKEW else rate


@part
def give_housing_powers(b, y, h, power):
    """What the others do to ring b, into its bearing's ``power``, if it has room."""
    if b >= h.q.shape[0] or power.shape[0] == 0:
        return
    handed = lost = 0.0
    for i in range(MOTIONS):
        place, rate = y[h.q[b] + i], _rate(b, i, y, h)
        handed += rate * h.pull[b, i]
        lost += y[h.u[b] + _velocity(i)] * h.drag[b, i]
        for c in range(h.q.shape[0]):
            for k in range(MOTIONS):
                handed += place * h.stiffness[b, c, i, k] * _rate(c, k, y, h)
    power[LOAD] += 0.5 * handed
    power[MOUNT] += lost


@part
def add_housing_energy(b, y, h, energy):
    """Energy between ring b's seat and the others, half of it, to its bearing's ``energy``."""
    if b >= h.q.shape[0]:
        return
    for i in range(MOTIONS):
        energy[IN_MOUNT] -= 0.5 * y[h.q[b] + i] * h.pull[b, i]
