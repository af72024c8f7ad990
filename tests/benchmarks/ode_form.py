"""The bearing's equations as x' = f(t, x), for integrators that know no constraints.

x = (q, u). What the constraints hold are single coordinates of the inner ring, whose mass matrix is
diagonal: axial position, skew and tilt stay as they are, and its spin is the constant speed of the
drive. So their rows say what force holds them and nothing else, and leaving those rows out removes
the constraints exactly. All other accelerations follow from M u' = Q, with the cage's full mass.
"""

from __future__ import annotations

import numpy as np
from c_functions import CFunctions, c_function, vector
from dense_tangent import kinematics, momentum_matrices
from numba import types

from flexcage.core.jit import fields, kernel
from flexcage.solve.bordered import lu_factor, lu_solve

_HELD = (0, 3, 4, 5)  # of the inner ring's velocities


class OdeForm:
    """``rates`` and ``jacobian`` of a bearing with a fixed outer ring and a prescribed speed."""

    def __init__(self, functions: CFunctions) -> None:
        bearing = functions.bearing
        bodies = bearing.data.model.bodies
        if bodies.drive[0] > 0.0 or np.ptp(bodies.speed[1]) > 0.0 or bodies.outer[3] <= 0.0:
            raise ValueError(
                "the ODE form wants a fixed outer ring and a constant prescribed speed"
            )
        self.c, self.layout = functions, bearing.layout
        self.size = self.layout.n_q + self.layout.n_u
        n_cage = 6 + self.layout.modes
        self._work = (
            np.zeros((3, functions.size)), np.zeros((n_cage, n_cage)), np.zeros(n_cage),
            np.zeros(n_cage, np.int64), np.zeros((3, self.size)),
        )  # fmt: skip
        self._compile()

    def _compile(self) -> None:
        address, read, n, size = self.c.address, self.c.read, self.size, self.c.size
        Z, nc, powers = self.layout.rollers, 6 + self.layout.modes, len(self.c.power)

        @kernel
        def arrays(work, matrix, rows, pivot):
            return (
                vector(work, 3 * size).reshape(3, size), vector(matrix, nc * nc).reshape(nc, nc),
                vector(rows, nc), vector(pivot, nc),
            )  # fmt: skip

        def rates(t, x, dx, work, matrix, rows, pivot):
            fns, data = read(address)
            w = arrays(work, matrix, rows, pivot)
            _rates(t, vector(x, n), vector(dx, n), fns[0], data, Z, w)

        def runge_kutta(t, x, h, steps, work, matrix, rows, pivot, stages, power):
            fns, data = read(address)
            w = arrays(work, matrix, rows, pivot)
            y, k = vector(x, n), vector(stages, 3 * n).reshape(3, n)
            for step in range(steps):
                _runge_kutta_step(t + step * h, y, h, fns[0], data, Z, w, k)
                for c in range(n):
                    w[0][0, c] = y[c]
                fns[4](t + (step + 1) * h, w[0][0], w[0][1], data, vector(power, powers))

        pointer, real = types.CPointer(types.float64), types.float64
        work = (pointer, pointer, pointer, types.CPointer(types.int64))
        self._rates = c_function(rates, types.void(real, pointer, pointer, *work))
        self._runge_kutta = c_function(
            runge_kutta, types.void(real, pointer, real, types.int64, *work, pointer, pointer)
        )
        self._addresses = [a.ctypes.data for a in self._work]

    def rates(self, t: float, x: np.ndarray) -> np.ndarray:
        """f(t, x), a new array."""
        dx = np.empty(self.size)
        self._rates(t, x.ctypes.data, dx.ctypes.data, *self._addresses[:4])
        return dx

    def runge_kutta(self, t: float, x: np.ndarray, h: float, steps: int) -> None:
        """Steps of the classical Runge-Kutta method of order 4, in place, each one accepted."""
        self._runge_kutta(
            t, x.ctypes.data, h, steps, *self._addresses, self.c.power.ctypes.data
        )  # fmt: skip

    def full(self, x: np.ndarray) -> np.ndarray:
        """y of x, with multipliers of zero."""
        return np.concatenate([x, np.zeros(self.c.size - self.size)])

    def jacobian(self, t: float, x: np.ndarray) -> np.ndarray:
        """df/dx (n, n), as exact as Newton's matrix."""
        y = self.full(x)
        M, C, K = momentum_matrices(self.c, t, y, np.zeros_like(y))
        to_rate, to_displacement = kinematics(self.layout, y)
        n_q, ring = self.layout.n_q, 6 * self.layout.rollers
        J = np.zeros((self.size, self.size))
        J[:n_q, n_q:] = to_rate
        J[n_q:, :n_q] = -K @ to_displacement
        J[n_q:, n_q:] = -C
        force = J[n_q:]
        force[:ring] /= np.diag(M)[:ring, None]
        force[ring:] = np.linalg.solve(M[ring:, ring:], force[ring:])
        force[[ring + c for c in _HELD]] = 0.0
        return J


@kernel
def _rates(t, x, dx, residual, data, Z, work):
    """x' into dx; ``work`` holds (y, y', F), the cage's mass, its rows, and their pivots."""
    vectors, matrix, rows, pivot = work
    y, yd, out = vectors[0], vectors[1], vectors[2]
    n, nc = x.shape[0], rows.shape[0]
    for k in range(n):
        y[k] = x[k]
    residual(t, y, yd, data, out)
    bodies, frame = fields(data[0].bodies), fields(data[0].frame)
    n_q = 6 * Z + 9 + nc
    for k in range(n):
        dx[k] = -out[k]
    for i in range(Z):
        v = dx[n_q + 6 * i : n_q + 6 * i + 6]
        for c in range(6):
            v[c] /= bodies.roller[0 if c < 3 else (1 if c == 3 else 2)]
    ring = n_q + 6 * Z
    for c in range(8):
        dx[ring + c] = dx[ring + c] / bodies.ring[0] if 1 <= c <= 2 else 0.0
    _cage_accelerations(dx[ring + 8 :], frame.M, fields(data[0].scratch).A, matrix, rows, pivot)


@kernel
def _cage_accelerations(v, M, A, matrix, rows, pivot):
    """Solve M a = v in place: translations of v in space, M in the body's frame."""
    nc = rows.shape[0]
    for r in range(nc):
        for c in range(nc):
            matrix[r, c] = M[r, c]
        rows[r] = v[r]
    for c in range(3):
        rows[c] = A[0, c] * v[0] + A[1, c] * v[1] + A[2, c] * v[2]
    lu_factor(matrix, pivot)
    lu_solve(matrix, pivot, rows)
    for c in range(3):
        v[c] = A[c, 0] * rows[0] + A[c, 1] * rows[1] + A[c, 2] * rows[2]
    for r in range(3, nc):
        v[r] = rows[r]


@kernel
def _runge_kutta_step(t, x, h, residual, data, Z, work, k):
    """One step of the classical method of order 4; ``k`` (3, n): slope, stage, sum of slopes."""
    n = x.shape[0]
    slope, stage, total = k[0], k[1], k[2]
    for c in range(n):
        stage[c] = x[c]
    for i in range(4):
        _rates(t + (0.0 if i == 0 else (h if i == 3 else 0.5 * h)), stage, slope, residual, data,
               Z, work)  # fmt: skip
        ahead = h if i == 2 else 0.5 * h
        weight = 1.0 / 6.0 if i == 0 or i == 3 else 1.0 / 3.0
        for c in range(n):
            total[c] = weight * slope[c] + (total[c] if i > 0 else 0.0)
            stage[c] = x[c] + ahead * slope[c]
    for c in range(n):
        x[c] += h * total[c]
