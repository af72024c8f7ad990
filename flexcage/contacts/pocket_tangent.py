"""Tangent of a pocket: how its forces on roller and cage follow displacements and velocities.

A force on a slice acts along a generator: what a unit of it does to each coordinate of the pocket
(roller 6, modes n, residual 12). By virtual work the same generator says how coordinates move the
slice, so every product of two generators is a share of the tangent.
"""

from __future__ import annotations

from flexcage.contacts.condensation import factor
from flexcage.contacts.pocket_forces import axes_of_face, lever_of_slice, normal_generator
from flexcage.contacts.pocket_wall import SIDES, span_of, station_weight
from flexcage.contacts.state import WHOLE, add_generator
from flexcage.core.jit import VECTORISED, outlined, part, zero
from flexcage.core.vectors import RIGID


@outlined
def add_tangent(pose, data, i, f, Rw, distance, sl, pw):
    """Add the slices of face f of pocket i to ``pw.K`` and ``pw.C``.

    ``pw.h`` holds the slopes of the elastic forces. They alone move the residual coordinates, and
    are there as well where damping holds back all force.
    """
    n, e1, e2 = axes_of_face(pw, f)
    normal, first, second, whole = pw.gen[0], pw.gen[1], pw.gen[2], pw.gen[WHOLE]
    # what has a velocity: residual coordinates follow at once
    moving = RIGID + data.phi_max.shape[0]
    size = moving + (pw.size[0] if data.soft != 0 else 0)
    span = span_of(pw, f)
    for k in range(span[0], span[1]):
        N, g, t1, t2 = sl.N[k], sl.g[k], sl.t1[k], sl.t2[k]
        elastic = pw.h[k] if data.soft != 0 else 0.0
        if N <= 0.0 and elastic <= 0.0:
            continue
        r = lever_of_slice(pose, data, Rw, f, k, pw)
        normal_generator(pose, data, distance, f, k, n, r, pw, normal)
        add_generator(e1, r, first)
        add_generator(e2, r, second)
        _add_modes(data, i, f, k, pw.face[f], pw.gen)
        for l in range(size - moving):
            normal[moving + l] = pw.face[f].R[l, k]
        # K: of elastic forces on residual coordinates, and of all force on the others
        _add_product(moving, size, elastic, normal, normal, size, pw.K)
        if N <= 0.0:
            continue
        for c in range(moving):
            whole[c] = normal[c] - g * (t1 * first[c] + t2 * second[c])
        _add_product(0, moving, sl.Nd[k], whole, normal, size, pw.K)
        h = sl.dg[k] / sl.u[k] if sl.u[k] > 1e-12 else 0.0
        friction = (N * (g + h * t1 * t1), N * h * t1 * t2, N * (g + h * t2 * t2))
        _add_damping(moving, sl.Nv[k], friction, pw.gen, pw.C)


@part(fastmath=VECTORISED)
def _add_modes(data, i, f, k, face, gen):
    """What forces on slice k of face f do to the modes."""
    sgn = 1.0 if f % 2 == 0 else -1.0
    n_st, n_m, slope = data.phi.shape[2], data.phi_max.shape[0], face.slope[k]
    across, along = (2, 0) if f < SIDES else (0, 2)
    one, two = (0, 1) if f < SIDES else (1, 2)
    for g in range(3):
        for m in range(n_m):
            gen[g, RIGID + m] = 0.0
    j = face.j[k]
    for s in range(max(j - 1, 0), min(j + 3, n_st)):
        w, shape = station_weight(face, k, n_st, s), data.phi[i, f, s]
        for m in range(n_m):
            gen[0, RIGID + m] += w * (sgn * shape[across, m] - slope * shape[along, m])
            gen[1, RIGID + m] -= w * shape[one, m]
            gen[2, RIGID + m] -= w * shape[two, m]


@part(fastmath=VECTORISED)
def _add_product(first, end, scale, a, b, n, M):
    """M += scale a b^T in rows ``first`` to before ``end`` and n columns."""
    for c in range(first, end):
        x = scale * a[c]
        for e in range(n):
            M[c, e] += x * b[e]


@part(fastmath=VECTORISED)
def _add_damping(n, Nv, friction, gen, C):
    """Damping of one slice: of its normal force by approach, of its friction by sliding."""
    f11, f12, f22 = friction
    for c in range(n):
        x = Nv * gen[WHOLE, c]
        y, z = f11 * gen[1, c] + f12 * gen[2, c], f12 * gen[1, c] + f22 * gen[2, c]
        for e in range(n):
            C[c, e] += x * gen[0, e] + y * gen[1, e] + z * gen[2, e]


@outlined
def soften(moving, pw):
    """Condense the residual coordinates, which come after ``moving`` others, out of pw.K."""
    n, K, A = pw.size[0], pw.K, pw.A
    for l in range(n):
        for m in range(l + 1):
            A[l, m] = K[moving + l, moving + m]
    factor(n, A)
    for m in range(n):
        for l in range(m + 1, n):
            _take_off(moving, A[l, m], K[moving + m], K[moving + l])
    for l in range(n - 1, -1, -1):
        _scale(moving, A[l, l], K[moving + l])
        for k in range(l + 1, n):
            _take_off(moving, A[k, l], K[moving + k], K[moving + l])
    for c in range(moving):
        for l in range(n):
            _take_off(moving, K[c, moving + l], K[moving + l], K[c])


@part(fastmath=VECTORISED)
def _take_off(n, x, a, b):
    """b -= x a for n entries."""
    for e in range(n):
        b[e] -= x * a[e]


@part(fastmath=VECTORISED)
def _scale(n, x, a):
    for e in range(n):
        a[e] *= x


@part
def give_pair(pw, pair):
    """The roller's own share of the tangent into ``pair``."""
    for c in range(6):
        for e in range(6):
            pair.K[c, e] = pw.K[c, e]
            pair.C[c, e] = pw.C[c, e]


@part
def clear_tangent(pw):
    """Zero what the tangent of a pocket adds to."""
    zero(pw.K)
    zero(pw.C)
