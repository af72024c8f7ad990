"""Roller end against a ring's ribs: a few points of the end face that overlap the rib."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.evaluation import DAMPED, NORMAL, REPORT, RUBBED, STORED, TANGENT
from flexcage.contacts.laws import EXPONENT
from flexcage.contacts.slices import (
    friction_factors,
    friction_power,
    normal_forces,
    stored_and_damped,
)
from flexcage.contacts.state import (
    AXIS,
    CENTRE,
    SPIN,
    VELOCITY,
    WHOLE,
    add_end_generator,
    add_generator,
    add_outer,
    approach,
    clear,
    friction_tangent,
)
from flexcage.core.jit import part, zero
from flexcage.core.vectors import combine, cross, dot, minus, plus, row, times, xyz


class RibData(NamedTuple):
    """Ribs of one ring. Those of sides ``first`` to before ``end`` are there (0: +x, 1: -x), and
    ``column`` is the place of the first in arrays of an element's ribs."""

    first: int
    end: int
    column: int
    half_gap: float
    half_roller: float
    points: np.ndarray  # (np, 2) points of the end face along the transverse axes
    normal: np.ndarray  # (N_NORMAL,) normal law of a point
    friction: np.ndarray  # (N_FRICTION,)


@part
def rib_contact(pose, ring, data, middle, onset, laws, sl, pair, mode, sums):
    """Wrench on the roller from the ribs of one ring (0: +x, 1: -x), met at speeds ``onset`` (2,).

    ``ring`` (4, 3): the partner as ``race.RaceWork`` has it; ``middle`` [m] between the ribs, from
    its centre.

    ``sums``: normal at +x and -x, elastic energy, damping power, friction power.
    """
    clear(pair, mode == TANGENT)
    if mode >= REPORT:
        zero(sums)
    centre, ring_axis, ring_spin = row(ring, CENTRE), row(ring, AXIS), row(ring, SPIN)
    a0, a1, a2 = row(pose.axis, 0), row(pose.axis, 1), row(pose.axis, 2)
    along = dot(centre, ring_axis) - middle  # in F, from the middle between the ribs
    tilt = abs(a0[1] - ring_axis[1]) + abs(a0[2] - ring_axis[2])
    play = data.half_gap - data.half_roller
    if abs(along) + 2.0 * tilt * data.half_roller < play:  # a bound: no point reaches a rib
        return False
    # motion relative to the ring's material at the roller's centre; e1 and e2 span the rib's plane
    spin = minus(xyz(pose.w), ring_spin)
    rel = minus(minus(xyz(pose.V), row(ring, VELOCITY)), cross(ring_spin, centre))
    d = sqrt(1.0 - ring_axis[2] * ring_axis[2])
    e1 = (-ring_axis[1] / d, ring_axis[0] / d, 0.0)
    e2 = cross(ring_axis, e1)
    count = data.points.shape[0]
    Wn, W1, W2, V = pair.W[0], pair.W[1], pair.W[2], pair.W[WHOLE]
    active = False
    for f in range(data.first, data.end):
        sgn = 1.0 if f == 0 else -1.0
        touched = False
        n = times(-sgn, ring_axis)
        for k in range(count):
            r = combine(times(sgn * data.half_roller, a0), data.points[k, 0], a1)
            r = combine(r, data.points[k, 1], a2)
            # d = sgn x - half_gap, x of the point along the ring's axis: ribs are flat
            sl.d[k] = sgn * (along + dot(r, ring_axis)) - data.half_gap
            sl.v[k] = sl.u[k] = 0.0
            if sl.d[k] > 0.0:
                touched = True
                v = plus(rel, cross(spin, r))
                add_end_generator(n, r, a0, centre[1], Wn)
                sl.v[k] = approach(Wn, rel, spin)
                sl.t1[k], sl.t2[k] = dot(e1, v), dot(e2, v)
                sl.u[k] = sqrt(sl.t1[k] ** 2 + sl.t2[k] ** 2)
        if not touched:
            continue
        active = True
        normal_forces(laws.normal, (0, count), sl, data.normal, onset[f])
        friction_factors(laws.friction, (0, count), sl, data.friction)
        for k in range(count):
            N = sl.N[k]
            if N <= 0.0:
                continue
            r = combine(times(sgn * data.half_roller, a0), data.points[k, 0], a1)
            r = combine(r, data.points[k, 1], a2)
            add_end_generator(n, r, a0, centre[1], Wn)
            add_generator(e1, r, W1)
            add_generator(e2, r, W2)
            # generators (f, r x f): V = Wn - (mu/u) (t1 W1 + t2 W2), wrench N V
            for c in range(6):
                V[c] = Wn[c] - sl.g[k] * (sl.t1[k] * W1[c] + sl.t2[k] * W2[c])
                pair.wrench[c] += N * V[c]
            if mode == TANGENT:
                add_outer(pair.K, sl.Nd[k], V, Wn)
                add_outer(pair.C, sl.Nv[k], V, Wn)
                friction_tangent(pair.C, N, sl.g[k], sl.dg[k], sl.u[k], sl.t1[k], sl.t2[k], W1, W2)
            elif mode >= REPORT:
                sums[NORMAL + f] += N
        if mode >= REPORT:
            energy, damped = stored_and_damped((0, count), sl, data.normal[EXPONENT])
            sums[STORED] += energy
            sums[DAMPED] += damped
            sums[RUBBED] += friction_power((0, count), sl)
    return active
