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
    NORMAL,
    POCKET_LAW,
    POCKET_RUBS,
    RACE_LAW,
    RACE_RUBS,
    REPORT,
    ROLLED,
    RUBBED,
    SLIDING,
    STORED,
)
from flexcage.contacts.groove import BallOnRace, groove_contact
from flexcage.contacts.slices import Laws
from flexcage.contacts.state import CageModes, set_frame
from flexcage.core.jit import copy_into, fields, outlined, part, zero
from flexcage.core.rotation import matrix_from_quaternion
from flexcage.core.vectors import (
    MOMENT,
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
from flexcage.system.equations import (
    CAGE_SPIN,
    RING_AXIS,
    RING_SPIN,
    clear_sums,
    inner_ring,
    push_modes,
    react,
)
from flexcage.system.layout import (
    CAGE,
    CAGE_TURN,
    INNER,
    INNER_TURN,
    MODES,
    OUTER,
    Q_CAGE,
    Q_INNER_TURN,
    Q_MODES,
    Q_OUTER,
    Q_QUATERNION,
    of_element,
    places,
)

# places in ``law``: the family's functions ``separate``
SHARED, BESIDE = FAMILY_PARTS, FAMILY_PARTS + 1


def evaluate(t, y, yd, d, law, out, mode):
    """Residual into ``out``; see the module's text. Index letters: i ball, c component, m mode.

    ``law`` holds the normal laws of race, pocket, (side, rib,) land, their friction laws, and
    what is compiled separately: ``equations.shared_equations`` and ``touch_neighbours``.
    """
    Z = fields(d.bodies).radius.shape[0]
    at = places(Z, fields(d.pocket).phi_max.shape[0])
    q, u, qd, ud = y[: at.rest_q], y[at.u : at.rest_u], yd[: at.rest_q], yd[at.u : at.rest_u]
    r_q, r_u = out[: at.rest_q], out[at.u : at.rest_u]
    rest_q, rest_u = y[at.rest_q : at.u], y[at.rest_u : at.lam]
    modes = set_bodies(rest_q, rest_u, d, mode)
    law[BESIDE](t, y, yd, d, law[:FAMILY_PARTS], out, mode)
    Rc, Vc = rest_q[Q_CAGE:Q_QUATERNION], rest_u[CAGE:CAGE_TURN]
    for i in range(Z):
        own = of_element(i)
        qi, ui = q[own], u[own]
        set_frame(qi[2], fields(d.pose).F)
        _races(i, qi, ui, rest_q, rest_u, d, law, mode)
        ball_in_pocket(i, qi, ui, Rc, Vc, modes, d, law, mode)
        ball_rows(i, qi, ui, qd[own], ud[own], d, r_q[own], r_u[own], mode)
    law[SHARED](t, y, yd, d, law[:FAMILY_PARTS], out, mode)


@part
def set_bodies(rest_q, rest_u, d, mode):
    """Cage's attitude and spin, ring's axis and spin, and no forces yet; the cage's modes."""
    work, phi_max = fields(d.scratch), fields(d.pocket).phi_max
    clear_sums(work.border, d, mode)
    quat, qf = rest_q[Q_QUATERNION:Q_MODES], rest_q[Q_MODES:]
    wb, qfd = rest_u[CAGE_TURN:MODES], rest_u[MODES:]
    matrix_from_quaternion(quat, work.A)
    put(work.vec[CAGE_SPIN], turned(work.A, xyz(wb)))
    inner_ring(rest_q[:Q_OUTER], rest_u[:OUTER], work.vec)
    margin = 0.0
    for m in range(phi_max.shape[0]):
        margin += phi_max[m] * abs(qf[m])
    zero(work.wrenches)
    return CageModes(qf, qfd, margin)


@part
def on_inner_race(i, qi, ui, rest_q, rest_u, d):
    """Ball i as the inner race meets it, in its frame F."""
    F, vec = fields(d.pose).F, fields(d.scratch).vec
    P = minus((qi[0], qi[1], 0.0), turned(F, xyz(rest_q[:Q_INNER_TURN])))
    return BallOnRace(
        fields(d.bodies).radius[i], P, xyz(ui), turn_of(ui), turned(F, xyz(vec[RING_AXIS])),
        turned(F, xyz(rest_u[:INNER_TURN])), turned(F, xyz(vec[RING_SPIN])),
        fields(d.memory).race[i, INNER_RACE], qi[2] - rest_q[Q_INNER_TURN + 2],
        fields(d.spot).has[i], turn_of(qi),
    )  # fmt: skip


@part
def on_outer_race(i, qi, ui, rest_q, rest_u, d):
    """The same of the outer race, whose ring moves in its plane only."""
    F = fields(d.pose).F
    P = minus((qi[0], qi[1], 0.0), turned(F, (0.0, rest_q[Q_OUTER], rest_q[Q_OUTER + 1])))
    return BallOnRace(
        fields(d.bodies).radius[i], P, xyz(ui), turn_of(ui), (1.0, 0.0, 0.0),
        turned(F, (0.0, rest_u[OUTER], rest_u[OUTER + 1])), (0.0, 0.0, 0.0),
        fields(d.memory).race[i, OUTER_RACE], qi[2], fields(d.spot).has[i],
        turn_of(qi),
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
def _races(i, qi, ui, rest_q, rest_u, d, law, mode):
    """Ball i on both races, in its frame F."""
    F, work, pair = fields(d.pose).F, fields(d.scratch), fields(d.pair)
    border = work.border
    laws, sl = Laws(law[RACE_LAW], law[RACE_RUBS]), fields(d.slices).row[0]
    zero(pair.wrench)
    ball = on_inner_race(i, qi, ui, rest_q, rest_u, d)
    if groove_contact(ball, fields(d.inner), laws, sl, pair.wrench, mode, work.sums):
        react(F, work.unit, pair.wrench, ball.centre, border, INNER)
        add_wrench(work.wrenches[i], pair.wrench)
    if mode >= REPORT:
        report_race(i, INNER_RACE, work.sums, fields(d.report))
    zero(pair.wrench)
    ball = on_outer_race(i, qi, ui, rest_q, rest_u, d)
    if groove_contact(ball, fields(d.outer), laws, sl, pair.wrench, mode, work.sums):
        push_outer(i, d)
    if mode >= REPORT:
        report_race(i, OUTER_RACE, work.sums, fields(d.report))


@part
def push_outer(i, d):
    """Add the pair's wrench to ball i and to the outer ring."""
    F, wrench, work = fields(d.pose).F, fields(d.pair).wrench, fields(d.scratch)
    add_wrench(work.wrenches[i], wrench)
    for c in range(2):
        work.border[OUTER + c] -= F[1, 1 + c] * wrench[1] + F[2, 1 + c] * wrench[2]


@part
def add_wrench(total, wrench):
    for c in range(6):
        total[c] += wrench[c]


@part
def report_race(i, side, sums, rep):
    closed = 1 if sums[NORMAL] > 0.0 else 0
    rep.contact[i, side] = closed
    rep.approach[i, side] = sums[APPROACH]
    for c in range(SLIDING + 1):
        rep.race[i, side, c] = sums[c]
    rep.energy[IN_CONTACTS] += sums[STORED]
    rep.power[RACE_DAMPING] += sums[DAMPED]
    rep.power[RACE_FRICTION] += sums[RUBBED]
    rep.power[ROLLING_RESISTANCE] += sums[ROLLED]


@part
def ball_in_pocket(i, qi, ui, Rc, Vc, modes, d, law, mode):
    """Ball i in its pocket; the cage is at Rc and moves as Vc."""
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
        add_wrench(work.wrenches[i], pair.wrench)
        react(fields(d.pose).F, work.A, pair.wrench, ball.centre, work.border, CAGE)
        push_modes(data, i, pw, work.border)
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
