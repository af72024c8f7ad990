"""The residual F(t, y, y') = 0 of a whole bearing, its tangent, and its report.

One pass over the rollers calls the contact kernels, adds their wrenches to the bodies, and forms
the rows: kinematics q' - T(q) u - G^T mu, momentum M u' + h - Q - G^T lambda, g and its rate.
``mode``: 0 residual, 1 also the tangent blocks, 2 also the report.
"""

from __future__ import annotations

from math import cos, sin

import numpy as np

from flexcage.bodies.floating_frame import inertia_terms
from flexcage.contacts.land import land_contact
from flexcage.contacts.pocket import pocket_contact
from flexcage.contacts.race import race_contact
from flexcage.contacts.rib import rib_contact
from flexcage.contacts.state import set_pose, shift_matrix, to_frame
from flexcage.core.jit import copy_into, kernel, zero
from flexcage.core.rotation import matrix_from_quaternion, quaternion_rate


@kernel
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


@kernel
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


@kernel
def roller_rates(q, u, out):
    """Kinematics of a roller: out = T(q) u; returns the axial rate of its non-spinning frame."""
    orbit = u[2] / q[1]
    cx, sx, ce, se = cos(q[3]), sin(q[3]), cos(q[4]), sin(q[4])
    skew = (u[4] + orbit * cx * se) / ce
    frame = orbit * cx * ce + skew * se
    out[0], out[1], out[2] = u[0], u[1], orbit
    out[3], out[4], out[5] = skew, u[5] - orbit * sx, u[3] - frame
    return frame


@kernel
def ring_rates(q, u, out):
    """Kinematics of the inner ring (its frame does not orbit); returns its frame's axial rate."""
    skew = u[4] / cos(q[4])
    frame = skew * sin(q[4])
    out[0], out[1], out[2] = u[0], u[1], u[2]
    out[3], out[4], out[5] = skew, u[5], u[3] - frame
    return frame


@kernel
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


@kernel
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


@kernel
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
                for t in range(max(s - 1, 0), min(s + 2, n_st)):
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


@kernel
def _add_to_ring(F, wrench, P, border, vec):
    """Reaction of a roller's wrench on the inner ring, about its centre, in space."""
    f, m = vec[0], vec[1]
    m[0] = wrench[3] + P[1] * wrench[2] - P[2] * wrench[1]
    m[1] = wrench[4] + P[2] * wrench[0] - P[0] * wrench[2]
    m[2] = wrench[5] + P[0] * wrench[1] - P[1] * wrench[0]
    for j in range(3):
        f[j] = wrench[j]
        border[j] -= F[0, j] * wrench[0] + F[1, j] * wrench[1] + F[2, j] * wrench[2]
        border[3 + j] -= F[0, j] * m[0] + F[1, j] * m[1] + F[2, j] * m[2]


def evaluate(t, y, yd, box, law, out, mode):
    """Residual into ``out``; see the module's text. Index letters: i roller, c component, m mode.

    ``box`` refers to the model, its memory and its workspaces; ``law`` holds the normal laws of
    race, pocket, side, rib and land, then their friction laws.
    """
    race_law, pocket_law, side_law, rib_law, land_law = law[0], law[1], law[2], law[3], law[4]
    race_mu, pocket_mu, side_mu, rib_mu, land_mu = law[5], law[6], law[7], law[8], law[9]
    model, memory, work = box.value.model, box.value.memory, box.value.work
    bodies, tan, rep = model.bodies, work.tangent, work.report
    Z = bodies.radius.shape[0]
    nm = model.cage.mff.shape[0]
    nq, nu = 6 * Z + 15 + nm, 6 * Z + 14 + nm
    q, u, qd, ud = y[:nq], y[nq : nq + nu], yd[:nq], yd[nq : nq + nu]
    lam, mu_ = y[nq + nu : nq + nu + 4], y[nq + nu + 4 :]
    r_q, r_u = out[:nq], out[nq : nq + nu]
    zq, border = 6 * Z, work.border
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
    if mode == 2:
        zero(rep.power)
        zero(rep.energy)
        zero(rep.race)
        zero(rep.rib)
        zero(rep.contact)
        zero(rep.body_force)
        zero(rep.land)
    vec = work.vec
    ring_q, ring_u = q[zq : zq + 6], u[zq : zq + 6]
    out_q, out_u = q[zq + 6 : zq + 8], u[zq + 6 : zq + 8]
    Rc, quat, qf = q[zq + 8 : zq + 11], q[zq + 11 : zq + 15], q[zq + 15 :]
    Vc, wb, qfd = u[zq + 8 : zq + 11], u[zq + 11 : zq + 14], u[zq + 14 :]
    A = work.A
    matrix_from_quaternion(quat, A)
    wg = vec[2]
    for c in range(3):
        wg[c] = A[c, 0] * wb[0] + A[c, 1] * wb[1] + A[c, 2] * wb[2]
    # inner ring's axes and angular velocity in space (its frame does not spin)
    cx, sx, ce, se = cos(ring_q[3]), sin(ring_q[3]), cos(ring_q[4]), sin(ring_q[4])
    b_s, w_s = vec[3], vec[4]
    b_s[0], b_s[1], b_s[2] = cx * ce, se, -sx * ce
    w_s[0] = ring_u[3] * b_s[0] - ring_u[4] * cx * se + ring_u[5] * sx
    w_s[1] = ring_u[3] * b_s[1] + ring_u[4] * ce
    w_s[2] = ring_u[3] * b_s[2] + ring_u[4] * sx * se + ring_u[5] * cx
    margin = 0.0
    for m in range(nm):
        margin += model.pocket.phi_max[m] * abs(qf[m])
    pose, sl, pair, pw, sums = work.pose, work.slices, work.pair, work.pocket, work.sums
    P, b, Vr, wr = vec[5], vec[6], vec[7], vec[8]
    zero3 = np.zeros(3)
    xaxis = np.zeros(3)
    xaxis[0] = 1.0
    D, rel = vec[9], vec[10]
    tmp = vec[11]
    mass, Ia, It = bodies.roller
    FR = np.empty(6)
    laws = (pocket_law, side_law, pocket_mu, side_mu)
    rib_laws = (rib_law, rib_mu)
    half_drag = bodies.drag[0]
    for i in range(Z):
        qi, ui, udi = q[6 * i : 6 * i + 6], u[6 * i : 6 * i + 6], ud[6 * i : 6 * i + 6]
        set_pose(qi, ui, pose)
        F, a = pose.F, pose.axis
        Rw = bodies.radius[i]
        zero(FR)
        # inner race and ribs
        P[0] = qi[0] - ring_q[0]
        P[1] = qi[1] - (ring_q[1] * F[1, 1] + ring_q[2] * F[1, 2])
        P[2] = -(ring_q[1] * F[2, 1] + ring_q[2] * F[2, 2])
        to_frame(F, b_s, b)
        to_frame(F, ring_u[0:3], Vr)
        to_frame(F, w_s, wr)
        for k in range(2):
            if k == 0:
                hit = race_contact(
                    pose, model.inner, Rw, P, b, Vr, wr, ring_q[5], memory.race[i, 0],
                    race_law, race_mu, sl, pair, mode, sums,
                )  # fmt: skip
            else:
                hit = rib_contact(
                    pose, model.rib, P, b, Vr, wr, memory.rib[i], rib_laws, sl, pair, mode, sums
                )
            if not hit:
                continue
            for c in range(6):
                FR[c] += pair.wrench[c]
            _add_to_ring(F, pair.wrench, P, border, vec)
            if mode == 1:
                for c in range(3):
                    for e in range(3):
                        work.R[0, c, e] = F[c, e]
                        work.R[1, c, e] = F[c, e]
                shift_matrix(work.R, P, work.S)
                _scatter(pair, work.S, i, 0, tan, work.T6)
            elif mode == 2 and k == 0:
                for c in range(9):
                    rep.race[i, 0, c] = sums[c]
                rep.contact[i, 0] = 1 if sums[0] > 0.0 else 0
                rep.energy[2] += sums[5]
                rep.power[3] += sums[6]
                rep.power[4] += sums[7]
                rep.power[5] += sums[8]
            elif mode == 2:
                rep.rib[i, 0], rep.rib[i, 1] = sums[0], sums[1]
                rep.contact[i, 6] = 1 if sums[0] > 0.0 else 0
                rep.contact[i, 7] = 1 if sums[1] > 0.0 else 0
                rep.energy[2] += sums[2]
                rep.power[8] += sums[3] + sums[4]
        # outer race
        P[0] = qi[0]
        P[1] = qi[1] - (out_q[0] * F[1, 1] + out_q[1] * F[1, 2])
        P[2] = -(out_q[0] * F[2, 1] + out_q[1] * F[2, 2])
        for c in range(3):
            Vr[c] = F[c, 1] * out_u[0] + F[c, 2] * out_u[1]
        hit = race_contact(
            pose, model.outer, Rw, P, xaxis, Vr, zero3, 0.0, memory.race[i, 1],
            race_law, race_mu, sl, pair, mode, sums,
        )  # fmt: skip
        if hit:
            for c in range(6):
                FR[c] += pair.wrench[c]
            for c in range(2):
                fo = F[1, 1 + c] * pair.wrench[1] + F[2, 1 + c] * pair.wrench[2]
                border[6 + c] -= fo
            if mode == 1:
                _scatter_outer(pair, F, i, tan)
            elif mode == 2:
                for c in range(9):
                    rep.race[i, 1, c] = sums[c]
                rep.contact[i, 1] = 1 if sums[0] > 0.0 else 0
                rep.energy[2] += sums[5]
                rep.power[3] += sums[6]
                rep.power[4] += sums[7]
                rep.power[5] += sums[8]
        # pocket
        rel[0], rel[1], rel[2] = qi[0] - Rc[0], -Rc[1], -Rc[2]
        to_frame(F, rel, D)
        D[1] += qi[1]
        ca, sa = model.pocket.azimuth[i, 0], model.pocket.azimuth[i, 1]
        for c in range(3):
            pw.G[0, c] = F[c, 0] * A[0, 0] + F[c, 1] * A[1, 0] + F[c, 2] * A[2, 0]
            e1 = F[c, 0] * A[0, 1] + F[c, 1] * A[1, 1] + F[c, 2] * A[2, 1]
            e2 = F[c, 0] * A[0, 2] + F[c, 1] * A[1, 2] + F[c, 2] * A[2, 2]
            pw.G[1, c] = ca * e1 + sa * e2
            pw.G[2, c] = -sa * e1 + ca * e2
        to_frame(F, Vc, Vr)
        to_frame(F, wg, wr)
        hit = pocket_contact(
            pose, model.pocket, i, Rw, D, Vr, wr, qf, qfd, margin, memory.pocket[i], laws,
            sl, pw, pair, mode, sums,
        )  # fmt: skip
        if mode == 1:
            tan.active[i] = 1 if hit else 0
        if hit:
            for c in range(6):
                FR[c] += pair.wrench[c]
            w6 = pair.wrench
            tmp[0] = w6[3] + D[1] * w6[2] - D[2] * w6[1]
            tmp[1] = w6[4] + D[2] * w6[0] - D[0] * w6[2]
            tmp[2] = w6[5] + D[0] * w6[1] - D[1] * w6[0]
            for c in range(3):
                border[8 + c] -= F[0, c] * w6[0] + F[1, c] * w6[1] + F[2, c] * w6[2]
                rel[c] = F[0, c] * tmp[0] + F[1, c] * tmp[1] + F[2, c] * tmp[2]
            for c in range(3):
                border[11 + c] -= A[0, c] * rel[0] + A[1, c] * rel[1] + A[2, c] * rel[2]
            if nm > 0:
                for f in range(4):
                    if pw.normal[f] > 0.0:
                        for s in range(pw.st.shape[1]):
                            for c in range(3):
                                x = pw.st[f, s, c]
                                if x != 0.0:
                                    for m in range(nm):
                                        border[14 + m] += x * model.pocket.phi[i, f, s, c, m]
            if mode == 1:
                for c in range(3):
                    for e in range(3):
                        work.R[0, c, e] = F[c, e]
                        x = 0.0
                        for o in range(3):
                            x += F[c, o] * A[o, e]
                        work.R[1, c, e] = x
                shift_matrix(work.R, D, work.S)
                _scatter(pair, work.S, i, 8, tan, work.T6)
                if nm > 0:
                    _scatter_modes(model.pocket, i, pw, work.S, tan, work.Lm, work.Bm, work.PR)
        if mode == 2:
            if hit:
                rep.energy[2] += sums[0]
                rep.power[6] += sums[1]
                rep.power[7] += sums[2]
                copy_into(rep.station[i], pw.st)
                copy_into(rep.residual[i], pw.a)
                for f in range(2):
                    for k in range(rep.slice_normal.shape[2]):
                        rep.slice_normal[i, f, k] = pw.slice_N[f, k]
                        rep.slice_friction[i, f, k] = pw.slice_T[f, k]
            else:
                zero(rep.station[i])
                zero(rep.residual[i])
                zero(rep.slice_normal[i])
                zero(rep.slice_friction[i])
            for f in range(4):
                rep.pocket_normal[i, f] = pw.normal[f]
                rep.pocket_friction[i, f] = pw.tangential[f]
                rep.contact[i, 2 + f] = 1 if pw.normal[f] > 0.0 else 0
            _approach(pose, model, i, ring_u, out_u, F, Vr, wr, D, pw, rep)
        # drag and gravity
        drag = -half_drag * abs(ui[2]) * ui[2]
        FR[2] += drag
        gr = F[1, 1] * bodies.gravity[1] + F[1, 2] * bodies.gravity[2]
        gp = F[2, 1] * bodies.gravity[1] + F[2, 2] * bodies.gravity[2]
        # rows of the roller
        rates = work.S[0]
        frame = roller_rates(qi, ui, rates)
        for c in range(6):
            r_q[6 * i + c] = qd[6 * i + c] - rates[c]
        r = qi[1]
        o = 6 * i
        r_u[o] = mass * (udi[0] - bodies.gravity[0]) - FR[0]
        r_u[o + 1] = mass * (udi[1] - ui[2] * ui[2] / r - gr) - FR[1]
        r_u[o + 2] = mass * (udi[2] + ui[1] * ui[2] / r - gp) - FR[2]
        M1 = a[0, 0] * FR[3] + a[0, 1] * FR[4] + a[0, 2] * FR[5]
        M2 = a[1, 0] * FR[3] + a[1, 1] * FR[4] + a[1, 2] * FR[5]
        M3 = a[2, 0] * FR[3] + a[2, 1] * FR[4] + a[2, 2] * FR[5]
        r_u[o + 3] = Ia * udi[3] - M1
        r_u[o + 4] = It * (udi[4] - frame * ui[5]) + Ia * ui[3] * ui[5] - M2
        r_u[o + 5] = It * (udi[5] + frame * ui[4]) - Ia * ui[3] * ui[4] - M3
        if mode == 1:
            tan.Crr[i, 1, 2] -= 2.0 * mass * ui[2] / r
            tan.Crr[i, 2, 1] += mass * ui[2] / r
            tan.Crr[i, 2, 2] += mass * ui[1] / r + 2.0 * half_drag * abs(ui[2])
            tan.Crr[i, 4, 5] += Ia * ui[3] - It * frame
            tan.Crr[i, 5, 4] -= Ia * ui[3] - It * frame
        elif mode == 2:
            rep.power[2] += mass * (gr * ui[1] + gp * ui[2])
            rep.power[10] += drag * ui[2]
            v2 = ui[0] * ui[0] + ui[1] * ui[1] + ui[2] * ui[2]
            w2 = ui[4] * ui[4] + ui[5] * ui[5]
            rep.energy[0] += 0.5 * (mass * v2 + Ia * ui[3] * ui[3] + It * w2)
    # cage land
    Fc, Mc, Fr, Mr = vec[5], vec[6], vec[7], vec[8]
    zero(Fc)
    zero(Mc)
    zero(Fr)
    zero(Mr)
    Qm = border[14:]
    rides_inner = model.land.inner > 0.0
    if rides_inner:
        copy_into(rel, ring_q[0:3])
        copy_into(tmp, ring_u[0:3])
    else:
        rel[0], rel[1], rel[2] = 0.0, out_q[0], out_q[1]
        tmp[0], tmp[1], tmp[2] = 0.0, out_u[0], out_u[1]
    spin = ring_u[3] if rides_inner else 0.0
    land_contact(
        A, Rc, Vc, wg, qf, qfd, rel, tmp, spin, model.land, memory.land, (land_law, land_mu),
        sl, work.land, Fc, Mc, Qm, Fr, Mr, sums,
    )  # fmt: skip
    Mc[0] -= bodies.drag[1] * abs(wg[0]) * wg[0]
    for c in range(3):
        border[8 + c] += Fc[c] + 0.0
        border[11 + c] += A[0, c] * Mc[0] + A[1, c] * Mc[1] + A[2, c] * Mc[2]
        if rides_inner:
            border[c] += Fr[c]
            border[3 + c] += Mr[c]
    if not rides_inner:
        border[6] += Fr[1]
        border[7] += Fr[2]
    if mode == 2:
        copy_into(rep.land, Fc)
        for c in range(2):
            rep.land_touch[c, 0], rep.land_touch[c, 1] = sums[4 + c], sums[6 + c]
        rep.energy[2] += sums[0]
        rep.power[9] += sums[1] + sums[2] + sums[3]
        rep.power[10] -= bodies.drag[1] * abs(wg[0]) * wg[0] * wg[0]
    _cage_rows(model, work, A, Rc, quat, Vc, wb, qf, qfd, qd, ud, zq, r_q, r_u, border, mode)
    _ring_rows(t, model, work, q, u, qd, ud, lam, mu_, zq, r_q, r_u, border, out, nq + nu, mode)


@kernel
def _approach(pose, model, i, ring_u, out_u, F, Vc, wc, D, pw, rep):
    """Approach speed of roller i at each of its contacts, at its centre (for the onset memory)."""
    vi = F[1, 1] * ring_u[1] + F[1, 2] * ring_u[2]
    vo = F[1, 1] * out_u[0] + F[1, 2] * out_u[1]
    rep.approach[i, 0] = -(pose.V[1] - vi)
    rep.approach[i, 1] = pose.V[1] - vo
    vx = pose.V[0] - Vc[0] - (wc[1] * D[2] - wc[2] * D[1])
    vr = pose.V[1] - Vc[1] - (wc[2] * D[0] - wc[0] * D[2])
    vp = pose.V[2] - Vc[2] - (wc[0] * D[1] - wc[1] * D[0])
    t = pw.G[2, 0] * vx + pw.G[2, 1] * vr + pw.G[2, 2] * vp
    x = pw.G[0, 0] * vx + pw.G[0, 1] * vr + pw.G[0, 2] * vp
    rep.approach[i, 2], rep.approach[i, 3] = t, -t
    rep.approach[i, 4], rep.approach[i, 5] = x, -x
    rep.approach[i, 6] = pose.V[0] - ring_u[0]
    rep.approach[i, 7] = -rep.approach[i, 6]


@kernel
def _cage_rows(model, work, A, Rc, quat, Vc, wb, qf, qfd, qd, ud, zq, r_q, r_u, border, mode):
    """Rows of the cage: floating frame, translations in space, rotations in the body."""
    data, tan, rep = model.cage, work.tangent, work.report
    nm = qf.shape[0]
    M, h = work.frame.M, work.frame.h
    inertia_terms(data, wb, qf, qfd, work.frame)
    rate = np.empty(4)
    quaternion_rate(quat, wb, rate)
    for c in range(3):
        r_q[zq + 8 + c] = qd[zq + 8 + c] - Vc[c]
    for c in range(4):
        r_q[zq + 11 + c] = qd[zq + 11 + c] - rate[c]
    for m in range(nm):
        r_q[zq + 15 + m] = qd[zq + 15 + m] - qfd[m]
    acc = np.empty(6 + nm)
    g = model.bodies.gravity
    gb = np.empty(3)
    for c in range(3):
        acc[c] = A[0, c] * ud[zq + 8] + A[1, c] * ud[zq + 9] + A[2, c] * ud[zq + 10]
        gb[c] = A[0, c] * g[0] + A[1, c] * g[1] + A[2, c] * g[2]
        acc[3 + c] = ud[zq + 11 + c]
    for m in range(nm):
        acc[6 + m] = ud[zq + 14 + m]
    rows = np.empty(6 + nm)
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
    elif mode == 2:
        v = np.empty(6 + nm)
        for c in range(3):
            v[c] = A[0, c] * Vc[0] + A[1, c] * Vc[1] + A[2, c] * Vc[2]
            v[3 + c] = wb[c]
        for m in range(nm):
            v[6 + m] = qfd[m]
        for a in range(6 + nm):
            for b in range(6 + nm):
                rep.energy[0] += 0.5 * v[a] * M[a, b] * v[b]
            for c in range(3):
                rep.power[2] += v[a] * M[a, c] * gb[c]
        for m in range(nm):
            for l in range(nm):
                rep.energy[1] += 0.5 * qf[m] * data.kff[m, l] * qf[l]
                rep.power[11] -= qfd[m] * data.dff[m, l] * qfd[l]


@kernel
def _ring_rows(t, model, work, q, u, qd, ud, lam, mu_, zq, r_q, r_u, border, out, end, mode):
    """Rows of the inner and outer rings and of the constraints."""
    bodies, tan, rep = model.bodies, work.tangent, work.report
    rq, ru, rud = q[zq : zq + 6], u[zq : zq + 6], ud[zq : zq + 6]
    rates = np.empty(6)
    frame = ring_rates(rq, ru, rates)
    for c in range(6):
        r_q[zq + c] = qd[zq + c] - rates[c]
    r_q[zq] -= mu_[0]
    r_q[zq + 3] -= mu_[1]
    r_q[zq + 4] -= mu_[2]
    mass, Ia, It = bodies.ring
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
    mo, ko, co, fixed = bodies.outer
    for c in range(2):
        r_q[zq + 6 + c] = qd[zq + 6 + c] - ou[c]
        if fixed > 0.0:
            r_u[zq + 6 + c] = oud[c]
        else:
            force = border[6 + c] - ko * oq[c] - co * ou[c] + mo * bodies.gravity[1 + c]
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
            else:
                tan.Kbb[6 + c, 6 + c] += ko
                tan.Cbb[6 + c, 6 + c] += co
    elif mode == 2:
        w2 = ru[4] * ru[4] + ru[5] * ru[5]
        v2 = ru[0] * ru[0] + ru[1] * ru[1] + ru[2] * ru[2]
        rep.energy[0] += 0.5 * (mass * v2 + Ia * ru[3] * ru[3] + It * w2)
        rep.power[0] += lam[3] * ru[3] + shaft * ru[3]
        rep.power[1] += load * (bodies.load_direction[0] * ru[1] + bodies.load_direction[1] * ru[2])
        for c in range(3):
            rep.power[2] += mass * bodies.gravity[c] * ru[c]
        if fixed == 0.0:
            for c in range(2):
                rep.energy[0] += 0.5 * mo * ou[c] * ou[c]
                rep.energy[3] += 0.5 * ko * oq[c] * oq[c]
                rep.power[12] -= co * ou[c] * ou[c]
                rep.power[2] += mo * bodies.gravity[1 + c] * ou[c]
        for c in range(2):
            rep.body_force[c] = border[6 + c]
