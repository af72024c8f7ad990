"""Residual (quasi-static) flexibility of a pocket's walls, condensed pocket by pocket.

With R(x) the pocket's residual shapes, scaled so that their compliance is one, coordinates b solve

    b = sum_k R(x_k) F_el(d_k - R(x_k) . b),

so no unknown is added to the DAE, energy stays consistent (the wall stores b . b/2), and damping
acts on the rate of the remaining motion. A rigid cage has no such shapes.

A face's stations move with as many combinations of them as it has stations, at the most; a face
that is touched alone, as nearly all are, is solved in the softest of these
(``model.own_coordinates``).
"""

from __future__ import annotations

from flexcage.contacts.pocket_wall import (
    FACES,
    N_FACE,
    N_LOCAL,
    SIDES,
    add_share,
    most_of_curve,
    read_values,
    span_of,
)
from flexcage.contacts.slices import elastic_forces, largest
from flexcage.core.jit import VECTORISED, copy_into, outlined, part, zero

SOLVED = 3e-11  # [m] a last Newton step this small leaves an error of its square over d
SOLVED_AGAIN = 3e-12  # [m] the same with factors of an earlier step, which gain less
SLOW = 0.1  # a step this large of the one before asks for new factors


@part(fastmath=VECTORISED)
def _read(m, span, shapes, face):
    """m residual shapes (nst + 2, m) under the slices of a face into face.R."""
    for j in range(face.j_least, face.j_most + 1):
        for l in range(m):
            add_share(
                span, j, face.w, face, shapes[j, l], shapes[j + 1, l], shapes[j + 2, l],
                shapes[j + 3, l], face.R[l],
            )  # fmt: skip


@part(fastmath=VECTORISED)
def _yielded(m, span, face, c, sl):
    for k in range(span[0], span[1]):
        sl.d[k] = face.d0[k]
    for l in range(m):
        x = c[l]
        for k in range(span[0], span[1]):
            sl.d[k] -= x * face.R[l, k]


@part
def yielded(span, face, pw, sl):
    """Penetration sl.d of a face after the residual deflection of its slices."""
    if pw.size[0] == N_FACE:
        _yielded(N_FACE, span, face, pw.c, sl)
    else:
        _yielded(N_LOCAL, span, face, pw.c, sl)


@outlined
def condense(data, i, laws, guess, sl, pw):
    """Solve pocket i's residual coordinates pw.b from ``guess`` (12,), by Newton's method.

    Faces that nothing touches before the walls yield join if those that are touched push them in.
    """
    touched, last = 0, 0
    for f in range(FACES):
        pw.live[f] = 1 if pw.near[f] != 0 and pw.deep[f] > 0.0 else 0
        if pw.live[f] != 0:
            touched, last = touched + 1, f
    if touched == 0:
        zero(pw.b)
        return
    copy_into(pw.b, guess)
    if touched == 1:
        _solve_alone(data, i, last, laws, sl, pw)
        if not _join(data, i, sl, pw):
            _residual_deflection(data, i, last, pw)
            return
    pw.size[0] = N_LOCAL
    copy_into(pw.c, pw.b)
    for f in range(FACES):
        if pw.live[f] != 0:
            _read(N_LOCAL, span_of(pw, f), data.res[i, f], pw.face[f])
    joined = True
    while joined:
        _solve(N_LOCAL, data.most[i], data, laws, sl, pw)
        copy_into(pw.b, pw.c)
        joined = _join(data, i, sl, pw)
    for f in range(FACES):
        if pw.live[f] != 0:
            _residual_deflection(data, i, f, pw)


@part
def touches_more(pw):
    """Whether the residual deflection may push to the roller what was not near before."""
    for f in range(FACES):
        if pw.rest[f] + pw.push[f] > 0.0:
            return True
    return False


@part
def _join(data, i, sl, pw):
    """Whether faces join that the residual deflection pushes to the roller."""
    joined = False
    for f in range(FACES):
        if pw.live[f] != 0:
            continue
        push = 0.0
        for l in range(N_LOCAL):
            push += abs(pw.b[l]) * data.res_max[i, f, l]
        pw.push[f] = max(push, pw.push[f])
        if pw.near[f] != 0 and pw.deep[f] + push > 0.0:
            span = span_of(pw, f)
            _read(N_LOCAL, span, data.res[i, f], pw.face[f])
            _yielded(N_LOCAL, span, pw.face[f], pw.b, sl)
            if largest(span, sl.d) > 0.0:
                pw.live[f] = 1
                joined = True
    return joined


@part
def _solve_alone(data, i, f, laws, sl, pw):
    """The coordinates pw.c of face f alone, which no other face pushes; from and to pw.b."""
    pw.size[0] = N_FACE
    _read(N_FACE, span_of(pw, f), data.own[i, f], pw.face[f])
    turn = data.turn[i, f]
    _take(turn, pw.b, pw.c)
    _solve(N_FACE, data.own_max[i, f], data, laws, sl, pw)
    _give(turn, pw.c, pw.b)


@part(fastmath=VECTORISED)
def _take(turn, b, c):
    """A face's own coordinates c from the pocket's."""
    for l in range(N_FACE):
        x = 0.0
        for k in range(N_LOCAL):
            x += turn[l, k] * b[k]
        c[l] = x


@part(fastmath=VECTORISED)
def _give(turn, c, b):
    """The pocket's coordinates b from a face's own."""
    zero(b)
    for l in range(N_FACE):
        x = c[l]
        for k in range(N_LOCAL):
            b[k] += turn[l, k] * x


@part
def _solve(m, most, data, laws, sl, pw):
    """The m coordinates pw.c of the live faces; ``most`` (m,): what one of each moves the walls."""
    before, step = 0.0, 1.0
    for _ in range(40):
        anew = step > SLOW * before
        _balance(m, data, laws, anew, sl, pw)
        before, step = step, 0.0
        for l in range(m):
            pw.c[l] += pw.g[l]
            step = max(step, abs(pw.g[l]) * most[l])
        if step < (SOLVED if anew else SOLVED_AGAIN):
            break


@part
def _balance(m, data, laws, anew, sl, pw):
    """Newton's step of m coordinates into pw.g, with new factors or those of an earlier step."""
    # (1 + R^T H R) dc = R^T F_el(d0 - R c) - c, H = dF_el/dd
    for l in range(m):
        pw.g[l] = -pw.c[l]
    if anew:
        for l in range(m):
            for k in range(l + 1):
                pw.A[l, k] = 0.0
    for f in range(FACES):
        if pw.live[f] != 0:
            span = span_of(pw, f)
            _yielded(m, span, pw.face[f], pw.c, sl)
            on_beam = f < SIDES
            law = laws.crossbeam if on_beam else laws.side
            p = data.normal[0 if on_beam else 1]
            elastic_forces(law, span, sl, p)
            _load(m, span, pw.face[f], sl, pw.g)
            if anew:
                _stiffen(m, span, pw.face[f], sl, pw.h, pw.A)
    if anew:
        factor(m, pw.A)
    back_substitute(m, pw.A, pw.g)


@part(fastmath=VECTORISED)
def _load(m, span, face, sl, g):
    """Add the residual coordinates' loads to g."""
    for l in range(m):
        x = 0.0
        for k in range(span[0], span[1]):
            x += face.R[l, k] * sl.Ne[k]
        g[l] += x


@part(fastmath=VECTORISED)
def _stiffen(m, span, face, sl, h, A):
    """Add R^T H R to the lower triangle of A (m, m)."""
    for l in range(m):
        for k in range(span[0], span[1]):
            h[k] = face.R[l, k] * sl.Nd[k]
        for o in range(l + 1):
            x = 0.0
            for k in range(span[0], span[1]):
                x += h[k] * face.R[o, k]
            A[l, o] += x


@outlined
def factor(n, A):
    """L D L^T of 1 + A (n, n) in place of the lower triangle of A: L, and 1/D in the diagonal."""
    for l in range(n):
        A[l, l] += 1.0
    for m in range(n):
        A[m, m] = 1.0 / A[m, m]
        for l in range(m + 1, n):
            x = A[l, m] * A[m, m]
            for k in range(m + 1, l + 1):
                A[l, k] -= x * A[k, m]
        for l in range(m + 1, n):
            A[l, m] *= A[m, m]


@outlined
def back_substitute(n, A, x):
    """x <- (1 + A)^-1 x (n,) with the factors that ``factor`` left."""
    for m in range(n):
        for l in range(m + 1, n):
            x[l] -= A[l, m] * x[m]
    for l in range(n - 1, -1, -1):
        y = x[l] * A[l, l]
        for k in range(l + 1, n):
            y -= A[k, l] * x[k]
        x[l] = y


@part
def _residual_deflection(data, i, f, pw):
    """Residual deflection of face f's stations, and the most by which it comes to the roller."""
    deflection = pw.deflection[f]
    for s in range(deflection.shape[0]):
        x = 0.0
        if pw.size[0] == N_FACE:
            for l in range(N_FACE):
                x += data.own[i, f, s, l] * pw.c[l]
        else:
            for l in range(N_LOCAL):
                x += data.res[i, f, s, l] * pw.c[l]
        deflection[s] = x
    pw.push[f] = max(pw.push[f], most_of_curve(deflection.shape[0] - 2, -1.0, deflection))


@part
def add_residual_slope(f, pw):
    """Add to the slope of face f what the residual deflection gives it."""
    face, span = pw.face[f], span_of(pw, f)
    read_values(span, face.ws, face, pw.deflection[f], face.read)
    for k in range(span[0], span[1]):
        face.slope[k] += face.read[k]
