"""Vectors of three for kernels, as tuples: they live in registers and are never allocated."""

from __future__ import annotations

from flexcage.core.jit import VECTORISED, part

# places in a 6-vector behind force, translation or velocity of the centre: rotation or angular
# velocity, or moment
TURN = MOMENT = 3
RIGID = 6  # motions of a rigid body; modes follow


@part(fastmath=VECTORISED)
def xyz(a):
    """The first three entries of an array."""
    return a[0], a[1], a[2]


@part(fastmath=VECTORISED)
def turn_of(a):
    """The entries of a 6-vector behind its first three: a moment, or an angular velocity."""
    return a[TURN], a[TURN + 1], a[TURN + 2]


@part(fastmath=VECTORISED)
def row(M, i):
    """Row i of a matrix of three columns."""
    return M[i, 0], M[i, 1], M[i, 2]


@part(fastmath=VECTORISED)
def column(M, j):
    """Column j of a matrix of three rows."""
    return M[0, j], M[1, j], M[2, j]


@part(fastmath=VECTORISED)
def dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@part(fastmath=VECTORISED)
def cross(a, b):
    return (
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    )


@part(fastmath=VECTORISED)
def plus(a, b):
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


@part(fastmath=VECTORISED)
def minus(a, b):
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


@part(fastmath=VECTORISED)
def times(s, a):
    return s * a[0], s * a[1], s * a[2]


@part(fastmath=VECTORISED)
def combine(a, s, b):
    """a + s b."""
    return a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]


@part(fastmath=VECTORISED)
def turned(R, a):
    """R a."""
    return dot(row(R, 0), a), dot(row(R, 1), a), dot(row(R, 2), a)


@part(fastmath=VECTORISED)
def turned_back(R, a):
    """R^T a."""
    return (
        R[0, 0] * a[0] + R[1, 0] * a[1] + R[2, 0] * a[2],
        R[0, 1] * a[0] + R[1, 1] * a[1] + R[2, 1] * a[2],
        R[0, 2] * a[0] + R[1, 2] * a[1] + R[2, 2] * a[2],
    )


@part(fastmath=VECTORISED)
def add_to(out, a):
    """out += a, into an array."""
    out[0] += a[0]
    out[1] += a[1]
    out[2] += a[2]


@part(fastmath=VECTORISED)
def put(out, a):
    """out = a, into an array."""
    out[0] = a[0]
    out[1] = a[1]
    out[2] = a[2]
