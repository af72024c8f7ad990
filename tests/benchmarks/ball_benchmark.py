"""The ball bearing beside the roller bearing: cost of a revolution, and the error of its forces."""

from __future__ import annotations

from statistics import median
from typing import Any

import numpy as np
from scipy.integrate import DOP853
from settled import SETTLE, Forces, Settled, sample_times

import flexcage
from flexcage.solve.contract import COUNTS
from flexcage.system.data import POWERS

WINDOW = 3e-3  # [s] compared with the reference
SHARE = 1e-4  # of the tolerance: the reference
QUICK: dict[str, Any] = {"window": 0.15e-3}  # whether it runs


def measure(
    case: flexcage.Case, *, rollers: flexcage.Case, window: float = WINDOW
) -> dict[str, Any]:
    """All figures that README.md lists, with errors over ``window`` [s]; ``rollers``: the case
    beside it."""
    balls = Settled(case)
    times = sample_times(window)
    reference = balls.window(window, share=SHARE)
    looser = balls.window(window, share=10 * SHARE)
    error = balls.window(window).error(reference)
    touching = np.abs(reference.cage).max(axis=(1, 2)) > 1e-3
    cost, counts = revolution(balls)
    other, _ = revolution(Settled(rollers))
    elements = (case.bearing.element_count, rollers.bearing.element_count)
    return {
        "cpu_s_per_revolution": round(cost, 4),
        "force_error": float(f"{max(error):.3e}"),
        "force_error_race": float(f"{error[0]:.3e}"),
        "force_error_cage": float(f"{error[1]:.3e}"),
        "window_contact": round(float(touching.mean()), 3),
        "reference": {
            "tolerance_next": [float(f"{e:.2e}") for e in looser.error(reference)],
            "second_method": [
                float(f"{e:.2e}") for e in _second_method(balls, times).error(reference)
            ],
        },
        "roller_cpu_s_per_revolution": round(other, 4),
        "per_ball_over_per_roller": round(cost / elements[0] / (other / elements[1]), 3),
        **counts,
        "unknowns": balls.bearing.layout.size,
        "tolerance_um": case.solver.tolerance * 1e6,
    }


def revolution(settled: Settled) -> tuple[float, dict[str, int]]:
    """CPU time [s] of a revolution of the inner ring, the median of three, and counts of one."""
    revolution = 2.0 * np.pi / abs(settled.case.drive.speed)
    stride = settled.case.output.vibration_ratio
    settled.integrate(1e-4, stride=stride, method="explicit")  # kernels are loaded
    timed = [settled.integrate(revolution, stride=stride, method="explicit") for _ in range(3)]
    return median(t.cpu for t in timed), {k: int(timed[0].count[i]) for k, i in COUNTS.items()}


def _second_method(settled: Settled, times: np.ndarray) -> Forces:
    """Forces at the times by SciPy's Runge-Kutta method of order 8, contacts told of its steps."""
    y, _ = settled.restore()
    b = settled.bearing
    rates, note = b.function("rates"), b.function("note")
    size, power = b.layout.n_q + b.layout.n_u, np.zeros(len(POWERS))

    def full(x: np.ndarray) -> np.ndarray:
        return np.concatenate([x, np.zeros(len(y) - size)])

    def slope(t: float, x: np.ndarray) -> np.ndarray:
        yd = np.zeros_like(y)
        rates(t, full(x), yd, b.args, power)
        return yd[:size]

    weight = settled.weights(SHARE)[:size]
    allowed = np.where(weight > 0.0, 1.0 / np.maximum(weight, 1e-300), 1.0)
    method = DOP853(slope, SETTLE, y[:size], times[-1], rtol=1e-12, atol=allowed, max_step=2e-6)
    ys: list[np.ndarray] = []
    while method.status == "running":
        method.step()
        between = method.dense_output()
        ys += [full(between(t)) for t in times[len(ys) :] if t <= method.t]
        slope(method.t, method.y)
        note(method.t, full(method.y), b.args)
    return settled.forces(np.array(ys), np.zeros((len(ys), len(y))), times)
