"""Rings: where they are, how fast, what holds them, and their rows of the residual.

A ring has six degrees of freedom: centre (x, y, z), and skew, tilt and spin. In its frame, which
does not spin with it and turns at a rate f about the axis, with axial and transverse inertia Ia and
It,

    m (v' - g)                      = F
    Ia w_1'                         = M_1
    It (w_2' - f w_3) + Ia w_1 w_3  = M_2
    It (w_3' + f w_2) - Ia w_1 w_2  = M_3

What ``RingBody.free`` does not free is held: the inner ring's by multipliers, which are results; an
outer ring's by its mount, where the row is u' = 0.
"""

from __future__ import annotations

from math import cos, sin, sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.state import Q_SKEW, Q_SPIN, Q_TILT, U_SKEW, U_SPIN, U_TILT
from flexcage.core.jit import array_from, fields, part, zero
from flexcage.core.vectors import RIGID, TURN, combine, put, times, turn_of
from flexcage.system.data import (
    AXIAL,
    GRAVITY,
    IN_MOUNT,
    KINETIC,
    MASS,
    MOUNT,
    RING_AXIS,
    RING_SPIN,
    TRANSVERSE,
)

STIFFNESS, DAMPING, CLEARANCE = range(3)  # of ``RingBody.bore``


class Ring(NamedTuple):
    """A ring as contacts meet it."""

    q: np.ndarray  # (6,) coordinates
    u: np.ndarray  # (6,) velocities
    axis: np.ndarray  # (3,) in space
    spin: np.ndarray  # (3,) angular velocity in space
    b: int  # its first row in the border


class Rows(NamedTuple):
    """A ring's part of y' or of the residual."""

    q: np.ndarray  # (6,) of its coordinates
    u: np.ndarray  # (6,) of its velocities


@part
def inner_of(y, d):
    """The inner ring in y; ``set_axes`` comes before."""
    at = fields(d.places)
    return _ring_at(y, at.inner_q, at.inner_u, at.inner_b, fields(d.scratch).rings[0])


@part
def outer_of(y, d):
    """The outer ring in y."""
    at = fields(d.places)
    return _ring_at(y, at.outer_q, at.outer_u, at.outer_b, fields(d.scratch).rings[1])


@part
def _ring_at(y, q, u, b, axes):
    return Ring(array_from(y, q), array_from(y, u), axes[RING_AXIS], axes[RING_SPIN], b)


@part
def rows_at(v, q, u):
    """A ring's ``Rows`` of y' or the residual, with its places."""
    return Rows(array_from(v, q), array_from(v, u))


@part
def set_axes(y, d):
    """Axes and angular velocities of both rings in space."""
    at, axes = fields(d.places), fields(d.scratch).rings
    set_axis(array_from(y, at.inner_q), array_from(y, at.inner_u), axes[0])
    set_axis(array_from(y, at.outer_q), array_from(y, at.outer_u), axes[1])


@part
def set_axis(q, u, out):
    """Axis and angular velocity of a ring in space (its frame does not spin)."""
    cx, sx, ce, se = cos(q[Q_SKEW]), sin(q[Q_SKEW]), cos(q[Q_TILT]), sin(q[Q_TILT])
    axis = (cx * ce, se, -sx * ce)
    put(out[RING_AXIS], axis)
    skew = (-cx * se, ce, sx * se)
    put(
        out[RING_SPIN],
        combine(combine(times(u[U_SPIN], axis), u[U_SKEW], skew), u[U_TILT], (sx, 0.0, cx)),
    )


@part
def ring_rates(q, u, out):
    """Kinematics of a ring (its frame does not spin); returns its frame's axial rate."""
    skew = u[U_SKEW] / cos(q[Q_TILT])
    frame = skew * sin(q[Q_TILT])
    out[0], out[1], out[2] = u[0], u[1], u[2]
    out[Q_SKEW], out[Q_TILT], out[Q_SPIN] = skew, u[U_TILT], u[U_SPIN] - frame
    return frame


@part
def ring_rows(body, ring, yd, push, gravity, given, rates, rows):
    """Rows of a ring that ``push`` (6,) acts on, force and moment in space, and ``given`` moments
    about y and z; ``yd`` and ``rows`` are ``Rows``, ``rates`` a buffer."""
    q, u, ud, r_u = ring.q, ring.u, yd.u, rows.u
    frame = ring_rates(q, u, rates)
    for c in range(RIGID):
        rows.q[c] = yd.q[c] - rates[c]
    mass, Ia, It = body.inertia[MASS], body.inertia[AXIAL], body.inertia[TRANSVERSE]
    cx, sx, ce, se = cos(q[Q_SKEW]), sin(q[Q_SKEW]), cos(q[Q_TILT]), sin(q[Q_TILT])
    Mx, My, Mz = push[TURN], push[TURN + 1] + given[0], push[TURN + 2] + given[1]
    # moments about the axes of the ring's frame, which skew and tilt turn, and no spin
    M1 = cx * ce * Mx + se * My - sx * ce * Mz
    M2 = -cx * se * Mx + ce * My + sx * se * Mz
    M3 = sx * Mx + cx * Mz
    for c in range(3):  # translations in space, then the module's three of rotation
        r_u[c] = mass * (ud[c] - gravity[c]) - push[c]
    spin, skew, tilt = turn_of(u)
    r_u[U_SPIN] = Ia * ud[U_SPIN] - M1
    r_u[U_SKEW] = It * (ud[U_SKEW] - frame * tilt) + Ia * spin * tilt - M2
    r_u[U_TILT] = It * (ud[U_TILT] + frame * skew) - Ia * spin * skew - M3


@part
def ring_slopes(body, u, b, tan):
    """Slopes of a ring's own rows, the first at b in the border."""
    Ia, It = body.inertia[AXIAL], body.inertia[TRANSVERSE]
    for c in range(3):
        tan.Mbb[b + c, b + c] = body.inertia[MASS]
    tan.Mbb[b + U_SPIN, b + U_SPIN] = Ia
    tan.Mbb[b + U_SKEW, b + U_SKEW] = tan.Mbb[b + U_TILT, b + U_TILT] = It
    tan.Cbb[b + U_SKEW, b + U_TILT] += Ia * u[U_SPIN]
    tan.Cbb[b + U_TILT, b + U_SKEW] -= Ia * u[U_SPIN]


@part
def ring_energy(body, u, gravity, rep):
    """Kinetic energy of a ring, and what gravity does on it."""
    mass, Ia, It = body.inertia[MASS], body.inertia[AXIAL], body.inertia[TRANSVERSE]
    w2 = u[U_SKEW] * u[U_SKEW] + u[U_TILT] * u[U_TILT]
    v2 = u[0] * u[0] + u[1] * u[1] + u[2] * u[2]
    rep.energy[KINETIC] += 0.5 * (mass * v2 + Ia * u[U_SPIN] * u[U_SPIN] + It * w2)
    for c in range(3):
        rep.power[GRAVITY] += mass * gravity[c] * u[c]


@part
def ring_springs(body, q, u, pull):
    """What springs and dampers to the ground do to a ring, into ``pull`` (6,). Returns energy
    stored and power lost."""
    rest = body.rest
    away = (
        q[0] - rest[0], q[1] - rest[1], q[2] - rest[2], 0.0, q[Q_SKEW] - rest[U_SKEW],
        q[Q_TILT] - rest[U_TILT],
    )  # fmt: skip
    stored = lost = 0.0
    for i in range(RIGID):  # -K (q - rest) - C u, and an energy of the first
        force = damped = 0.0
        for k in range(RIGID):
            force += body.stiffness[i, k] * away[k]
            damped += body.damping[i, k] * u[k]
        stored += 0.5 * away[i] * force
        lost += u[i] * damped
        if i == U_SKEW:  # the ring's own axis turns slower than skew
            force /= cos(q[Q_TILT])
        pull[i] = -force - damped
    return stored, lost


@part
def _spring_slopes(body, b, tan):
    """Slopes of these, with the first row at b in the border."""
    for i in range(RIGID):
        for k in range(RIGID):
            tan.Kbb[b + i, b + k] += body.stiffness[i, k]
            tan.Cbb[b + i, b + k] += body.damping[i, k]


@part
def _in_bore(body, q, u, b, held, tan, sloped):
    """Force ``held`` (y, z) of the outer ring on its bore; returns energy stored and power lost.
    Slopes are added if ``sloped``."""
    k, c = body.bore[STIFFNESS], body.bore[DAMPING]
    y, z = q[1], q[2]
    held[0] = held[1] = 0.0
    distance = sqrt(y * y + z * z)
    n = (1.0, 0.0) if distance == 0.0 else (y / distance, z / distance)
    depth = distance - body.bore[CLEARANCE]
    rate = n[0] * u[1] + n[1] * u[2]
    force = k * depth + c * rate  # towards the middle, and no tension
    if depth <= 0.0:
        return 0.0, 0.0
    if force <= 0.0:  # it parts while still compressed: what is stored relaxes unseen
        return 0.5 * k * depth * depth, -k * depth * rate
    for i in range(2):
        held[i] = force * n[i]
        if sloped:
            for j in range(2):
                across = (1.0 if i == j else 0.0) - n[i] * n[j]
                tan.Kbb[b + 1 + i, b + 1 + j] += k * n[i] * n[j] + force / distance * across
                tan.Cbb[b + 1 + i, b + 1 + j] += c * n[i] * n[j]
    return 0.5 * k * depth * depth, c * rate * rate


@part
def outer_rows(body, ring, yd, rows, d, sloped, reported):
    """Rows of the outer ring on its mount; slopes if ``sloped``, energies if ``reported``."""
    work, tan, gravity = fields(d.scratch), fields(d.tangent), fields(d.bodies).gravity
    q, u, b, r_u = ring.q, ring.u, ring.b, rows.u
    push, held, pull = array_from(work.border, b), work.held, work.pull
    ring_rows(body, ring, yd, push, gravity, (0.0, 0.0), work.S[0], rows)
    stored, lost = ring_springs(body, q, u, pull)
    for c in range(RIGID):
        r_u[c] -= pull[c]
    if body.loose != 0:
        pressed, damped = _in_bore(body, q, u, b, held, tan, sloped)
        stored, lost = stored + pressed, lost + damped
        r_u[1] += held[0]
        r_u[2] += held[1]
    if sloped:
        ring_slopes(body, u, b, tan)
        _spring_slopes(body, b, tan)
    for c in range(RIGID):
        if body.free[c] == 0:
            r_u[c] = yd.u[c]
            if sloped:
                _hold_row(b + c, tan)
    if reported:
        rep = fields(d.report)
        ring_energy(body, u, gravity, rep)
        rep.energy[IN_MOUNT] += stored
        rep.power[MOUNT] -= lost
        for c in range(RIGID):
            rep.outer_wrench[c] = push[c]


@part
def _hold_row(k, tan):
    """Row k of the border is u' = 0, whatever pushes it; and nothing moves with it."""
    zero(tan.Kbb[k])
    zero(tan.Cbb[k])
    zero(tan.Mbb[k])
    tan.Mbb[k, k] = 1.0
    for i in range(tan.Kbr.shape[0]):
        zero(tan.Kbr[i, k])
        zero(tan.Cbr[i, k])
        for c in range(RIGID):
            tan.Krb[i, c, k] = tan.Crb[i, c, k] = 0.0
