"""Problems with known solutions, and the plain Python integrator with a dense Newton matrix."""

from __future__ import annotations

import importlib.util

import numpy as np
from scipy.integrate import solve_ivp

GRAVITY = 9.81


def plain(name: str):
    """A private copy of an integrator's module: plain Python, whatever others have compiled."""
    spec = importlib.util.find_spec(f"flexcage.solve.{name}")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


class Oscillator:
    """y'' + 2 z w y' + w^2 y = 0 from rest at 1; quadrature: the power lost in the damper."""

    def __init__(self, w=1.0, z=0.0):
        self.w, self.z, self.n = w, z, 2

    def F(self, t, y, yd):
        return np.array([yd[0] - y[1], yd[1] + 2 * self.z * self.w * y[1] + self.w**2 * y[0]])

    def exact(self, t):
        wd, decay = self.w * np.sqrt(1 - self.z**2), np.exp(-self.z * self.w * t)
        c, s = np.cos(wd * t), np.sin(wd * t)
        y = decay * (c + self.z * self.w / wd * s)
        return np.array([y, -decay * self.w**2 / wd * s])

    def rate(self, t):
        y = self.exact(t)
        return np.array([y[1], -2 * self.z * self.w * y[1] - self.w**2 * y[0]])

    def power(self, t, y, yd):
        return np.array([2 * self.z * self.w * y[1] ** 2])

    tested = np.array([1.0, 1.0])


class Pendulum:
    """Pendulum of length 1 in Cartesian coordinates, index 2, stabilised: (x, z, vx, vz, l, mu).

    Released from the horizontal; the exact solution is that of the angle, integrated tightly.
    """

    n = 6
    tested = np.array([1.0, 1.0, 1.0, 1.0, 0.0, 0.0])

    def __init__(self):
        self.angle = solve_ivp(
            lambda t, s: [s[1], -GRAVITY * np.cos(s[0])], (-0.5, 2.5), self._at_start(), rtol=1e-13,
            atol=1e-14, method="DOP853", dense_output=True,
        ).sol  # fmt: skip

    @staticmethod
    def _at_start():  # half a second before it passes the horizontal at rest
        back = solve_ivp(
            lambda t, s: [s[1], -GRAVITY * np.cos(s[0])], (0.0, -0.5), [0.0, 0.0], rtol=1e-13,
            atol=1e-14, method="DOP853",
        )  # fmt: skip
        return back.y[:, -1]

    def F(self, t, y, yd):
        x, z, vx, vz, l, m = y
        return np.array([
            yd[0] - vx - 2 * x * m, yd[1] - vz - 2 * z * m, yd[2] - 2 * x * l,
            yd[3] + GRAVITY - 2 * z * l, x * x + z * z - 1, 2 * x * vx + 2 * z * vz,
        ])  # fmt: skip

    def exact(self, t):
        a, w = self.angle(t)
        c, s = np.cos(a), np.sin(a)
        tension = 0.5 * (GRAVITY * s - w * w)  # lambda of the rows above
        return np.array([c, s, -s * w, c * w, tension, 0.0 * t])

    def rate(self, t):
        h = 1e-5
        return (self.exact(t + h) - self.exact(t - h)) / (2 * h)

    def power(self, t, y, yd):
        return np.zeros(1)

    @staticmethod
    def violation(y):
        return max(abs(y[0] ** 2 + y[1] ** 2 - 1), abs(2 * y[0] * y[2] + 2 * y[1] * y[3]))


def functions(problem):
    """The functions of a problem, with a dense Newton matrix by differences; integrands are those
    of the last residual, unless the problem has ``powers``, and ``losses`` if it says so."""
    keep, n = {}, problem.n
    compute, losses = getattr(problem, "powers", None), getattr(problem, "losses", False)
    settled = problem.__dict__.setdefault("settled", [])

    def residual(t, y, yd, data, out, power):
        out[:] = problem.F(t, y, yd)
        power[:] = problem.power(t, y, yd)[: len(power)]

    def linearise(t, y, yd, data):
        base = problem.F(t, y, yd)
        J, Jd = np.empty((n, n)), np.empty((n, n))
        for k in range(n):
            h = 1e-7 * max(1.0, abs(y[k]))
            e = np.eye(n)[k]
            J[:, k] = (problem.F(t, y + h * e, yd) - base) / h
            Jd[:, k] = (problem.F(t, y, yd + e) - base) / 1.0
        keep.update(J=J, Jd=Jd)

    def factor(alpha, data):
        keep["inverse"] = np.linalg.inv(keep["J"] + alpha * keep["Jd"])
        return True

    def backsolve(alpha, y, r, data):
        r[:] = -keep["inverse"] @ r

    def powers(t, y, data, power):
        if compute is not None:
            compute(t, y, power)
        return 0 if losses else len(power)

    def settle(t, y, data):
        settled.append((t, y.copy()))

    def observe(sample, t, y, yd, data):
        pass

    return residual, linearise, factor, backsolve, powers, settle, observe


def run(bdf, problem, *, tolerance, end=2.0, max_order=2, times=(), h0=1e-6, h_max=0.1, quads=0,
        h_min=1e-14, max_steps=100_000, log_rows=100_000, quad_weight=0.0):  # fmt: skip
    """Integrate from the exact start; (outcome, state, log, samples, derivatives, integrals)."""
    y0, yd0 = problem.exact(0.0), problem.rate(0.0)
    st = bdf.new_state(
        0.0, y0, yd0, weight=problem.tested / tolerance, h0=h0, quad_weight=[quad_weight] * quads
    )
    st.power[0] = problem.power(0.0, y0, yd0)[:quads]
    times = np.append(np.asarray(times, float), end)
    ys, yds, qs = (np.zeros((len(times), w)) for w in (problem.n, problem.n, quads))
    log = np.zeros((log_rows, 5))
    fns, first, rows = functions(problem), 0, []
    options = bdf.BDFOptions(max_order, h_max, h_min, 0.3, max_steps)
    while True:
        outcome, first, filled = bdf.advance(
            fns, None, st, options, end, times, ys, yds, first, log, qs
        )
        rows.append(log[:filled].copy())
        if outcome != bdf.LOG_FULL:
            return outcome, st, np.concatenate(rows), ys, yds, qs
