"""Cost of one revolution, and the error of its contact forces against a converged reference."""

from __future__ import annotations

from collections.abc import Callable
from statistics import median
from time import process_time
from typing import Any

import numpy as np
import runge_kutta
from settled import RATE, SETTLE, Forces, Settled

import flexcage
from flexcage.solve import bdf
from flexcage.system.scales import error_weights

WINDOW = 3e-3  # [s] compared with the reference
SHARE, STEP_SHARE = 1e-3, 1e-2  # of tolerance and largest step: the reference
SECOND_STEP = 0.25e-6  # [s] of the second method
COUNTS = {
    "steps": bdf.STEPS,
    "residuals": bdf.RESIDUALS,
    "jacobians": bdf.JACOBIANS,
    "factorisations": bdf.FACTORS,
    "failed_error_tests": bdf.ERROR_FAILS,
    "failed_newton": bdf.NEWTON_FAILS,
}


def measure(case: flexcage.Case) -> dict[str, Any]:
    """All figures that README.md lists."""
    settled = Settled(case)
    revolution = 2.0 * np.pi / abs(case.drive.speed)
    stride = case.output.vibration_ratio
    settled.integrate(1e-4, stride=stride)  # kernels are loaded
    timed = [settled.integrate(revolution, stride=stride) for _ in range(3)]
    times = SETTLE + np.arange(1, round(WINDOW * RATE) + 1) / RATE

    def window(share: float = 1.0, step_share: float = 1.0) -> Forces:
        out = settled.integrate(WINDOW, stride=1, share=share, step_share=step_share)
        return settled.forces(out.ys, out.yds, times)

    reference = window(SHARE, STEP_SHARE)
    default = window()
    error = default.error(reference)
    touching = np.abs(reference.cage).max(axis=(1, 2)) > 1e-3
    return {
        "cpu_s_per_revolution": round(median(t.cpu for t in timed), 4),
        "force_error": float(f"{max(error):.3e}"),
        "force_error_race": float(f"{error[0]:.3e}"),
        "force_error_cage": float(f"{error[1]:.3e}"),
        "window_contact": round(float(touching.mean()), 3),
        "reference": {
            "tolerance_next": _pair(window(10.0 * SHARE, STEP_SHARE).error(reference)),
            "second_method": _pair(_second(settled, times).error(reference)),
        },
        **kernel_times(settled),
        **{name: int(timed[0].count[i]) for name, i in COUNTS.items()},
        "unknowns": settled.bearing.layout.size,
        "tolerance_um": case.solver.tolerance * 1e6,
    }


def _pair(error: tuple[float, float]) -> list[float]:
    return [float(f"{e:.2e}") for e in error]


def _second(settled: Settled, times: np.ndarray) -> Forces:
    y, yd = settled.restore()
    layout, model = settled.bearing.layout, settled.bearing.data.model
    ys, yds = runge_kutta.integrate(
        settled.bearing, SETTLE, y, yd,
        weight=error_weights(model, layout, settled.case.solver.tolerance),
        step=SECOND_STEP, every=round(1.0 / (RATE * SECOND_STEP)), samples=len(times),
    )  # fmt: skip
    return settled.forces(ys, yds, times)


def kernel_times(settled: Settled) -> dict[str, float]:
    """Time of single kernels at a state with cage contact [us]; calls from Python included."""
    out = settled.integrate(WINDOW, stride=1)
    b = settled.bearing
    peak = int(b.data.samples.pocket_normal.max(axis=(1, 2))[: len(out.ys)].argmax())
    y, yd, t = out.ys[peak], out.yds[peak], SETTLE + (peak + 1) / RATE
    residual, linearise, factor, backsolve = b.functions[:4]
    r, alpha = np.empty_like(y), 1.0 / 2e-6
    linearise(t, y, yd, b.args)
    factor(alpha, b.args)
    residual(t, y, yd, b.args, r)
    start = r.copy()

    def solve() -> None:
        r[:] = start
        backsolve(alpha, y, r, b.args)

    calls: dict[str, Callable[[], Any]] = {
        "residual_us": lambda: residual(t, y, yd, b.args, r),
        "tangent_us": lambda: linearise(t, y, yd, b.args),
        "factor_us": lambda: factor(alpha, b.args),
        "solve_us": solve,
    }
    return {name: round(_microseconds(call), 2) for name, call in calls.items()}


def _microseconds(call: Callable[[], Any], *, repeat: int = 7, number: int = 500) -> float:
    best = np.inf
    for _ in range(repeat):
        begin = process_time()
        for _ in range(number):
            call()
        best = min(best, (process_time() - begin) / number)
    return best * 1e6
