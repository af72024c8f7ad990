"""Cost of one revolution, and the error of its contact forces against a converged reference."""

from __future__ import annotations

from statistics import median
from time import process_time
from typing import Any

import numba
import numpy as np
import runge_kutta
from numba import types
from settled import RATE, SETTLE, Forces, Settled

import flexcage
from flexcage.solve import bdf
from flexcage.system.scales import error_weights

WINDOW = 3e-3  # [s] compared with the reference
SHARE, STEP_SHARE = 1e-5, 2e-2  # of tolerance and largest step: the reference
NUDGE = 1e-12  # [m] by which the cage is moved at the start, to see how errors grow
SECOND_STEP = 0.05e-6  # [s] of the second method
ALPHA = 1.0 / 2e-6  # [1/s] of the timed factorisation
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
    aside = settled.integrate(WINDOW, stride=1, share=SHARE, step_share=STEP_SHARE, aside=NUDGE)
    touching = np.abs(reference.cage).max(axis=(1, 2)) > 1e-3
    return {
        "cpu_s_per_revolution": round(median(t.cpu for t in timed), 4),
        "force_error": float(f"{max(error):.3e}"),
        "force_error_race": float(f"{error[0]:.3e}"),
        "force_error_cage": float(f"{error[1]:.3e}"),
        "force_error_by_ms": [_larger(default, reference, n) for n in (200, 400, 600)],
        "window_contact": round(float(touching.mean()), 3),
        "reference": {
            "tolerance_next": _pair(window(10.0 * SHARE, STEP_SHARE).error(reference)),
            "second_method": _pair(second_method(settled, times).error(reference)),
            "nudged": _pair(settled.forces(aside.ys, aside.yds, times).error(reference)),
        },
        **kernel_times(settled),
        **{name: int(timed[0].count[i]) for name, i in COUNTS.items()},
        "unknowns": settled.bearing.layout.size,
        "tolerance_um": case.solver.tolerance * 1e6,
    }


def _larger(forces: Forces, reference: Forces, samples: int) -> float:
    """The larger relative error over the first samples."""
    return float(f"{max(forces.first(samples).error(reference.first(samples))):.2e}")


def _pair(error: tuple[float, float]) -> list[float]:
    return [float(f"{e:.2e}") for e in error]


def second_method(settled: Settled, times: np.ndarray) -> Forces:
    """Forces at the times by the second method."""
    y, yd = settled.restore()
    layout, model = settled.bearing.layout, settled.bearing.data.model
    ys, yds = runge_kutta.integrate(
        settled.bearing, SETTLE, y, yd,
        weight=error_weights(model, layout, settled.case.solver.tolerance),
        step=SECOND_STEP, every=round(1.0 / (RATE * SECOND_STEP)), samples=len(times),
    )  # fmt: skip
    return settled.forces(ys, yds, times)


def kernel_times(settled: Settled) -> dict[str, float]:
    """Time of single kernels at the window's state of largest pocket force [us]."""
    out = settled.integrate(WINDOW, stride=1)
    b = settled.bearing
    peak = int(b.data.samples.pocket_normal.max(axis=(1, 2))[: len(out.ys)].argmax())
    y, yd, t = out.ys[peak], out.yds[peak], SETTLE + (peak + 1) / RATE
    functions, data = b._advance.signatures[0][:2]
    f8, i8, vector = types.float64, types.int64, types.Array(types.float64, 1, "C")
    signature = types.void(functions, data, i8, i8, f8, vector, vector, vector, vector)
    compiled = numba.njit(signature)(_repeat)
    r = b.residual(t, y, yd)
    b.functions[1](t, y, yd, b.args)
    b.functions[2](ALPHA, b.args)

    def seconds(which: int, number: int) -> float:
        begin = process_time()
        compiled(b.functions, b.args, which, number, t, y, yd, r, np.empty_like(r))
        return process_time() - begin

    names = ("residual_us", "tangent_us", "factor_us", "solve_us")
    # the difference of two lengths leaves the call itself out
    return {
        name: round(min((seconds(k, 2200) - seconds(k, 200)) / 2e3 for _ in range(5)) * 1e6, 2)
        for k, name in enumerate(names)
    }


def _repeat(fns, data, which, number, t, y, yd, r, out):
    for _ in range(number):
        if which == 0:
            fns[0](t, y, yd, data, out)
        elif which == 1:
            fns[1](t, y, yd, data)
        elif which == 2:
            fns[2](ALPHA, data)
        else:
            for k in range(r.shape[0]):
                out[k] = r[k]
            fns[3](ALPHA, y, out, data)
