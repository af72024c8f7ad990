"""Equations of motion of a rotor in its bearings, for an explicit integrator: y' = f(t, y).

Every inner ring is part of the rotor, and its unknowns in y are set by those of the rotor. With p
the place of a bearing along the axis a, second and third axes s and k of the rotor's frame, which
does not spin, and modes of displacements phi and slopes theta,

    r_b = r + p a + phi eta            v_b = v + p (w_3 s - w_2 k) + phi eta'
    skew_b = skew + theta_2 eta        w_b = w + theta eta'

A bearing's own equations give the forces f_b on its inner ring as if it were free. So the rotor,
with the velocities u = (v, w_2, w_3, eta'), the rings' velocities B_b u and accelerations
B_b u' + c_b, accelerates by

    (M + sum B_b^T M_b B_b) u' = f + sum B_b^T (f_b - M_b c_b)

with M = diag(m, m, m, It, It, 1 ...), and in f its loads, weight and unbalance, the gyroscopic
moments Ia W of its spin W (those of rings are in f_b), stiffness, damping and gyroscopic terms
W G of its modes. M_b (B_b u' + c_b) - f_b is what the rotor does to a ring: a result, whose power
enters that bearing's books as its load's. Outer rings in one housing push each other (``housing``).
"""

from __future__ import annotations

from math import cos, sin

from numba import literal_unroll

from flexcage.contacts.state import Q_SKEW, Q_TILT, U_SKEW, U_TILT
from flexcage.core.jit import copy_into, fields, part
from flexcage.core.vectors import put
from flexcage.solve.bordered import lu_factor, lu_solve
from flexcage.system.data import LOAD, POWERS
from flexcage.system.layout import AXIAL_FORCE, MOMENT_Y, MOMENT_Z
from flexcage.system.shaft.data import DAMPED, LOADS, RIGID_ROTOR, TO_BEARINGS, WEIGHT
from flexcage.system.shaft.housing import (
    add_housing_energy,
    give_housing_powers,
    move_ring,
    push_rings,
)
from flexcage.system.time_functions import (
    table_integral,
    table_slope,
    table_value,
    wave_integral,
    wave_slope,
    wave_value,
)

_POWERS = len(POWERS)
_MASS, _AXIAL, _TRANSVERSE = range(3)  # of ``ShaftData.inertia``
_SECOND, _THIRD = 3, 4  # of the rotor: skew and tilt, angular velocities about those axes
RATES, NOTE, SAMPLE, WANTED, DATA = range(5)  # of a bearing in ``data[0]``


def rates(t, y, yd, data, power):
    """y' into yd, what follows from y into y, powers into ``power`` if it has room: those of every
    bearing, then the rotor's."""
    s, housing, k = fields(data[1]), fields(data[2]), 0
    _begin(y, s)
    push_rings(y, housing)
    for bearing in literal_unroll(data[0]):
        low, high = s.first[k], s.first[k + 1]
        _set_ring(k, y, s)
        first = min(k * _POWERS, power.shape[0])
        last = min((k + 1) * _POWERS, power.shape[0])
        bearing[RATES](t, y[low:high], yd[low:high], bearing[DATA], power[first:last])
        _borne_by(k, y, yd, s)
        move_ring(k, y, yd, housing)
        give_housing_powers(k, y, housing, power[first:last])
        k += 1
    _accelerate(t, y, yd, s)
    _give_powers(t, y, s, power)


def note(t, y, data):
    """The point evaluated last, of this y, was accepted."""
    s, k = fields(data[1]), 0
    for bearing in literal_unroll(data[0]):
        bearing[NOTE](t, y[s.first[k] : s.first[k + 1]], bearing[DATA])
        k += 1


def sample(sample, t, y, yd, data):
    """Keep every bearing's report at sampling time t, and what the rotor does to its rings."""
    s, housing, k, whole = fields(data[1]), fields(data[2]), 0, False
    _begin(y, s)
    push_rings(y, housing)
    for bearing in literal_unroll(data[0]):
        low, high = s.first[k], s.first[k + 1]
        _set_ring(k, y, s)
        bearing[SAMPLE](sample, t, y[low:high], yd[low:high], bearing[DATA])
        whole = bearing[WANTED](sample, bearing[DATA])
        if whole:
            _borne_by(k, y, yd, s)
            move_ring(k, y, yd, housing)
            kept = fields(bearing[DATA][0].samples)
            add_housing_energy(k, y, housing, kept.energy[sample // kept.stride])
        k += 1
    if whole:
        _accelerate(t, y, yd, s)
        copy_into(s.kept[sample], s.given)


def wanted(sample, data):
    """Whether y of a sample is wanted to the last mode."""
    whole = False
    for bearing in literal_unroll(data[0]):
        whole = bearing[WANTED](sample, bearing[DATA]) or whole
    return whole


@part
def _begin(y, s):
    """The rotor's axes, and how its velocities move the inner rings."""
    at, n = s.first[s.first.shape[0] - 1], s.stiffness.shape[0]
    skew, tilt = y[at + _SECOND], y[at + _THIRD]
    cx, sx, ce, se = cos(skew), sin(skew), cos(tilt), sin(tilt)
    put(s.axes[0], (cx * ce, se, -sx * ce))
    put(s.axes[1], (-cx * se, ce, sx * se))
    put(s.axes[2], (sx, 0.0, cx))
    v = at + RIGID_ROTOR + n
    w2, w3 = y[v + _SECOND], y[v + _THIRD]
    frame = w2 * se / ce  # rate of the frame about the axis
    for b in range(s.place.shape[0]):
        p, B = s.place[b], s.reach[b]
        for c in range(3):
            f = s.sign[b, c]
            for j in range(3):
                B[c, j] = f if c == j else 0.0
            B[c, _SECOND], B[c, _THIRD] = -f * p * s.axes[2, c], f * p * s.axes[1, c]
            turned = frame * (w2 * s.axes[1, c] + w3 * s.axes[2, c])
            s.apart[b, c] = f * p * (turned - (w2 * w2 + w3 * w3) * s.axes[0, c])
            for m in range(n):
                B[c, RIGID_ROTOR + m] = f * s.shape[b, c, m]
        for c in range(3, 5):
            f = s.sign[b, c]
            for j in range(RIGID_ROTOR):
                B[c, j] = f if c == j else 0.0
            s.apart[b, c] = 0.0
            for m in range(n):
                B[c, RIGID_ROTOR + m] = f * s.shape[b, c, m]


@part
def _set_ring(b, y, s):
    """Coordinates and velocities of an inner ring in y, from the rotor's."""
    at, n, p = s.first[s.first.shape[0] - 1], s.stiffness.shape[0], s.place[b]
    q, u, v = s.inner_q[b], s.inner_u[b], at + RIGID_ROTOR + n
    for c in range(RIGID_ROTOR):
        x = y[at + c]
        if c < 3:
            x += p * s.axes[0, c]
            if c == 0:
                x -= p  # a bearing's own coordinates begin in its place
        for m in range(n):
            x += s.shape[b, c, m] * y[at + RIGID_ROTOR + m]
        speed = 0.0
        for j in range(RIGID_ROTOR + n):
            speed += s.reach[b, c, j] * y[v + j]
        x *= s.sign[b, c]
        x += s.offset[b] if c == 0 else 0.0
        if c < 3:
            y[q + c], y[u + c] = x, speed
        else:
            y[q + (Q_SKEW if c == 3 else Q_TILT)] = x
            y[u + (U_SKEW if c == 3 else U_TILT)] = speed


@part
def _borne_by(b, y, yd, s):
    """Forces on an inner ring, from its accelerations as a free one."""
    u = s.inner_u[b]
    for c in range(3):
        s.borne[b, c] = s.ring[b, 0] * yd[u + c]
    s.borne[b, _SECOND] = s.ring[b, 1] * yd[u + U_SKEW]
    s.borne[b, _THIRD] = s.ring[b, 1] * yd[u + U_TILT]


@part
def _accelerate(t, y, yd, s):
    """The rotor's rates and accelerations, those of the inner rings, and what the rotor does to
    them, into yd and y."""
    at, n = s.first[s.first.shape[0] - 1], s.stiffness.shape[0]
    N = RIGID_ROTOR + n
    v, M, x = at + N, s.matrix, s.x
    _own_forces(t, y, s)
    for i in range(N):
        for j in range(N):
            M[i, j] = 0.0
        M[i, i] = s.inertia[_MASS] if i < 3 else s.inertia[_TRANSVERSE] if i < 5 else 1.0
    for b in range(s.place.shape[0]):
        B = s.reach[b]
        for c in range(RIGID_ROTOR):
            mass = s.ring[b, 0] if c < 3 else s.ring[b, 1]
            force = s.borne[b, c] - mass * s.apart[b, c]
            for i in range(N):
                if B[c, i] != 0.0:
                    x[i] += B[c, i] * force
                    for j in range(N):
                        M[i, j] += B[c, i] * mass * B[c, j]
    lu_factor(M, s.pivot)
    lu_solve(M, s.pivot, x)
    ce = cos(y[at + _THIRD])
    for c in range(3):
        yd[at + c] = y[v + c]
    yd[at + _SECOND], yd[at + _THIRD] = y[v + _SECOND] / ce, y[v + _THIRD]
    for m in range(n):
        yd[at + RIGID_ROTOR + m] = y[v + RIGID_ROTOR + m]
    for i in range(N):
        yd[v + i] = x[i]
    for b in range(s.place.shape[0]):
        u, lam = s.inner_u[b], s.lam[b]
        for c in range(RIGID_ROTOR):
            a = s.apart[b, c]
            for i in range(N):
                a += s.reach[b, c, i] * x[i]
            yd[u + (c if c < 3 else U_SKEW if c == 3 else U_TILT)] = a
            s.given[b, c] = (s.ring[b, 0] if c < 3 else s.ring[b, 1]) * a - s.borne[b, c]
        y[lam + AXIAL_FORCE] = s.given[b, 0]
        y[lam + MOMENT_Y], y[lam + MOMENT_Z] = s.given[b, _SECOND], s.given[b, _THIRD]


@part
def _own_forces(t, y, s):
    """Generalised forces (N,) on the rotor, but those of its bearings, into ``s.x``."""
    at, n = s.first[s.first.shape[0] - 1], s.stiffness.shape[0]
    v, x = at + RIGID_ROTOR + n, s.x
    spin = table_value(s.speed, t) + wave_value(s.wave, t)
    _loads(t, s, spin)
    for i in range(x.shape[0]):
        x[i] = s.pushed[i]
    for c in range(3):
        x[c] += s.inertia[_MASS] * s.gravity[c]
    w2, w3 = y[v + _SECOND], y[v + _THIRD]
    frame = w2 * sin(y[at + _THIRD]) / cos(y[at + _THIRD])
    Ia, It = s.inertia[_AXIAL], s.inertia[_TRANSVERSE]
    x[_SECOND] += It * frame * w3 - Ia * spin * w3
    x[_THIRD] += Ia * spin * w2 - It * frame * w2
    for m in range(n):
        q, u = y[at + RIGID_ROTOR + m], y[v + RIGID_ROTOR + m]
        force = -s.stiffness[m] * q - s.damping[m] * u
        force -= spin * (s.gyro_turn[m, 0] * w2 + s.gyro_turn[m, 1] * w3)
        x[_SECOND] += spin * s.gyro_turn[m, 0] * u
        x[_THIRD] += spin * s.gyro_turn[m, 1] * u
        for j in range(n):
            force -= spin * s.gyro[m, j] * y[v + RIGID_ROTOR + j]
        x[RIGID_ROTOR + m] += force


@part
def _loads(t, s, spin):
    """Constant loads and unbalance into ``s.pushed``."""
    angle = table_integral(s.speed, s.angle, t) + wave_integral(s.wave, t)
    change = table_slope(s.speed, t) + wave_slope(s.wave, t)
    ce, se, w2 = cos(angle), sin(angle), spin * spin
    for i in range(s.pushed.shape[0]):
        # e_r = (ce, se), e_t = (-se, ce): w^2 along e_r, less the change of speed along e_t
        along_y = w2 * ce + change * se
        along_z = w2 * se - change * ce
        quarter_y = -w2 * se + change * ce
        quarter_z = w2 * ce + change * se
        force = s.load[i] + along_y * s.unbalance[0, i] + along_z * s.unbalance[1, i]
        s.pushed[i] = force + quarter_y * s.phase[0, i] + quarter_z * s.phase[1, i]


@part
def _give_powers(t, y, s, power):
    """What the rotor does to each inner ring, to that bearing's books; then the rotor's own. Forces
    are those that ``_accelerate`` found there."""
    bearings = s.place.shape[0]
    if power.shape[0] == 0:
        return
    at, n = s.first[bearings], s.stiffness.shape[0]
    v, own = at + RIGID_ROTOR + n, bearings * _POWERS
    total = 0.0
    for b in range(bearings):
        work, u = 0.0, s.inner_u[b]
        for c in range(RIGID_ROTOR):
            work += s.given[b, c] * y[u + (c if c < 3 else U_SKEW if c == 3 else U_TILT)]
        power[b * _POWERS + LOAD] += work
        total += work
    power[own + TO_BEARINGS] = -total
    done = 0.0
    for i in range(s.pushed.shape[0]):
        done += s.pushed[i] * y[v + i]
    power[own + LOADS] = done
    weight = lost = 0.0
    for c in range(3):
        weight += s.inertia[_MASS] * s.gravity[c] * y[v + c]
    for m in range(n):
        lost -= s.damping[m] * y[v + RIGID_ROTOR + m] * y[v + RIGID_ROTOR + m]
    power[own + WEIGHT], power[own + DAMPED] = weight, lost
