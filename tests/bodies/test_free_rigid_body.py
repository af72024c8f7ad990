"""A rigid body free of torque that turns about its middle axis.

A body with moments of inertia 1, 2 and 3 kg m^2, turned about its middle axis at 10 rad/s and
nudged by 0.01 rad/s, turns over on time and keeps energy and angular momentum.

Source: L. Euler's equations, solved by elliptic functions (L. D. Landau and E. M. Lifshitz,
Mechanics, section 37); times from an independent program.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from free_motion import Tumbler
from known_rows import check
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from scipy.special import ellipk

from flexcage.bodies.floating_frame import rigid_body
from flexcage.verification import Row, Tolerance

INERTIA, START = np.array([1.0, 2.0, 3.0]), np.array([0.01, 10.0, 0.01])  # kg m^2, rad/s
CROSSINGS = (1.49059, 4.24367, 6.99676, 9.74984)  # s, sign changes of w_y
PRINTED = Tolerance(1e-5, "printed to 1e-5 s", absolute=True)
PERIOD = Tolerance(1e-7, "closed form; events of an integration with 1e-12")
LINEAR = Tolerance(1e-4, "growth is exponential to first order in 0.002 of the speed")
START_VALUE = Tolerance(1e-9, "set by the start")
KEPT = Tolerance(1e-8, "invariants, integrated with 1e-12 over 20 s", absolute=True)


def half_period() -> float:
    """Time between two turn-overs [s]: 2 K(m)/p of Euler's solution."""
    a, b, c = INERTIA
    energy, momentum = INERTIA @ START**2, np.sum((INERTIA * START) ** 2)
    p2 = (c - b) * (momentum - a * energy) / (a * b * c)
    m = (b - a) * (c * energy - momentum) / ((c - b) * (momentum - a * energy))
    if m > 1.0:
        m, p2 = 1.0 / m, p2 * m
    return float(2.0 * ellipk(m) / np.sqrt(p2))


def rows() -> Iterator[Row]:
    flyer = Tumbler(rigid_body(1.0, np.zeros(3), np.diag([2.0, 1.0, 0.0])))

    def turned_over(t: float, y: np.ndarray) -> float:
        return y[11]

    grid = np.linspace(0.0, 20.0, 201)
    out = solve_ivp(
        flyer.rate, (0.0, 20.0), flyer.start(w=START), method="DOP853", rtol=1e-12, atol=1e-14,
        events=turned_over, t_eval=grid,
    )  # fmt: skip
    times = out.t_events[0]
    for k, expected in enumerate(CROSSINGS):
        yield Row(f"turn-over {k + 1}", "s", expected, times[k], PRINTED)
    interval = float(np.diff(times).mean())
    yield Row("time between turn-overs", "s", half_period(), interval, PERIOD)
    w = out.y[10:13].T
    h = grid[1]  # w(t - h) + w(t + h) = 2 cosh(growth h) w(t) of a growing and a fading part
    growth = np.arccosh(0.5 * (w[0, 0] + w[2, 0]) / w[1, 0]) / h
    yield Row("growth rate at first", "1/s", 10.0 / np.sqrt(3.0), growth, LINEAR)
    energy = w**2 @ INERTIA
    turns = Rotation.from_quat(out.y[6:10].T, scalar_first=True)
    momentum = turns.apply(w * INERTIA)
    size = float(np.linalg.norm(momentum[0]))
    yield Row("twice the energy", "J", 200.0004, energy[0], START_VALUE)
    yield Row("angular momentum", "kg m^2/s", 20.0000250, size, START_VALUE)
    yield Row("drift of energy", "", 0.0, np.abs(energy / energy[0] - 1.0).max(), KEPT)
    drift = np.abs(momentum - momentum[0]).max() / size
    yield Row("drift of angular momentum", "", 0.0, drift, KEPT)


def test_a_rigid_body_turns_over():
    check(rows())
