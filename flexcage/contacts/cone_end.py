"""Tapered roller's spherical end against a rib, whose face is a cone: one sphere more of those that
``cone`` has as slices. Small ends, which are flat, count as spheres as flat as the large ones.

Its friction acts at the middle of the spot; the end's turning on its own spot is left out.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.cone import cone_line
from flexcage.contacts.evaluation import (
    APPROACH,
    DAMPED,
    NORMAL,
    REPORT,
    RUBBED,
    SLIDING,
    STORED,
    TANGENT,
)
from flexcage.contacts.laws import EXPONENT
from flexcage.contacts.slices import (
    friction_factors,
    friction_power,
    normal_forces,
    stored_and_damped,
)
from flexcage.contacts.state import (
    AXIS,
    MOMENT,
    SPIN,
    WHOLE,
    add_generator,
    add_outer,
    add_wrench,
    clear,
    friction_tangent,
)
from flexcage.core.jit import outlined, part, zero
from flexcage.core.vectors import TURN, combine, cross, dot, minus, plus, row, times, xyz


class EndData(NamedTuple):
    """A roller's spherical end, and the conical face of the rib."""

    place: float  # of the sphere's centre on the roller's axis
    radius: float
    cos: float  # the face's normal, towards the roller, is cos e_D + sin b
    sin: float
    apex: float  # place of the face's apex on the ring's axis
    normal: np.ndarray  # (N_NORMAL,)
    friction: np.ndarray  # (N_FRICTION,)


@part
def end_contact(pose, partner, data, onset, laws, sl, pair, mode, sums):
    """Wrench on the roller from the rib of its ``partner`` (4, 3), closed at the speed ``onset``.

    From REPORT on with ``sums``: normal force, approach speed, sliding round the rib, elastic
    energy, power of damping and of friction; returns whether they touch.
    """
    ring_axis, a = row(partner, AXIS), row(pose.axis, 0)
    line, spin = cone_line(pose, partner)
    s = data.place
    x = combine(line.x0, s, line.x1)
    distance = sqrt(dot(x, x))
    e = times(1.0 / distance, x)
    n = combine(times(data.cos, e), data.sin, ring_axis)
    v = combine(line.v0, s, line.v1)
    along = line.l0 + s * line.l1 - data.apex
    sl.d[0], sl.v[0] = data.radius - data.cos * distance - data.sin * along, -dot(n, v)
    if mode >= REPORT:
        zero(sums)
        sums[APPROACH] = sl.v[0]
    if sl.d[0] <= 0.0:
        return False
    clear(pair, mode == TANGENT)
    t = cross(ring_axis, e)
    l = cross(n, t)
    v = combine(v, -data.radius, cross(spin, n))
    sl.t1[0], sl.t2[0] = dot(v, l), dot(v, t)
    sl.u[0] = sqrt(sl.t1[0] ** 2 + sl.t2[0] ** 2)
    normal_forces(laws.normal, (0, 1), sl, data.normal, onset)
    friction_factors(laws.friction, (0, 1), sl, data.friction)
    f = combine(n, -sl.g[0] * sl.t1[0], l)
    f = times(sl.N[0], combine(f, -sl.g[0] * sl.t2[0], t))
    add_wrench(pair.wrench, f, combine(times(s, a), -data.radius, n))
    if mode == TANGENT:
        _tangent(pose, partner, data, distance, (n, l, t), sl, pair)
    elif mode >= REPORT:
        sums[NORMAL], sums[SLIDING], sums[RUBBED] = sl.N[0], sl.t2[0], friction_power((0, 1), sl)
        sums[STORED], sums[DAMPED] = stored_and_damped((0, 1), sl, data.normal[EXPONENT])
    return True


@outlined
def _tangent(pose, partner, data, distance, directions, sl, pair):
    """Slopes of the end's wrench, all of them, but for how the orbital frame turns."""
    a, (n, l, t), W = row(pose.axis, 0), directions, pair.W
    r = combine(times(data.place, a), -data.radius, n)
    g1, g2 = sl.g[0] * sl.t1[0], sl.g[0] * sl.t2[0]
    add_generator(n, r, W[0])
    add_generator(l, r, W[1])
    add_generator(t, r, W[2])
    for j in range(6):
        W[WHOLE, j] = W[0, j] - g1 * W[1, j] - g2 * W[2, j]
    add_outer(pair.C, sl.Nv[0], W[WHOLE], W[0])
    friction_tangent(
        pair.C, sl.N[0], sl.g[0], sl.dg[0], sl.u[0], sl.t1[0], sl.t2[0], W[1], W[2]
    )  # fmt: skip
    for j in range(6):
        _turn_with(j, pose, partner, data, distance, directions, sl, pair)


@part
def _turn_with(j, pose, partner, data, distance, directions, sl, pair):
    """Column j of K: how the wrench follows a displacement of the roller, or its turning."""
    a, (n, l, t), s, R = row(pose.axis, 0), directions, data.place, data.radius
    own, ring_spin = xyz(pose.w), row(partner, SPIN)
    k = j % TURN
    one = (1.0 if k == 0 else 0.0, 1.0 if k == 1 else 0.0, 1.0 if k == 2 else 0.0)
    moved = one if j < TURN else (0.0, 0.0, 0.0)
    turn = (0.0, 0.0, 0.0) if j < TURN else combine(one, -dot(one, a), a)  # it spins unseen
    lean = times(s, cross(turn, a))  # of the sphere's centre, from the roller's
    moved = plus(moved, lean)
    about = dot(t, moved) / distance  # the contact goes round the ring
    dn, dl = times(data.cos * about, t), times(-data.sin * about, t)
    dt = times(-about, combine(times(data.cos, n), -data.sin, l))
    # sliding: velocity of the centre, and of the surface there
    spin = minus(own, ring_spin)
    dv = minus(cross(cross(turn, own), times(s, a)), cross(ring_spin, moved))
    dv = combine(plus(dv, cross(own, lean)), -R, plus(cross(cross(turn, own), n), cross(spin, dn)))
    r = combine(times(s, a), -R, n)
    _add_column(j, (dn, dl, dt), dv, (r, combine(lean, -R, dn), moved), directions, sl, pair)


@part
def _add_column(j, turned, dv, places, directions, sl, pair):
    """Take from column j of K what force and moment gain as directions are ``turned``, sliding
    changes by dv, and the contact at r goes by dr as the sphere's centre is ``moved``."""
    (dn, dl, dt), (n, l, t), (r, dr, moved) = turned, directions, places
    t1, t2, g, N = sl.t1[0], sl.t2[0], sl.g[0], sl.N[0]
    slip = combine(combine(times(t1, l), t2, t), -sl.v[0], n)
    d1, d2 = dot(dv, l) + dot(slip, dl), dot(dv, t) + dot(slip, dt)
    faster = (t1 * d1 + t2 * d2) / sl.u[0] if sl.u[0] > 1e-12 else 0.0
    more = -sl.Nd[0] * dot(n, moved) - sl.Nv[0] * (dot(n, dv) + dot(slip, dn))
    rubs = combine(times(t1, l), t2, t)
    whole = combine(n, -g, rubs)
    drags = combine(combine(times(d1, l), d2, t), t1, dl)
    drags = combine(times(g, combine(drags, t2, dt)), sl.dg[0] * faster, rubs)
    df = combine(times(more, whole), N, minus(dn, drags))
    dm = plus(cross(r, df), cross(dr, times(N, whole)))
    for c in range(3):
        pair.K[c, j] -= df[c]
        pair.K[MOMENT + c, j] -= dm[c]
