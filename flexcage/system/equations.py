"""Equations that all bearings share: rings, cage, lands, drive and constraints.

Rolling elements differ from type to type; what they push is collected in ``Scratch.border`` (inner
ring 6, outer ring 2, cage 6 + n) and balanced here.
"""

from __future__ import annotations

from math import cos, sin, sqrt
from typing import NamedTuple

import numpy as np

from flexcage.bodies.floating_frame import inertia_terms, modal_product
from flexcage.contacts.evaluation import (
    APPROACH,
    DAMPED,
    LAND_LAW,
    LAND_RUBS,
    NORMAL,
    REPORT,
    RUBBED,
    SHEARED,
    STORED,
    TANGENT,
)
from flexcage.contacts.land import NONE as NO_LAND
from flexcage.contacts.land import (
    LandCage,
    LandForces,
    LandRing,
    land_contact,
    other_contact,
    other_land,
)
from flexcage.contacts.land_frame import AT_REST, bring_back, is_tilted, seen_from_ring
from flexcage.contacts.slices import Laws
from flexcage.contacts.state import Q_SKEW, Q_SPIN, Q_TILT, U_SKEW, U_SPIN, U_TILT
from flexcage.core.jit import VECTORISED, copy_into, fields, outlined, part, zero
from flexcage.core.rotation import quaternion_rate
from flexcage.core.vectors import (
    RIGID,
    TURN,
    combine,
    cross,
    minus,
    plus,
    put,
    times,
    turn_of,
    turned_back,
    xyz,
)
from flexcage.system.data import (
    AXIAL,
    CONSTRAINT_EQUATIONS,
    DRAG,
    DRIVE,
    FILM,
    FIXED,
    FREE_AXIAL,
    FREE_SKEW,
    FREE_TILT,
    GRAVITY,
    HOLD,
    IN_CONTACTS,
    IN_MOUNT,
    KINETIC,
    LAND_DAMPING,
    LAND_FRICTION,
    LOOSE,
    MASS,
    MODAL_DAMPING,
    MOUNT,
    OF_AXIAL,
    OF_LOAD,
    OF_SPEED,
    OTHER_LAND,
    OUTER_CLEARANCE,
    OUTER_DAMPING,
    OUTER_STIFFNESS,
    SHAFT_DAMPING,
    SHAFT_STIFFNESS,
    STRAIN,
    TRANSVERSE,
)
from flexcage.system.layout import (
    AXIAL_FORCE,
    CAGE,
    CAGE_TURN,
    DRIVE_TORQUE,
    HELD_VELOCITIES,
    INNER_TURN,
    MODES,
    MOMENT_Y,
    MOMENT_Z,
    N_LAMBDA,
    N_OWN,
    OUTER,
    Q_CAGE,
    Q_INNER_TURN,
    Q_MODES,
    Q_OUTER,
    Q_QUATERNION,
    places,
)
from flexcage.system.time_functions import table_integral, table_value, wave_integral, wave_value

# rows of ``Work.vec``: of the bodies, in space; of the pair under work, in the roller's frame F
CAGE_SPIN, RING_AXIS, RING_SPIN, LEVER, AXIS, PARTNER_V, PARTNER_W, GUIDE, GUIDE_V = range(9)
# the same rows when lands and rings have their turn: forces and moments on cage and guiding ring,
# forces of the outer ring on its housing and of the shaft on the inner ring
CAGE_FORCE, CAGE_MOMENT, RING_FORCE, RING_MOMENT = LEVER, AXIS, PARTNER_V, PARTNER_W
HOUSING_FORCE, SHAFT_PULL = LEVER, AXIS


class State(NamedTuple):
    """Rings and cage: their parts of y and y'."""

    q: np.ndarray  # coordinates
    u: np.ndarray  # velocities
    qd: np.ndarray  # rates of both in y'
    ud: np.ndarray
    lam: np.ndarray  # multipliers of drive and load
    mu: np.ndarray  # and of what they hold in place


class Residual(NamedTuple):
    """Parts of the residual that belong to them."""

    q: np.ndarray  # kinematics
    u: np.ndarray  # momentum
    g: np.ndarray  # constraints


def shared_equations(t, y, yd, d, law, out, mode):
    """Residual of cage, lands, rings and constraints; the elements' contacts are summed already.

    The elements' equations call it as a function value, so that it is compiled separately, in
    another process at the same time (a third of the work, measured).
    """
    nm = fields(d.pocket).phi_max.shape[0]
    at = places(fields(d.bodies).radius.shape[0], nm)
    q, u = y[at.rest_q : at.u], y[at.rest_u : at.lam]
    qd, ud = yd[at.rest_q : at.u], yd[at.rest_u : at.lam]
    r_q, r_u = out[at.rest_q : at.u], out[at.rest_u : at.lam]
    lam, mu = y[at.lam : at.lam + N_LAMBDA], y[at.lam + N_LAMBDA :]
    state, residual = State(q, u, qd, ud, lam, mu), Residual(r_q, r_u, out[at.lam :])
    land_forces(q, u, nm, d, law, mode)
    cage_equations(d, state, residual, mode)
    ring_equations(t, d, state, residual, mode)
    law[HOLD](t, y, yd, d, law[CONSTRAINT_EQUATIONS], out, mode)


@part
def speed_at(bodies, t):
    """Prescribed speed of the inner ring."""
    return table_value(bodies.speed, t) + wave_value(bodies.waves[OF_SPEED], t)


@part
def radial_load(bodies, t):
    """Radial load on the inner ring [N]."""
    return table_value(bodies.load, t) + wave_value(bodies.waves[OF_LOAD], t)


@part
def axial_load(bodies, t):
    """Axial load on the inner ring [N]."""
    return table_value(bodies.axial, t) + wave_value(bodies.waves[OF_AXIAL], t)


@part
def load_power(t, bodies, y, q, u, vec):
    """Power [W] of the loads on the inner ring; its coordinates in y begin at q, its velocities at
    u."""
    radial = bodies.load_direction[0] * y[u + 1] + bodies.load_direction[1] * y[u + 2]
    power = radial_load(bodies, t) * radial + axial_load(bodies, t) * y[u]
    if bodies.moments[0] != 0.0 or bodies.moments[1] != 0.0:
        inner_ring(y[q : q + Q_OUTER], y[u : u + OUTER], vec)
        spin = vec[RING_SPIN]
        power += bodies.moments[0] * spin[1] + bodies.moments[1] * spin[2]
    return power


@part
def drive_angle(bodies, t):
    """Angle that the prescribed speed has turned by time t since t = 0."""
    return table_integral(bodies.speed, bodies.angle, t) + wave_integral(bodies.waves[OF_SPEED], t)


@part
def ring_rates(q, u, out):
    """Kinematics of the inner ring (its frame does not orbit); returns its frame's axial rate."""
    skew = u[U_SKEW] / cos(q[Q_TILT])
    frame = skew * sin(q[Q_TILT])
    out[0], out[1], out[2] = u[0], u[1], u[2]
    out[Q_SKEW], out[Q_TILT], out[Q_SPIN] = skew, u[U_TILT], u[U_SPIN] - frame
    return frame


@part
def react(F, R, wrench, lever, border, at):
    """Reaction of an element's wrench on a partner at ``lever`` from it: force in space, moment in
    the frame with columns R."""
    f = xyz(wrench)
    m = plus(turn_of(wrench), cross(lever, f))
    f, m = turned_back(F, f), turned_back(R, turned_back(F, m))
    for c in range(3):
        border[at + c] -= f[c]
        border[at + TURN + c] -= m[c]


@part
def clear_sums(border, d, mode):
    """Set to zero what the contacts add to."""
    tan, rep = fields(d.tangent), fields(d.report)
    zero(border)
    if mode == TANGENT:
        zero(tan.Krr)
        zero(tan.Crr)
        zero(tan.Krb)
        zero(tan.Crb)
        zero(tan.Kbr)
        zero(tan.Cbr)
        zero(tan.Kbb)
        zero(tan.Cbb)
        zero(tan.Mbb)
    elif mode >= REPORT:
        zero(rep.power)
        zero(rep.energy)
        zero(rep.race)
        zero(rep.rib)
        zero(rep.contact)
        zero(rep.body_force)
        zero(rep.land)


@part
def inner_ring(q, u, vec):
    """Axis and angular velocity of the inner ring in space (its frame does not spin)."""
    cx, sx, ce, se = cos(q[Q_SKEW]), sin(q[Q_SKEW]), cos(q[Q_TILT]), sin(q[Q_TILT])
    axis = (cx * ce, se, -sx * ce)
    put(vec[RING_AXIS], axis)
    skew = (-cx * se, ce, sx * se)
    put(
        vec[RING_SPIN],
        combine(combine(times(u[U_SPIN], axis), u[U_SKEW], skew), u[U_TILT], (sx, 0.0, cx)),
    )


@part
def add_to_element(total, pair):
    for c in range(6):
        total[c] += pair.wrench[c]


@part(fastmath=VECTORISED)
def push_modes(data, i, pw, border):
    """Generalised forces of pocket i's station forces on the cage's modes."""
    modes = border[MODES:]
    for f in range(pw.st.shape[0]):
        if pw.normal[f] <= 0.0:
            continue
        for s in range(pw.st.shape[1]):
            x, y, z = pw.st[f, s, 0], pw.st[f, s, 1], pw.st[f, s, 2]
            if x == 0.0 and y == 0.0 and z == 0.0:
                continue
            shape = data.phi[i, f, s]
            for m in range(modes.shape[0]):
                modes[m] += x * shape[0, m] + y * shape[1, m] + z * shape[2, m]


@part
def land_forces(q, u, nm, d, law, mode):
    """Cage's lands on the ring that guides it and on the other one, and the drag on the cage."""
    work, data, rep = fields(d.scratch), fields(d.land), fields(d.report)
    vec, border, A = work.vec, work.border, work.A
    Fc, Mc, wg = vec[CAGE_FORCE], vec[CAGE_MOMENT], vec[CAGE_SPIN]
    zero(Fc)
    zero(Mc)
    inner = data.inner != 0
    lw, onset = fields(d.land_work), fields(d.memory).land
    cage, ring = LandCage(
        A, q[Q_CAGE:Q_QUATERNION], u[CAGE:CAGE_TURN], wg, q[Q_MODES:], u[MODES:]
    ), _land_ring(q, u, inner, vec, lw)  # fmt: skip
    forces = LandForces(
        Fc, Mc, border[MODES : MODES + nm], vec[RING_FORCE], vec[RING_MOMENT]
    )  # fmt: skip
    laws, sl = Laws(law[LAND_LAW], law[LAND_RUBS]), fields(d.slices).row[0]
    seen, met, pushed = cage, ring, forces
    tilted = inner and is_tilted(vec[RING_AXIS])
    if tilted:
        seen, met, pushed = _from_inner_ring(q, cage, ring, forces, work, lw)
    land_contact(seen, met, data, onset, laws, sl, lw, pushed, work.sums)
    if tilted:
        bring_back(pushed, work.R[0], forces)
    _push_ring(forces, inner, border)
    if mode >= REPORT:
        _report_land(lw.st, work.sums, 0, rep)
    if data.other_kind != NO_LAND:
        _other_ring(q, u, cage, forces, d, law, mode)
    drag = fields(d.bodies).drag[1] * abs(wg[0]) * wg[0]
    Mc[0] -= drag
    moment = turned_back(A, xyz(Mc))
    for c in range(3):
        border[CAGE + c] += Fc[c]
        border[CAGE_TURN + c] += moment[c]
    if mode >= REPORT:
        copy_into(rep.land, Fc)
        rep.power[DRAG] -= drag * wg[0]


@part
def _land_ring(q, u, inner, vec, lw):
    """Inner or outer ring as the cage's land meets it, where it is not tilted."""
    where, speed, turn = vec[GUIDE], vec[GUIDE_V], lw.seen[AT_REST]
    if inner:
        put(where, xyz(q[:Q_INNER_TURN]))
        put(speed, xyz(u[:INNER_TURN]))
        turn = u[INNER_TURN:OUTER]
    else:
        put(where, (0.0, q[Q_OUTER], q[Q_OUTER + 1]))
        put(speed, (0.0, u[OUTER], u[OUTER + 1]))
    zero(vec[RING_FORCE])
    zero(vec[RING_MOMENT])
    return LandRing(where, speed, turn)


@part
def _from_inner_ring(q, cage, ring, forces, work, lw):
    """Cage, ring and forces in the frame of an inner ring that is tilted: ``work.R[0]``."""
    frame, axis = work.R[0], xyz(work.vec[RING_AXIS])
    third = (sin(q[Q_SKEW]), 0.0, cos(q[Q_SKEW]))
    for k, e in enumerate((axis, cross(third, axis), third)):
        frame[0, k], frame[1, k], frame[2, k] = e
    return seen_from_ring(cage, ring, frame, forces.modal, lw)


@outlined
def _other_ring(q, u, cage, forces, d, law, mode):
    """The cage on the ring that does not guide it."""
    work, data, rep = fields(d.scratch), fields(d.land), fields(d.report)
    land, inner = other_land(data), data.inner == 0
    laws, sl = Laws(law[LAND_LAW], law[LAND_RUBS]), fields(d.slices).row[0]
    lw, onset = fields(d.land_work), fields(d.memory).land[OTHER_LAND:]
    ring = _land_ring(q, u, inner, work.vec, lw)
    seen, met, pushed = cage, ring, forces
    tilted = inner and is_tilted(work.vec[RING_AXIS])
    if tilted:
        seen, met, pushed = _from_inner_ring(q, cage, ring, forces, work, lw)
    other_contact(seen, met, land, onset, laws, sl, lw, pushed, work.sums)
    if tilted:
        bring_back(pushed, work.R[0], forces)
    _push_ring(forces, inner, work.border)
    if mode >= REPORT:
        _report_land(lw.st, work.sums, OTHER_LAND, rep)


@part
def _push_ring(forces, inner, border):
    """Add what lands do to inner or outer ring."""
    Fr, Mr = forces.ring_force, forces.ring_moment
    if inner:
        for c in range(3):
            border[c] += Fr[c]
            border[INNER_TURN + c] += Mr[c]
    else:
        border[OUTER] += Fr[1]
        border[OUTER + 1] += Fr[2]


@part
def _report_land(st, sums, first, rep):
    """Report two lands, the ones from ``first`` on, with the forces at their stations."""
    begin = 0 if first == 0 else st.shape[0]
    copy_into(rep.land_station[begin : begin + st.shape[0]], st)
    for c in range(2):
        rep.land_touch[first + c, 0] = sums[NORMAL + c]
        rep.land_touch[first + c, 1] = sums[APPROACH + c]
    rep.energy[IN_CONTACTS] += sums[STORED]
    rep.power[LAND_DAMPING] += sums[DAMPED]
    rep.power[LAND_FRICTION] += sums[RUBBED]
    rep.power[FILM] += sums[SHEARED]


@part(fastmath=VECTORISED)
def cage_equations(d, state, residual, mode):
    """Rows of the cage: floating frame, translations in space, rotations in the body."""
    quat, qf = state.q[Q_QUATERNION:Q_MODES], state.q[Q_MODES:]
    Vc, wb, qfd = state.u[CAGE:CAGE_TURN], state.u[CAGE_TURN:MODES], state.u[MODES:]
    qd, ud, r_q, r_u = state.qd, state.ud, residual.q, residual.u
    data, tan, rep, work = fields(d.cage), fields(d.tangent), fields(d.report), fields(d.scratch)
    frame, A, border = fields(d.frame), work.A, work.border
    nm = qf.shape[0]
    acc, v, product = frame.w[0], frame.w[1], frame.w[2]
    M, H, h = frame.rigid, frame.coupled, frame.h
    inertia_terms(data, wb, qf, qfd, frame)
    rate = work.S[0]
    quaternion_rate(quat, wb, rate)
    for c in range(3):
        r_q[Q_CAGE + c] = qd[Q_CAGE + c] - Vc[c]
    for c in range(4):
        r_q[Q_QUATERNION + c] = qd[Q_QUATERNION + c] - rate[c]
    for m in range(nm):
        r_q[Q_MODES + m] = qd[Q_MODES + m] - qfd[m]
    gb = turned_back(A, xyz(fields(d.bodies).gravity))
    # gravity is an acceleration of the whole body
    put(acc, minus(turned_back(A, xyz(ud[CAGE:CAGE_TURN])), gb))
    for c in range(3):
        acc[TURN + c] = ud[CAGE_TURN + c]
    modes = ud[MODES : MODES + nm]
    for k in range(6):
        x = h[k]
        for c in range(6):
            x += M[k, c] * acc[c]
        for m in range(nm):
            x += H[k, m] * modes[m]
        v[k] = x
    for c in range(3):
        x = A[c, 0] * v[0] + A[c, 1] * v[1] + A[c, 2] * v[2]
        r_u[CAGE + c] = x - border[CAGE + c]
        r_u[CAGE_TURN + c] = v[TURN + c] - border[CAGE_TURN + c]
    row_of = r_u[MODES : MODES + nm]
    for m in range(nm):
        row_of[m] = h[RIGID + m] - border[MODES + m]
        for c in range(6):
            row_of[m] += H[c, m] * acc[c]
    modal_product(data.mff, data.plain, modes, product)
    for m in range(nm):
        row_of[m] += product[m]
    modal_product(data.kff, data.plain, qf, product)
    for m in range(nm):
        row_of[m] += product[m]
    modal_product(data.dff, data.plain, qfd, product)
    for m in range(nm):
        row_of[m] += product[m]
    if mode == TANGENT:
        for a in range(3):  # translations to space
            for b in range(3):
                x = y = 0.0
                for c in range(3):
                    x += A[a, c] * M[c, TURN + b]
                    y += M[TURN + b, c] * A[a, c]
                tan.Mbb[CAGE + a, CAGE + b] = data.mass if a == b else 0.0
                tan.Mbb[CAGE + a, CAGE_TURN + b] = x
                tan.Mbb[CAGE_TURN + b, CAGE + a] = y
                tan.Mbb[CAGE_TURN + a, CAGE_TURN + b] = M[TURN + a, TURN + b]
        for m in range(nm):
            for a in range(3):
                x = A[a, 0] * H[0, m] + A[a, 1] * H[1, m] + A[a, 2] * H[2, m]
                tan.Mbb[CAGE + a, MODES + m] = tan.Mbb[MODES + m, CAGE + a] = x
                turn = H[TURN + a, m]
                tan.Mbb[CAGE_TURN + a, MODES + m] = tan.Mbb[MODES + m, CAGE_TURN + a] = turn
            for l in range(nm):
                tan.Mbb[MODES + m, MODES + l] = data.mff[m, l]
        for m in range(nm):
            for l in range(nm):
                tan.Kbb[MODES + m, MODES + l] += data.kff[m, l]
                tan.Cbb[MODES + m, MODES + l] += data.dff[m, l]
    elif mode >= REPORT:
        for m in range(nm):  # the product is that of the damping
            rep.power[MODAL_DAMPING] -= qfd[m] * product[m]
        put(v, turned_back(A, xyz(Vc)))
        for c in range(3):
            v[TURN + c] = wb[c]
        for k in range(6):
            momentum = 0.0
            for m in range(nm):
                momentum += H[k, m] * qfd[m]
            if k < 3:  # what gravity does on the body's first moment of mass
                rep.power[GRAVITY] += gb[k] * momentum
            rep.energy[KINETIC] += v[k] * momentum
            for c in range(6):
                rep.energy[KINETIC] += 0.5 * v[k] * M[k, c] * v[c]
                if c < 3:
                    rep.power[GRAVITY] += v[k] * M[k, c] * gb[c]
        modal_product(data.mff, data.plain, qfd, product)
        for m in range(nm):
            rep.energy[KINETIC] += 0.5 * qfd[m] * product[m]
        modal_product(data.kff, data.plain, qf, product)
        for m in range(nm):
            rep.energy[STRAIN] += 0.5 * qf[m] * product[m]


@part
def _housing(bodies, q, u, held, tan, mode):
    """Force ``held`` of the outer ring on its housing; returns energy stored and power lost."""
    k, c = bodies.outer[OUTER_STIFFNESS], bodies.outer[OUTER_DAMPING]
    held[0] = held[1] = 0.0
    distance = sqrt(q[0] * q[0] + q[1] * q[1])
    n = (1.0, 0.0) if distance == 0.0 else (q[0] / distance, q[1] / distance)
    if bodies.support != LOOSE:
        for i in range(2):
            held[i] = k * q[i] + c * u[i]
            if mode == TANGENT:
                tan.Kbb[OUTER + i, OUTER + i] += k
                tan.Cbb[OUTER + i, OUTER + i] += c
        return 0.5 * k * distance * distance, c * (u[0] * u[0] + u[1] * u[1])
    depth = distance - bodies.outer[OUTER_CLEARANCE]
    rate = n[0] * u[0] + n[1] * u[1]
    force = k * depth + c * rate
    if depth <= 0.0:
        return 0.0, 0.0
    if force <= 0.0:  # it parts while still compressed: what is stored relaxes unseen
        return 0.5 * k * depth * depth, -k * depth * rate
    for i in range(2):
        held[i] = force * n[i]
        if mode == TANGENT:
            for j in range(2):
                across = (1.0 if i == j else 0.0) - n[i] * n[j]
                tan.Kbb[OUTER + i, OUTER + j] += k * n[i] * n[j] + force / distance * across
                tan.Cbb[OUTER + i, OUTER + j] += c * n[i] * n[j]
    return 0.5 * k * depth * depth, c * rate * rate


@part
def shaft_pull(bodies, q, u, pull):
    """Force of the shaft on the inner ring, axial and moments of skew and tilt, into ``pull``.

    What pulls motions that are free is known, not a constraint's; zero where there is no spring.
    Returns energy stored and power lost.
    """
    away = (q[0], q[Q_SKEW], q[Q_TILT] - bodies.misalignment)
    speed = (u[0], u[U_SKEW], u[U_TILT])
    stored = lost = 0.0
    for k in range(3):
        stiffness, damping = bodies.spring[k, 0], bodies.spring[k, 1]
        force = stiffness * away[k]
        if k == 1:  # the ring's own axis turns slower than skew
            force /= cos(q[Q_TILT])
        pull[k] = -force - damping * speed[k]
        stored += 0.5 * stiffness * away[k] * away[k]
        lost += damping * speed[k] * speed[k]
    return stored, lost


@part
def constraint_slopes(bodies, tan):
    """Slopes of the constraints in ``ring_equations`` in coordinates, velocities and multipliers
    (multipliers of positions are displacements)."""
    first = tan.Kbb.shape[0] - N_OWN - 2 * tan.held.shape[0]
    for k in range(3):
        rate, place, at = first + k, first + N_LAMBDA + k, HELD_VELOCITIES[k]
        if bodies.free[k] != 0:
            tan.Kbb[rate, at], tan.Cbb[rate, at] = bodies.spring[k, 0], bodies.spring[k, 1]
            tan.Cbb[rate, rate] = tan.Cbb[place, place] = 1.0
        else:
            tan.Cbb[rate, at] = tan.Kbb[place, at] = tan.Kbb[place, place] = 1.0
    drive = first + 3
    tan.Cbb[drive, INNER_TURN if bodies.by_shaft == 0 else drive] = 1.0


@part
def ring_equations(t, d, state, residual, mode):
    """Rows of the inner and outer rings and of the constraints."""
    q, u, qd, ud, lam, mu = state
    r_q, r_u, g = residual
    bodies, tan, rep = fields(d.bodies), fields(d.tangent), fields(d.report)
    work, border = fields(d.scratch), fields(d.scratch).border
    rq, ru, rud = q[:Q_OUTER], u[:OUTER], ud[:OUTER]
    rates = work.S[0]
    frame = ring_rates(rq, ru, rates)
    for c in range(6):
        r_q[c] = qd[c] - rates[c]
    r_q[0] -= mu[0]
    r_q[Q_INNER_TURN] -= mu[1]
    r_q[Q_INNER_TURN + 1] -= mu[2]
    mass, Ia, It = bodies.ring[MASS], bodies.ring[AXIAL], bodies.ring[TRANSVERSE]
    load, axial = radial_load(bodies, t), axial_load(bodies, t)
    # moments about the ring's own (non-spinning) axes
    cx, sx, ce, se = cos(rq[Q_SKEW]), sin(rq[Q_SKEW]), cos(rq[Q_TILT]), sin(rq[Q_TILT])
    Mx, My, Mz = (
        border[INNER_TURN],
        border[INNER_TURN + 1] + bodies.moments[0],
        border[INNER_TURN + 2] + bodies.moments[1],
    )
    M1 = cx * ce * Mx + se * My - sx * ce * Mz
    M2 = -cx * se * Mx + ce * My + sx * se * Mz
    M3 = sx * Mx + cx * Mz
    target = speed_at(bodies, t)
    shaft = 0.0
    if bodies.by_shaft != 0:
        shaft = bodies.shaft[SHAFT_STIFFNESS] * (drive_angle(bodies, t) - rq[Q_SPIN])
        shaft += bodies.shaft[SHAFT_DAMPING] * (target - ru[U_SPIN])
    for c in range(3):
        r_u[c] = mass * (rud[c] - bodies.gravity[c]) - border[c]
    r_u[0] -= lam[AXIAL_FORCE] + axial
    r_u[1] -= load * bodies.load_direction[0]
    r_u[2] -= load * bodies.load_direction[1]
    spin, skew, tilt = turn_of(ru)
    r_u[U_SPIN] = Ia * rud[U_SPIN] - M1 - lam[DRIVE_TORQUE] - shaft
    r_u[U_SKEW] = It * (rud[U_SKEW] - frame * tilt) + Ia * spin * tilt - M2 - lam[MOMENT_Y]
    r_u[U_TILT] = It * (rud[U_TILT] + frame * skew) - Ia * spin * skew - M3 - lam[MOMENT_Z]
    # outer ring
    oq, ou, oud = q[Q_OUTER:Q_CAGE], u[OUTER:CAGE], ud[OUTER:CAGE]
    mo, fixed = bodies.outer[MASS], bodies.support == FIXED
    held = work.vec[HOUSING_FORCE]
    stored, lost = _housing(bodies, oq, ou, held, tan, mode)
    for c in range(2):
        r_q[Q_OUTER + c] = qd[Q_OUTER + c] - ou[c]
        if fixed:
            r_u[OUTER + c] = oud[c]
        else:
            force = border[OUTER + c] - held[c] + mo * bodies.gravity[1 + c]
            r_u[OUTER + c] = mo * oud[c] - force
    # constraints: lambda rows hold rates, mu rows positions; what is free has the shaft's lambda
    free, pull = bodies.free, work.vec[SHAFT_PULL]
    bent, damped = shaft_pull(bodies, rq, ru, pull)
    g[AXIAL_FORCE] = lam[AXIAL_FORCE] - pull[0] if free[FREE_AXIAL] != 0 else ru[0]
    g[MOMENT_Y] = lam[MOMENT_Y] - pull[1] if free[FREE_SKEW] != 0 else ru[U_SKEW]
    g[MOMENT_Z] = lam[MOMENT_Z] - pull[2] if free[FREE_TILT] != 0 else ru[U_TILT]
    g[DRIVE_TORQUE] = ru[U_SPIN] - target if bodies.by_shaft == 0 else lam[DRIVE_TORQUE]
    g[N_LAMBDA] = mu[0] if free[FREE_AXIAL] != 0 else rq[0]
    g[N_LAMBDA + 1] = mu[1] if free[FREE_SKEW] != 0 else rq[Q_SKEW]
    g[N_LAMBDA + 2] = mu[2] if free[FREE_TILT] != 0 else rq[Q_TILT] - bodies.misalignment
    if mode == TANGENT:
        constraint_slopes(bodies, tan)
        for c in range(3):
            tan.Mbb[c, c] = mass
        tan.Mbb[U_SPIN, U_SPIN] = Ia
        tan.Mbb[U_SKEW, U_SKEW] = tan.Mbb[U_TILT, U_TILT] = It
        tan.Cbb[U_SKEW, U_TILT] += Ia * ru[U_SPIN]
        tan.Cbb[U_TILT, U_SKEW] -= Ia * ru[U_SPIN]
        if bodies.by_shaft != 0:
            tan.Kbb[U_SPIN, U_SPIN] += bodies.shaft[SHAFT_STIFFNESS]
            tan.Cbb[U_SPIN, U_SPIN] += bodies.shaft[SHAFT_DAMPING]
        for c in range(2):
            tan.Mbb[OUTER + c, OUTER + c] = 1.0 if fixed else mo
            if fixed:  # its row is u' = 0, whatever pushes it
                zero(tan.Kbb[OUTER + c])
                zero(tan.Cbb[OUTER + c])
                for i in range(tan.Kbr.shape[0]):
                    zero(tan.Kbr[i, OUTER + c])
                    zero(tan.Cbr[i, OUTER + c])
    elif mode >= REPORT:
        w2 = ru[U_SKEW] * ru[U_SKEW] + ru[U_TILT] * ru[U_TILT]
        v2 = ru[0] * ru[0] + ru[1] * ru[1] + ru[2] * ru[2]
        rep.energy[KINETIC] += 0.5 * (mass * v2 + Ia * ru[U_SPIN] * ru[U_SPIN] + It * w2)
        # what loads and constraints do follows from y alone: ``sampling.give_powers`` adds it
        rep.power[DRIVE] += shaft * ru[U_SPIN]
        for c in range(3):
            rep.power[GRAVITY] += mass * bodies.gravity[c] * ru[c]
        rep.energy[IN_MOUNT] += bent
        rep.power[MOUNT] -= damped
        if not fixed:
            rep.energy[IN_MOUNT] += stored
            rep.power[MOUNT] -= lost
            for c in range(2):
                rep.energy[KINETIC] += 0.5 * mo * ou[c] * ou[c]
                rep.power[GRAVITY] += mo * bodies.gravity[1 + c] * ou[c]
        for c in range(2):
            rep.body_force[c] = border[OUTER + c]
