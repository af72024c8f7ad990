"""The residual F(t, y, y') = 0 of a whole bearing, its tangent, and its report.

One pass over the rollers calls the contact kernels, adds their wrenches to the bodies, and forms
the rows: kinematics q' - T(q) u - G^T mu, momentum M u' + h - Q - G^T lambda, g and its rate.
``mode``: 0 residual, 1 also the tangent blocks, 2 also the whole report, 3 without its arrays of
slices and stations.
"""

from __future__ import annotations

from math import cos, sin, sqrt

from flexcage.bodies.floating_frame import inertia_terms
from flexcage.contacts.land import land_contact
from flexcage.contacts.pocket import pocket_contact
from flexcage.contacts.race import race_contact
from flexcage.contacts.rib import rib_contact
from flexcage.contacts.state import set_pose, shift_matrix
from flexcage.core.jit import VECTORISED, copy_into, fields, part, zero
from flexcage.core.rotation import matrix_from_quaternion, quaternion_rate
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

# rows of ``Work.vec``: of the bodies, in space; of the pair under work, in the roller's frame F
CAGE_SPIN, RING_AXIS, RING_SPIN, LEVER, AXIS, PARTNER_V, PARTNER_W, GUIDE, GUIDE_V = range(9)


@part
def interpolate(table, t):
    """Linear interpolation in a (2, n) table, constant outside."""
    n = table.shape[1]
    if t <= table[0, 0]:
        return table[1, 0]
    for i in range(1, n):
        if t <= table[0, i]:
            f = (t - table[0, i - 1]) / (table[0, i] - table[0, i - 1])
            return table[1, i - 1] + f * (table[1, i] - table[1, i - 1])
    return table[1, n - 1]


@part
def drive_angle(bodies, t):
    """Angle that the prescribed speed has turned by time t since t = 0."""
    table = bodies.speed
    n = table.shape[1]
    if t <= table[0, 0]:
        return table[1, 0] * t
    base = table[1, 0] * table[0, 0]
    for i in range(1, n):
        if t <= table[0, i]:
            h = t - table[0, i - 1]
            f = h / (table[0, i] - table[0, i - 1])
            slope = 0.5 * f * (table[1, i] - table[1, i - 1])
            return base + bodies.angle[i - 1] + h * (table[1, i - 1] + slope)
    return base + bodies.angle[n - 1] + table[1, n - 1] * (t - table[0, n - 1])


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
def ring_rates(q, u, out):
    """Kinematics of the inner ring (its frame does not orbit); returns its frame's axial rate."""
    skew = u[4] / cos(q[4])
    frame = skew * sin(q[4])
    out[0], out[1], out[2] = u[0], u[1], u[2]
    out[3], out[4], out[5] = skew, u[5], u[3] - frame
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
                for l in range(8):
                    h = sgn * pw.HR[f, s, l]
                    if h != 0.0:
                        for m in range(n_m):
                            PR[m, l] += h * data.phi[i, f, s, comp, m]
        for m in range(n_m):
            for l in range(8):
                h = 0.0
                for k in range(8):
                    h += PR[m, k] * pw.X[k, l]
                if h != 0.0:
                    for o in range(n_m):
                        tan.Kbb[14 + m, 14 + o] -= h * PR[o, l]
    for c in range(6):
        for m in range(n_m):
            tan.Krb[i, c, 14 + m] += Lm[c, m]
            tan.Kbr[i, 14 + m, c] += Bm[m, c]
            for e in range(6):
                tan.Kbb[8 + e, 14 + m] -= S[c, e] * Lm[c, m]
                tan.Kbb[14 + m, 8 + e] -= Bm[m, c] * S[c, e]


@part
def _react(F, R, wrench, lever, border, at):
    """Reaction of a roller's wrench on a partner at ``lever`` from it: force in space, moment in
    the frame with columns R."""
    f = xyz(wrench)
    m = plus((wrench[3], wrench[4], wrench[5]), cross(lever, f))
    f, m = turned_back(F, f), turned_back(R, turned_back(F, m))
    for c in range(3):
        border[at + c] -= f[c]
        border[at + 3 + c] -= m[c]


def evaluate(t, y, yd, d, law, out, mode):
    """Residual into ``out``; see the module's text. Index letters: i roller, c component, m mode.

    ``d`` (``problem.Parts``) refers to the model, its memory and its workspaces; ``law`` holds
    the normal laws of race, pocket, side, rib and land, then their friction laws.
    """
    work, phi_max = fields(d.scratch), fields(d.pocket).phi_max
    Z, nm = fields(d.bodies).radius.shape[0], phi_max.shape[0]
    nq, nu = 6 * Z + 15 + nm, 6 * Z + 14 + nm
    q, u, qd, ud = y[:nq], y[nq : nq + nu], yd[:nq], yd[nq : nq + nu]
    lam, mu = y[nq + nu : nq + nu + 4], y[nq + nu + 4 :]
    r_q, r_u = out[:nq], out[nq : nq + nu]
    zq, border = 6 * Z, work.border
    _clear(border, d, mode)
    ring_q, ring_u = q[zq : zq + 6], u[zq : zq + 6]
    Rc, quat, qf = q[zq + 8 : zq + 11], q[zq + 11 : zq + 15], q[zq + 15 :]
    Vc, wb, qfd = u[zq + 8 : zq + 11], u[zq + 11 : zq + 14], u[zq + 14 :]
    A = work.A
    matrix_from_quaternion(quat, A)
    wg = work.vec[CAGE_SPIN]
    put(wg, turned(A, xyz(wb)))
    _inner_ring(ring_q, ring_u, work.vec)
    margin = 0.0
    for m in range(nm):
        margin += phi_max[m] * abs(qf[m])
    for i in range(Z):
        o = 6 * i
        qi, ui = q[o : o + 6], u[o : o + 6]
        set_pose(qi, ui, fields(d.pose))
        zero(work.roller)
        _inner_contacts(i, qi, ring_q, ring_u, d, law, mode)
        _outer_contact(i, qi, q[zq + 6 : zq + 8], u[zq + 6 : zq + 8], d, law, mode)
        _pocket(i, qi, Rc, Vc, qf, qfd, margin, d, law, mode)
        if mode >= 2:
            _approach(i, ring_u, u[zq + 6 : zq + 8], d)
        _roller_rows(
            i, qi, ui, qd[o : o + 6], ud[o : o + 6], d, r_q[o : o + 6], r_u[o : o + 6], mode
        )
    _land(q, u, zq, nm, d, law, mode)
    _cage_rows(d, quat, Vc, wb, qf, qfd, qd, ud, zq, r_q, r_u, mode)
    _ring_rows(t, d, q, u, qd, ud, lam, mu, zq, r_q, r_u, out, nq + nu, mode)


@part
def _clear(border, d, mode):
    """Set to zero what the contacts add to."""
    tan, rep = fields(d.tangent), fields(d.report)
    zero(border)
    if mode == 1:
        zero(tan.Krr)
        zero(tan.Crr)
        zero(tan.Krb)
        zero(tan.Crb)
        zero(tan.Kbr)
        zero(tan.Cbr)
        zero(tan.Kbb)
        zero(tan.Cbb)
        zero(tan.Mbb)
    elif mode >= 2:
        zero(rep.power)
        zero(rep.energy)
        zero(rep.race)
        zero(rep.rib)
        zero(rep.contact)
        zero(rep.body_force)
        zero(rep.land)


@part
def _inner_ring(q, u, vec):
    """Axis and angular velocity of the inner ring in space (its frame does not spin)."""
    cx, sx, ce, se = cos(q[3]), sin(q[3]), cos(q[4]), sin(q[4])
    axis = (cx * ce, se, -sx * ce)
    put(vec[RING_AXIS], axis)
    skew = (-cx * se, ce, sx * se)
    put(vec[RING_SPIN], combine(combine(times(u[3], axis), u[4], skew), u[5], (sx, 0.0, cx)))


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
        _add_to_roller(work.roller, pair)
        _react(F, work.unit, pair.wrench, xyz(P), work.border, 0)
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
    _add_to_roller(work.roller, pair)
    for c in range(2):
        border[6 + c] -= F[1, 1 + c] * pair.wrench[1] + F[2, 1 + c] * pair.wrench[2]
    if mode == 1:
        _scatter_outer(pair, F, i, fields(d.tangent))
    elif mode >= 2:
        _report_race(i, 1, work.sums, fields(d.report))


@part
def _add_to_roller(total, pair):
    for c in range(6):
        total[c] += pair.wrench[c]


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
        _add_to_roller(work.roller, pair)
        _react(F, A, pair.wrench, xyz(D), border, 8)
        _push_modes(data, i, pw, border)
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
def _push_modes(data, i, pw, border):
    """Generalised forces of pocket i's station forces on the cage's modes."""
    for f in range(4):
        if pw.normal[f] <= 0.0:
            continue
        for s in range(pw.st.shape[1]):
            for c in range(3):
                x = pw.st[f, s, c]
                if x != 0.0:
                    shape = data.phi[i, f, s, c]
                    for m in range(shape.shape[0]):
                        border[14 + m] += x * shape[m]


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
    F, FR, rates = pose.F, work.roller, work.S[0]
    mass, Ia, It = bodies.roller[0], bodies.roller[1], bodies.roller[2]
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
def _land(q, u, zq, nm, d, law, mode):
    """Cage's lands on the ring that guides it, and the drag on the cage."""
    work, data, rep = fields(d.scratch), fields(d.land), fields(d.report)
    vec, border, A = work.vec, work.border, work.A
    Fc, Mc, Fr, Mr = vec[LEVER], vec[AXIS], vec[PARTNER_V], vec[PARTNER_W]
    zero(Fc)
    zero(Mc)
    zero(Fr)
    zero(Mr)
    wg, where, speed, spin = vec[CAGE_SPIN], vec[GUIDE], vec[GUIDE_V], 0.0
    rides_inner = data.inner > 0.0
    if rides_inner:
        put(where, xyz(q[zq : zq + 3]))
        put(speed, xyz(u[zq : zq + 3]))
        spin = u[zq + 3]
    else:
        put(where, (0.0, q[zq + 6], q[zq + 7]))
        put(speed, (0.0, u[zq + 6], u[zq + 7]))
    land_contact(
        A, q[zq + 8 : zq + 11], u[zq + 8 : zq + 11], wg, q[zq + 15 :], u[zq + 14 :], where, speed,
        spin, data, fields(d.memory).land, (law[4], law[9]), fields(d.slices).row[0],
        fields(d.land_work), Fc, Mc, border[14 : 14 + nm], Fr, Mr, work.sums,
    )  # fmt: skip
    drag = fields(d.bodies).drag[1] * abs(wg[0]) * wg[0]
    Mc[0] -= drag
    moment = turned_back(A, xyz(Mc))
    for c in range(3):
        border[8 + c] += Fc[c]
        border[11 + c] += moment[c]
        if rides_inner:
            border[c] += Fr[c]
            border[3 + c] += Mr[c]
    if not rides_inner:
        border[6] += Fr[1]
        border[7] += Fr[2]
    if mode >= 2:
        sums = work.sums
        copy_into(rep.land, Fc)
        for c in range(2):
            rep.land_touch[c, 0], rep.land_touch[c, 1] = sums[4 + c], sums[6 + c]
        rep.energy[2] += sums[0]
        rep.power[9] += sums[1] + sums[2] + sums[3]
        rep.power[10] -= drag * wg[0]


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


@part(fastmath=VECTORISED)
def _cage_rows(d, quat, Vc, wb, qf, qfd, qd, ud, zq, r_q, r_u, mode):
    """Rows of the cage: floating frame, translations in space, rotations in the body."""
    data, tan, rep, work = fields(d.cage), fields(d.tangent), fields(d.report), fields(d.scratch)
    frame, A, border = fields(d.frame), work.A, work.border
    nm = qf.shape[0]
    acc, rows, v = frame.w[0], frame.w[1], frame.w[2]
    M, h = frame.M, frame.h
    inertia_terms(data, wb, qf, qfd, frame)
    rate = work.S[0]
    quaternion_rate(quat, wb, rate)
    for c in range(3):
        r_q[zq + 8 + c] = qd[zq + 8 + c] - Vc[c]
    for c in range(4):
        r_q[zq + 11 + c] = qd[zq + 11 + c] - rate[c]
    for m in range(nm):
        r_q[zq + 15 + m] = qd[zq + 15 + m] - qfd[m]
    gb = turned_back(A, xyz(fields(d.bodies).gravity))
    put(acc, turned_back(A, xyz(ud[zq + 8 : zq + 11])))
    for c in range(3 + nm):
        acc[3 + c] = ud[zq + 11 + c]
    for k in range(6 + nm):
        x = h[k]
        for c in range(3):  # gravity is an acceleration of the whole body
            x += M[k, c] * (acc[c] - gb[c])
        for c in range(3, 6 + nm):
            x += M[k, c] * acc[c]
        rows[k] = x
    for c in range(3):
        x = A[c, 0] * rows[0] + A[c, 1] * rows[1] + A[c, 2] * rows[2]
        r_u[zq + 8 + c] = x - border[8 + c]
        r_u[zq + 11 + c] = rows[3 + c] - border[11 + c]
    for m in range(nm):
        x = rows[6 + m] - border[14 + m]
        for l in range(nm):
            x += data.kff[m, l] * qf[l] + data.dff[m, l] * qfd[l]
        r_u[zq + 14 + m] = x
    if mode == 1:
        n6 = 6 + nm
        for a in range(n6):
            for b in range(n6):
                tan.Mbb[8 + a, 8 + b] = M[a, b]
        for a in range(3):  # translations to space
            for b in range(n6):
                x = y = 0.0
                for c in range(3):
                    x += A[a, c] * M[c, b]
                    y += M[b, c] * A[a, c]
                if b >= 3:
                    tan.Mbb[8 + a, 8 + b] = x
                    tan.Mbb[8 + b, 8 + a] = y
        for a in range(3):
            for b in range(3):
                tan.Mbb[8 + a, 8 + b] = data.mass if a == b else 0.0
        for m in range(nm):
            for l in range(nm):
                tan.Kbb[14 + m, 14 + l] += data.kff[m, l]
                tan.Cbb[14 + m, 14 + l] += data.dff[m, l]
    elif mode >= 2:
        put(v, turned_back(A, xyz(Vc)))
        for c in range(3):
            v[3 + c] = wb[c]
        for m in range(nm):
            v[6 + m] = qfd[m]
        for a in range(6 + nm):
            momentum = 0.0
            for b in range(6 + nm):
                momentum += M[a, b] * v[b]
            rep.energy[0] += 0.5 * v[a] * momentum
            for c in range(3):
                rep.power[2] += v[a] * M[a, c] * gb[c]
        for m in range(nm):
            spring = damper = 0.0
            for l in range(nm):
                spring += data.kff[m, l] * qf[l]
                damper += data.dff[m, l] * qfd[l]
            rep.energy[1] += 0.5 * qf[m] * spring
            rep.power[11] -= qfd[m] * damper


@part
def _housing(outer, q, u, held, tan, mode):
    """Force ``held`` of the outer ring on its housing; returns energy stored and power lost."""
    k, c, clearance = outer[1], outer[2], outer[4]
    held[0] = held[1] = 0.0
    distance = sqrt(q[0] * q[0] + q[1] * q[1])
    n = (1.0, 0.0) if distance == 0.0 else (q[0] / distance, q[1] / distance)
    if clearance < 0.0:  # a bushing
        for i in range(2):
            held[i] = k * q[i] + c * u[i]
            if mode == 1:
                tan.Kbb[6 + i, 6 + i] += k
                tan.Cbb[6 + i, 6 + i] += c
        return 0.5 * k * distance * distance, c * (u[0] * u[0] + u[1] * u[1])
    depth = distance - clearance
    rate = n[0] * u[0] + n[1] * u[1]
    force = k * depth + c * rate
    if depth <= 0.0:
        return 0.0, 0.0
    if force <= 0.0:  # it parts while still compressed: what is stored relaxes unseen
        return 0.5 * k * depth * depth, -k * depth * rate
    for i in range(2):
        held[i] = force * n[i]
        if mode == 1:
            for j in range(2):
                across = (1.0 if i == j else 0.0) - n[i] * n[j]
                tan.Kbb[6 + i, 6 + j] += k * n[i] * n[j] + force / distance * across
                tan.Cbb[6 + i, 6 + j] += c * n[i] * n[j]
    return 0.5 * k * depth * depth, c * rate * rate


@part
def _ring_rows(t, d, q, u, qd, ud, lam, mu_, zq, r_q, r_u, out, end, mode):
    """Rows of the inner and outer rings and of the constraints."""
    bodies, tan, rep = fields(d.bodies), fields(d.tangent), fields(d.report)
    work, border = fields(d.scratch), fields(d.scratch).border
    rq, ru, rud = q[zq : zq + 6], u[zq : zq + 6], ud[zq : zq + 6]
    rates = work.S[0]
    frame = ring_rates(rq, ru, rates)
    for c in range(6):
        r_q[zq + c] = qd[zq + c] - rates[c]
    r_q[zq] -= mu_[0]
    r_q[zq + 3] -= mu_[1]
    r_q[zq + 4] -= mu_[2]
    mass, Ia, It = bodies.ring[0], bodies.ring[1], bodies.ring[2]
    load = interpolate(bodies.load, t)
    # moments about the ring's own (non-spinning) axes
    cx, sx, ce, se = cos(rq[3]), sin(rq[3]), cos(rq[4]), sin(rq[4])
    Mx, My, Mz = border[3], border[4], border[5]
    M1 = cx * ce * Mx + se * My - sx * ce * Mz
    M2 = -cx * se * Mx + ce * My + sx * se * Mz
    M3 = sx * Mx + cx * Mz
    target = interpolate(bodies.speed, t)
    shaft = 0.0
    if bodies.drive[0] > 0.0:
        shaft = bodies.drive[1] * (drive_angle(bodies, t) - rq[5])
        shaft += bodies.drive[2] * (target - ru[3])
    for c in range(3):
        r_u[zq + c] = mass * (rud[c] - bodies.gravity[c]) - border[c]
    r_u[zq] -= lam[0]
    r_u[zq + 1] -= load * bodies.load_direction[0]
    r_u[zq + 2] -= load * bodies.load_direction[1]
    r_u[zq + 3] = Ia * rud[3] - M1 - lam[3] - shaft
    r_u[zq + 4] = It * (rud[4] - frame * ru[5]) + Ia * ru[3] * ru[5] - M2 - lam[1]
    r_u[zq + 5] = It * (rud[5] + frame * ru[4]) - Ia * ru[3] * ru[4] - M3 - lam[2]
    # outer ring
    oq, ou, oud = q[zq + 6 : zq + 8], u[zq + 6 : zq + 8], ud[zq + 6 : zq + 8]
    mo, fixed = bodies.outer[0], bodies.outer[3]
    held = work.vec[LEVER]
    stored, lost = _housing(bodies.outer, oq, ou, held, tan, mode)
    for c in range(2):
        r_q[zq + 6 + c] = qd[zq + 6 + c] - ou[c]
        if fixed > 0.0:
            r_u[zq + 6 + c] = oud[c]
        else:
            force = border[6 + c] - held[c] + mo * bodies.gravity[1 + c]
            r_u[zq + 6 + c] = mo * oud[c] - force
    # constraints: lambda rows hold rates, mu rows positions
    g = out[end:]
    g[0], g[1], g[2] = ru[0], ru[4], ru[5]
    g[3] = ru[3] - target if bodies.drive[0] == 0.0 else lam[3]
    g[4], g[5], g[6] = rq[0], rq[3], rq[4] - bodies.misalignment
    if mode == 1:
        for c in range(3):
            tan.Mbb[c, c] = mass
        tan.Mbb[3, 3] = Ia
        tan.Mbb[4, 4] = tan.Mbb[5, 5] = It
        tan.Cbb[4, 5] += Ia * ru[3]
        tan.Cbb[5, 4] -= Ia * ru[3]
        if bodies.drive[0] > 0.0:
            tan.Kbb[3, 3] += bodies.drive[1]
            tan.Cbb[3, 3] += bodies.drive[2]
        for c in range(2):
            tan.Mbb[6 + c, 6 + c] = 1.0 if fixed > 0.0 else mo
            if fixed > 0.0:  # its row is u' = 0, whatever pushes it
                zero(tan.Kbb[6 + c])
                zero(tan.Cbb[6 + c])
                for i in range(tan.Kbr.shape[0]):
                    zero(tan.Kbr[i, 6 + c])
                    zero(tan.Cbr[i, 6 + c])
    elif mode >= 2:
        w2 = ru[4] * ru[4] + ru[5] * ru[5]
        v2 = ru[0] * ru[0] + ru[1] * ru[1] + ru[2] * ru[2]
        rep.energy[0] += 0.5 * (mass * v2 + Ia * ru[3] * ru[3] + It * w2)
        rep.power[0] += lam[3] * ru[3] + shaft * ru[3]
        rep.power[1] += load * (bodies.load_direction[0] * ru[1] + bodies.load_direction[1] * ru[2])
        for c in range(3):
            rep.power[2] += mass * bodies.gravity[c] * ru[c]
        if fixed == 0.0:
            rep.energy[3] += stored
            rep.power[12] -= lost
            for c in range(2):
                rep.energy[0] += 0.5 * mo * ou[c] * ou[c]
                rep.power[2] += mo * bodies.gravity[1 + c] * ou[c]
        for c in range(2):
            rep.body_force[c] = border[6 + c]
