"""Cost of one revolution, and the error of its contact forces against a converged reference."""

from __future__ import annotations

from functools import partial
from statistics import median
from time import process_time
from typing import Any

import implicit_runge_kutta
import numba
import numpy as np
from numba import types
from settled import NUDGE, RATE, SETTLE, Forces, Settled, sample_times

import flexcage
from flexcage.solve.bdf import BDF
from flexcage.solve.contract import COUNTS

WINDOW = 3e-3  # [s] compared with the reference
SHARE, STEP_SHARE = 1e-5, 2e-2  # of tolerance and largest step: the reference
FINE = 1e-4  # of tolerance: the explicit method beside the reference
SECOND_STEP = 0.05e-6  # [s] of the second method
ALPHA = 1.0 / 2e-6  # [1/s] of the timed factorisation
REFERENCE: dict[str, Any] = {"method": "bdf", "share": SHARE, "step_share": STEP_SHARE}
LOOSER = {**REFERENCE, "share": 10.0 * SHARE}
# whether it runs
QUICK: dict[str, Any] = {"window": 0.15e-3, "calm": 0, "share": 0.02, "repeats": 1}


def measure(
    case: flexcage.Case,
    *,
    window: float = WINDOW,
    calm: int = 1,
    share: float = 1.0,
    repeats: int = 3,
) -> dict[str, Any]:
    """All figures that README.md lists, with errors over ``window`` [s]; what a revolution costs
    from a ``share`` of one, ``repeats`` times."""
    settled, times = Settled(case, calm=calm), sample_times(window)
    turn = share * 2.0 * np.pi / abs(case.drive.speed)
    stride = case.output.vibration_ratio
    timed: dict[str, Any] = {}
    for method in ("explicit", "bdf"):
        settled.integrate(1e-4, stride=stride, method=method)  # kernels are loaded
        timed[method] = [
            settled.integrate(turn, stride=stride, method=method) for _ in range(repeats)
        ]
    forces = partial(settled.window, window)
    reference, default = forces(**REFERENCE), forces()
    error = default.error(reference)
    aside = forces(aside=NUDGE, **REFERENCE)
    fine = forces(method="explicit", share=FINE)
    touching = np.abs(reference.cage).max(axis=(1, 2)) > 1e-3
    return {
        "cpu_s_per_revolution": round(median(t.cpu for t in timed["explicit"]) / share, 4),
        "bdf_cpu_s_per_revolution": round(median(t.cpu for t in timed["bdf"]) / share, 4),
        "force_error": float(f"{max(error):.3e}"),
        "force_error_race": float(f"{error[0]:.3e}"),
        "force_error_cage": float(f"{error[1]:.3e}"),
        "force_error_by_ms": [_larger(default, reference, n * len(times) // 3) for n in (1, 2, 3)],
        "window_contact": round(float(touching.mean()), 3),
        "reference": {
            "tolerance_next": _pair(forces(**LOOSER).error(reference)),
            "explicit": _pair(fine.error(reference)),
            "second_method": _pair(second_method(settled, times).error(reference)),
            "nudged": _pair(aside.error(reference)),
        },
        **kernel_times(settled, window),
        **{name: int(timed["explicit"][0].count[i]) for name, i in COUNTS.items()},
        **{f"bdf_{name}": int(timed["bdf"][0].count[i]) for name, i in COUNTS.items()},
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
    ys, yds = implicit_runge_kutta.integrate(
        settled.bearing, SETTLE, y, yd,
        weight=settled.bearing.error_weights(settled.case.solver.tolerance),
        step=SECOND_STEP, every=round(1.0 / (RATE * SECOND_STEP)), samples=len(times),
    )  # fmt: skip
    return settled.forces(ys, yds, times)


def kernel_times(settled: Settled, window: float = WINDOW) -> dict[str, float]:
    """Time of single kernels at the window's state of largest pocket force [us]."""
    out = settled.integrate(window, stride=1)
    b = settled.bearing
    peak = int(b.data.samples.pocket_normal.max(axis=(1, 2))[: len(out.ys)].argmax())
    y, yd, t = out.ys[peak], out.yds[peak], SETTLE + (peak + 1) / RATE
    functions, data = b.function_types(BDF), b.data_type
    f8, i8, vector = types.float64, types.int64, types.Array(types.float64, 1, "C")
    signature = types.void(functions, data, i8, i8, f8, vector, vector, vector, vector)
    compiled = numba.njit(signature)(_repeat)
    r = b.residual(t, y, yd)
    b.function("linearise")(t, y, yd, b.args)
    b.function("factor")(ALPHA, b.args)

    def seconds(which: int, number: int) -> float:
        begin = process_time()
        compiled(b.functions(BDF), b.args, which, number, t, y, yd, r, np.empty_like(r))
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
            fns[0](t, y, yd, data, out, out[:0])
        elif which == 1:
            fns[1](t, y, yd, data)
        elif which == 2:
            fns[2](ALPHA, data)
        else:
            for k in range(r.shape[0]):
                out[k] = r[k]
            fns[3](ALPHA, y, out, data)
