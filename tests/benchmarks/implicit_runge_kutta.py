"""A second method for F(t, y, y') = 0, to confirm the reference: nothing of the BDF is in it.

Alexander 1977: singly diagonally implicit Runge-Kutta, three stages, order 3, L-stable, stiffly
accurate (so constraints hold at every step). Stage i solves F(t_i, Y_i, K_i) = 0 with
Y_i = y_n + h sum_j a_ij K_j, thus K_i = (Y_i - psi_i)/(h g): the Newton matrix of a BDF step.
"""

from __future__ import annotations

import numba
import numpy as np
from numba import types

from flexcage.core.jit import kernel
from flexcage.solve.bdf import BDF
from flexcage.system.data import POWERS
from flexcage.system.problem import BearingSystem

_G = 0.43586652150845899942  # root of g^3 - 3 g^2 + 3 g/2 - 1/6
_B = -(6.0 * _G**2 - 16.0 * _G + 1.0) / 4.0
_TABLE = np.array([[_G, 0, 0], [0.5 * (1.0 - _G), _G, 0], [_B, 1.0 - _G - _B, _G]])
_NODES = _TABLE.sum(axis=1)
_ITERATIONS = 12
_FRESH = 20  # steps between Jacobians
_MATRIX = types.Array(types.float64, 2, "C")
_VECTOR = types.Array(types.float64, 1, "C")
_REAL, _COUNT = types.float64, types.int64


@kernel
def march(fns, data, t0, y, yd, weight, table, nodes, step, every, tolerance, power, ys, yds):
    """Steps from (y, yd), which they change; every ``every``-th goes into ys, yds.

    Returns the number of samples filled: fewer than asked for if Newton's method failed.
    """
    residual, linearise, factor, backsolve, settle = fns[0], fns[1], fns[2], fns[3], fns[5]
    n = y.shape[0]
    g = step * table[0, 0]
    alpha = 1.0 / g
    r, psi, Y, stages = np.empty(n), np.empty(n), np.empty(n), np.empty((3, n))
    age = _FRESH
    for count in range(ys.shape[0] * every):
        t = t0 + count * step
        for i in range(3):
            for k in range(n):
                psi[k] = y[k]
                for j in range(i):
                    psi[k] += step * table[i, j] * stages[j, k]
                Y[k] = psi[k] + g * yd[k]
            now = t + nodes[i] * step
            converged = False
            for it in range(_ITERATIONS):
                if age >= _FRESH or it == 6:
                    linearise(now, Y, yd, data)
                    if not factor(alpha, data):
                        return count // every
                    age = 0
                residual(now, Y, yd, data, r, power)
                backsolve(alpha, Y, r, data)
                size = 0.0
                for k in range(n):
                    Y[k] += r[k]
                    yd[k] = (Y[k] - psi[k]) * alpha
                    size = max(size, abs(r[k]) * weight[k])
                if size < tolerance:
                    converged = True
                    break
            if not converged:
                return count // every
            stages[i] = yd
        y[:] = Y
        age += 1
        settle(t + step, y, data)
        if (count + 1) % every == 0:
            ys[count // every] = y
            yds[count // every] = yd
    return ys.shape[0]


def integrate(
    bearing: BearingSystem,
    t0: float,
    y: np.ndarray,
    yd: np.ndarray,
    *,
    weight: np.ndarray,
    step: float,
    every: int,
    samples: int,
    tolerance: float = 1e-6,
) -> tuple[np.ndarray, np.ndarray]:
    """y and y' (samples, n) after each ``every`` steps; ``tolerance`` in units of 1/``weight``."""
    functions, data = bearing.function_types(BDF), bearing.data_type
    signature = types.int64(
        functions, data, _REAL, _VECTOR, _VECTOR, _VECTOR, _MATRIX, _VECTOR, _REAL, _COUNT, _REAL,
        _VECTOR, _MATRIX, _MATRIX,
    )  # fmt: skip
    compiled = numba.njit(signature)(march.py_func)
    ys, yds = np.empty((samples, len(y))), np.empty((samples, len(y)))
    done = compiled(
        bearing.functions(BDF), bearing.args, t0, y, yd, weight, _TABLE, _NODES, step, every,
        tolerance, np.zeros(len(POWERS)), ys, yds,
    )  # fmt: skip
    if done < samples:
        raise RuntimeError(f"no convergence after {done} samples")
    return ys, yds
