"""A thin steel ring in the floating frame, and its frequencies as it spins."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
from scipy import sparse
from scipy.linalg import eigvals

from flexcage.bodies.floating_frame import (
    FlexibleBody,
    flexible_body,
    frame_work,
    inertia_terms,
)

E, RHO, R, H, B = 207e9, 7800.0, 50e-3, 2e-3, 10e-3  # steel; radial height H, axial width B
RPM = 2.0 * np.pi / 60.0
REST = {2: 508.0701, 3: 1437.0392, 4: 2755.3968, 5: 4456.0693}  # Hz
# speed [rpm], order: higher and lower frequency [Hz] in the rotating frame
STIFFENED = {
    (3000, 2): (551.6006, 471.6006), (6000, 2): (602.0490, 442.0490),
    (6000, 3): (1516.9426, 1396.9426), (10000, 2): (679.3509, 412.6842),
    (20000, 2): (913.3004, 379.9671), (20000, 3): (1844.7132, 1444.7132),
}  # fmt: skip
LINEAR = {
    (6000, 2): (584.459, 424.400), (6000, 3): (1494.588, 1374.405),
    (20000, 2): (733.714, 200.239), (20000, 3): (1612.018, 1211.446),
}  # fmt: skip


def ring(orders: Sequence[int], *, count: int = 120, stiffened: bool = False) -> FlexibleBody:
    """A ring of points with inextensional shapes of the orders (pairs); order 0 is breathing.

    ``stiffened`` adds the geometric stiffness of the hoop tension rho A R^2 W^2 in closed form: it
    has no elements. That of ``modes.stiffening`` enters the same equations in
    ``verification/test_solid_rings.py``.
    """
    angle = 2.0 * np.pi * np.arange(count) / count
    er = np.stack([0 * angle, np.cos(angle), np.sin(angle)], axis=1)
    et = np.stack([0 * angle, -np.sin(angle), np.cos(angle)], axis=1)
    mass = RHO * B * H * 2.0 * np.pi * R
    shapes, stiffness, tension = [], [], []
    for n in orders:
        if n == 0:
            shapes.append(er)
            stiffness.append(2.0 * np.pi * R * E * B * H / R**2)
            tension.append(0.0)
            continue
        wave = E * H**2 / 12.0 / (RHO * R**4) * n**2 * (n**2 - 1) ** 2 / (n**2 + 1)
        for phase in (0.0, 0.5 * np.pi):
            c, s = np.cos(n * angle - phase)[:, None], np.sin(n * angle - phase)[:, None]
            shapes.append(c * er - s / n * et)  # u_r = -d u_t/d angle: no stretch
            stiffness.append(wave * 0.5 * mass * (1.0 + 1.0 / n**2))
            # rho A R^2 times the squared turn of the tangent, (d u_r/d angle - u_t)/R
            tension.append(0.5 * mass * (n - 1.0 / n) ** 2)
    each = sparse.csr_matrix(sparse.diags(np.full(count, mass / count)))
    geometric = np.diag(tension) if stiffened else None
    return flexible_body(
        R * er, each, np.stack(shapes, axis=2), np.diag(stiffness), geometric=geometric
    )


def frequencies(body: FlexibleBody, speed: float) -> np.ndarray:
    """Frequencies [Hz] in the rotating frame, falling: the kernel linearised about steady spin."""
    n, w = body.modes, np.array([speed, 0.0, 0.0])
    work = frame_work(n)

    def h(q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        inertia_terms(body.data, w, q, qd, work)
        return work.h[6:].copy()

    step, zero = 1e-6, np.zeros(n)
    eye = step * np.eye(n)
    K = body.data.kff + np.stack([h(e, zero) - h(-e, zero) for e in eye], axis=1) / (2.0 * step)
    C = np.stack([h(zero, e) - h(zero, -e) for e in eye], axis=1) / (2.0 * step)
    inverse = np.linalg.inv(body.data.mff)
    values = eigvals(np.block([[zero * eye, np.eye(n)], [-inverse @ K, -inverse @ C]])).imag
    return np.sort(values[values > 1.0])[::-1] / (2.0 * np.pi)
