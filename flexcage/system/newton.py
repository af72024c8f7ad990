"""The equations as F(t, y, y') = 0 for an implicit integrator, and their Newton step.

Newton's matrix is formed in velocities: with displacements d = T^+ dq = (du + dmu - r_s)/alpha
the momentum rows become (alpha M + C + K/alpha) du = -r_u + K r_s/alpha, so that blocks stay
6 by 6. Constraints are rows of the border.
"""

from __future__ import annotations

from flexcage.contacts.evaluation import ACCEPT, RESIDUAL, TANGENT
from flexcage.contacts.state import Q_SKEW, Q_SPIN, Q_TILT, U_SKEW, U_SPIN, U_TILT
from flexcage.core.jit import VECTORISED, fields, kernel, zero
from flexcage.core.rotation import quaternion_rate, rotation_of_quaternion_change
from flexcage.core.vectors import TURN
from flexcage.solve import bordered
from flexcage.system.data import AXIAL, MASS, TRANSVERSE
from flexcage.system.layout import (
    CAGE_TURN,
    HELD_VELOCITIES,
    MODES,
    N_LAMBDA,
    N_OWN,
    OUTER,
    PER_ELEMENT,
    Q_MODES,
    Q_OUTER,
    Q_QUATERNION,
    places,
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
    return assemble(alpha, fields(d.bodies), fields(d.tangent), fields(d.matrix))


@kernel(fastmath=VECTORISED)
def assemble(alpha, bodies, tan, m):
    """Newton's matrix alpha M + C + K/alpha in blocks, and its factors."""
    mass, Ia, It = bodies.element[MASS], bodies.element[AXIAL], bodies.element[TRANSVERSE]
    b = 1.0 / alpha
    nb, further = m.S.shape[0], tan.held.shape[0]
    n6 = nb - N_OWN - 2 * further
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
    # multipliers: forces on the inner ring
    for k in range(N_LAMBDA):
        m.S[HELD_VELOCITIES[k], n6 + k] -= 1.0
    for k in range(further):
        for c in range(MODES):
            m.S[c, n6 + N_OWN + k] -= tan.held[k, c]
    return _factor_bordered(m)


def backsolve(alpha, y, r, data):
    newton_step(alpha, y, r, fields(data[0].tangent), fields(data[0].matrix))


@kernel(fastmath=VECTORISED)
def newton_step(alpha, y, r, tan, m):
    """r <- Newton step for the residual r, all unknowns; alpha is that of the factors."""
    Z = m.A.shape[0]
    nb, further = m.S.shape[0], tan.held.shape[0]
    nm = nb - MODES - N_OWN - 2 * further
    at = places(Z, nm)
    z, nq = at.rest_q, at.u
    b = 1.0 / alpha
    s, sb = m.blocks[0], m.border[0]  # kinematic residuals as displacements
    x, xb = m.blocks[1], m.border[1]  # right-hand side, then velocities
    zero(sb)
    for i in range(Z):
        o = PER_ELEMENT * i
        s[i, 0], s[i, 1], s[i, 2] = r[o], r[o + 1], r[o + 2] * y[o + 1]
        for c in range(3):
            s[i, TURN + c] = r[o + tan.turns[c]]
    sb[0], sb[1], sb[2] = r[z], r[z + 1], r[z + 2]
    sb[U_SPIN], sb[U_SKEW], sb[U_TILT] = r[z + Q_SPIN], r[z + Q_SKEW], r[z + Q_TILT]
    for c in range(5):
        sb[OUTER + c] = r[z + Q_OUTER + c]
    quat, r_quat = y[z + Q_QUATERNION : z + Q_MODES], r[z + Q_QUATERNION : z + Q_MODES]
    rotation_of_quaternion_change(quat, r_quat, sb[CAGE_TURN:MODES])
    stretch, norm = 0.0, 0.0  # of the quaternion: no rotation, but it must not run away
    for c in range(Q_QUATERNION, Q_MODES):
        stretch += y[z + c] * r[z + c]
        norm += y[z + c] * y[z + c]
    for k in range(nm):
        sb[MODES + k] = r[z + Q_MODES + k]
    for k in range(nb):
        f = 0.0
        for c in range(MODES + nm):
            f += tan.Kbb[k, c] * sb[c]
        xb[k] = -r[nq + z + k] + b * f
    for i in range(Z):
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
    for i in range(Z):
        o = PER_ELEMENT * i
        for k in range(6):
            r[nq + o + k] = x[i, k]
            s[i, k] = b * (x[i, k] - s[i, k])
        r[o], r[o + 1], r[o + 2] = s[i, 0], s[i, 1], s[i, 2] / y[o + 1]
        for c in range(3):
            r[o + tan.turns[c]] = s[i, TURN + c]
    for k in range(MODES + nm):
        r[nq + z + k] = xb[k]
        sb[k] = b * (xb[k] - sb[k])
    for k in range(N_OWN + 2 * further):
        r[at.lam + k] = xb[MODES + nm + k]
    place = MODES + nm + N_LAMBDA  # of the multipliers that hold places
    sb[0] += b * xb[place]
    sb[U_SKEW] += b * xb[place + 1]
    sb[U_TILT] += b * xb[place + 2]
    for k in range(further):
        for c in range(MODES):
            sb[c] += b * tan.held[k, c] * xb[MODES + N_OWN + nm + further + k]
    r[z], r[z + 1], r[z + 2] = sb[0], sb[1], sb[2]
    r[z + Q_SKEW], r[z + Q_TILT], r[z + Q_SPIN] = sb[U_SKEW], sb[U_TILT], sb[U_SPIN]
    for c in range(5):
        r[z + Q_OUTER + c] = sb[OUTER + c]
    quaternion_rate(quat, sb[CAGE_TURN:MODES], r_quat)
    for c in range(Q_QUATERNION, Q_MODES):
        r[z + c] -= b * stretch / norm * y[z + c]
    for k in range(nm):
        r[z + Q_MODES + k] = sb[MODES + k]
