"""The deformed walls of a pocket: where they are, how they yield, what they feel.

Dynamic modes are read at a few stations per face and interpolated smoothly (a wall with kinks has
no equilibrium on them), and forces go back to the same stations with the same weights; a defect's
offset is known on a finer grid. The residual (quasi-static) flexibility is condensed pocket by
pocket: with psi(x) the pocket's residual shapes and C their compliance, coordinates a solve

    a = C sum_k psi(x_k) F_el(d_k - psi(x_k) . a),

so no unknown is added to the DAE, energy stays consistent (the wall stores a^T C^-1 a/2), and
damping acts on the rate of the remaining motion. A rigid cage has C = 0 and no modes.
"""

from __future__ import annotations

from math import floor
from typing import NamedTuple

import numpy as np

from flexcage.core.jit import VECTORISED, part, zero
from flexcage.core.splines import smooth_weights
from flexcage.core.vectors import dot, row

N_LOCAL = 8  # residual coordinates of a pocket: uniform and linear on four faces
SOLVED = 3e-11  # [m] a last Newton step this small leaves an error of its square over d


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
    """Buffers of one pocket; n slices or points, nst stations."""

    G: np.ndarray  # (3, 3) rows: pocket axes x, r, psi in F
    d0: np.ndarray  # (4, n) penetration before the residual deflection
    j: np.ndarray  # (4, n) first of the four stations that a slice reads
    w: np.ndarray  # (4, n, 4) their weights
    ws: np.ndarray  # (4, n, 4) slopes of the weights along the face [1/m]
    R: np.ndarray  # (4, n, 8) residual shapes under a slice
    slope: np.ndarray  # (4, n) of the wall's offset along the face
    near: np.ndarray  # (4,) face may touch
    wall: np.ndarray  # (4, nst, 3) modal displacement, then velocity, of stations
    st: np.ndarray  # (4, nst, 3) forces on the cage, pocket axes
    a: np.ndarray  # (8,) residual coordinates
    BW: np.ndarray  # (4, nst, 6) station-generator products
    LV: np.ndarray  # (4, nst, 6)
    H: np.ndarray  # (4, nst, nst) station stiffness, before the residual is condensed
    HR: np.ndarray  # (4, nst, 8) H times the residual shapes
    X: np.ndarray  # (8, 8) (1 + C R^T H R)^-1 C; zero for a rigid pocket
    A8: np.ndarray  # (8, 9) small solves
    g: np.ndarray  # (8,) loads on the residual coordinates
    RHR: np.ndarray  # (8, 8) their stiffness
    RB: np.ndarray  # (8, 6)
    LR: np.ndarray  # (6, 8)
    XB: np.ndarray  # (8, 6)
    LX: np.ndarray  # (6, 8)
    normal: np.ndarray  # (4,) sums of the faces
    tangential: np.ndarray  # (4,)
    slice_N: np.ndarray  # (4, n)
    slice_T: np.ndarray  # (4, n)


def pocket_work(n_slices: int, n_points: int, n_stations: int) -> PocketWork:
    n, st, z = max(n_slices, n_points), n_stations, np.zeros
    return PocketWork(
        z((3, 3)), z((4, n)), z((4, n), np.int64), z((4, n, 4)), z((4, n, 4)), z((4, n, 8)),
        z((4, n)), z(4, np.int64),
        z((4, st, 3)), z((4, st, 3)), z(8), z((4, st, 6)), z((4, st, 6)), z((4, st, st)),
        z((4, st, 8)), z((8, 8)), z((8, 9)), z(8), z((8, 8)), z((8, 6)), z((6, 8)), z((8, 6)),
        z((6, 8)), z(4), z(4), z((4, n)), z((4, n)),
    )  # fmt: skip


def with_offset(data: PocketData, offset: np.ndarray) -> PocketData:
    """The pockets with other stress-free offsets (Z, 4, no) [m]."""
    return data._replace(offset=np.ascontiguousarray(offset), low=offset.min(axis=2))


@part(forceinline=False)
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


@part
def points_of_face(data, f):
    """How many slices (crossbeams) or points (side beams) may touch face f."""
    return data.s.shape[0] if f < 2 else data.points.shape[0]


@part(fastmath=VECTORISED)
def face_modes(data, i, f, q, wall):
    """Modal displacement (or velocity) of the stations of face f of pocket i."""
    n_m = q.shape[0]
    for s in range(data.phi.shape[2]):
        for c in range(3):
            shape = data.phi[i, f, s, c]
            x = 0.0
            for m in range(n_m):
                x += shape[m] * q[m]
            wall[f, s, c] = x


@part
def _cell(x, first, spacing, n):
    """Index j and share t of x between points j and j+1 of a grid of n; not held at its ends."""
    place = (x - first) / spacing
    j = min(max(int(floor(place)), 0), n - 2)
    return j, place - j


@part
def _read(x, first, spacing, n, w, ws):
    """First of four stations around x, their weights into w and the weights' slopes into ws.

    Beyond its outer stations a wall goes on straight, for half a spacing at the most.
    """
    j, t = _cell(x, first, spacing, n)
    if 0.0 <= t <= 1.0 and 1 <= j <= n - 3:
        value, slope = smooth_weights(t)
        for k in range(4):
            w[k], ws[k] = value[k], slope[k] / spacing
        return j - 1
    held = min(max(t, -0.5), 1.5)
    inside = 1.0 / spacing if held == t else 0.0
    at = min(max(t, 0.0), 1.0)
    value, slope = smooth_weights(at)
    start = min(max(j - 1, 0), n - 4)
    for k in range(4):
        w[k] = ws[k] = 0.0
    for k in range(4):
        v, d = value[k] + (held - at) * slope[k], slope[k] * inside
        station = j - 1 + k
        if station < 0:  # straight on: 2 p0 - p1
            w[0] += 2.0 * v
            w[1] -= v
            ws[0] += 2.0 * d
            ws[1] -= d
        elif station >= n:
            w[3] += 2.0 * v
            w[2] -= v
            ws[3] += 2.0 * d
            ws[2] -= d
        else:
            w[station - start] += v
            ws[station - start] += d
    return start


@part
def _mix(pw, f, k, comp, slopes):
    """What slice k of face f reads of the stations' displacement component (or its slope)."""
    j, total = pw.j[f, k], 0.0
    for s in range(4):
        total += (pw.ws[f, k, s] if slopes else pw.w[f, k, s]) * pw.wall[f, j + s, comp]
    return total


@part
def penetrations(pose, data, i, Rw, D, q, margin, pw):
    """Penetration d0 of every slice of every face that is near; returns whether any touches."""
    X, T = dot(row(pw.G, 0), D), dot(row(pw.G, 2), D)
    a0, a1, a2 = row(pose.axis, 0), row(pose.axis, 1), row(pose.axis, 2)
    ax = (dot(row(pw.G, 0), a0), dot(row(pw.G, 0), a1), dot(row(pw.G, 0), a2))
    at = (dot(row(pw.G, 2), a0), dot(row(pw.G, 2), a1), dot(row(pw.G, 2), a2))
    reach = abs(data.s[data.s.shape[0] - 1])
    n_st, n_o = data.phi.shape[2], data.offset.shape[2]
    touch = False
    for f in range(4):
        sgn = 1.0 if f % 2 == 0 else -1.0
        if f < 2:
            gap = data.half[0] + data.low[i, f] - sgn * T - abs(at[0]) * reach - Rw
        else:
            tilt = (abs(ax[1]) + abs(ax[2])) * Rw
            gap = data.half[1] + data.low[i, f] - sgn * X - tilt - data.half_roller
        pw.near[f] = 1 if gap < margin else 0
        if pw.near[f] == 0:
            continue
        comp, along_comp = (2, 0) if f < 2 else (0, 2)
        face_modes(data, i, f, q, pw.wall)
        most = 0.0  # that this face has moved; smooth curves overshoot their stations a little
        for st in range(n_st):
            most = max(most, abs(pw.wall[f, st, comp]))
        if gap > 1.5 * most:
            pw.near[f] = 0
            continue
        for k in range(points_of_face(data, f)):
            if f < 2:
                along = X + data.s[k] * ax[0]
                depth = sgn * (T + data.s[k] * at[0]) + Rw - data.drop[k] - data.half[0]
            else:
                h = sgn * data.half_roller
                y, z = data.points[k, 0], data.points[k, 1]
                along = T + h * at[0] + y * at[1] + z * at[2]
                depth = sgn * (X + h * ax[0] + y * ax[1] + z * ax[2]) - data.half[1]
            # what lies under this point has moved there along the face
            j, t = _cell(along, data.x0[f], data.dx[f], n_st)
            here, there = pw.wall[f, j, along_comp], pw.wall[f, j + 1, along_comp]
            along -= here + min(max(t, 0.0), 1.0) * (there - here)
            pw.j[f, k] = _read(along, data.x0[f], data.dx[f], n_st, pw.w[f, k], pw.ws[f, k])
            o, g = _cell(along, data.grid[0, f], data.grid[1, f], n_o)
            step = data.offset[i, f, o + 1] - data.offset[i, f, o]
            pw.slope[f, k] = sgn * _mix(pw, f, k, comp, True)
            if 0.0 <= g <= 1.0:
                pw.slope[f, k] += step / data.grid[1, f]
            g = min(max(g, 0.0), 1.0)
            wall = data.offset[i, f, o] + g * step + sgn * _mix(pw, f, k, comp, False)
            pw.d0[f, k] = depth - wall
            if pw.d0[f, k] > 0.0:
                touch = True
    return touch


@part
def read_residual(data, i, f, pw):
    """Residual shapes under the slices of face f into pw.R."""
    for k in range(points_of_face(data, f)):
        j, total = pw.j[f, k], pw.R[f, k]
        for l in range(N_LOCAL):
            total[l] = 0.0
        for s in range(4):
            w, shape = pw.w[f, k, s], data.res[i, f, j + s]
            for l in range(N_LOCAL):
                total[l] += w * shape[l]


@part
def yielded(data, f, pw, sl):
    """Penetration sl.d of face f after the residual deflection sl.u of its slices."""
    for k in range(points_of_face(data, f)):
        u = 0.0
        for l in range(N_LOCAL):
            u += pw.R[f, k, l] * pw.a[l]
        sl.u[k] = u
        sl.d[k] = pw.d0[f, k] - u


@part
def elastic_forces(data, f, p, laws, sl, N):
    """Forces N without rates (and their slopes sl.Nd) at the penetrations sl.d of face f."""
    if f < 2:
        laws[0](points_of_face(data, f), sl.d, sl.zero, p[f], N, sl.Nd, sl.Nv)
    else:
        laws[1](points_of_face(data, f), sl.d, sl.zero, p[f], N, sl.Nd, sl.Nv)


@part
def _press(data, f, p, laws, sl, pw):
    """Elastic forces sl.N of face f at the residual coordinates pw.a."""
    yielded(data, f, pw, sl)
    elastic_forces(data, f, p, laws, sl, sl.N)


@part
def condense(data, i, p, laws, guess, sl, pw):
    """Solve pocket i's residual coordinates pw.a by Newton's method from ``guess`` (8,)."""
    C, R = data.comp[i], data.res[i]
    middle, last = data.phi.shape[2] // 2, data.phi.shape[2] - 1
    for l in range(N_LOCAL):
        pw.a[l] = guess[l]
    for f in range(4):
        if pw.near[f] != 0:
            read_residual(data, i, f, pw)
    for _ in range(25):
        zero(pw.g)
        zero(pw.RHR)
        for f in range(4):
            if pw.near[f] == 0:
                continue
            _press(data, f, p, laws, sl, pw)
            for k in range(points_of_face(data, f)):
                if sl.N[k] > 0.0:
                    shape = pw.R[f, k]
                    for l in range(N_LOCAL):
                        pw.g[l] += shape[l] * sl.N[k]
                        h, row_l = shape[l] * sl.Nd[k], pw.RHR[l]
                        for m in range(N_LOCAL):
                            row_l[m] += h * shape[m]
        _compliant_matrix(C, pw)
        for l in range(N_LOCAL):
            r = -pw.a[l]
            for m in range(N_LOCAL):
                r += C[l, m] * pw.g[m]
            pw.A8[l, N_LOCAL] = r
        solve_small(pw.A8, N_LOCAL)
        worst = 0.0
        for l in range(N_LOCAL):
            pw.a[l] += pw.A8[l, N_LOCAL]
            scale = 0.0
            for f in range(4):
                scale = max(scale, abs(R[f, 0, l]), abs(R[f, middle, l]), abs(R[f, last, l]))
            worst = max(worst, abs(pw.A8[l, N_LOCAL]) * scale)
        if worst < SOLVED:
            break


@part
def _compliant_matrix(C, pw):
    """1 + C R^T H R into the square part of pw.A8."""
    for l in range(N_LOCAL):
        for m in range(N_LOCAL):
            pw.A8[l, m] = 1.0 if l == m else 0.0
        for o in range(N_LOCAL):
            c = C[l, o]
            if c != 0.0:
                for m in range(N_LOCAL):
                    pw.A8[l, m] += c * pw.RHR[o, m]


@part
def stored_energy(data, p, laws, sl, pw):
    """Elastic energy in the residual deflection, a . g/2 with g the loads that made it."""
    energy = 0.0
    for f in range(4):
        if pw.near[f] == 0:
            continue
        _press(data, f, p, laws, sl, pw)
        for k in range(points_of_face(data, f)):
            energy += 0.5 * sl.N[k] * sl.u[k]
    return energy


@part
def lean_of_residual(data, i, f, pw):
    """Add to pw.slope what the residual deflection gives it."""
    for k in range(points_of_face(data, f)):
        j = pw.j[f, k]
        for s in range(4):
            d = pw.ws[f, k, s]
            for l in range(N_LOCAL):
                pw.slope[f, k] += d * data.res[i, f, j + s, l] * pw.a[l]


@part
def soften(data, i, pw, pair):
    """Condense the residual coordinates out of the roller's tangent, and keep X for the modes."""
    R, C, n_st = data.res[i], data.comp[i], data.phi.shape[2]
    zero(pw.HR)
    zero(pw.RHR)
    zero(pw.RB)
    zero(pw.LR)
    for f in range(4):
        if pw.near[f] == 0:
            continue
        for s in range(n_st):
            for t in range(n_st):
                if pw.H[f, s, t] != 0.0:
                    for l in range(N_LOCAL):
                        pw.HR[f, s, l] += pw.H[f, s, t] * R[f, t, l]
            for l in range(N_LOCAL):
                for m in range(N_LOCAL):
                    pw.RHR[l, m] += R[f, s, l] * pw.HR[f, s, m]
                for c in range(6):
                    pw.RB[l, c] += R[f, s, l] * pw.BW[f, s, c]
                    pw.LR[c, l] += pw.LV[f, s, c] * R[f, s, l]
    for col in range(N_LOCAL):
        _compliant_matrix(C, pw)
        for l in range(N_LOCAL):
            pw.A8[l, N_LOCAL] = C[l, col]
        solve_small(pw.A8, N_LOCAL)
        for l in range(N_LOCAL):
            pw.X[l, col] = pw.A8[l, N_LOCAL]
    zero(pw.XB)
    zero(pw.LX)
    for l in range(N_LOCAL):
        for m in range(N_LOCAL):
            for c in range(6):
                pw.XB[l, c] += pw.X[l, m] * pw.RB[m, c]
                pw.LX[c, l] += pw.LR[c, m] * pw.X[m, l]
    for c in range(6):
        for e in range(6):
            for l in range(N_LOCAL):
                pair.K[c, e] -= pw.LR[c, l] * pw.XB[l, e]
    for f in range(4):
        if pw.near[f] == 0:
            continue
        for s in range(n_st):
            for c in range(6):
                for l in range(N_LOCAL):
                    pw.BW[f, s, c] -= pw.HR[f, s, l] * pw.XB[l, c]
                    pw.LV[f, s, c] -= pw.LX[c, l] * pw.HR[f, s, l]


@part
def station_motion(pw, f, k):
    """Wall's motion (x, r, psi) under slice k of face f, interpolated from pw.wall."""
    return _mix(pw, f, k, 0, False), _mix(pw, f, k, 1, False), _mix(pw, f, k, 2, False)
