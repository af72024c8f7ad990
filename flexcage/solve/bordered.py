"""Bordered block systems: many small blocks that meet only in one border.

    [ A_i          B_i ] [x_i]   [r_i]
    [  C_i   ...    S  ] [x_b] = [r_b]

The blocks are eliminated first, 6 by 6; the border's Schur complement is factored dense. Border
columns beyond ``low`` are touched only by blocks whose ``active`` flag is set.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from flexcage.core.jit import VECTORISED, kernel


class Bordered(NamedTuple):
    """Matrix blocks before, and factors after, ``factor``."""

    A: np.ndarray  # (Z, 6, 6) blocks, then their inverses
    B: np.ndarray  # (Z, 6, nb), then A^-1 B
    C: np.ndarray  # (Z, nb, 6)
    S: np.ndarray  # (nb, nb) border, then its LU factors
    pivot: np.ndarray  # (nb,)
    active: np.ndarray  # (Z,)
    low: int
    perm: np.ndarray  # (6,) row exchanges of a block
    x6: np.ndarray  # (6,)
    blocks: np.ndarray  # (2, Z, 6) vectors of whoever forms and solves the system
    border: np.ndarray  # (2, nb)


def new_bordered(blocks: int, border: int, low: int, active: np.ndarray) -> Bordered:
    z = np.zeros
    return Bordered(
        z((blocks, 6, 6)), z((blocks, 6, border)), z((blocks, border, 6)),
        z((border, border)), z(border, np.int64), active, low, z(6, np.int64), z(6),
        z((2, blocks, 6)), z((2, border)),
    )  # fmt: skip


@kernel(fastmath=VECTORISED)
def invert6(A, perm):
    """Invert a 6x6 matrix in place (Gauss-Jordan with pivoting); False if singular."""
    n = 6
    for k in range(n):
        p = k
        for r in range(k + 1, n):
            if abs(A[r, k]) > abs(A[p, k]):
                p = r
        perm[k] = p
        if A[p, k] == 0.0:
            return False
        if p != k:
            for c in range(n):
                A[k, c], A[p, c] = A[p, c], A[k, c]
        inv = 1.0 / A[k, k]
        A[k, k] = 1.0
        for c in range(n):
            A[k, c] *= inv
        for r in range(n):
            if r != k:
                f = A[r, k]
                A[r, k] = 0.0
                if f != 0.0:
                    for c in range(n):
                        A[r, c] -= f * A[k, c]
    for k in range(n - 1, -1, -1):
        p = perm[k]
        if p != k:
            for r in range(n):
                A[r, k], A[r, p] = A[r, p], A[r, k]
    return True


@kernel(fastmath=VECTORISED)
def lu_factor(A, pivot):
    """LU factors of A in place with row pivoting; False if singular."""
    n = A.shape[0]
    for k in range(n):
        p = k
        for r in range(k + 1, n):
            if abs(A[r, k]) > abs(A[p, k]):
                p = r
        pivot[k] = p
        if A[p, k] == 0.0:
            return False
        if p != k:
            for c in range(n):
                A[k, c], A[p, c] = A[p, c], A[k, c]
        inv = 1.0 / A[k, k]
        for r in range(k + 1, n):
            f = A[r, k]
            if f != 0.0:
                f *= inv
                A[r, k] = f
                for c in range(k + 1, n):
                    A[r, c] -= f * A[k, c]
    return True


@kernel(fastmath=VECTORISED)
def lu_solve(A, pivot, b):
    """Solve with factors from ``lu_factor``, in place."""
    n = A.shape[0]
    for k in range(n):
        p = pivot[k]
        if p != k:
            b[k], b[p] = b[p], b[k]
    for r in range(1, n):
        s = b[r]
        for c in range(r):
            s -= A[r, c] * b[c]
        b[r] = s
    for r in range(n - 1, -1, -1):
        s = b[r]
        for c in range(r + 1, n):
            s -= A[r, c] * b[c]
        b[r] = s / A[r, r]


@kernel(fastmath=VECTORISED)
def factor(m):
    """Factor a bordered system in place; False if a block or the border is singular."""
    nb = m.S.shape[0]
    for i in range(m.A.shape[0]):
        if not invert6(m.A[i], m.perm):
            return False
        high = nb if m.active[i] else m.low
        for c in range(high):
            x0, x1, x2 = m.B[i, 0, c], m.B[i, 1, c], m.B[i, 2, c]
            x3, x4, x5 = m.B[i, 3, c], m.B[i, 4, c], m.B[i, 5, c]
            for r in range(6):
                a = m.A[i, r]
                m.B[i, r, c] = a[0] * x0 + a[1] * x1 + a[2] * x2 + a[3] * x3 + a[4] * x4 + a[5] * x5
        for r in range(high):
            c0, c1, c2 = m.C[i, r, 0], m.C[i, r, 1], m.C[i, r, 2]
            c3, c4, c5 = m.C[i, r, 3], m.C[i, r, 4], m.C[i, r, 5]
            for c in range(high):
                m.S[r, c] -= (
                    c0 * m.B[i, 0, c] + c1 * m.B[i, 1, c] + c2 * m.B[i, 2, c]
                    + c3 * m.B[i, 3, c] + c4 * m.B[i, 4, c] + c5 * m.B[i, 5, c]
                )  # fmt: skip
    return lu_factor(m.S, m.pivot)


@kernel(fastmath=VECTORISED)
def solve(m, r, b):
    """Solve in place: r (Z, 6) the blocks' right-hand sides, b (nb,) the border's."""
    nb = m.S.shape[0]
    x = m.x6
    for i in range(m.A.shape[0]):
        for k in range(6):
            s = 0.0
            for l in range(6):
                s += m.A[i, k, l] * r[i, l]
            x[k] = s
        for k in range(6):
            r[i, k] = x[k]
        high = nb if m.active[i] else m.low
        for k in range(high):
            s = 0.0
            for l in range(6):
                s += m.C[i, k, l] * x[l]
            b[k] -= s
    lu_solve(m.S, m.pivot, b)
    for i in range(m.A.shape[0]):
        high = nb if m.active[i] else m.low
        for k in range(6):
            s = 0.0
            for c in range(high):
                s += m.B[i, k, c] * b[c]
            r[i, k] -= s
