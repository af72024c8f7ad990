"""The residual F(t, y, y') = 0 of a ball bearing, and its report.

A ball's coordinates are (x, r, psi) of its centre and the angles that it has turned about the axes
of its orbiting frame F = (e_x, e_r, e_psi), or, of a ball with a spot, the direction of that in F;
its velocities are those of its centre and its angular velocity, both in F. ``mode`` is one of
``contacts.evaluation``, but for the tangent, which is ``tangent.linearise``.
"""

from __future__ import annotations

from flexcage.contacts.ball_pocket import BallInPocket, pocket_wall_contact
from flexcage.contacts.evaluation import (
    ANGLE,
    APPROACH,
    DAMPED,
    N_RACE,
    NORMAL,
    POCKET_LAW,
    POCKET_RUBS,
    RACE_LAW,
    RACE_RUBS,
    REPORT,
    ROLLED,
    RUBBED,
    STORED,
)
from flexcage.contacts.groove import BallOnRace, groove_contact
from flexcage.contacts.slices import Laws
from flexcage.contacts.state import Q_SPIN, CageModes, set_frame
from flexcage.core.jit import array_from, copy_into, fields, outlined, part, zero
from flexcage.core.vectors import (
    MOMENT,
    RIGID,
    TURN,
    column,
    combine,
    cross,
    minus,
    plus,
    put,
    times,
    turn_of,
    turned,
    xyz,
)
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
    POCKET_DAMPING,
    POCKET_FRICTION,
    RACE_DAMPING,
    RACE_FRICTION,
    ROLLING_RESISTANCE,
)
from flexcage.system.equations import clear_sums, push_pair
from flexcage.system.floating import modes_at, push_modes, take_cage
from flexcage.system.layout import FRAME, cage_at, cage_of, of_element
from flexcage.system.ring import inner_of, outer_of, set_axes

# places in ``law``: the family's functions ``separate``
SHARED, NEIGHBOUR_FORCES = FAMILY_PARTS, FAMILY_PARTS + 1


def evaluate(t, y, yd, d, law, out, mode):
    """Residual into ``out``; see the module's text. Index letters: i ball, c component, m mode.

    ``law`` holds the normal laws of race, pocket, (side, rib,) land, their friction laws, and
    what is compiled separately: ``equations.shared_equations`` and ``touch_neighbours``.
    """
    at = fields(d.places)
    q, u, qd, ud = y[: at.bodies_q], y[at.u : at.bodies_u], yd[: at.bodies_q], yd[at.u :]
    r_q, r_u = out[: at.bodies_q], out[at.u :]
    modes = set_bodies(y, d, mode)
    law[NEIGHBOUR_FORCES](t, y, yd, d, law[:FAMILY_PARTS], out, mode)
    Rc, Vc = array_from(y, at.cage_q), array_from(y, at.cage_u)
    for i in range(at.elements):
        own = of_element(i)
        qi, ui = q[own], u[own]
        set_frame(qi[2], fields(d.pose).F)
        push_on_race(i, qi, ui, inner_of(y, d), fields(d.inner), INNER_RACE, d, law, mode)
        push_on_race(i, qi, ui, outer_of(y, d), fields(d.outer), OUTER_RACE, d, law, mode)
        if at.cages > 0:
            ball_in_pocket(i, qi, ui, Rc, Vc, modes, d, law, mode)
        ball_rows(i, qi, ui, qd[own], ud[own], d, r_q[own], r_u[own], mode)
    law[SHARED](t, y, yd, d, law[:FAMILY_PARTS], out, mode)


@part
def set_bodies(y, d, mode):
    """Attitude and spin of the first cage, axes and spins of the rings, and no forces yet; that
    cage's modes."""
    work, at = fields(d.scratch), fields(d.places)
    clear_sums(work.border, d, mode)
    if at.cages > 0:
        take_cage(0, y, d)
    set_axes(y, d)
    zero(work.wrenches)
    return modes_of_cage(0, y, d)


@part
def modes_of_cage(k, y, d):
    """Modes of cage k in y."""
    phi_max, at = fields(d.pocket).phi_max, fields(d.places)
    own, margin = cage_at(k, at), 0.0
    qf, qfd = y[modes_at(own.q + FRAME, at.modes)], y[modes_at(own.u + RIGID, at.modes)]
    for m in range(at.modes):
        margin += phi_max[m] * abs(qf[m])
    return CageModes(qf, qfd, margin)


@part
def on_race(i, qi, ui, ring, onset, d):
    """Ball i as the race of a ring meets it, in its frame F; ``onset``: speed at which they met."""
    F = fields(d.pose).F
    P = minus((qi[0], qi[1], 0.0), turned(F, xyz(ring.q)))
    return BallOnRace(
        fields(d.bodies).radius[i], P, xyz(ui), turn_of(ui), turned(F, xyz(ring.axis)),
        turned(F, xyz(ring.u)), turned(F, xyz(ring.spin)), onset,
        qi[2] - ring.q[Q_SPIN], fields(d.spot).has[i], turn_of(qi),
    )  # fmt: skip


@part
def in_pocket(i, qi, ui, Rc, Vc, d):
    """Ball i as its pocket meets it, the cage at Rc and moving as Vc; the pocket's axes into
    ``BallPocketWork.G``."""
    data, pw, work = fields(d.pocket), fields(d.pocket_work), fields(d.scratch)
    F, A = fields(d.pose).F, work.A
    D = plus((0.0, qi[1], 0.0), turned(F, (qi[0] - Rc[0], -Rc[1], -Rc[2])))
    ca, sa = data.azimuth[i, 0], data.azimuth[i, 1]
    e1, e2 = column(A, 1), column(A, 2)
    put(pw.G[0], turned(F, column(A, 0)))
    put(pw.G[1], turned(F, combine(times(ca, e1), sa, e2)))
    put(pw.G[2], turned(F, combine(times(ca, e2), -sa, e1)))
    turn = turned(F, xyz(work.vec[CAGE_SPIN]))
    v = minus(minus(xyz(ui), turned(F, xyz(Vc))), cross(turn, D))
    spin = minus(turn_of(ui), turn)
    return BallInPocket(fields(d.bodies).radius[i], D, v, spin, fields(d.memory).pocket[i, 0])


@part
def push_on_race(i, qi, ui, ring, groove, race, d, law, mode):
    """Ball i on the race ``groove`` of a ring, in its frame F."""
    work, pair = fields(d.scratch), fields(d.pair)
    laws, sl = Laws(law[RACE_LAW], law[RACE_RUBS]), fields(d.slices).row[0]
    zero(pair.wrench)
    ball = on_race(i, qi, ui, ring, fields(d.memory).race[i, race], d)
    if groove_contact(ball, groove, laws, sl, pair.wrench, mode, work.sums):
        push_pair(i, pair.wrench, work.unit, ball.centre, ring.b, d)
    if mode >= REPORT:
        report_race(i, race, work.sums, fields(d.report))


@part
def report_race(i, side, sums, rep):
    closed = 1 if sums[NORMAL] > 0.0 else 0
    rep.contact[i, side] = closed
    rep.approach[i, side] = sums[APPROACH]
    for c in range(N_RACE):
        rep.race[i, side, c] = sums[c]
    rep.energy[IN_CONTACTS] += sums[STORED]
    rep.power[RACE_DAMPING] += sums[DAMPED]
    rep.power[RACE_FRICTION] += sums[RUBBED]
    rep.power[ROLLING_RESISTANCE] += sums[ROLLED]


@part
def ball_in_pocket(i, qi, ui, Rc, Vc, modes, d, law, mode):
    """Ball i in its pocket; its cage is at Rc and moves as Vc."""
    data, pw, pair, work = (
        fields(d.pocket),
        fields(d.pocket_work),
        fields(d.pair),
        fields(d.scratch),
    )
    sums = work.sums
    zero(pair.wrench)
    ball = in_pocket(i, qi, ui, Rc, Vc, d)
    laws, sl = Laws(law[POCKET_LAW], law[POCKET_RUBS]), fields(d.slices).row[0]
    hit = pocket_wall_contact(i, ball, modes, data, laws, sl, pw, pair.wrench, mode, sums)
    if hit:
        at = fields(d.places)
        b = cage_at(cage_of(i, at), at).b
        push_pair(i, pair.wrench, work.A, ball.centre, b, d)
        push_modes(data, i, pw, work.border[modes_at(b + RIGID, at.modes)])
    if mode >= REPORT:
        _report_pocket(i, hit, sums, pw, fields(d.report), mode)


@outlined
def _report_pocket(i, hit, sums, pw, rep, mode):
    rep.energy[IN_CONTACTS] += sums[STORED]
    rep.power[POCKET_DAMPING] += sums[DAMPED]
    rep.power[POCKET_FRICTION] += sums[RUBBED]
    rep.residual[i, 0] = sums[ANGLE]
    rep.contact[i, POCKET] = 1 if pw.normal[0] > 0.0 else 0
    rep.approach[i, POCKET] = sums[APPROACH]
    rep.pocket_normal[i, 0] = pw.normal[0]
    rep.pocket_friction[i, 0] = pw.tangential[0]
    if pw.normal[0] > 0.0:
        copy_into(rep.station[i], pw.st)
    elif mode == REPORT:
        zero(rep.station[i])


@part
def ball_rows(i, qi, ui, qdi, udi, d, r_q, r_u, mode):
    """Kinematics and momentum of ball i, with drag and gravity."""
    bodies, rep, FR = fields(d.bodies), fields(d.report), fields(d.scratch).wrenches[i]
    F = fields(d.pose).F
    mass, inertia, r = bodies.element[MASS], bodies.element[AXIAL], qi[1]
    orbit = ui[2] / r
    drag = -bodies.drag[0] * abs(ui[2]) * ui[2]
    gr = F[1, 1] * bodies.gravity[1] + F[1, 2] * bodies.gravity[2]
    gp = F[2, 1] * bodies.gravity[1] + F[2, 2] * bodies.gravity[2]
    for c in range(6):
        r_q[c] = qdi[c] - ui[c]
    r_q[2] = qdi[2] - orbit
    if fields(d.spot).has[i] > 0:  # its spot's direction turns with it, in a frame that orbits
        rate = cross(minus(turn_of(ui), (orbit, 0.0, 0.0)), turn_of(qi))
        for c in range(3):
            r_q[TURN + c] = qdi[TURN + c] - rate[c]
    r_u[0] = mass * (udi[0] - bodies.gravity[0]) - FR[0]
    r_u[1] = mass * (udi[1] - orbit * ui[2] - gr) - FR[1]
    r_u[2] = mass * (udi[2] + orbit * ui[1] - gp) - FR[2] - drag
    r_u[TURN] = inertia * udi[TURN] - FR[MOMENT]
    r_u[TURN + 1] = inertia * (udi[TURN + 1] - orbit * ui[TURN + 2]) - FR[MOMENT + 1]
    r_u[TURN + 2] = inertia * (udi[TURN + 2] + orbit * ui[TURN + 1]) - FR[MOMENT + 2]
    if mode >= REPORT:
        rep.power[GRAVITY] += mass * (gr * ui[1] + gp * ui[2])
        rep.power[DRAG] += drag * ui[2]
        v2 = ui[0] * ui[0] + ui[1] * ui[1] + ui[2] * ui[2]
        w2 = ui[TURN] * ui[TURN] + ui[TURN + 1] * ui[TURN + 1] + ui[TURN + 2] * ui[TURN + 2]
        rep.energy[KINETIC] += 0.5 * (mass * v2 + inertia * w2)
