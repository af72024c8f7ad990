"""Roller in its pocket: crossbeam faces in slices, side beams over points of the roller's end.

The wall is deformed: dynamic modes are read at a few stations per face and interpolated, and forces
go back to the same stations with the same weights; a defect's offset is known on a finer grid. The
normal force leans with the wall's slope along the face, so that it is the slope of an energy. The
residual
(quasi-static) flexibility is condensed pocket by pocket inside this kernel: with psi(x) the
pocket's residual shapes and C their compliance, coordinates a solve

    a = C sum_k psi(x_k) F_el(d_k - psi(x_k) . a),

so no unknown is added to the DAE, energy stays consistent (the wall stores a^T C^-1 a/2), and
damping acts on the rate of the remaining motion. A rigid cage has C = 0 and no modes.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.state import (
    add_end_generator,
    add_generator,
    add_outer,
    approach,
    clear,
    friction_tangent,
)
from flexcage.core.jit import kernel, zero

N_LOCAL = 8  # residual coordinates of a pocket: uniform and linear on four faces


class PocketData(NamedTuple):
    """All pockets of a cage: faces 0 front, 1 rear, 2 side +x, 3 side -x."""

    azimuth: np.ndarray  # (Z, 2) cos, sin of pocket azimuths in the cage frame
    half: np.ndarray  # (2,) half width, half length of a pocket
    s: np.ndarray  # (ns,) slice positions along the roller
    drop: np.ndarray  # (ns,)
    points: np.ndarray  # (np, 2) points of a roller's end: along its two transverse axes
    half_roller: float  # half of the roller's overall length
    x0: np.ndarray  # (4,) first station
    dx: np.ndarray  # (4,) station spacing
    offset: np.ndarray  # (Z, 4, no) stress-free outward offset, on a grid of its own
    grid: np.ndarray  # (2, 4) first point and spacing of that grid
    low: np.ndarray  # (Z, 4) least offset of a face
    phi: np.ndarray  # (Z, 4, nst, 3, nm)
    phi_max: np.ndarray  # (nm,) largest normal value over all stations
    res: np.ndarray  # (Z, 4, nst, 8)
    comp: np.ndarray  # (Z, 8, 8)
    friction: np.ndarray  # (2, 5) crossbeams, side beams


class PocketWork(NamedTuple):
    """Buffers of one pocket."""

    G: np.ndarray  # (3, 3) rows: pocket axes x, r, psi in F
    d0: np.ndarray  # (4, n) penetration before the residual deflection
    v: np.ndarray  # (4, n)
    j: np.ndarray  # (4, n) station index
    w: np.ndarray  # (4, n) weight of station j+1
    slope: np.ndarray  # (4, n) of the wall's offset along the face
    near: np.ndarray  # (4,) face may touch
    wall: np.ndarray  # (4, nst, 3) modal displacement, then velocity, of stations
    st: np.ndarray  # (4, nst, 3) forces on the cage, pocket axes
    a: np.ndarray  # (8,)
    BW: np.ndarray  # (4, nst, 6) station-generator products
    LV: np.ndarray  # (4, nst, 6)
    H: np.ndarray  # (4, nst, nst) station stiffness, before the residual is condensed
    HR: np.ndarray  # (4, nst, 8) H times the residual shapes
    X: np.ndarray  # (8, 8) (1 + C R^T H R)^-1 C; zero for a rigid pocket
    A8: np.ndarray  # (8, 9) small solves
    normal: np.ndarray  # (4,) sums of the faces
    tangential: np.ndarray  # (4,)
    slice_N: np.ndarray  # (4, n)
    slice_T: np.ndarray  # (4, n)


def pocket_work(n_slices: int, n_points: int, n_stations: int) -> PocketWork:
    n, st, z = max(n_slices, n_points), n_stations, np.zeros
    return PocketWork(
        z((3, 3)), z((4, n)), z((4, n)), z((4, n), np.int64), z((4, n)), z((4, n)),
        z(4, np.int64), z((4, st, 3)), z((4, st, 3)), z(8), z((4, st, 6)), z((4, st, 6)),
        z((4, st, st)), z((4, st, 8)), z((8, 8)), z((8, 9)), z(4), z(4), z((4, n)), z((4, n)),
    )  # fmt: skip


def with_offset(data: PocketData, offset: np.ndarray) -> PocketData:
    """The pockets with other stress-free offsets (Z, 4, no) [m]."""
    return data._replace(offset=np.ascontiguousarray(offset), low=offset.min(axis=2))


@kernel
def solve_small(A, n):
    """Gaussian elimination with pivoting of the (n, n+1) system in A; solution in column n."""
    for i in range(n):
        p = i
        for r in range(i + 1, n):
            if abs(A[r, i]) > abs(A[p, i]):
                p = r
        if p != i:
            for c in range(i, n + 1):
                A[i, c], A[p, c] = A[p, c], A[i, c]
        inv = 1.0 / A[i, i]
        for r in range(i + 1, n):
            f = A[r, i] * inv
            if f != 0.0:
                for c in range(i + 1, n + 1):
                    A[r, c] -= f * A[i, c]
    for i in range(n - 1, -1, -1):
        s = A[i, n]
        for c in range(i + 1, n):
            s -= A[i, c] * A[c, n]
        A[i, n] = s / A[i, i]


@kernel
def lever(pose, data, Rw, f, k, pw, r):
    """Lever from the roller's centre to slice or point k of face f, in F."""
    a = pose.axis
    if f < 2:
        h = (Rw - data.drop[k]) * (1.0 if f == 0 else -1.0)
        for j in range(3):
            r[j] = data.s[k] * a[0, j] + h * pw.G[2, j]
    else:
        h = data.half_roller if f == 2 else -data.half_roller
        for j in range(3):
            r[j] = h * a[0, j] + data.points[k, 0] * a[1, j] + data.points[k, 1] * a[2, j]


@kernel
def _face_modes(data, i, f, q, wall):
    """Modal displacement (or velocity) of the stations of face f of pocket i."""
    n_st = data.phi.shape[2]
    n_m = q.shape[0]
    for s in range(n_st):
        for c in range(3):
            x = 0.0
            for m in range(n_m):
                x += data.phi[i, f, s, c, m] * q[m]
            wall[f, s, c] = x


@kernel
def _cell(x, first, spacing, n):
    """Index j and weight w of x between points j and j+1 of a grid of n; held at its ends."""
    place = (x - first) / spacing
    j = min(max(int(place), 0), n - 2)
    return j, min(max(place - j, 0.0), 1.0)


@kernel
def _penetrations(pose, data, i, Rw, D, q, margin, pw):
    """Penetration d0 of every slice of every face that is near; returns whether any touches."""
    G = pw.G
    X = G[0, 0] * D[0] + G[0, 1] * D[1] + G[0, 2] * D[2]
    T = G[2, 0] * D[0] + G[2, 1] * D[1] + G[2, 2] * D[2]
    ax = np.empty(3)
    at = np.empty(3)
    for c in range(3):
        ax[c] = G[0, 0] * pose.axis[c, 0] + G[0, 1] * pose.axis[c, 1] + G[0, 2] * pose.axis[c, 2]
        at[c] = G[2, 0] * pose.axis[c, 0] + G[2, 1] * pose.axis[c, 1] + G[2, 2] * pose.axis[c, 2]
    reach = abs(data.s[data.s.shape[0] - 1])
    n_st, n_o = data.phi.shape[2], data.offset.shape[2]
    touch = False
    for f in range(4):
        sgn = 1.0 if f % 2 == 0 else -1.0
        low = data.low[i, f]
        if f < 2:
            near = sgn * T + abs(at[0]) * reach + Rw - data.half[0] - low + margin
        else:
            tilt = (abs(ax[1]) + abs(ax[2])) * Rw
            near = sgn * X + tilt + data.half_roller - data.half[1] - low + margin
        pw.near[f] = 1 if near > 0.0 else 0
        if pw.near[f] == 0:
            continue
        comp, along_comp = (2, 0) if f < 2 else (0, 2)
        if q.shape[0] > 0:
            _face_modes(data, i, f, q, pw.wall)
        else:
            pw.wall[f, :, :] = 0.0
        count = data.s.shape[0] if f < 2 else data.points.shape[0]
        for k in range(count):
            if f < 2:
                along = X + data.s[k] * ax[0]
                depth = sgn * (T + data.s[k] * at[0]) + Rw - data.drop[k] - data.half[0]
            else:
                h = sgn * data.half_roller
                y, z = data.points[k, 0], data.points[k, 1]
                along = T + h * at[0] + y * at[1] + z * at[2]
                depth = sgn * (X + h * ax[0] + y * ax[1] + z * ax[2]) - data.half[1]
            j, w = _cell(along, data.x0[f], data.dx[f], n_st)
            # what lies under this point has moved there along the face
            along -= (1.0 - w) * pw.wall[f, j, along_comp] + w * pw.wall[f, j + 1, along_comp]
            j, w = _cell(along, data.x0[f], data.dx[f], n_st)
            pw.j[f, k], pw.w[f, k] = j, w
            rise = pw.wall[f, j + 1, comp] - pw.wall[f, j, comp]
            o, g = _cell(along, data.grid[0, f], data.grid[1, f], n_o)
            step = data.offset[i, f, o + 1] - data.offset[i, f, o]
            pw.slope[f, k] = 0.0
            if 0.0 < g < 1.0:
                pw.slope[f, k] += step / data.grid[1, f]
            if 0.0 < w < 1.0:
                pw.slope[f, k] += sgn * rise / data.dx[f]
            wall = data.offset[i, f, o] + g * step + sgn * (pw.wall[f, j, comp] + w * rise)
            pw.d0[f, k] = depth - wall
            if pw.d0[f, k] > 0.0:
                touch = True
    return touch


@kernel
def _condense(data, i, p, law, side_law, sl, pw):
    """Solve the pocket's residual coordinates a; leaves station stiffness in pw.H."""
    C, R = data.comp[i], data.res[i]
    n_st = data.phi.shape[2]
    zero(pw.a)
    g = np.zeros(8)
    RH = np.zeros((8, 8))
    for _ in range(25):
        zero(g)
        zero(RH)
        for f in range(4):
            if pw.near[f] == 0:
                continue
            count = data.s.shape[0] if f < 2 else data.points.shape[0]
            for k in range(count):
                j, w = pw.j[f, k], pw.w[f, k]
                u = 0.0
                for l in range(8):
                    u += ((1.0 - w) * R[f, j, l] + w * R[f, j + 1, l]) * pw.a[l]
                sl.d[k] = pw.d0[f, k] - u
            if f < 2:
                law(count, sl.d, sl.zero, p[f], sl.N, sl.Nd, sl.Nv)
            else:
                side_law(count, sl.d, sl.zero, p[f], sl.N, sl.Nd, sl.Nv)
            for k in range(count):
                if sl.N[k] > 0.0:
                    j, w = pw.j[f, k], pw.w[f, k]
                    for l in range(8):
                        rl = (1.0 - w) * R[f, j, l] + w * R[f, j + 1, l]
                        g[l] += rl * sl.N[k]
                        for m in range(8):
                            rm = (1.0 - w) * R[f, j, m] + w * R[f, j + 1, m]
                            RH[l, m] += sl.Nd[k] * rl * rm
        worst = 0.0
        for l in range(8):
            r = -pw.a[l]
            for m in range(8):
                r += C[l, m] * g[m]
                x = 1.0 if l == m else 0.0
                for o in range(8):
                    x += C[l, o] * RH[o, m]
                pw.A8[l, m] = x
            pw.A8[l, 8] = r
        solve_small(pw.A8, 8)
        for l in range(8):
            pw.a[l] += pw.A8[l, 8]
            scale = 0.0
            for f in range(4):
                scale = max(scale, abs(R[f, 0, l]), abs(R[f, n_st - 1, l]), abs(R[f, n_st // 2, l]))
            worst = max(worst, abs(pw.A8[l, 8]) * scale)
        if worst < 1e-13:
            break


@kernel
def pocket_contact(pose, data, i, Rw, D, Vc, wc, q, qd, margin, p, laws, sl, pw, pair, mode, sums):
    """Wrench of pocket i on its roller, and station forces on the cage in ``pw.st``.

    D: roller centre from the cage's origin; Vc, wc: cage velocity and angular velocity, in F;
    q, qd: modal coordinates and rates; ``margin``: bound of the walls' motion; p (4, N_NORMAL).
    ``laws``: normal (crossbeam, side), friction (crossbeam, side). Tangent (mode 1) in ``pair`` and
    ``pw.BW, pw.LV, pw.H``; report (mode 2) in ``sums``: elastic energy (with the residual's),
    damping power, friction power.
    """
    clear(pair, mode == 1)
    law, side_law, mu, side_mu = laws
    zero(pw.normal)
    zero(pw.tangential)
    if mode == 2:
        zero(sums)
        zero(pw.slice_N)
        zero(pw.slice_T)
        zero(pw.a)
    if not _penetrations(pose, data, i, Rw, D, q, margin, pw):
        return False
    n_st = data.phi.shape[2]
    soft = data.comp[i, 0, 0] > 0.0
    if soft:
        _condense(data, i, p, law, side_law, sl, pw)
        if mode == 2:
            sums[0] += _stored(data, i, p, law, side_law, sl, pw)
    zero(pw.st)
    if mode == 1:
        zero(pw.BW)
        zero(pw.LV)
        zero(pw.H)
        zero(pw.X)
    r, rel = np.empty(3), np.empty(3)
    Wn, Wt, Wx, V = np.empty(6), np.empty(6), np.empty(6), np.empty(6)
    n, e1, e2 = np.empty(3), np.empty(3), np.empty(3)
    any_contact = False
    for f in range(4):
        if pw.near[f] == 0:
            continue
        sgn = 1.0 if f % 2 == 0 else -1.0
        comp = 2 if f < 2 else 0
        first, second = (0, 1) if f < 2 else (1, 2)  # tangential components of the face
        lean = 0 if f < 2 else 1  # which of them runs along the face, where the wall may slope
        count = data.s.shape[0] if f < 2 else data.points.shape[0]
        loaded = False
        for k in range(count):
            j, w = pw.j[f, k], pw.w[f, k]
            sl.d[k] = pw.d0[f, k]
            if soft:
                rise = 0.0
                for l in range(8):
                    first_l, second_l = data.res[i, f, j, l], data.res[i, f, j + 1, l]
                    sl.d[k] -= (first_l + w * (second_l - first_l)) * pw.a[l]
                    rise += (second_l - first_l) * pw.a[l]
                if 0.0 < w < 1.0:
                    pw.slope[f, k] += rise / data.dx[f]
            loaded = loaded or sl.d[k] > 0.0
        if not loaded:
            continue
        any_contact = True
        for c in range(3):
            n[c] = -sgn * pw.G[comp, c]
            e1[c], e2[c] = pw.G[first, c], pw.G[second, c]
        if qd.shape[0] > 0:
            _face_modes(data, i, f, qd, pw.wall)
        for k in range(count):
            sl.v[k] = sl.u[k] = 0.0
            if sl.d[k] <= 0.0:
                continue
            j, w = pw.j[f, k], pw.w[f, k]
            lever(pose, data, Rw, f, k, pw, r)
            x, y, z = D[0] + r[0], D[1] + r[1], D[2] + r[2]
            o = pose.w
            rel[0] = pose.V[0] - Vc[0] + o[1] * r[2] - o[2] * r[1] - wc[1] * z + wc[2] * y
            rel[1] = pose.V[1] - Vc[1] + o[2] * r[0] - o[0] * r[2] - wc[2] * x + wc[0] * z
            rel[2] = pose.V[2] - Vc[2] + o[0] * r[1] - o[1] * r[0] - wc[0] * y + wc[1] * x
            wn = (1.0 - w) * pw.wall[f, j, comp] + w * pw.wall[f, j + 1, comp]
            w1 = (1.0 - w) * pw.wall[f, j, first] + w * pw.wall[f, j + 1, first]
            w2 = (1.0 - w) * pw.wall[f, j, second] + w * pw.wall[f, j + 1, second]
            if f < 2:
                sl.v[k] = -(n[0] * rel[0] + n[1] * rel[1] + n[2] * rel[2]) - sgn * wn
            else:
                add_end_generator(n, r, pose.axis[0], D[1], Wn)
                sl.v[k] = approach(Wn, pose, D, Vc, wc) - sgn * wn
            sl.t[k, 0] = e1[0] * rel[0] + e1[1] * rel[1] + e1[2] * rel[2] - w1
            sl.t[k, 1] = e2[0] * rel[0] + e2[1] * rel[1] + e2[2] * rel[2] - w2
            sl.v[k] -= pw.slope[f, k] * sl.t[k, lean]
            if f < 2:  # a crossbeam's slope is met by the roller's axis, not by its surface
                h = (Rw - data.drop[k]) * sgn * pw.slope[f, k]
                for c in range(3):
                    sl.v[k] += h * (o[c] - wc[c]) * pw.G[1, c]
            sl.u[k] = sqrt(sl.t[k, 0] ** 2 + sl.t[k, 1] ** 2)
        if f < 2:
            law(count, sl.d, sl.v, p[f], sl.N, sl.Nd, sl.Nv)
            mu(count, sl.u, data.friction[0], sl.g, sl.dg)
        else:
            side_law(count, sl.d, sl.v, p[f], sl.N, sl.Nd, sl.Nv)
            side_mu(count, sl.u, data.friction[1], sl.g, sl.dg)
        for k in range(count):
            N = sl.N[k]
            if N <= 0.0:
                continue
            j, w = pw.j[f, k], pw.w[f, k]
            lever(pose, data, Rw, f, k, pw, r)
            if f < 2:
                add_generator(n, r, Wn)
            else:
                add_end_generator(n, r, pose.axis[0], D[1], Wn)
            add_generator(e1, r, Wx)
            add_generator(e2, r, Wt)
            g1, g2 = sl.g[k] * sl.t[k, 0], sl.g[k] * sl.t[k, 1]
            slope = pw.slope[f, k]
            for c in range(6):
                Wn[c] += slope * (Wx[c] if lean == 0 else Wt[c])
                if f < 2 and c >= 3:
                    Wn[c] -= slope * (Rw - data.drop[k]) * sgn * pw.G[1, c - 3]
                V[c] = Wn[c] - g1 * Wx[c] - g2 * Wt[c]
                pair.wrench[c] += N * V[c]
            pw.normal[f] += N
            pw.tangential[f] += N * sl.g[k] * sl.u[k]
            for s in range(2):
                share = N * (w if s == 1 else 1.0 - w)
                pw.st[f, j + s, comp] += sgn * share
                pw.st[f, j + s, first] += (g1 - (slope if lean == 0 else 0.0)) * share
                pw.st[f, j + s, second] += (g2 - (slope if lean == 1 else 0.0)) * share
            if mode == 1:
                _add_tangent(f, j, w, k, V, Wn, Wx, Wt, sl, pw, pair)
            elif mode == 2:
                pw.slice_N[f, k] = N
                pw.slice_T[f, k] = N * sl.g[k] * sl.u[k]
                sums[2] -= N * sl.g[k] * sl.u[k] ** 2
        if mode == 2:
            if f < 2:
                law(count, sl.d, sl.zero, p[f], sl.g, sl.Nd, sl.Nv)
            else:
                side_law(count, sl.d, sl.zero, p[f], sl.g, sl.Nd, sl.Nv)
            for k in range(count):
                sums[0] += sl.g[k] * max(sl.d[k], 0.0) / (p[f, 1] + 1.0)
                sums[1] -= (sl.N[k] - sl.g[k]) * sl.v[k]
    if mode == 1 and any_contact and soft:
        _soften(data, i, n_st, pw, pair)
    return any_contact


@kernel
def _add_tangent(f, j, w, k, V, Wn, Wx, Wt, sl, pw, pair):
    """One slice's share of the pair's tangent and of the station products."""
    Nd = sl.Nd[k]
    add_outer(pair.K, Nd, V, Wn)
    add_outer(pair.C, sl.Nv[k], V, Wn)
    friction_tangent(pair.C, sl.N[k], sl.g[k], sl.dg[k], sl.u[k], sl.t[k, 0], sl.t[k, 1], Wx, Wt)
    for s in range(2):
        ws = (w if s == 1 else 1.0 - w) * Nd
        for c in range(6):
            pw.BW[f, j + s, c] += ws * Wn[c]
            pw.LV[f, j + s, c] += ws * V[c]
        pw.H[f, j + s, j] += ws * (1.0 - w)
        pw.H[f, j + s, j + 1] += ws * w


@kernel
def _stored(data, i, p, law, side_law, sl, pw):
    """Elastic energy in the residual deflection, a . g/2 with g the loads that made it."""
    energy = 0.0
    for f in range(4):
        if pw.near[f] == 0:
            continue
        count = data.s.shape[0] if f < 2 else data.points.shape[0]
        for k in range(count):
            j, w = pw.j[f, k], pw.w[f, k]
            u = 0.0
            for l in range(8):
                rl = (1.0 - w) * data.res[i, f, j, l] + w * data.res[i, f, j + 1, l]
                u += rl * pw.a[l]
            sl.d[k] = pw.d0[f, k] - u
            sl.u[k] = u
        if f < 2:
            law(count, sl.d, sl.zero, p[f], sl.N, sl.Nd, sl.Nv)
        else:
            side_law(count, sl.d, sl.zero, p[f], sl.N, sl.Nd, sl.Nv)
        for k in range(count):
            energy += 0.5 * sl.N[k] * sl.u[k]
    return energy


@kernel
def _soften(data, i, n_st, pw, pair):
    """Condense the residual coordinates out of the roller's tangent, and keep X for the modes."""
    R, C = data.res[i], data.comp[i]
    RHR = np.zeros((8, 8))
    HR, X = pw.HR, pw.X
    zero(HR)
    RB = np.zeros((8, 6))
    LR = np.zeros((6, 8))
    for f in range(4):
        if pw.near[f] == 0:
            continue
        for s in range(n_st):
            for t in range(n_st):
                if pw.H[f, s, t] != 0.0:
                    for l in range(8):
                        HR[f, s, l] += pw.H[f, s, t] * R[f, t, l]
            for l in range(8):
                for m in range(8):
                    RHR[l, m] += R[f, s, l] * HR[f, s, m]
                for c in range(6):
                    RB[l, c] += R[f, s, l] * pw.BW[f, s, c]
                    LR[c, l] += pw.LV[f, s, c] * R[f, s, l]
    for col in range(8):
        for l in range(8):
            for m in range(8):
                x = 1.0 if l == m else 0.0
                for o in range(8):
                    x += C[l, o] * RHR[o, m]
                pw.A8[l, m] = x
            pw.A8[l, 8] = C[l, col]
        solve_small(pw.A8, 8)
        for l in range(8):
            X[l, col] = pw.A8[l, 8]
    XB = X @ RB
    LX = LR @ X
    for c in range(6):
        for e in range(6):
            for l in range(8):
                pair.K[c, e] -= LR[c, l] * XB[l, e]
    for f in range(4):
        if pw.near[f] == 0:
            continue
        for s in range(n_st):
            for c in range(6):
                for l in range(8):
                    pw.BW[f, s, c] -= HR[f, s, l] * XB[l, c]
                    pw.LV[f, s, c] -= LX[c, l] * HR[f, s, l]
