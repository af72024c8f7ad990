"""A ball bearing by both integrators over a map of load and speed: cost, mean figures, and which
one ``auto`` takes."""

from __future__ import annotations

import logging
from statistics import median
from typing import Any

import numpy as np
from settled import SETTLE, Settled

import flexcage
from flexcage.core.errors import FlexcageError
from flexcage.solve.contract import COUNTS

log = logging.getLogger(__name__)

LOADS = (100.0, 1000.0, 12500.0)  # [N] axial
SPEEDS = (1e5, 5e5, 1e6)  # bore times speed [mm/min]
WINDOW = 10e-3  # [s] of bearing time, in which every method begins from the same settled state
ALIKE = 1.5  # auto may miss the cheaper method by so much
QUICK: dict[str, Any] = {"window": 0.2e-3, "loads": (100.0,), "speeds": (1e5,), "repeats": 1}


def measure(
    case: flexcage.Case,
    *,
    window: float = WINDOW,
    loads: tuple[float, ...] = LOADS,
    speeds: tuple[float, ...] = SPEEDS,
    repeats: int = 3,
) -> dict[str, Any]:
    """All figures that README.md lists, a row for every load and speed."""
    rows = []
    for load in loads:
        for dn in speeds:
            speed = 2.0 * np.pi / 60.0 * dn / (case.bearing.bore * 1e3)
            point = case.replace(si=True, **{"load.axial": load, "drive.speed": speed})
            try:
                rows.append([load, dn, *_row(point, window, repeats)])
            except (FlexcageError, RuntimeError) as error:
                log.warning("%g N at dn %g is left out: %s", load, dn, error)
    ratios = [row[COLUMNS.index("auto_over_cheaper")] for row in rows]
    return {"columns": COLUMNS, "rows": rows, "worst_auto": max(ratios), "target": ALIKE}


COLUMNS = [
    "load_N", "dn", "bound_us", "explicit_cpu_s", "bdf_cpu_s", "explicit_over_bdf", "auto",
    "auto_over_cheaper", "bdf_steps", "explicit_steps", "race_force_error", "axial_error",
]  # fmt: skip


def _row(case: flexcage.Case, window: float, repeats: int) -> list[Any]:
    """Both methods from one state: processor time, and by how much their means differ."""
    settled = Settled(case)
    stride, bearing = case.output.vibration_ratio, settled.bearing
    y, yd = settled.restore()
    bound = bearing.stable_step(SETTLE, y, yd)
    auto = bearing.cheaper(bound, case.solver.stable_step)
    cpu, steps, means = {}, {}, {}
    for method in ("explicit", "bdf"):
        settled.integrate(1e-4, stride=stride, method=method)  # kernels are loaded
        runs = [settled.integrate(window, stride=stride, method=method) for _ in range(repeats)]
        cpu[method] = median(run.cpu for run in runs)
        steps[method] = int(runs[0].count[COUNTS["steps"]])
        forces = bearing.data.samples.race[: len(runs[0].ys) // stride, :, :, 0]
        ring = bearing.layout.q(runs[0].ys)["inner"][:, 0]
        means[method] = forces.mean(axis=0), ring.mean(keepdims=True)
    force, place = (
        float(np.abs(a - b).max() / np.abs(b).max())
        for a, b in zip(means["bdf"], means["explicit"], strict=True)
    )
    ratio = cpu["explicit"] / cpu["bdf"]
    return [
        _short(bound * 1e6), _short(cpu["explicit"]), _short(cpu["bdf"]), _short(ratio), auto,
        _short(cpu[auto] / min(cpu.values())), steps["bdf"], steps["explicit"], _short(force),
        _short(place),
    ]  # fmt: skip


def _short(value: float) -> float:
    return float(f"{value:.3g}")
