"""The bordered block solver against a dense solve."""

from __future__ import annotations

import numpy as np
import pytest

from flexcage.solve.bordered import factor, invert6, lu_factor, lu_solve, new_bordered, solve


def random_system(blocks, border, low, active, seed=0):
    """A solver's matrix and the same as one dense array; inactive blocks reach only ``low``."""
    rng = np.random.default_rng(seed)
    m = new_bordered(blocks, border, low, np.array(active, np.int64))
    n = 6 * blocks + border
    dense = np.zeros((n, n))
    for i in range(blocks):
        high = border if active[i] else low
        rows = slice(6 * i, 6 * i + 6)
        m.A[i] = rng.normal(size=(6, 6)) * 10.0 ** rng.integers(-3, 4)
        m.B[i] = rng.normal(size=(6, border))  # what lies beyond ``low`` must not be read
        m.C[i] = rng.normal(size=(border, 6))
        dense[rows, rows] = m.A[i]
        dense[rows, 6 * blocks : 6 * blocks + high] = m.B[i, :, :high]
        dense[6 * blocks : 6 * blocks + high, rows] = m.C[i, :high]
    m.S[:] = rng.normal(size=(border, border)) + 5.0 * np.eye(border)
    m.S[-1, -1] = 0.0  # a multiplier's diagonal: pivoting needed
    dense[6 * blocks :, 6 * blocks :] = m.S
    return m, dense, rng


@pytest.mark.parametrize(
    ("blocks", "border", "low", "active"),
    [(1, 1, 1, [1]), (5, 9, 4, [0, 0, 0, 0, 0]), (5, 9, 4, [1, 0, 1, 0, 1]), (22, 51, 8, [1] * 22)],
)
def test_against_a_dense_solve(blocks, border, low, active):
    m, dense, rng = random_system(blocks, border, low, active)
    if border == 1:
        m.S[0, 0] = dense[-1, -1] = 2.0
    right = rng.normal(size=(3, 6 * blocks + border))
    assert factor(m)
    for b in right:  # one factorisation, several right-hand sides
        x, xb = b[: 6 * blocks].reshape(blocks, 6).copy(), b[6 * blocks :].copy()
        solve(m, x, xb)
        got = np.concatenate([x.ravel(), xb])
        np.testing.assert_allclose(dense @ got, b, atol=1e-9 * np.abs(dense @ np.abs(got)).max())
        np.testing.assert_allclose(got, np.linalg.solve(dense, b), rtol=1e-6, atol=1e-8)


def test_singular_matrices_are_told():
    m, _, _ = random_system(3, 4, 4, [1, 1, 1])
    m.A[1] = 0.0
    assert not factor(m)
    m, _, _ = random_system(3, 4, 4, [0, 0, 0])
    m.B[:], m.S[2] = 0.0, 0.0
    assert not factor(m)


def test_inverse_and_factors_pivot():
    rng = np.random.default_rng(4)
    A = rng.normal(size=(6, 6))
    A[0, 0] = 0.0
    inverse = A.copy()
    assert invert6(inverse, np.zeros(6, np.int64))
    np.testing.assert_allclose(inverse @ A, np.eye(6), atol=1e-12)
    B = rng.normal(size=(17, 17))
    B[0, 0] = 0.0
    lu, pivot, b = B.copy(), np.zeros(17, np.int64), rng.normal(size=17)
    x = b.copy()
    assert lu_factor(lu, pivot)
    lu_solve(lu, pivot, x)
    np.testing.assert_allclose(B @ x, b, atol=1e-12)
