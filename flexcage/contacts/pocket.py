"""Roller in its pocket: crossbeam faces in slices, side beams over points of the roller's end.

The walls are those of ``pocket_wall``. The normal force leans with the wall's slope along the
face, so that it is the slope of an energy; a crossbeam's slope acts at the roller's axis.
"""

from __future__ import annotations

from math import sqrt

from flexcage.contacts.pocket_wall import (
    condense,
    elastic_forces,
    face_modes,
    lean_of_residual,
    penetrations,
    points_of_face,
    soften,
    station_motion,
    stored_energy,
    yielded,
)
from flexcage.contacts.state import (
    add_end_generator,
    add_generator,
    add_outer,
    approach,
    clear,
    friction_tangent,
)
from flexcage.core.jit import part, zero
from flexcage.core.vectors import combine, cross, dot, minus, plus, row, times, xyz


@part
def pocket_contact(
    pose, data, i, Rw, D, Vc, wc, q, qd, margin, p, laws, guess, sl, pw, pair, mode, sums
):
    """Wrench of pocket i on its roller, and station forces on the cage in ``pw.st``.

    D: roller centre from the cage's origin; Vc, wc: cage velocity and angular velocity, in F;
    q, qd: modal coordinates and rates; ``margin``: bound of the walls' motion; p (4, N_NORMAL).
    ``laws``: normal (crossbeam, side), friction (crossbeam, side); ``guess``: residual coordinates
    to begin with. Tangent (mode 1) in ``pair`` and ``pw.BW, pw.LV, pw.H``; report (from mode 2) in
    ``sums``: elastic energy (with the residual's), damping power, friction power.
    """
    clear(pair, mode == 1)
    zero(pw.normal)
    zero(pw.tangential)
    if mode >= 2:
        zero(sums)
        zero(pw.slice_N)
        zero(pw.slice_T)
        zero(pw.a)
    centre, cage_spin = xyz(D), xyz(wc)
    if not penetrations(pose, data, i, Rw, centre, q, margin, pw):
        return False
    soft = data.comp[i, 0, 0] > 0.0
    if soft:
        condense(data, i, p, laws, guess, sl, pw)
        if mode >= 2:
            sums[0] += stored_energy(data, p, laws, sl, pw)
    zero(pw.st)
    if mode == 1:
        zero(pw.BW)
        zero(pw.LV)
        zero(pw.H)
        zero(pw.X)
    rel = minus(minus(xyz(pose.V), xyz(Vc)), cross(cage_spin, centre))
    spin = minus(xyz(pose.w), cage_spin)
    any_contact = False
    for f in range(4):
        if pw.near[f] == 0:
            continue
        count = points_of_face(data, f)
        if soft:
            yielded(data, f, pw, sl)
        loaded = False
        for k in range(count):
            if not soft:
                sl.d[k] = pw.d0[f, k]
            loaded = loaded or sl.d[k] > 0.0
        if not loaded:
            continue
        any_contact = True
        if soft:
            lean_of_residual(data, i, f, pw)
        face_modes(data, i, f, qd, pw.wall)
        _rates(pose, data, f, Rw, centre[1], rel, spin, sl, pw, pair)
        if f < 2:
            laws[0](count, sl.d, sl.v, p[f], sl.N, sl.Nd, sl.Nv)
            laws[2](count, sl.u, data.friction[0], sl.g, sl.dg)
        else:
            laws[1](count, sl.d, sl.v, p[f], sl.N, sl.Nd, sl.Nv)
            laws[3](count, sl.u, data.friction[1], sl.g, sl.dg)
        _collect(pose, data, f, Rw, centre[1], sl, pw, pair, mode, sums)
        if mode >= 2:
            elastic_forces(data, f, p, laws, sl, sl.g)
            for k in range(count):
                sums[0] += sl.g[k] * max(sl.d[k], 0.0) / (p[f, 1] + 1.0)
                sums[1] -= (sl.N[k] - sl.g[k]) * sl.v[k]
    if mode == 1 and any_contact and soft:
        soften(data, i, pw, pair)
    return any_contact


@part
def _axes(pw, f):
    """Normal on the roller and the two tangents of face f, in F."""
    sgn = 1.0 if f % 2 == 0 else -1.0
    if f < 2:
        return times(-sgn, row(pw.G, 2)), row(pw.G, 0), row(pw.G, 1)
    return times(-sgn, row(pw.G, 0)), row(pw.G, 1), row(pw.G, 2)


@part
def _lever(pose, data, Rw, f, k, pw):
    """Lever from the roller's centre to slice or point k of face f, in F."""
    sgn, a = 1.0 if f % 2 == 0 else -1.0, row(pose.axis, 0)
    if f < 2:
        return combine(times(data.s[k], a), sgn * (Rw - data.drop[k]), row(pw.G, 2))
    r = combine(times(sgn * data.half_roller, a), data.points[k, 0], row(pose.axis, 1))
    return combine(r, data.points[k, 1], row(pose.axis, 2))


@part
def _normal_generator(pose, data, Rw, distance, f, k, n, r, pw, out):
    """Generator of the normal force of slice k of face f, leaning with the wall's slope."""
    if f >= 2:
        leaning = combine(n, pw.slope[f, k], row(pw.G, 2))
        add_end_generator(leaning, r, row(pose.axis, 0), distance, out)
        return
    add_generator(n, r, out)
    along = times(pw.slope[f, k], row(pw.G, 0))
    moment = cross(times(data.s[k], row(pose.axis, 0)), along)
    for c in range(3):
        out[c] += along[c]
        out[3 + c] += moment[c]


@part
def _rates(pose, data, f, Rw, distance, rel, spin, sl, pw, pair):
    """Approach speed and sliding of every penetrating slice of face f."""
    sgn = 1.0 if f % 2 == 0 else -1.0
    n, e1, e2 = _axes(pw, f)
    Wn = pair.W[0]
    for k in range(points_of_face(data, f)):
        sl.v[k] = sl.u[k] = 0.0
        if sl.d[k] <= 0.0:
            continue
        r = _lever(pose, data, Rw, f, k, pw)
        v = plus(rel, cross(spin, r))
        wall = station_motion(pw, f, k)
        _normal_generator(pose, data, Rw, distance, f, k, n, r, pw, Wn)
        sl.v[k] = approach(Wn, rel, spin)
        if f < 2:
            sl.v[k] += pw.slope[f, k] * wall[0] - sgn * wall[2]
            sl.t[k, 0], sl.t[k, 1] = dot(e1, v) - wall[0], dot(e2, v) - wall[1]
        else:
            sl.v[k] += pw.slope[f, k] * wall[2] - sgn * wall[0]
            sl.t[k, 0], sl.t[k, 1] = dot(e1, v) - wall[1], dot(e2, v) - wall[2]
        sl.u[k] = sqrt(sl.t[k, 0] ** 2 + sl.t[k, 1] ** 2)


@part
def _collect(pose, data, f, Rw, distance, sl, pw, pair, mode, sums):
    """Sum the forces of face f into the pair and onto the stations, with tangent or report."""
    sgn = 1.0 if f % 2 == 0 else -1.0
    comp, first, second = (2, 0, 1) if f < 2 else (0, 1, 2)
    n, e1, e2 = _axes(pw, f)
    Wn, W1, W2, V = pair.W[0], pair.W[1], pair.W[2], pair.W[3]
    for k in range(points_of_face(data, f)):
        N = sl.N[k]
        if N <= 0.0:
            continue
        j, slope = pw.j[f, k], pw.slope[f, k]
        r = _lever(pose, data, Rw, f, k, pw)
        _normal_generator(pose, data, Rw, distance, f, k, n, r, pw, Wn)
        add_generator(e1, r, W1)
        add_generator(e2, r, W2)
        g1, g2 = sl.g[k] * sl.t[k, 0], sl.g[k] * sl.t[k, 1]
        for c in range(6):
            V[c] = Wn[c] - g1 * W1[c] - g2 * W2[c]
            pair.wrench[c] += N * V[c]
        pw.normal[f] += N
        pw.tangential[f] += N * sl.g[k] * sl.u[k]
        if f < 2:
            g1 -= slope
        else:
            g2 -= slope
        for s in range(4):
            share = N * pw.w[f, k, s]
            pw.st[f, j + s, comp] += sgn * share
            pw.st[f, j + s, first] += g1 * share
            pw.st[f, j + s, second] += g2 * share
        if mode == 1:
            _add_tangent(f, j, k, V, Wn, W1, W2, sl, pw, pair)
        elif mode >= 2:
            pw.slice_N[f, k] = N
            pw.slice_T[f, k] = N * sl.g[k] * sl.u[k]
            sums[2] -= N * sl.g[k] * sl.u[k] ** 2


@part
def _add_tangent(f, j, k, V, Wn, W1, W2, sl, pw, pair):
    """One slice's share of the pair's tangent and of the station products."""
    Nd = sl.Nd[k]
    add_outer(pair.K, Nd, V, Wn)
    add_outer(pair.C, sl.Nv[k], V, Wn)
    friction_tangent(pair.C, sl.N[k], sl.g[k], sl.dg[k], sl.u[k], sl.t[k, 0], sl.t[k, 1], W1, W2)
    for s in range(4):
        ws = pw.w[f, k, s] * Nd
        for c in range(6):
            pw.BW[f, j + s, c] += ws * Wn[c]
            pw.LV[f, j + s, c] += ws * V[c]
        for t in range(4):
            pw.H[f, j + s, j + t] += ws * pw.w[f, k, t]
