"""The residual F(t, y, y') = 0 of a roller bearing, its tangent, and its report.

One kind of contact after another is evaluated for all rollers, and its wrenches added to the
bodies; then the rows are formed: kinematics q' - T(q) u - G^T mu, momentum M u' + h - Q - G^T
lambda, g and its rate. (With one roller's contacts after the other the code of all of them passes
through the processor's cache 22 times: a sixth more time.)
``mode``: 0 residual, 1 also the tangent blocks, 2 also the whole report, 3 without its arrays of
slices and stations.
"""

from __future__ import annotations

from flexcage.contacts.pocket import pocket_contact
from flexcage.contacts.race import race_contact
from flexcage.contacts.rib import rib_contact
from flexcage.contacts.state import keep_pose, set_pose, shift_matrix, take_pose
from flexcage.core.jit import copy_into, fields, part, zero
from flexcage.core.rotation import matrix_from_quaternion
from flexcage.core.vectors import (
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
from flexcage.system.rows import (
    AXIS,
    CAGE_SPIN,
    LEVER,
    PARTNER_V,
    PARTNER_W,
    RING_AXIS,
    RING_SPIN,
    add_to_element,
    clear_sums,
    inner_ring,
    push_modes,
    react,
)


@part
def roller_rates(q, u, axis, out):
    """Kinematics of a roller: out = T(q) u; returns the axial rate of its non-spinning frame.

    ``axis``: rows of its pose, which hold cosine and sine of skew and tilt.
    """
    orbit = u[2] / q[1]
    cx, sx, ce, se = axis[2, 2], axis[2, 0], axis[1, 1], axis[0, 1]
    skew = (u[4] + orbit * cx * se) / ce
    frame = orbit * cx * ce + skew * se
    out[0], out[1], out[2] = u[0], u[1], orbit
    out[3], out[4], out[5] = skew, u[5] - orbit * sx, u[3] - frame
    return frame


@part
def _scatter(pair, S, i, start, tan, T6):
    """Add a roller-partner pair's tangent; the partner's columns begin at ``start``."""
    for m in range(2):
        M = pair.K if m == 0 else pair.C
        rr = tan.Krr if m == 0 else tan.Crr
        rb = tan.Krb if m == 0 else tan.Crb
        br = tan.Kbr if m == 0 else tan.Cbr
        bb = tan.Kbb if m == 0 else tan.Cbb
        MS, SM = T6[0], T6[1]
        for a in range(6):
            for b in range(6):
                rr[i, a, b] += M[a, b]
                x = y = 0.0
                for c in range(6):
                    x += M[a, c] * S[c, b]
                    y += S[c, a] * M[c, b]
                MS[a, b], SM[a, b] = x, y
        for a in range(6):
            for b in range(6):
                rb[i, a, start + b] -= MS[a, b]
                br[i, start + a, b] -= SM[a, b]
                x = 0.0
                for c in range(6):
                    x += SM[a, c] * S[c, b]
                bb[start + a, start + b] += x


@part
def _scatter_outer(pair, F, i, tan):
    """The same for the outer ring, which only moves in y and z (columns 6 and 7)."""
    for m in range(2):
        M = pair.K if m == 0 else pair.C
        rr = tan.Krr if m == 0 else tan.Crr
        rb = tan.Krb if m == 0 else tan.Crb
        br = tan.Kbr if m == 0 else tan.Cbr
        bb = tan.Kbb if m == 0 else tan.Cbb
        for a in range(6):
            for b in range(6):
                rr[i, a, b] += M[a, b]
            for b in range(2):
                x = y = 0.0
                for c in range(1, 3):
                    x += M[a, c] * F[c, 1 + b]
                    y += F[c, 1 + b] * M[c, a]
                rb[i, a, 6 + b] -= x
                br[i, 6 + b, a] -= y
        for a in range(2):
            for b in range(2):
                for c in range(1, 3):
                    for e in range(1, 3):
                        bb[6 + a, 6 + b] += F[c, 1 + a] * M[c, e] * F[e, 1 + b]


@part
def _scatter_modes(data, i, pw, S, tan, Lm, Bm, PR):
    """Stiffness between pocket i's roller, the cage's rigid motion and its modes."""
    n_m = data.phi.shape[4]
    n_st = data.phi.shape[2]
    zero(Lm)
    zero(Bm)
    for f in range(4):
        if pw.near[f] == 0:
            continue
        sgn = 1.0 if f % 2 == 0 else -1.0
        comp = 2 if f < 2 else 0
        for s in range(n_st):
            if pw.H[f, s, s] == 0.0:
                continue
            for m in range(n_m):
                phi = sgn * data.phi[i, f, s, comp, m]
                for c in range(6):
                    Lm[c, m] += pw.LV[f, s, c] * phi
                    Bm[m, c] += phi * pw.BW[f, s, c]
                for t in range(max(s - 3, 0), min(s + 4, n_st)):
                    h = pw.H[f, s, t] * phi
                    if h != 0.0:
                        for o in range(n_m):
                            tan.Kbb[14 + m, 14 + o] += h * sgn * data.phi[i, f, t, comp, o]
    if pw.X[0, 0] != 0.0:  # less what the residual flexibility yields
        zero(PR)
        for f in range(4):
            if pw.near[f] == 0:
                continue
            sgn = 1.0 if f % 2 == 0 else -1.0
            comp = 2 if f < 2 else 0
            for s in range(n_st):
                for l in range(pw.size[0]):
                    h = sgn * pw.HR[f, s, l]
                    if h != 0.0:
                        for m in range(n_m):
                            PR[l, m] += h * data.phi[i, f, s, comp, m]
        for m in range(n_m):
            for l in range(pw.size[0]):
                h = 0.0
                for k in range(pw.size[0]):
                    h += PR[k, m] * pw.X[k, l]
                if h != 0.0:
                    for o in range(n_m):
                        tan.Kbb[14 + m, 14 + o] -= h * PR[l, o]
    for c in range(6):
        for m in range(n_m):
            tan.Krb[i, c, 14 + m] += Lm[c, m]
            tan.Kbr[i, 14 + m, c] += Bm[m, c]
            for e in range(6):
                tan.Kbb[8 + e, 14 + m] -= S[c, e] * Lm[c, m]
                tan.Kbb[14 + m, 8 + e] -= Bm[m, c] * S[c, e]


def evaluate(t, y, yd, d, law, out, mode):
    """Residual into ``out``; see the module's text. Index letters: i roller, c component, m mode.

    ``d`` (``problem.Parts``) refers to the model, its memory and its workspaces; ``law`` holds
    the normal laws of race, pocket, side, rib and land, their friction laws, and ``shared_rows``.
    """
    work, phi_max = fields(d.scratch), fields(d.pocket).phi_max
    Z, nm = fields(d.bodies).radius.shape[0], phi_max.shape[0]
    nq, nu = 6 * Z + 15 + nm, 6 * Z + 14 + nm
    q, u, qd, ud = y[:nq], y[nq : nq + nu], yd[:nq], yd[nq : nq + nu]
    r_q, r_u = out[:nq], out[nq : nq + nu]
    zq, border = 6 * Z, work.border
    clear_sums(border, d, mode)
    ring_q, ring_u = q[zq : zq + 6], u[zq : zq + 6]
    Rc, quat, qf = q[zq + 8 : zq + 11], q[zq + 11 : zq + 15], q[zq + 15 :]
    Vc, wb, qfd = u[zq + 8 : zq + 11], u[zq + 11 : zq + 14], u[zq + 14 :]
    A = work.A
    matrix_from_quaternion(quat, A)
    wg = work.vec[CAGE_SPIN]
    put(wg, turned(A, xyz(wb)))
    inner_ring(ring_q, ring_u, work.vec)
    margin = 0.0
    for m in range(nm):
        margin += phi_max[m] * abs(qf[m])
    pose, poses = fields(d.pose), work.poses
    zero(work.wrenches)
    for i in range(Z):
        o = 6 * i
        set_pose(q[o : o + 6], u[o : o + 6], pose)
        keep_pose(pose, poses[i])
        _inner_contacts(i, q[o : o + 6], ring_q, ring_u, d, law, mode)
    for i in range(Z):
        o = 6 * i
        take_pose(poses[i], pose)
        _outer_contact(i, q[o : o + 6], q[zq + 6 : zq + 8], u[zq + 6 : zq + 8], d, law, mode)
    for i in range(Z):
        o = 6 * i
        take_pose(poses[i], pose)
        _pocket(i, q[o : o + 6], Rc, Vc, qf, qfd, margin, d, law, mode)
        if mode >= 2:
            _approach(i, ring_u, u[zq + 6 : zq + 8], d)
    for i in range(Z):
        o = 6 * i
        take_pose(poses[i], pose)
        _roller_rows(
            i, q[o : o + 6], u[o : o + 6], qd[o : o + 6], ud[o : o + 6], d, r_q[o : o + 6],
            r_u[o : o + 6], mode,
        )  # fmt: skip
    law[10](t, y, yd, d, law[:10], out, mode)


@part
def _inner_contacts(i, qi, ring_q, ring_u, d, law, mode):
    """Roller i on the inner race and its ribs."""
    pose, pair, rep, work = fields(d.pose), fields(d.pair), fields(d.report), fields(d.scratch)
    F, vec, sums, memory = pose.F, work.vec, work.sums, fields(d.memory)
    P, b, Vr, wr = vec[LEVER], vec[AXIS], vec[PARTNER_V], vec[PARTNER_W]
    put(P, minus((qi[0], qi[1], 0.0), turned(F, xyz(ring_q))))
    put(b, turned(F, xyz(vec[RING_AXIS])))
    put(Vr, turned(F, xyz(ring_u)))
    put(wr, turned(F, xyz(vec[RING_SPIN])))
    for k in range(2):
        if k == 0:
            hit = race_contact(
                pose, fields(d.inner), fields(d.bodies).radius[i], P, b, Vr, wr, ring_q[5],
                memory.race[i, 0], law[0], law[5], fields(d.slices).row[0], pair, mode, sums,
            )  # fmt: skip
        else:
            hit = rib_contact(
                pose, fields(d.rib), P, b, Vr, wr, memory.rib[i], (law[3], law[8]),
                fields(d.slices).row[0], pair, mode, sums,
            )  # fmt: skip
        if not hit:
            continue
        add_to_element(work.wrenches[i], pair)
        react(F, work.unit, pair.wrench, xyz(P), work.border, 0)
        if mode == 1:
            copy_into(work.R[0], F)
            copy_into(work.R[1], F)
            shift_matrix(work.R, P, work.S)
            _scatter(pair, work.S, i, 0, fields(d.tangent), work.T6)
        elif mode >= 2 and k == 0:
            _report_race(i, 0, sums, rep)
        elif mode >= 2:
            rep.rib[i, 0], rep.rib[i, 1] = sums[0], sums[1]
            rep.contact[i, 6] = 1 if sums[0] > 0.0 else 0
            rep.contact[i, 7] = 1 if sums[1] > 0.0 else 0
            rep.energy[2] += sums[2]
            rep.power[8] += sums[3] + sums[4]


@part
def _outer_contact(i, qi, out_q, out_u, d, law, mode):
    """Roller i on the outer race, whose ring moves in its plane only."""
    pose, pair, work = fields(d.pose), fields(d.pair), fields(d.scratch)
    F, vec, border = pose.F, work.vec, work.border
    P, b, Vr, wr = vec[LEVER], vec[AXIS], vec[PARTNER_V], vec[PARTNER_W]
    put(P, minus((qi[0], qi[1], 0.0), turned(F, (0.0, out_q[0], out_q[1]))))
    put(b, (1.0, 0.0, 0.0))
    put(Vr, turned(F, (0.0, out_u[0], out_u[1])))
    put(wr, (0.0, 0.0, 0.0))
    hit = race_contact(
        pose, fields(d.outer), fields(d.bodies).radius[i], P, b, Vr, wr, 0.0,
        fields(d.memory).race[i, 1], law[0], law[5], fields(d.slices).row[0], pair, mode, work.sums,
    )  # fmt: skip
    if not hit:
        return
    add_to_element(work.wrenches[i], pair)
    for c in range(2):
        border[6 + c] -= F[1, 1 + c] * pair.wrench[1] + F[2, 1 + c] * pair.wrench[2]
    if mode == 1:
        _scatter_outer(pair, F, i, fields(d.tangent))
    elif mode >= 2:
        _report_race(i, 1, work.sums, fields(d.report))


@part
def _report_race(i, side, sums, rep):
    for c in range(9):
        rep.race[i, side, c] = sums[c]
    rep.contact[i, side] = 1 if sums[0] > 0.0 else 0
    rep.energy[2] += sums[5]
    rep.power[3] += sums[6]
    rep.power[4] += sums[7]
    rep.power[5] += sums[8]


@part
def _pocket(i, qi, Rc, Vc, qf, qfd, margin, d, law, mode):
    """Roller i in its pocket."""
    pose, pair, pw, work = fields(d.pose), fields(d.pair), fields(d.pocket_work), fields(d.scratch)
    data, memory, tan = fields(d.pocket), fields(d.memory), fields(d.tangent)
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
    hit = pocket_contact(
        pose, data, i, fields(d.bodies).radius[i], D, Vr, wr, qf, qfd, margin, memory.pocket[i],
        (law[1], law[2], law[6], law[7]), memory.deflection[i], fields(d.slices).row[0], pw, pair,
        mode, sums,
    )  # fmt: skip
    if hit:
        add_to_element(work.wrenches[i], pair)
        react(F, A, pair.wrench, xyz(D), border, 8)
        push_modes(data, i, pw, border)
    if mode == 1:
        tan.active[i] = 1 if hit else 0
        if hit:
            copy_into(work.R[0], F)
            for c in range(3):
                put(work.R[1, c], turned_back(A, row(F, c)))
            shift_matrix(work.R, D, work.S)
            _scatter(pair, work.S, i, 8, tan, work.T6)
            if qf.shape[0] > 0:
                _scatter_modes(data, i, pw, work.S, tan, work.Lm, work.Bm, work.PR)
    elif mode >= 2:
        _report_pocket(i, hit, sums, pw, fields(d.report), mode)


@part
def _report_pocket(i, hit, sums, pw, rep, mode):
    if hit:
        rep.energy[2] += sums[0]
        rep.power[6] += sums[1]
        rep.power[7] += sums[2]
    if hit and mode == 2:
        copy_into(rep.station[i], pw.st)
        for f in range(2):
            for k in range(rep.slice_normal.shape[2]):
                rep.slice_normal[i, f, k] = pw.slice_N[f, k]
                rep.slice_friction[i, f, k] = pw.slice_T[f, k]
    elif mode == 2:
        zero(rep.station[i])
        zero(rep.slice_normal[i])
        zero(rep.slice_friction[i])
    copy_into(rep.residual[i], pw.b)
    for f in range(4):
        rep.pocket_normal[i, f] = pw.normal[f]
        rep.pocket_friction[i, f] = pw.tangential[f]
        rep.contact[i, 2 + f] = 1 if pw.normal[f] > 0.0 else 0


@part
def _roller_rows(i, qi, ui, qdi, udi, d, r_q, r_u, mode):
    """Kinematics and momentum of roller i, with drag and gravity."""
    pose, work, bodies = fields(d.pose), fields(d.scratch), fields(d.bodies)
    tan, rep = fields(d.tangent), fields(d.report)
    F, FR, rates = pose.F, work.wrenches[i], work.S[0]
    mass, Ia, It = bodies.element[0], bodies.element[1], bodies.element[2]
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
    M1, M2, M3 = turned(pose.axis, (FR[3], FR[4], FR[5]))
    r_u[3] = Ia * udi[3] - M1
    r_u[4] = It * (udi[4] - frame * ui[5]) + Ia * ui[3] * ui[5] - M2
    r_u[5] = It * (udi[5] + frame * ui[4]) - Ia * ui[3] * ui[4] - M3
    if mode == 1:
        tan.Crr[i, 1, 2] -= 2.0 * mass * ui[2] / r
        tan.Crr[i, 2, 1] += mass * ui[2] / r
        tan.Crr[i, 2, 2] += mass * ui[1] / r + 2.0 * bodies.drag[0] * abs(ui[2])
        tan.Crr[i, 4, 5] += Ia * ui[3] - It * frame
        tan.Crr[i, 5, 4] -= Ia * ui[3] - It * frame
    elif mode >= 2:
        rep.power[2] += mass * (gr * ui[1] + gp * ui[2])
        rep.power[10] += drag * ui[2]
        v2 = ui[0] * ui[0] + ui[1] * ui[1] + ui[2] * ui[2]
        w2 = ui[4] * ui[4] + ui[5] * ui[5]
        rep.energy[0] += 0.5 * (mass * v2 + Ia * ui[3] * ui[3] + It * w2)


@part
def _approach(i, ring_u, out_u, d):
    """Approach speed of roller i at each of its contacts, at its centre (for the onset memory)."""
    pose, vec, G = fields(d.pose), fields(d.scratch).vec, fields(d.pocket_work).G
    rep = fields(d.report)
    F, V = pose.F, xyz(pose.V)
    rep.approach[i, 0] = F[1, 1] * ring_u[1] + F[1, 2] * ring_u[2] - V[1]
    rep.approach[i, 1] = V[1] - F[1, 1] * out_u[0] - F[1, 2] * out_u[1]
    cage = plus(xyz(vec[PARTNER_V]), cross(xyz(vec[PARTNER_W]), xyz(vec[LEVER])))
    v = minus(V, cage)
    t, x = dot(row(G, 2), v), dot(row(G, 0), v)
    rep.approach[i, 2], rep.approach[i, 3] = t, -t
    rep.approach[i, 4], rep.approach[i, 5] = x, -x
    rep.approach[i, 6] = V[0] - ring_u[0]
    rep.approach[i, 7] = -rep.approach[i, 6]
