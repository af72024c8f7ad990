"""A second method for F(t, y, y') = 0, to confirm the reference: nothing of the BDF is in it.

Alexander 1977: singly diagonally implicit Runge-Kutta, three stages, order 3, L-stable, stiffly
accurate (so constraints hold at every step). Stage i solves F(t_i, Y_i, K_i) = 0 with
Y_i = y_n + h sum_j a_ij K_j, thus K_i = (Y_i - psi_i)/(h g): the Newton matrix of a BDF step.
"""

from __future__ import annotations

import numpy as np

from flexcage.system.model import POWERS
from flexcage.system.problem import Bearing

_G = 0.43586652150845899942  # root of g^3 - 3 g^2 + 3 g/2 - 1/6
_C = (_G, 0.5 * (1.0 + _G), 1.0)
_A = (
    (_G,),
    (0.5 * (1.0 - _G), _G),
    (-(6.0 * _G**2 - 16.0 * _G + 1.0) / 4.0, (6.0 * _G**2 - 20.0 * _G + 5.0) / 4.0, _G),
)
_ITERATIONS = 12
_FRESH = 20  # steps between Jacobians


def integrate(
    bearing: Bearing,
    t0: float,
    y: np.ndarray,
    yd: np.ndarray,
    *,
    weight: np.ndarray,
    step: float,
    every: int,
    samples: int,
    newton: float = 1e-4,
) -> tuple[np.ndarray, np.ndarray]:
    """y and y' (samples, n) after each ``every`` steps; ``newton`` is in units of 1/``weight``."""
    residual, linearise, factor, backsolve, accepted, _ = bearing.functions
    args, power = bearing.args, np.zeros(len(POWERS))
    alpha = 1.0 / (step * _G)
    r, stages = np.empty_like(y), np.empty((3, len(y)))
    ys, yds = np.empty((samples, len(y))), np.empty((samples, len(y)))
    age = _FRESH
    for n in range(samples * every):
        t = t0 + n * step
        K = yd.copy()
        for i in range(3):
            psi = y + step * sum(a * k for a, k in zip(_A[i][:-1], stages, strict=False))
            Y = psi + step * _G * K
            now = t + _C[i] * step
            for it in range(_ITERATIONS):
                if age >= _FRESH or it == 6:
                    linearise(now, Y, K, args)
                    if not factor(alpha, args):
                        raise RuntimeError("Newton's matrix is singular")
                    age = 0
                residual(now, Y, K, args, r)
                backsolve(alpha, Y, r, args)
                Y += r
                K = (Y - psi) * alpha
                if np.max(np.abs(r) * weight) < newton:
                    break
            else:
                raise RuntimeError(f"no convergence at t = {now:.6e}")
            stages[i] = K
        y, yd = Y, K
        age += 1
        accepted(t + step, y, yd, args, power)
        if (n + 1) % every == 0:
            ys[n // every], yds[n // every] = y, yd
    return ys, yds
