"""Pockets of a roller bearing: every roller's contacts with the cage, one pocket after another.

``evaluate`` in ``residual`` calls it as a function value, as it does ``shared_equations``.
"""

from __future__ import annotations

from flexcage.contacts.evaluation import (
    DAMPED,
    POCKET_LAW,
    POCKET_RUBS,
    REPORT,
    RUBBED,
    SIDE_LAW,
    SIDE_RUBS,
    STORED,
    TANGENT,
)
from flexcage.contacts.pocket import pocket_contact
from flexcage.contacts.pocket_wall import (
    FACES,
    FRONT,
    MINUS_X,
    PLUS_X,
    REAR,
    CageAtRoller,
    PocketLaws,
    RollerInPocket,
)
from flexcage.contacts.state import CageModes, shift_matrix, take_pose
from flexcage.core.jit import array_from, copy_into, fields, outlined, part, zero
from flexcage.core.vectors import (
    RIGID,
    column,
    combine,
    cross,
    dot,
    minus,
    plus,
    put,
    row,
    times,
    turned,
    turned_back,
    xyz,
)
from flexcage.system.blocks import scatter, scatter_modes
from flexcage.system.data import (
    CAGE_SPIN,
    IN_CONTACTS,
    INNER_RACE,
    LEVER,
    OUTER_RACE,
    PARTNER_V,
    PARTNER_W,
    POCKET,
    POCKET_DAMPING,
    POCKET_FRICTION,
)
from flexcage.system.equations import push_pair
from flexcage.system.floating import modes_at, push_modes, take_cage
from flexcage.system.layout import FRAME, cage_at, cage_of, of_element
from flexcage.system.ring import inner_of, outer_of


def roller_pockets(t, y, yd, d, law, out, mode):
    """Add the pockets' wrenches to ``Scratch.wrenches`` and ``border``; for other arguments see
    ``residual.evaluate``. Poses of rollers and cage are in ``Scratch`` already."""
    work, at, q = fields(d.scratch), fields(d.places), y[: fields(d.places).bodies_q]
    modes, cage = modes_of_cage(0, y, d), cage_at(0, at)
    for i in range(at.elements):
        if i == at.in_cage:  # each row has a cage
            take_cage(1, y, d)
            modes, cage = modes_of_cage(1, y, d), cage_at(1, at)
        take_pose(work.poses[i], fields(d.pose))
        Rc, Vc = array_from(y, cage.q), array_from(y, cage.u)
        _pocket(i, q[of_element(i)], Rc, Vc, modes, d, law, mode)
        if mode >= REPORT:
            _approach(i, inner_of(y, d).u, outer_of(y, d).u, d)


@part
def modes_of_cage(k, y, d):
    """Modes of cage k in y."""
    work, phi_max, at = fields(d.scratch), fields(d.pocket).phi_max, fields(d.places)
    nm, modal, own = at.modes, work.modal, cage_at(k, at)
    qf, qfd = array_from(y, own.q + FRAME), array_from(y, own.u + RIGID)
    margin = 0.0
    for m in range(nm):
        margin += phi_max[m] * abs(qf[m])
        modal[0, m], modal[1, m] = qf[m], qfd[m]
    return CageModes(modal[0], modal[1], margin)


@part
def _pocket(i, qi, Rc, Vc, modes, d, law, mode):
    """Roller i in its pocket; its cage is at Rc and moves as Vc."""
    pose, pair, pw, work = fields(d.pose), fields(d.pair), fields(d.pocket_work), fields(d.scratch)
    data, memory = fields(d.pocket), fields(d.memory)
    F, A, vec, sums, border = pose.F, work.A, work.vec, work.sums, work.border
    D, Vr, wr = vec[LEVER], vec[PARTNER_V], vec[PARTNER_W]
    put(D, plus((0.0, qi[1], 0.0), turned(F, (qi[0] - Rc[0], -Rc[1], -Rc[2]))))
    ca, sa = data.azimuth[i, 0], data.azimuth[i, 1]
    e1, e2 = column(A, 1), column(A, 2)
    put(pw.G[0], turned(F, column(A, 0)))
    put(pw.G[1], turned(F, combine(times(ca, e1), sa, e2)))
    put(pw.G[2], turned(F, combine(times(ca, e2), -sa, e1)))
    put(Vr, turned(F, xyz(Vc)))
    put(wr, turned(F, xyz(vec[CAGE_SPIN])))
    radius = fields(d.bodies).radius[i]
    roller = RollerInPocket(pose, radius, D, memory.pocket[i], memory.deflection[i])
    cage = CageAtRoller(Vr, wr, modes)
    laws = PocketLaws(law[POCKET_LAW], law[SIDE_LAW], law[POCKET_RUBS], law[SIDE_RUBS])
    sl, at = fields(d.slices).row[0], fields(d.places)
    hit = pocket_contact(i, roller, cage, data, laws, sl, pw, pair, mode, sums)
    if hit:
        b = cage_at(cage_of(i, at), at).b
        push_pair(i, pair.wrench, A, xyz(D), b, d)
        push_modes(data, i, pw, border[modes_at(b + RIGID, at.modes)])
    if mode == TANGENT:
        scatter_pocket(i, hit, modes, d)
    elif mode >= REPORT:
        report_pocket(i, hit, sums, pw, fields(d.report), mode)


@part
def scatter_pocket(i, hit, modes, d):
    """The share of pocket i in the tangent, if its roller touches it."""
    tan, work, at, F = fields(d.tangent), fields(d.scratch), fields(d.places), fields(d.pose).F
    pw, D, b = fields(d.pocket_work), work.vec[LEVER], cage_at(cage_of(i, at), at).b
    tan.active[i] = 1 if hit else 0
    if hit:
        copy_into(work.R[0], F)
        for c in range(3):
            put(work.R[1, c], turned_back(work.A, row(F, c)))
        shift_matrix(work.R, D, work.S)
        scatter(fields(d.pair), work.S, i, b, tan, work.T6)
        if modes.q.shape[0] > 0:
            scatter_modes(i, pw, work.S, b, tan, at.modes)


@outlined
def report_pocket(i, hit, sums, pw, rep, mode):
    if hit:
        rep.energy[IN_CONTACTS] += sums[STORED]
        rep.power[POCKET_DAMPING] += sums[DAMPED]
        rep.power[POCKET_FRICTION] += sums[RUBBED]
        copy_into(rep.station[i], pw.st)
    if hit and mode == REPORT:
        copy_into(rep.slice_normal[i], pw.slice_N)
        copy_into(rep.slice_friction[i], pw.slice_T)
        copy_into(rep.point_normal[i], pw.point_N)
        copy_into(rep.point_friction[i], pw.point_T)
    elif mode == REPORT:
        zero(rep.station[i])
        zero(rep.slice_normal[i])
        zero(rep.slice_friction[i])
        zero(rep.point_normal[i])
        zero(rep.point_friction[i])
    copy_into(rep.residual[i], pw.b)
    for f in range(FACES):
        rep.pocket_normal[i, f] = pw.normal[f]
        rep.pocket_friction[i, f] = pw.tangential[f]
        rep.contact[i, POCKET + f] = 1 if pw.normal[f] > 0.0 else 0


@part
def _approach(i, inner_u, outer_u, d):
    """Approach speed of roller i at each of its contacts, at its centre (for the onset memory)."""
    pose, vec, G = fields(d.pose), fields(d.scratch).vec, fields(d.pocket_work).G
    rep = fields(d.report)
    F, V = pose.F, xyz(pose.V)
    rep.approach[i, INNER_RACE] = F[1, 1] * inner_u[1] + F[1, 2] * inner_u[2] - V[1]
    rep.approach[i, OUTER_RACE] = V[1] - F[1, 1] * outer_u[1] - F[1, 2] * outer_u[2]
    cage = plus(xyz(vec[PARTNER_V]), cross(xyz(vec[PARTNER_W]), xyz(vec[LEVER])))
    v = minus(V, cage)
    t, x = dot(row(G, 2), v), dot(row(G, 0), v)
    rep.approach[i, POCKET + FRONT], rep.approach[i, POCKET + REAR] = t, -t
    rep.approach[i, POCKET + PLUS_X], rep.approach[i, POCKET + MINUS_X] = x, -x
    ribs = POCKET + rep.pocket_normal.shape[1]
    inner, outer = fields(d.rib), fields(d.outer_rib)
    if inner.end > inner.first:
        x = V[0] - inner_u[0]
        rep.approach[i, ribs + inner.column], rep.approach[i, ribs + inner.column + 1] = x, -x
    if outer.end > outer.first:
        x = V[0] - outer_u[0]
        rep.approach[i, ribs + outer.column], rep.approach[i, ribs + outer.column + 1] = x, -x
