"""Residual (quasi-static) flexibility of a pocket's walls, condensed pocket by pocket.

With R(x) the pocket's residual shapes, scaled so that their compliance is one, coordinates b solve

    b = sum_k R(x_k) F_el(d_k - R(x_k) . b),

so no unknown is added to the DAE, energy stays consistent (the wall stores b . b/2), and damping
acts on the rate of the remaining motion. A rigid cage has no such shapes.
"""

from __future__ import annotations

from flexcage.contacts.pocket_wall import N_LOCAL, mixed, points_of_face
from flexcage.contacts.slices import elastic_forces, largest
from flexcage.core.jit import VECTORISED, copy_into, part, zero

SOLVED = 3e-11  # [m] a last Newton step this small leaves an error of its square over d
SOLVED_AGAIN = 3e-12  # [m] the same with factors of an earlier step, which gain less
SLOW = 0.1  # a step this large of the one before asks for new factors


@part(fastmath=VECTORISED)
def read_residual(data, i, f, face):
    """Residual shapes under the slices of face f into face.R."""
    shapes = data.res[i, f]
    for k in range(points_of_face(data, f)):
        j = face.j[k]
        w0, w1, w2, w3 = face.w[0, k], face.w[1, k], face.w[2, k], face.w[3, k]
        for l in range(N_LOCAL):
            x = w0 * shapes[j, l] + w1 * shapes[j + 1, l]
            face.R[l, k] = x + w2 * shapes[j + 2, l] + w3 * shapes[j + 3, l]


@part(fastmath=VECTORISED)
def yielded(n, face, b, sl):
    """Penetration sl.d of a face after the residual deflection of its n slices."""
    for k in range(n):
        sl.d[k] = face.d0[k]
    for l in range(N_LOCAL):
        x = b[l]
        for k in range(n):
            sl.d[k] -= x * face.R[l, k]


@part
def condense(data, i, p, laws, guess, sl, pw):
    """Solve pocket i's residual coordinates pw.b from ``guess`` (12,), by Newton's method.

    Faces that nothing touches before the walls yield join if those that are touched push them in.
    """
    for f in range(4):
        pw.live[f] = 1 if pw.near[f] != 0 and pw.deep[f] > 0.0 else 0
        if pw.live[f] != 0:
            read_residual(data, i, f, pw.face[f])
    copy_into(pw.b, guess)
    joined = True
    while joined:
        _solve(data, i, p, laws, sl, pw)
        joined = False
        for f in range(4):
            if pw.near[f] == 0 or pw.live[f] != 0:
                continue
            bound = pw.deep[f]
            for l in range(N_LOCAL):
                bound += abs(pw.b[l]) * data.res_max[i, f, l]
            if bound > 0.0:
                n = points_of_face(data, f)
                read_residual(data, i, f, pw.face[f])
                yielded(n, pw.face[f], pw.b, sl)
                if largest(n, sl.d) > 0.0:
                    pw.live[f] = 1
                    joined = True


@part
def _solve(data, i, p, laws, sl, pw):
    """Newton's method on the faces that are live; factors are kept while it converges fast."""
    before, step = 0.0, 1.0
    for _ in range(40):
        anew = step > SLOW * before
        for l in range(N_LOCAL):
            pw.g[l] = -pw.b[l]
        if anew:
            zero(pw.A)
        for f in range(4):
            if pw.live[f] != 0:
                n = points_of_face(data, f)
                yielded(n, pw.face[f], pw.b, sl)
                elastic_forces(laws[0] if f < 2 else laws[1], n, sl, p[f])
                _load(n, pw.face[f], sl, pw.g)
                if anew:
                    _stiffen(n, pw.face[f], sl, pw.h, pw.A)
        if anew:
            factor(pw.A)
        back_substitute(pw.A, pw.g)
        before, step = step, 0.0
        for l in range(N_LOCAL):
            pw.b[l] += pw.g[l]
            scale = 0.0
            for f in range(4):
                scale = max(scale, data.res_max[i, f, l])
            step = max(step, abs(pw.g[l]) * scale)
        if step < (SOLVED if anew else SOLVED_AGAIN):
            break


@part(fastmath=VECTORISED)
def _load(n, face, sl, g):
    """Add the residual coordinates' loads to g."""
    for l in range(N_LOCAL):
        x = 0.0
        for k in range(n):
            x += face.R[l, k] * sl.Ne[k]
        g[l] += x


@part(fastmath=VECTORISED)
def _stiffen(n, face, sl, h, A):
    """Add R^T H R to the lower triangle of A."""
    for l in range(N_LOCAL):
        for k in range(n):
            h[k] = face.R[l, k] * sl.Nd[k]
        for m in range(l + 1):
            x = 0.0
            for k in range(n):
                x += h[k] * face.R[m, k]
            A[l, m] += x


@part(forceinline=False)
def factor(A):
    """L D L^T of 1 + A in place of the lower triangle of A: L, and 1/D in the diagonal."""
    for l in range(N_LOCAL):
        A[l, l] += 1.0
    for m in range(N_LOCAL):
        A[m, m] = 1.0 / A[m, m]
        for l in range(m + 1, N_LOCAL):
            x = A[l, m] * A[m, m]
            for k in range(m + 1, l + 1):
                A[l, k] -= x * A[k, m]
        for l in range(m + 1, N_LOCAL):
            A[l, m] *= A[m, m]


@part(forceinline=False)
def back_substitute(A, x):
    """x <- (1 + A)^-1 x with the factors that ``factor`` left."""
    for m in range(N_LOCAL):
        for l in range(m + 1, N_LOCAL):
            x[l] -= A[l, m] * x[m]
    for l in range(N_LOCAL - 1, -1, -1):
        y = x[l] * A[l, l]
        for k in range(l + 1, N_LOCAL):
            y -= A[k, l] * x[k]
        x[l] = y


@part
def lean_of_residual(data, i, f, pw):
    """Add to the slope of face f what the residual deflection gives it."""
    face = pw.face[f]
    for s in range(pw.lean.shape[0]):
        x = 0.0
        for l in range(N_LOCAL):
            x += data.res[i, f, s, l] * pw.b[l]
        pw.lean[s] = x
    for k in range(points_of_face(data, f)):
        face.slope[k] += mixed(face.ws, face, k, pw.lean)


@part
def soften(pw, pair):
    """Condense the residual coordinates out of the tangent, and keep X for the modes."""
    factor(pw.A)
    for l in range(N_LOCAL):
        zero(pw.g)
        pw.g[l] = 1.0
        back_substitute(pw.A, pw.g)
        for m in range(N_LOCAL):
            pw.X[m, l] = pw.g[m]
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
        if pw.live[f] == 0:
            continue
        for s in range(pw.HR.shape[1]):
            for c in range(6):
                for l in range(N_LOCAL):
                    pw.BW[f, s, c] -= pw.HR[f, s, l] * pw.XB[l, c]
                    pw.LV[f, s, c] -= pw.LX[c, l] * pw.HR[f, s, l]
