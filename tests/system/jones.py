"""An angular contact ball bearing at speed, by A. B. Jones and T. A. Harris: written for the tests.

Nothing of flexcage is used: Hertz's ellipses from their integrals, Harris's equations of every
ball, and outer race control, solved together by SciPy. Lengths in m, forces in N, angles in rad.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.optimize import brentq, root
from scipy.special import ellipe, ellipk


@dataclass(frozen=True)
class Solid:
    """Young's modulus [Pa], Poisson's ratio, density [kg/m^3]."""

    modulus: float
    ratio: float
    density: float


@dataclass(frozen=True)
class Balls:
    """Number, diameter and pitch diameter of balls, conformities f_i and f_o, free angle."""

    count: int
    diameter: float
    pitch: float
    conformity: tuple[float, float]
    angle: float
    ball: Solid
    ring: Solid

    @property
    def mass(self) -> float:
        return self.ball.density * np.pi * self.diameter**3 / 6.0

    def stiffness(self, outer: bool) -> float:
        """Q/delta^1.5 of a race (B. J. Hamrock, Fundamentals of Fluid Film Lubrication, 19)."""
        r, f = 0.5 * self.diameter, self.conformity[int(outer)]
        gamma = self.diameter * np.cos(self.angle) / self.pitch
        rolling = r * (1.0 + gamma) if outer else r * (1.0 - gamma)
        across = 1.0 / (1.0 / r - 1.0 / (2.0 * r * f))
        total = 1.0 / rolling + 1.0 / across
        difference = (1.0 / rolling - 1.0 / across) / total

        def excess(k: float) -> float:
            m = 1.0 - k**-2
            E, F = ellipe(m), ellipk(m)
            return ((k**2 + 1.0) * E - 2.0 * F) / ((k**2 - 1.0) * E) - difference

        k = brentq(excess, 1.0 + 1e-6, 100.0)
        E, F = ellipe(1.0 - k**-2), ellipk(1.0 - k**-2)
        soft = sum((1.0 - s.ratio**2) / s.modulus for s in (self.ball, self.ring))
        return np.pi * k * (2.0 / soft) * np.sqrt(2.0 * E / total / (9.0 * F**3))


@dataclass(frozen=True)
class Found:
    """Displacements (axial, radial), and by ball forces (Z, 2) and angles (Z, 2), inner first."""

    displacement: np.ndarray
    force: np.ndarray
    angle: np.ndarray


def solve(b: Balls, *, speed: float, axial: float, radial: float) -> Found:
    """The inner ring turns at ``speed`` [rad/s] and is not tilted."""
    Z, D, d_m = b.count, b.diameter, b.pitch
    psi = 2.0 * np.pi * np.arange(Z) / Z
    f_i, f_o = b.conformity
    K_i, K_o = b.stiffness(False), b.stiffness(True)
    distance = (f_i + f_o - 1.0) * D

    def state(x: np.ndarray):
        moved, X = x[:2] * 1e-6, x[2:].reshape(2, Z) * distance
        A1 = distance * np.sin(b.angle) + moved[0]
        A2 = distance * np.cos(b.angle) + moved[1] * np.cos(psi)
        reach_o, reach_i = np.hypot(X[0], X[1]), np.hypot(A1 - X[0], A2 - X[1])
        a_o = np.arctan2(X[0], X[1])
        a_i = np.arctan2(A1 - X[0], A2 - X[1])
        Q_o = K_o * np.maximum(reach_o - (f_o - 0.5) * D, 0.0) ** 1.5
        Q_i = K_i * np.maximum(reach_i - (f_i - 0.5) * D, 0.0) ** 1.5
        return a_i, a_o, Q_i, Q_o, X[1]

    def residual(x: np.ndarray) -> np.ndarray:
        a_i, a_o, Q_i, Q_o, height = state(x)
        g = D / d_m
        pitch = np.arctan2(np.sin(a_o), np.cos(a_o) + g)  # Harris: outer race control
        orbit = speed * (1.0 - g * np.cos(a_i)) / (1.0 + np.cos(a_i - a_o))
        on_o = (np.cos(a_o) + np.tan(pitch) * np.sin(a_o)) / (1.0 + g * np.cos(a_o))
        on_i = (np.cos(a_i) + np.tan(pitch) * np.sin(a_i)) / (1.0 - g * np.cos(a_i))
        spin = speed / ((on_o + on_i) * g * np.cos(pitch))
        centres = 0.5 * d_m - (f_o - 0.5) * D * np.cos(b.angle)
        push = b.mass * (centres + height) * orbit**2
        T = 2.0 / D * 0.1 * b.mass * D**2 * spin * orbit * np.sin(pitch)  # all on the outer race
        along = Q_o * np.sin(a_o) - Q_i * np.sin(a_i) - T * np.cos(a_o)
        out = Q_o * np.cos(a_o) - Q_i * np.cos(a_i) + T * np.sin(a_o) - push
        ring = (axial - (Q_i * np.sin(a_i)).sum(), radial - (Q_i * np.cos(a_i) * np.cos(psi)).sum())
        return np.concatenate([ring, along, out])

    start = np.concatenate([
        [20.0, 5.0],
        np.full(Z, (f_o - 0.5) * D / distance * np.sin(b.angle) * 1.05),
        np.full(Z, (f_o - 0.5) * D / distance * np.cos(b.angle) * 1.005),
    ])  # fmt: skip
    found = root(residual, start, method="hybr", tol=1e-12)
    assert np.abs(found.fun).max() < 1e-6, found.message
    a_i, a_o, Q_i, Q_o, _ = state(found.x)
    return Found(1e-6 * found.x[:2], np.stack([Q_i, Q_o], axis=1), np.stack([a_i, a_o], axis=1))
