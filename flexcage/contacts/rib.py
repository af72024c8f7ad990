"""Roller end against the inner ring's ribs: a few points of the end face that overlap the rib."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.state import (
    add_end_generator,
    add_generator,
    add_outer,
    approach,
    clear,
    friction_tangent,
)
from flexcage.core.jit import kernel, zero


class RibData(NamedTuple):
    half_gap: float
    half_roller: float
    points: np.ndarray  # (np, 2) points of the end face along the transverse axes
    friction: np.ndarray  # (5,)


@kernel
def rib_contact(pose, data, P, b, Vr, wr, p, laws, sl, pair, mode, sums):
    """Wrench on the roller from both ribs (0: +x, 1: -x), as ``race_contact``; p (2, N_NORMAL).

    ``sums``: normal at +x and -x, elastic energy, damping power, friction power.
    """
    clear(pair, mode == 1)
    law, friction = laws
    if mode == 2:
        zero(sums)
    a = pose.axis
    along = P[0] * b[0] + P[1] * b[1] + P[2] * b[2]
    tilt = abs(a[0, 1] - b[1]) + abs(a[0, 2] - b[2])
    play = data.half_gap - data.half_roller
    if abs(along) + 2.0 * tilt * data.half_roller < play:
        return False
    count = data.points.shape[0]
    n, e1, e2, r, v = np.empty(3), np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    Wn, W1, W2, V = np.empty(6), np.empty(6), np.empty(6), np.empty(6)
    d = sqrt(1.0 - b[2] * b[2])
    e1[0], e1[1], e1[2] = -b[1] / d, b[0] / d, 0.0
    e2[0], e2[1], e2[2] = b[1] * e1[2] - b[2] * e1[1], b[2] * e1[0] - b[0] * e1[2], d
    active = False
    for f in range(2):
        sgn = 1.0 if f == 0 else -1.0
        touched = False
        for c in range(3):
            n[c] = -sgn * b[c]
        for k in range(count):
            for c in range(3):
                r[c] = sgn * data.half_roller * a[0, c]
                r[c] += data.points[k, 0] * a[1, c] + data.points[k, 1] * a[2, c]
            x, y, z = P[0] + r[0], P[1] + r[1], P[2] + r[2]
            sl.d[k] = sgn * (x * b[0] + y * b[1] + z * b[2]) - data.half_gap
            sl.v[k] = sl.u[k] = 0.0
            if sl.d[k] > 0.0:
                touched = True
                o = pose.w
                v[0] = pose.V[0] - Vr[0] + o[1] * r[2] - o[2] * r[1] - wr[1] * z + wr[2] * y
                v[1] = pose.V[1] - Vr[1] + o[2] * r[0] - o[0] * r[2] - wr[2] * x + wr[0] * z
                v[2] = pose.V[2] - Vr[2] + o[0] * r[1] - o[1] * r[0] - wr[0] * y + wr[1] * x
                add_end_generator(n, r, a[0], P[1], Wn)
                sl.v[k] = approach(Wn, pose, P, Vr, wr)
                sl.t[k, 0] = e1[0] * v[0] + e1[1] * v[1] + e1[2] * v[2]
                sl.t[k, 1] = e2[0] * v[0] + e2[1] * v[1] + e2[2] * v[2]
                sl.u[k] = sqrt(sl.t[k, 0] ** 2 + sl.t[k, 1] ** 2)
        if not touched:
            continue
        active = True
        law(count, sl.d, sl.v, p[f], sl.N, sl.Nd, sl.Nv)
        friction(count, sl.u, data.friction, sl.g, sl.dg)
        for k in range(count):
            N = sl.N[k]
            if N <= 0.0:
                continue
            for c in range(3):
                r[c] = sgn * data.half_roller * a[0, c]
                r[c] += data.points[k, 0] * a[1, c] + data.points[k, 1] * a[2, c]
            add_end_generator(n, r, a[0], P[1], Wn)
            add_generator(e1, r, W1)
            add_generator(e2, r, W2)
            for c in range(6):
                V[c] = Wn[c] - sl.g[k] * (sl.t[k, 0] * W1[c] + sl.t[k, 1] * W2[c])
                pair.wrench[c] += N * V[c]
            if mode == 1:
                add_outer(pair.K, sl.Nd[k], V, Wn)
                add_outer(pair.C, sl.Nv[k], V, Wn)
                friction_tangent(
                    pair.C, N, sl.g[k], sl.dg[k], sl.u[k], sl.t[k, 0], sl.t[k, 1], W1, W2
                )
            elif mode == 2:
                sums[f] += N
                sums[4] -= N * sl.g[k] * sl.u[k] ** 2
        if mode == 2:
            law(count, sl.d, sl.zero, p[f], sl.g, sl.Nd, sl.Nv)
            for k in range(count):
                sums[2] += sl.g[k] * max(sl.d[k], 0.0) / (p[f, 1] + 1.0)
                sums[3] -= (sl.N[k] - sl.g[k]) * sl.v[k]
    return active
