"""Equations that all bearings share: drive and load on the inner ring, and the order in which
lands, cage, rings and constraints have their turn.

Rolling elements differ from type to type; what they push is collected in ``Scratch.border``, where
every body has its rows, and balanced here.
"""

from __future__ import annotations

from flexcage.contacts.evaluation import REPORT, TANGENT
from flexcage.contacts.state import Q_SKEW, Q_SPIN, Q_TILT, U_SKEW, U_SPIN, U_TILT
from flexcage.core.jit import array_from, fields, part, zero
from flexcage.core.vectors import RIGID, TURN, cross, plus, turn_of, turned_back, xyz
from flexcage.system.data import (
    CONSTRAINT_EQUATIONS,
    DRIVE,
    HOLD,
    IN_MOUNT,
    MOUNT,
    OF_AXIAL,
    OF_LOAD,
    OF_SPEED,
    RING_SPIN,
    SHAFT_DAMPING,
    SHAFT_STIFFNESS,
)
from flexcage.system.floating import cage_equations, take_cage
from flexcage.system.lands import land_forces
from flexcage.system.layout import (
    AXIAL_FORCE,
    DRIVE_TORQUE,
    HELD_VELOCITIES,
    MOMENT_Y,
    MOMENT_Z,
    N_LAMBDA,
)
from flexcage.system.ring import (
    inner_of,
    outer_of,
    outer_rows,
    ring_energy,
    ring_rows,
    ring_slopes,
    ring_springs,
    rows_at,
    set_axis,
)
from flexcage.system.time_functions import table_integral, table_value, wave_integral, wave_value


def shared_equations(t, y, yd, d, law, out, mode):
    """Residual of cage, lands, rings and constraints; the elements' contacts are summed already.

    The elements' equations call it as a function value, so that it is compiled separately, in
    another process at the same time (a third of the work, measured).
    """
    at = fields(d.places)
    for k in range(at.cages):
        if at.cages > 1:
            take_cage(k, y, d)
        land_forces(k, y, d, law, mode)
        cage_equations(k, y, yd, d, out, mode)
    _inner_equations(t, y, yd, d, out, mode)
    rates, rows = rows_at(yd, at.outer_q, at.outer_u), rows_at(out, at.outer_q, at.outer_u)
    sloped, reported = mode == TANGENT, mode >= REPORT
    outer_rows(fields(d.outer_ring), outer_of(y, d), rates, rows, d, sloped, reported)
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
def load_power(t, y, d):
    """Power [W] of the loads on the inner ring."""
    bodies, at, axes = fields(d.bodies), fields(d.places), fields(d.scratch).rings
    q, u = array_from(y, at.inner_q), array_from(y, at.inner_u)
    radial = bodies.load_direction[0] * u[1] + bodies.load_direction[1] * u[2]
    power = radial_load(bodies, t) * radial + axial_load(bodies, t) * u[0]
    if bodies.moments[0] != 0.0 or bodies.moments[1] != 0.0:
        set_axis(q, u, axes[0])
        spin = axes[0, RING_SPIN]
        power += bodies.moments[0] * spin[1] + bodies.moments[1] * spin[2]
    return power


@part
def drive_angle(bodies, t):
    """Angle that the prescribed speed has turned by time t since t = 0."""
    return table_integral(bodies.speed, bodies.angle, t) + wave_integral(bodies.waves[OF_SPEED], t)


@part
def react(F, R, wrench, lever, border, b):
    """Reaction of an element's wrench on a body at ``lever`` from it, whose rows of the border
    begin at b: force in space, moment in the frame with columns R."""
    f = xyz(wrench)
    m = plus(turn_of(wrench), cross(lever, f))
    f, m = turned_back(F, f), turned_back(R, turned_back(F, m))
    for c in range(3):
        border[b + c] -= f[c]
        border[b + TURN + c] -= m[c]


@part
def push_pair(i, wrench, R, lever, b, d):
    """Add a contact's wrench to element i, and its reaction to the body that is ``lever`` from it
    (as ``react``)."""
    work = fields(d.scratch)
    for c in range(RIGID):
        work.wrenches[i, c] += wrench[c]
    react(fields(d.pose).F, R, wrench, lever, work.border, b)


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
        zero(rep.outer_wrench)
        zero(rep.land)


@part
def _inner_equations(t, y, yd, d, out, mode):
    """Rows of the inner ring under load and drive, and of the constraints that hold it."""
    bodies, body, tan = fields(d.bodies), fields(d.inner_ring), fields(d.tangent)
    at, work, rep = fields(d.places), fields(d.scratch), fields(d.report)
    ring, lam, g = inner_of(y, d), array_from(y, at.lam), array_from(out, at.lam)
    q, u, mu = ring.q, ring.u, array_from(y, at.lam + N_LAMBDA)
    rates, rows = rows_at(yd, at.inner_q, at.inner_u), rows_at(out, at.inner_q, at.inner_u)
    r_q, r_u, push = rows.q, rows.u, array_from(work.border, ring.b)
    ring_rows(body, ring, rates, push, bodies.gravity, bodies.moments, work.S[0], rows)
    r_q[0] -= mu[0]
    r_q[Q_SKEW] -= mu[1]
    r_q[Q_TILT] -= mu[2]
    load, axial, target = radial_load(bodies, t), axial_load(bodies, t), speed_at(bodies, t)
    shaft = 0.0
    if bodies.by_shaft != 0:
        shaft = bodies.shaft[SHAFT_STIFFNESS] * (drive_angle(bodies, t) - q[Q_SPIN])
        shaft += bodies.shaft[SHAFT_DAMPING] * (target - u[U_SPIN])
    r_u[0] -= lam[AXIAL_FORCE] + axial
    r_u[1] -= load * bodies.load_direction[0]
    r_u[2] -= load * bodies.load_direction[1]
    r_u[U_SPIN] -= lam[DRIVE_TORQUE] + shaft
    r_u[U_SKEW] -= lam[MOMENT_Y]
    r_u[U_TILT] -= lam[MOMENT_Z]
    # lambda rows hold rates, mu rows places; of what is free lambda is the pull of the shaft
    free, rest, pull = body.free, body.rest, work.pull
    bent, damped = ring_springs(body, q, u, pull)
    g[AXIAL_FORCE] = lam[AXIAL_FORCE] - pull[0] if free[0] != 0 else u[0]
    g[MOMENT_Y] = lam[MOMENT_Y] - pull[U_SKEW] if free[U_SKEW] != 0 else u[U_SKEW]
    g[MOMENT_Z] = lam[MOMENT_Z] - pull[U_TILT] if free[U_TILT] != 0 else u[U_TILT]
    g[DRIVE_TORQUE] = u[U_SPIN] - target if free[U_SPIN] == 0 else lam[DRIVE_TORQUE]
    g[N_LAMBDA] = mu[0] if free[0] != 0 else q[0] - rest[0]
    g[N_LAMBDA + 1] = mu[1] if free[U_SKEW] != 0 else q[Q_SKEW] - rest[U_SKEW]
    g[N_LAMBDA + 2] = mu[2] if free[U_TILT] != 0 else q[Q_TILT] - rest[U_TILT]
    if mode == TANGENT:
        ring_slopes(body, u, ring.b, tan)
        _constraint_slopes(body, ring.b, at.border, tan)
        if bodies.by_shaft != 0:
            tan.Kbb[ring.b + U_SPIN, ring.b + U_SPIN] += bodies.shaft[SHAFT_STIFFNESS]
            tan.Cbb[ring.b + U_SPIN, ring.b + U_SPIN] += bodies.shaft[SHAFT_DAMPING]
    elif mode >= REPORT:
        ring_energy(body, u, bodies.gravity, rep)
        # what loads and constraints do follows from y alone: ``sampling.give_powers`` adds it
        rep.power[DRIVE] += shaft * u[U_SPIN]
        rep.energy[IN_MOUNT] += bent
        rep.power[MOUNT] -= damped


@part
def _constraint_slopes(body, b, first, tan):
    """Slopes of the rows of drive and load, the first one at ``first`` in the border, in
    coordinates, velocities and multipliers (multipliers of places are displacements)."""
    for k in range(3):
        rate, place, c = first + k, first + N_LAMBDA + k, HELD_VELOCITIES[k]
        if body.free[c] != 0:
            tan.Kbb[rate, b + c], tan.Cbb[rate, b + c] = body.stiffness[c, c], body.damping[c, c]
            tan.Cbb[rate, rate] = tan.Cbb[place, place] = 1.0
        else:
            tan.Cbb[rate, b + c] = tan.Kbb[place, b + c] = tan.Kbb[place, place] = 1.0
    drive = first + DRIVE_TORQUE
    tan.Cbb[drive, b + U_SPIN if body.free[U_SPIN] == 0 else drive] = 1.0
