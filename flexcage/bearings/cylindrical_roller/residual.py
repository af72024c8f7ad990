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
from flexcage.contacts.race import race_forces, race_penetrations, race_wrench
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
from flexcage.core.jit import array_from, copy_into, fields, part, zero
from flexcage.core.rotation import matrix_from_quaternion
from flexcage.core.vectors import RIGID, minus, put, turn_of, turned, xyz
from flexcage.system.blocks import scatter
from flexcage.system.data import (
    AXIAL,
    CAGE_SPIN,
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
from flexcage.system.equations import clear_sums, push_pair
from flexcage.system.layout import QUATERNION, of_element
from flexcage.system.ring import inner_of, outer_of, set_axes

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
    constraints and what puts these in (``constraint_equations``), and what is compiled separately:
    ``roller_pockets`` and ``equations.shared_equations``.
    """
    at = fields(d.places)
    Z, q = at.elements, y[: at.bodies_q]
    asked = RESIDUAL if mode == OUTER_RING else mode
    set_bodies(y, d, asked)
    lot = fields(d.race_work).who.shape[0]
    for first in range(0, Z if mode != OUTER_RING else 0, lot):
        span = (first, min(first + lot, Z))
        _on_ring(span, q, inner_of(y, d), fields(d.inner), fields(d.rib), INNER_RACE, d, law, mode)
    for first in range(0, Z, lot):
        span, ring = (first, min(first + lot, Z)), outer_of(y, d)
        _on_ring(span, q, ring, fields(d.outer), fields(d.outer_rib), OUTER_RACE, d, law, asked)
    if mode >= REPORT:
        report_outer(d)
    if mode == OUTER_RING:
        return
    law[POCKETS](t, y, yd, d, law[:FAMILY_PARTS], out, mode)
    roller_rows(y, yd, d, out, mode)
    law[SHARED](t, y, yd, d, law[:FAMILY_PARTS], out, mode)


@part
def set_bodies(y, d, mode):
    """Attitude and spin of the cage, axes and spins of the rings, poses of the rollers, and no
    forces yet."""
    work, pose, at = fields(d.scratch), fields(d.pose), fields(d.places)
    q, u = y[: at.bodies_q], y[at.u : at.bodies_u]
    clear_sums(work.border, d, mode)
    if at.cages > 0:
        matrix_from_quaternion(array_from(y, at.cage_q + QUATERNION), work.A)
        put(work.vec[CAGE_SPIN], turned(work.A, turn_of(array_from(y, at.cage_u))))
    set_axes(y, d)
    zero(work.wrenches)
    for i in range(at.elements):
        own = of_element(i)
        set_pose(q[own], u[own], pose)
        pose.spot[0] = fields(d.spot).has[i]
        pose.spot[1] = fields(d.spot).angle + q[own][Q_SPIN]
        pose.spot[2] = fields(d.spot).row[i]
        keep_pose(pose, work.poses[i])


@part
def report_outer(d):
    """What races and ribs do to the outer ring, which nothing else has pushed yet."""
    first = fields(d.places).outer_b
    for c in range(RIGID):
        fields(d.report).outer_races[c] = fields(d.scratch).border[first + c]


@part
def ring_partner(i, q, ring, d, at):
    """A ring as the partner ``at`` of roller i, whose pose is taken."""
    F, qi = fields(d.pose).F, q[of_element(i)]
    put(at[CENTRE], minus((qi[0], qi[1], 0.0), turned(F, xyz(ring.q))))
    put(at[AXIS], turned(F, xyz(ring.axis)))
    put(at[VELOCITY], turned(F, xyz(ring.u)))
    put(at[SPIN], turned(F, xyz(ring.spin)))


@part
def on_ribs(i, at, ribs, d, law, mode):
    """Does roller i touch the ``ribs`` of a ring, its partner ``at``? What they do to it."""
    laws, sl = Laws(law[RIB_LAW], law[RIB_RUBS]), fields(d.slices).row[0]
    speeds, sums = fields(d.memory).rib[i, ribs.column :], fields(d.scratch).sums
    middle = fields(d.rows).place[i]
    return rib_contact(
        fields(d.pose), at, ribs, middle, speeds, laws, sl, fields(d.pair), mode, sums
    )


@part
def push_by_ribs(i, at, ribs, b, d, law, mode):
    """Roller i on the ``ribs`` of a ring, its partner ``at``, whose border begins at b."""
    if on_ribs(i, at, ribs, d, law, mode):
        add_to_ring(i, at[CENTRE], b, d, mode)
        if mode >= REPORT:
            report_ribs(i, ribs.column, fields(d.scratch).sums, fields(d.report))


@part
def _on_ring(span, q, ring, side, ribs, race, d, law, mode):
    """Rollers span[0] to before span[1] on the race ``side`` of a ring, and on its ribs."""
    pose, pair, work, rw = fields(d.pose), fields(d.pair), fields(d.scratch), fields(d.race_work)
    radius, memory, turn = fields(d.bodies).radius, fields(d.memory).race, ring.q[Q_SPIN]
    count = 0
    for i in range(span[0], span[1]):
        take_pose(work.poses[i], pose)
        at = rw.partner[count]
        ring_partner(i, q, ring, d, at)
        if ribs.end > ribs.first:
            push_by_ribs(i, at, ribs, ring.b, d, law, mode)
        if race_penetrations(count, pose, side, radius[i], turn, memory[i, race], rw):
            rw.who[count] = i
            count += 1
    race_forces(count, side, Laws(law[RACE_LAW], law[RACE_RUBS]), rw)
    for m in range(count):
        i = rw.who[m]
        take_pose(work.poses[i], pose)
        race_wrench(m, pose, side, radius[i], turn, rw, pair, mode, work.sums)
        add_to_ring(i, rw.partner[m, CENTRE], ring.b, d, mode)
        if mode >= REPORT:
            report_race(i, race, work.sums, fields(d.report))


@part
def add_to_ring(i, P, b, d, mode):
    """Add the pair's wrench to roller i and to a ring, from which P leads to the roller and whose
    border begins at b."""
    pair, work, F = fields(d.pair), fields(d.scratch), fields(d.pose).F
    push_pair(i, pair.wrench, work.unit, xyz(P), b, d)
    if mode == TANGENT:
        copy_into(work.R[0], F)
        copy_into(work.R[1], F)
        shift_matrix(work.R, P, work.S)
        scatter(pair, work.S, i, b, fields(d.tangent), work.T6)


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
def roller_rows(y, yd, d, out, mode):
    """Kinematics and momentum of all rollers, whose contacts are summed."""
    at = fields(d.places)
    q, u, qd, ud = y[: at.bodies_q], y[at.u : at.bodies_u], yd[: at.bodies_q], yd[at.u :]
    r_q, r_u = out[: at.bodies_q], out[at.u :]
    for i in range(at.elements):
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
