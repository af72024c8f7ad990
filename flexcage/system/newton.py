"""The equations as F(t, y, y') = 0 for an implicit integrator, and their Newton step.

Newton's matrix is formed in velocities: with displacements d = T^+ dq = (du + dmu - r_s)/alpha
the momentum rows become (alpha M + C + K/alpha) du = -r_u + K r_s/alpha, so that blocks stay
6 by 6. Constraints are rows of the border.
"""

from __future__ import annotations

from math import cos, sin

from flexcage.contacts.evaluation import ACCEPT, RESIDUAL, TANGENT
from flexcage.contacts.state import Q_SKEW, Q_SPIN, Q_TILT, U_SKEW, U_SPIN, U_TILT
from flexcage.core.jit import VECTORISED, array_from, fields, kernel, part, zero
from flexcage.core.rotation import quaternion_rate, rotation_of_quaternion_change
from flexcage.core.vectors import RIGID, TURN
from flexcage.solve import bordered
from flexcage.system.data import AXIAL, MASS, TRANSVERSE
from flexcage.system.layout import (
    FRAME,
    HELD_VELOCITIES,
    N_LAMBDA,
    N_OWN,
    PER_ELEMENT,
    QUATERNION,
    RING,
    cage_at,
)
from flexcage.system.sampling import give_powers

_factor_bordered = bordered.factor
_solve_bordered = bordered.solve

# ``data`` is (Parts, laws, evaluate): evaluated through a function value, the residual
# is compiled once, not again inside each of the functions below.


def residual(t, y, yd, data, out, power):
    """F(t, y, y') into ``out``, powers into ``power`` if it has room."""
    data[2](t, y, yd, data[0], data[1], out, ACCEPT if power.shape[0] > 0 else RESIDUAL)
    give_powers(t, y, data[0], power)


def linearise(t, y, yd, data):
    data[2](t, y, yd, data[0], data[1], fields(data[0].scratch).out, TANGENT)


def factor(alpha, data):
    d = data[0]
    return assemble(alpha, fields(d.bodies), fields(d.places), fields(d.tangent), fields(d.matrix))


@kernel(fastmath=VECTORISED)
def assemble(alpha, bodies, at, tan, m):
    """Newton's matrix alpha M + C + K/alpha in blocks, and its factors; ``at``: ``Places``."""
    mass, Ia, It = bodies.element[MASS], bodies.element[AXIAL], bodies.element[TRANSVERSE]
    b = 1.0 / alpha
    nb, further, multipliers = m.S.shape[0], tan.held.shape[0], at.border
    for i in range(m.A.shape[0]):
        high = nb if m.active[i] else m.low
        for r in range(6):
            for c in range(6):
                m.A[i, r, c] = tan.Crr[i, r, c] + b * tan.Krr[i, r, c]
            for c in range(high):
                m.B[i, r, c] = tan.Crb[i, r, c] + b * tan.Krb[i, r, c]
                m.C[i, c, r] = tan.Cbr[i, c, r] + b * tan.Kbr[i, c, r]
        # the stored rotation order is (x, r, psi) as velocities: spin, skew, tilt
        for r in range(3):
            m.A[i, r, r] += alpha * mass
        m.A[i, U_SPIN, U_SPIN] += alpha * Ia
        m.A[i, U_SKEW, U_SKEW] += alpha * It
        m.A[i, U_TILT, U_TILT] += alpha * It
    for r in range(nb):
        for c in range(nb):
            m.S[r, c] = alpha * tan.Mbb[r, c] + tan.Cbb[r, c] + b * tan.Kbb[r, c]
    # multipliers: forces on the inner ring, and on any body
    for k in range(N_LAMBDA):
        m.S[at.inner_b + HELD_VELOCITIES[k], multipliers + k] -= 1.0
    for k in range(further):
        for c in range(at.border):
            m.S[c, multipliers + N_OWN + k] -= tan.held[k, c]
    return _factor_bordered(m)


def backsolve(alpha, y, r, data):
    d = data[0]
    newton_step(alpha, y, r, fields(d.places), fields(d.tangent), fields(d.matrix))


@part
def _ring_displacement(r, modes, s):
    """Kinematic residuals of a ring as displacements, in the order of its velocities."""
    s[0], s[1], s[2] = r[0], r[1], r[2]
    s[U_SPIN], s[U_SKEW], s[U_TILT] = r[Q_SPIN], r[Q_SKEW], r[Q_TILT]
    for m in range(modes):
        s[RIGID + m] = r[RING + m]


@part
def _ring_change(s, modes, r):
    """Changes of a ring's coordinates by displacements."""
    r[0], r[1], r[2] = s[0], s[1], s[2]
    r[Q_SPIN], r[Q_SKEW], r[Q_TILT] = s[U_SPIN], s[U_SKEW], s[U_TILT]
    for m in range(modes):
        r[RING + m] = s[RIGID + m]


@part
def _frames(k, y, r, s, at):
    """Coordinates of cage k, their residuals or changes, and its displacement."""
    own = cage_at(k, at)
    return array_from(y, own.q), array_from(r, own.q), array_from(s, own.b)


@part
def _frame_displacement(q, r, modes, s):
    """Kinematic residuals r of a floating frame at q as a displacement s, in the order of its
    velocities."""
    for c in range(3):
        s[c] = r[c]
    quat, turn = array_from(q, QUATERNION), array_from(s, TURN)
    rotation_of_quaternion_change(quat, array_from(r, QUATERNION), turn)
    for k in range(modes):
        s[RIGID + k] = r[FRAME + k]


@part
def _frame_change(q, s, modes, b, r):
    """Changes of a floating frame's coordinates by a displacement s, in place of their residuals
    r."""
    quat, changed = array_from(q, QUATERNION), array_from(r, QUATERNION)
    stretch, norm = 0.0, 0.0  # of the quaternion: no rotation, but it must not run away
    for c in range(4):
        stretch += quat[c] * changed[c]
        norm += quat[c] * quat[c]
    for c in range(3):
        r[c] = s[c]
    quaternion_rate(quat, array_from(s, TURN), changed)
    for c in range(4):
        changed[c] -= b * stretch / norm * quat[c]
    for k in range(modes):
        r[FRAME + k] = s[RIGID + k]


@kernel(fastmath=VECTORISED)
def newton_step(alpha, y, r, at, tan, m):
    """r <- Newton step for the residual r, all unknowns; alpha is that of the factors."""
    nb, further, nm, n = m.S.shape[0], tan.held.shape[0], at.modes, at.border
    nq, b = at.u, 1.0 / alpha
    s, sb = m.blocks[0], m.border[0]  # kinematic residuals as displacements
    x, xb = m.blocks[1], m.border[1]  # right-hand side, then velocities
    zero(sb)
    for i in range(at.elements):
        o = PER_ELEMENT * i
        s[i, 0], s[i, 1], s[i, 2] = r[o], r[o + 1], r[o + 2] * y[o + 1]
        for c in range(3):
            s[i, TURN + c] = r[o + tan.turns[c]]
        if tan.turns[1] == Q_SKEW:  # a roller, whose axis may lean far
            upright, lean = cos(y[o + Q_TILT]), sin(y[o + Q_TILT])
            s[i, U_SKEW] = upright * r[o + Q_SKEW] - lean * r[o + 2]
    _ring_displacement(array_from(r, at.inner_q), at.inner_modes, array_from(sb, at.inner_b))
    _ring_displacement(array_from(r, at.outer_q), at.outer_modes, array_from(sb, at.outer_b))
    for k in range(at.cages):
        cage, r_cage, s_cage = _frames(k, y, r, sb, at)
        _frame_displacement(cage, r_cage, nm, s_cage)
    for k in range(nb):
        f = 0.0
        for c in range(n):
            f += tan.Kbb[k, c] * sb[c]
        xb[k] = -r[at.bodies_u + k] + b * f
    for i in range(at.elements):
        high = nb if m.active[i] else m.low
        for k in range(6):
            f = 0.0
            for c in range(6):
                f += tan.Krr[i, k, c] * s[i, c]
            for c in range(high):
                f += tan.Krb[i, k, c] * sb[c]
            x[i, k] = -r[nq + PER_ELEMENT * i + k] + b * f
        for k in range(high):
            f = 0.0
            for c in range(6):
                f += tan.Kbr[i, k, c] * s[i, c]
            xb[k] += b * f
    _solve_bordered(m, x, xb)
    for i in range(at.elements):
        o = PER_ELEMENT * i
        for k in range(6):
            r[nq + o + k] = x[i, k]
            s[i, k] = b * (x[i, k] - s[i, k])
        r[o], r[o + 1], r[o + 2] = s[i, 0], s[i, 1], s[i, 2] / y[o + 1]
        for c in range(3):
            r[o + tan.turns[c]] = s[i, TURN + c]
        if tan.turns[1] == Q_SKEW:
            upright, lean = cos(y[o + Q_TILT]), sin(y[o + Q_TILT])
            r[o + Q_SKEW] = (s[i, U_SKEW] + lean * r[o + 2]) / upright
    for k in range(n):
        r[at.bodies_u + k] = xb[k]
        sb[k] = b * (xb[k] - sb[k])
    for k in range(N_OWN + 2 * further):
        r[at.lam + k] = xb[n + k]
    for k in range(3):  # multipliers that hold places
        sb[at.inner_b + HELD_VELOCITIES[k]] += b * xb[n + N_LAMBDA + k]
    for k in range(further):
        for c in range(n):
            sb[c] += b * tan.held[k, c] * xb[n + N_OWN + further + k]
    _ring_change(array_from(sb, at.inner_b), at.inner_modes, array_from(r, at.inner_q))
    _ring_change(array_from(sb, at.outer_b), at.outer_modes, array_from(r, at.outer_q))
    for k in range(at.cages):
        cage, r_cage, s_cage = _frames(k, y, r, sb, at)
        _frame_change(cage, s_cage, nm, b, r_cage)
