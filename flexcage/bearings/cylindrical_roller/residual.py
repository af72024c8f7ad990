"""The residual F(t, y, y') = 0 of a roller bearing, its tangent, and its report.

One kind of contact after another is evaluated for all rollers, races in lots of them, and its
wrenches added to the bodies; then the rows are formed: kinematics q' - T(q) u - G^T mu, momentum
M u' + h - Q - G^T lambda, g and its rate. (With one roller's contacts after the other the code of
all of them passes through the processor's cache 22 times: a sixth more time.)
``mode`` is one of ``contacts.evaluation``.
"""

from __future__ import annotations

from flexcage.contacts.evaluation import (
    DAMPED,
    N_RACE,
    NORMAL,
    OUTER_RING,
    RACE_LAW,
    RACE_RUBS,
    REPORT,
    RESIDUAL,
    RIB_LAW,
    RIB_RUBS,
    ROLLED,
    RUBBED,
    STORED,
    TANGENT,
)
from flexcage.contacts.race import meet_race, press_race, push_by_race
from flexcage.contacts.rib import rib_contact
from flexcage.contacts.slices import Laws
from flexcage.contacts.state import (
    AXIS,
    CENTRE,
    Q_SKEW,
    Q_SPIN,
    Q_TILT,
    SPIN,
    U_SKEW,
    U_SPIN,
    U_TILT,
    VELOCITY,
    keep_pose,
    set_pose,
    shift_matrix,
    take_pose,
)
from flexcage.core.jit import copy_into, fields, part, zero
from flexcage.core.rotation import matrix_from_quaternion
from flexcage.core.vectors import (
    minus,
    put,
    turn_of,
    turned,
    xyz,
)
from flexcage.system.blocks import scatter, scatter_outer
from flexcage.system.data import (
    AXIAL,
    DRAG,
    FAMILY_PARTS,
    GRAVITY,
    IN_CONTACTS,
    INNER_RACE,
    KINETIC,
    MASS,
    OUTER_RACE,
    POCKET,
    RACE_DAMPING,
    RACE_FRICTION,
    RIB_DAMPING,
    RIB_FRICTION,
    ROLLING_RESISTANCE,
    TRANSVERSE,
)
from flexcage.system.equations import (
    CAGE_SPIN,
    RING_AXIS,
    RING_SPIN,
    add_to_element,
    clear_sums,
    inner_ring,
    react,
)
from flexcage.system.layout import (
    CAGE,
    CAGE_TURN,
    INNER,
    MODES,
    OUTER,
    Q_CAGE,
    Q_MODES,
    Q_OUTER,
    Q_QUATERNION,
    of_element,
    places,
)

# places in ``law``: the family's functions ``separate``
POCKETS, SHARED = FAMILY_PARTS, FAMILY_PARTS + 1


@part
def roller_rates(q, u, axis, out):
    """Kinematics of a roller: out = T(q) u; returns the axial rate of its non-spinning frame.

    ``axis``: rows of its pose, which hold cosine and sine of skew and tilt.
    """
    orbit = u[2] / q[1]
    cx, sx, ce, se = axis[2, 2], axis[2, 0], axis[1, 1], axis[0, 1]
    skew = (u[U_SKEW] + orbit * cx * se) / ce
    frame = orbit * cx * ce + skew * se
    out[0], out[1], out[2] = u[0], u[1], orbit
    out[Q_SKEW], out[Q_TILT], out[Q_SPIN] = skew, u[U_TILT] - orbit * sx, u[U_SPIN] - frame
    return frame


def evaluate(t, y, yd, d, law, out, mode):
    """Residual into ``out``; see the module's text. Index letters: i roller, c component, m mode.

    ``d`` (``problem.Parts``) refers to the model, its memory and its workspaces; ``law`` holds
    the normal laws of race, pocket, side, rib and land, their friction laws, the rows of further
    constraints and what puts these in (``holding.hold``), and what is compiled separately:
    ``roller_pockets`` and ``equations.shared_equations``.
    """
    Z = fields(d.bodies).radius.shape[0]
    nm = fields(d.pocket).phi_max.shape[0]
    at = places(Z, nm)
    q, u, qd, ud = y[: at.rest_q], y[at.u : at.rest_u], yd[: at.rest_q], yd[at.u : at.rest_u]
    r_q, r_u = out[: at.rest_q], out[at.u : at.rest_u]
    rest_q, rest_u = y[at.rest_q : at.u], y[at.rest_u : at.lam]
    asked = RESIDUAL if mode == OUTER_RING else mode
    set_bodies(q, u, rest_q, rest_u, d, asked)
    ring_q, ring_u = rest_q[:Q_OUTER], rest_u[:OUTER]
    lot = fields(d.race_work).who.shape[0]
    for first in range(0, Z if mode != OUTER_RING else 0, lot):
        _inner_contacts(first, min(first + lot, Z), q, ring_q, ring_u, d, law, mode)
    out_q, out_u = rest_q[Q_OUTER:Q_CAGE], rest_u[OUTER:CAGE]
    for first in range(0, Z, lot):
        _outer_contacts(first, min(first + lot, Z), q, out_q, out_u, d, law, asked)
    outer_ribs(q, out_q, out_u, d, law, asked)
    if mode >= REPORT:
        report_outer(d)
    if mode == OUTER_RING:
        return
    law[POCKETS](t, y, yd, d, law[:FAMILY_PARTS], out, mode)
    roller_rows(q, u, qd, ud, d, r_q, r_u, mode)
    law[SHARED](t, y, yd, d, law[:FAMILY_PARTS], out, mode)


@part
def set_bodies(q, u, rest_q, rest_u, d, mode):
    """Attitude and spin of cage and inner ring, poses of the rollers, and no forces yet."""
    work, pose = fields(d.scratch), fields(d.pose)
    clear_sums(work.border, d, mode)
    matrix_from_quaternion(rest_q[Q_QUATERNION:Q_MODES], work.A)
    put(work.vec[CAGE_SPIN], turned(work.A, xyz(rest_u[CAGE_TURN:MODES])))
    inner_ring(rest_q[:Q_OUTER], rest_u[:OUTER], work.vec)
    zero(work.wrenches)
    for i in range(fields(d.bodies).radius.shape[0]):
        own = of_element(i)
        set_pose(q[own], u[own], pose)
        pose.spot[0] = fields(d.spot).has[i]
        pose.spot[1] = fields(d.spot).angle + q[own][Q_SPIN]
        keep_pose(pose, work.poses[i])


@part
def report_outer(d):
    """The races' force on the outer ring, which nothing else has pushed yet."""
    for c in range(2):
        fields(d.report).outer_races[c] = fields(d.scratch).border[OUTER + c]


@part
def beside_inner(i, q, ring_q, ring_u, d, at):
    """The inner ring as the partner ``at`` of roller i, whose pose is taken."""
    F, vec, qi = fields(d.pose).F, fields(d.scratch).vec, q[of_element(i)]
    put(at[CENTRE], minus((qi[0], qi[1], 0.0), turned(F, xyz(ring_q))))
    put(at[AXIS], turned(F, xyz(vec[RING_AXIS])))
    put(at[VELOCITY], turned(F, xyz(ring_u)))
    put(at[SPIN], turned(F, xyz(vec[RING_SPIN])))


@part
def beside_outer(i, q, out_q, out_u, d, at):
    """The same of the outer ring, which moves in its plane only."""
    F, qi = fields(d.pose).F, q[of_element(i)]
    put(at[CENTRE], minus((qi[0], qi[1], 0.0), turned(F, (0.0, out_q[0], out_q[1]))))
    put(at[AXIS], (1.0, 0.0, 0.0))
    put(at[VELOCITY], turned(F, (0.0, out_u[0], out_u[1])))
    put(at[SPIN], (0.0, 0.0, 0.0))


@part
def on_ribs(i, at, ribs, d, law, mode):
    """Does roller i touch the ``ribs`` of a ring, its partner ``at``? What they do to it."""
    laws, sl = Laws(law[RIB_LAW], law[RIB_RUBS]), fields(d.slices).row[0]
    speeds, sums = fields(d.memory).rib[i, ribs.column :], fields(d.scratch).sums
    return rib_contact(fields(d.pose), at, ribs, speeds, laws, sl, fields(d.pair), mode, sums)


@part
def inner_ribs(i, at, d, law, mode):
    """Roller i on the ribs of the inner ring, its partner ``at``."""
    ribs = fields(d.rib)
    if on_ribs(i, at, ribs, d, law, mode):
        add_inner(i, at[CENTRE], d, mode)
        if mode >= REPORT:
            report_ribs(i, ribs.column, fields(d.scratch).sums, fields(d.report))


@part
def _inner_contacts(first, end, q, ring_q, ring_u, d, law, mode):
    """Rollers ``first`` to before ``end`` on the inner race and its ribs."""
    pose, pair, rep, work = fields(d.pose), fields(d.pair), fields(d.report), fields(d.scratch)
    side, rw, memory = fields(d.inner), fields(d.race_work), fields(d.memory)
    sums, radius = work.sums, fields(d.bodies).radius
    race_laws, count = Laws(law[RACE_LAW], law[RACE_RUBS]), 0
    for i in range(first, end):
        take_pose(work.poses[i], pose)
        at = rw.partner[count]
        beside_inner(i, q, ring_q, ring_u, d, at)
        inner_ribs(i, at, d, law, mode)
        onset = memory.race[i, INNER_RACE]
        if meet_race(count, pose, side, radius[i], ring_q[Q_SPIN], onset, rw):
            rw.who[count] = i
            count += 1
    press_race(count, side, race_laws, rw)
    for m in range(count):
        i = rw.who[m]
        take_pose(work.poses[i], pose)
        push_by_race(m, pose, side, radius[i], ring_q[Q_SPIN], rw, pair, mode, sums)
        add_inner(i, rw.partner[m, CENTRE], d, mode)
        if mode >= REPORT:
            report_race(i, INNER_RACE, sums, rep)


@part
def add_inner(i, P, d, mode):
    """Add the pair's wrench to roller i and to the inner ring, from which P leads to the roller."""
    pair, work, F = fields(d.pair), fields(d.scratch), fields(d.pose).F
    add_to_element(work.wrenches[i], pair)
    react(F, work.unit, pair.wrench, xyz(P), work.border, INNER)
    if mode == TANGENT:
        copy_into(work.R[0], F)
        copy_into(work.R[1], F)
        shift_matrix(work.R, P, work.S)
        scatter(pair, work.S, i, INNER, fields(d.tangent), work.T6)


@part
def _outer_contacts(first, end, q, out_q, out_u, d, law, mode):
    """Rollers on the outer race, whose ring moves in its plane only."""
    pose, pair, work = fields(d.pose), fields(d.pair), fields(d.scratch)
    side, rw, memory = fields(d.outer), fields(d.race_work), fields(d.memory)
    radius, race_laws, count = fields(d.bodies).radius, Laws(law[RACE_LAW], law[RACE_RUBS]), 0
    for i in range(first, end):
        take_pose(work.poses[i], pose)
        at = rw.partner[count]
        beside_outer(i, q, out_q, out_u, d, at)
        onset = memory.race[i, OUTER_RACE]
        if meet_race(count, pose, side, radius[i], 0.0, onset, rw):
            rw.who[count] = i
            count += 1
    press_race(count, side, race_laws, rw)
    for m in range(count):
        i = rw.who[m]
        take_pose(work.poses[i], pose)
        push_by_race(m, pose, side, radius[i], 0.0, rw, pair, mode, work.sums)
        add_outer(i, d, mode)
        if mode >= REPORT:
            report_race(i, OUTER_RACE, work.sums, fields(d.report))


@part
def add_outer(i, d, mode):
    """Add the pair's wrench to roller i and to the outer ring."""
    pair, work, F = fields(d.pair), fields(d.scratch), fields(d.pose).F
    add_to_element(work.wrenches[i], pair)
    for c in range(2):
        work.border[OUTER + c] -= F[1, 1 + c] * pair.wrench[1] + F[2, 1 + c] * pair.wrench[2]
    if mode == TANGENT:
        scatter_outer(pair, F, i, fields(d.tangent))


@part
def outer_ribs(q, out_q, out_u, d, law, mode):
    """Rollers on the outer ring's ribs, if it has any."""
    pose, work = fields(d.pose), fields(d.scratch)
    ribs, at = fields(d.outer_rib), fields(d.race_work).partner[0]
    if ribs.end <= ribs.first:
        return
    for i in range(work.poses.shape[0]):
        take_pose(work.poses[i], pose)
        beside_outer(i, q, out_q, out_u, d, at)
        if on_ribs(i, at, ribs, d, law, mode):
            add_outer(i, d, mode)
            if mode >= REPORT:
                report_ribs(i, ribs.column, work.sums, fields(d.report))


@part
def report_ribs(i, column, sums, rep):
    ribs = POCKET + rep.pocket_normal.shape[1]
    for f in range(2):
        rep.rib[i, column + f] = sums[NORMAL + f]
        rep.contact[i, ribs + column + f] = 1 if sums[NORMAL + f] > 0.0 else 0
    rep.energy[IN_CONTACTS] += sums[STORED]
    rep.power[RIB_DAMPING] += sums[DAMPED]
    rep.power[RIB_FRICTION] += sums[RUBBED]


@part
def report_race(i, side, sums, rep):
    for c in range(N_RACE):
        rep.race[i, side, c] = sums[c]
    rep.contact[i, side] = 1 if sums[NORMAL] > 0.0 else 0
    rep.energy[IN_CONTACTS] += sums[STORED]
    rep.power[RACE_DAMPING] += sums[DAMPED]
    rep.power[RACE_FRICTION] += sums[RUBBED]
    rep.power[ROLLING_RESISTANCE] += sums[ROLLED]


@part
def roller_rows(q, u, qd, ud, d, r_q, r_u, mode):
    """Kinematics and momentum of all rollers, whose contacts are summed."""
    for i in range(fields(d.bodies).radius.shape[0]):
        own = of_element(i)
        take_pose(fields(d.scratch).poses[i], fields(d.pose))
        _roller_rows(i, q[own], u[own], qd[own], ud[own], d, r_q[own], r_u[own], mode)


@part
def _roller_rows(i, qi, ui, qdi, udi, d, r_q, r_u, mode):
    """Kinematics and momentum of roller i, with drag and gravity."""
    pose, work, bodies = fields(d.pose), fields(d.scratch), fields(d.bodies)
    tan, rep = fields(d.tangent), fields(d.report)
    F, FR, rates = pose.F, work.wrenches[i], work.S[0]
    mass, Ia, It = bodies.element[MASS], bodies.element[AXIAL], bodies.element[TRANSVERSE]
    drag = -bodies.drag[0] * abs(ui[2]) * ui[2]
    gr = F[1, 1] * bodies.gravity[1] + F[1, 2] * bodies.gravity[2]
    gp = F[2, 1] * bodies.gravity[1] + F[2, 2] * bodies.gravity[2]
    frame = roller_rates(qi, ui, pose.axis, rates)
    for c in range(6):
        r_q[c] = qdi[c] - rates[c]
    r = qi[1]
    r_u[0] = mass * (udi[0] - bodies.gravity[0]) - FR[0]
    r_u[1] = mass * (udi[1] - ui[2] * ui[2] / r - gr) - FR[1]
    r_u[2] = mass * (udi[2] + ui[1] * ui[2] / r - gp) - FR[2] - drag
    M1, M2, M3 = turned(pose.axis, turn_of(FR))
    r_u[U_SPIN] = Ia * udi[U_SPIN] - M1
    r_u[U_SKEW] = It * (udi[U_SKEW] - frame * ui[U_TILT]) + Ia * ui[U_SPIN] * ui[U_TILT] - M2
    r_u[U_TILT] = It * (udi[U_TILT] + frame * ui[U_SKEW]) - Ia * ui[U_SPIN] * ui[U_SKEW] - M3
    if mode == TANGENT:
        tan.Crr[i, 1, 2] -= 2.0 * mass * ui[2] / r
        tan.Crr[i, 2, 1] += mass * ui[2] / r
        tan.Crr[i, 2, 2] += mass * ui[1] / r + 2.0 * bodies.drag[0] * abs(ui[2])
        tan.Crr[i, U_SKEW, U_TILT] += Ia * ui[U_SPIN] - It * frame
        tan.Crr[i, U_TILT, U_SKEW] -= Ia * ui[U_SPIN] - It * frame
    elif mode >= REPORT:
        rep.power[GRAVITY] += mass * (gr * ui[1] + gp * ui[2])
        rep.power[DRAG] += drag * ui[2]
        v2 = ui[0] * ui[0] + ui[1] * ui[1] + ui[2] * ui[2]
        w2 = ui[U_SKEW] * ui[U_SKEW] + ui[U_TILT] * ui[U_TILT]
        rep.energy[KINETIC] += 0.5 * (mass * v2 + Ia * ui[U_SPIN] * ui[U_SPIN] + It * w2)
