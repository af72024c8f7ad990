"""Work and precision of flexcage and of Exudyn on one planar bearing, each against itself."""

from __future__ import annotations

import json
import os
import subprocess
import sys
from collections.abc import Callable, Mapping, Sequence
from importlib.metadata import version
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import numpy as np

WINDOW = 1e-3  # [s] from the settled state
SAMPLE = 5e-6  # [s]
EQUAL = 1e-8  # [m] error of the cage's position, flexcage's default tolerance
ERRORS = (1e-7, 5e-8, 2e-8, 1e-8, 5e-9)
ROUNDS = 3  # through all points, of which each has its least time
OURS = 3
SHARES = (30.0, 10.0, 3.0, 1.0, 0.3, 0.1, 0.03)  # of flexcage's default tolerance
REFERENCE = {"rigid": 2.5e-7, "flexible": 5e-7}  # [s] steps of Exudyn's RK4; a share of flexcage's:
TIGHT = 1e-4
METHODS = {  # Exudyn's names, and steps [s]
    "RK44": (5e-6, 2.5e-6),
    "RK33": (5e-6, 2.5e-6, 1.25e-6),
    "VelocityVerlet": (5e-6 / 3.0, 1.25e-6, 6.25e-7),  # unstable at 2.5 us
    "GeneralizedAlpha": (2e-5, 1e-5, 5e-6, 2.5e-6),  # what Exudyn takes if not told otherwise
    "TrapezoidalIndex2": (1e-5, 5e-6),
}
QUICK: dict[str, Any] = {  # whether it runs
    "rounds": 1, "shares": (1.0, 0.3),
    "methods": {"RK44": (5e-6, 2.5e-6), "GeneralizedAlpha": (1e-5, 5e-6)},
}  # fmt: skip
RATIOS = (
    "exudyn_ratio", "exudyn_rigid_ratio", "exudyn_fast_ratio", "exudyn_fast_rigid_ratio",
)  # fmt: skip
Row = tuple[str, float, float, float]  # method, share or step [s], processor time [s/ms], error [m]


def measure(**options: Any) -> dict[str, Any]:
    """Figures that README.md lists under ``peer``; ratios are None where Exudyn is missing.

    ``options`` are those of ``_compare``.
    """
    if find_spec("exudyn") is None:
        reason = "exudyn is not installed (the extra 'peer')"
        return {**dict.fromkeys(RATIOS), "exudyn": {"missing": reason}}
    try:
        found = _own_process({"EXUDYN_MODULE": ""}, options)
        fast = _own_process({"EXUDYN_MODULE": "fast"}, options)
    except subprocess.CalledProcessError as error:
        reason = f"exudyn failed, see above: {error}"
        return {**dict.fromkeys(RATIOS), "exudyn": {"missing": reason}}
    ratios = [found["flexible"], found["rigid"], fast["flexible"], fast["rigid"]]
    return {
        **{k: v["ratios_by_error"][f"{EQUAL:g}"] for k, v in zip(RATIOS, ratios, strict=True)},
        "exudyn": {
            "version": version("exudyn"),
            "equal_error_m": EQUAL,
            "columns": ["method", "share or step_s", "cpu_s_per_ms", "error_m"],
            **found,
            "fast": fast,
        },
    }


def _own_process(environment: dict[str, str], options: dict[str, Any]) -> dict[str, Any]:
    """``compare_both`` in a process of its own, as the first import picks Exudyn's module."""
    code = f"import exudyn_benchmark as b, json; print(json.dumps(b.compare_both(**{options!r})))"
    done = subprocess.run(
        [sys.executable, "-c", code], cwd=Path(__file__).parent, check=True, text=True,
        stdout=subprocess.PIPE, env={**os.environ, **environment},
    )  # fmt: skip
    return json.loads(done.stdout.splitlines()[-1])  # Exudyn has a word before


def compare_both(**options: Any) -> dict[str, Any]:
    """Both programs with a flexible and with a rigid cage."""
    from exudyn_cage import FlexibleExudynBearing
    from exudyn_model import ExudynBearing

    return {
        "flexible": _compare("flexible", FlexibleExudynBearing, **options),
        "rigid": _compare("rigid", ExudynBearing, **options),
    }


def _compare(
    model: str,
    program: Callable[..., Any],
    *,
    rounds: int = ROUNDS,
    shares: Sequence[float] = SHARES,
    methods: Mapping[str, Sequence[float]] = METHODS,
) -> dict[str, Any]:
    """Both programs' curves with a rigid or a flexible cage, and what Exudyn costs more."""
    from exudyn_model import coordinates
    from planar_case import Planar

    planar = Planar(model)
    exudyn = program(planar, sensors="cage")
    stride = planar.case.output.vibration_ratio

    def ours(share: float, times: np.ndarray) -> tuple[float, np.ndarray]:
        out = planar.integrate(WINDOW, stride=stride, share=share)
        return out.cpu, coordinates(planar, out.ys)[0][:, -1]

    def theirs(method: str) -> Callable[[float, np.ndarray], tuple[float, np.ndarray]]:
        return lambda step, times: exudyn.cage_path(times, method=method, step=step)

    fine = _times(SAMPLE)
    (_, own), (_, other) = ours(TIGHT, fine), theirs("RK44")(REFERENCE[model], fine)
    curves = [("flexcage", ours, own, shares)]
    curves += [(name, theirs(name), other, steps) for name, steps in methods.items()]
    found: dict[tuple[str, float], Row] = {}
    for _ in range(rounds):
        for name, path, reference, levels in curves:
            for level in levels:
                cpu, error = _point(path, level, reference, name)
                least = min(cpu, found[name, level][2]) if (name, level) in found else cpu
                found[name, level] = (name, level, least, error)
    rows = [row for row in found.values() if np.isfinite(row[3])]
    failed = [[name, _short(level)] for name, level, _, error in found.values() if error == np.inf]
    best = [
        _best([row for row in rows if row[0] in names])
        for names in (("flexcage",), tuple(methods), ("GeneralizedAlpha",))
    ]
    costs = {error: [cost(curve, error) for curve in best] for error in ERRORS}
    return {
        "ratios_by_error": {f"{e:g}": _ratio(c[0], c[1]) for e, c in costs.items()},
        "default_method_ratios_by_error": {f"{e:g}": _ratio(c[0], c[2]) for e, c in costs.items()},
        "cpu_s_per_ms": {f"{e:g}": [_short(c) for c in pair] for e, pair in costs.items()},
        "cage_apart_m": float(f"{_far(own, other):.2g}"),
        "failed": failed,
        "curves": [
            [name, _short(level), _short(cpu), _short(error)] for name, level, cpu, error in rows
        ],
    }


def _times(step: float) -> np.ndarray:
    """Sampling times [s] that steps of this length reach."""
    every = max(step, SAMPLE)
    return every * np.arange(1, round(WINDOW / every) + 1)


def _point(path, level: float, reference: np.ndarray, name: str) -> tuple[float, float]:
    """Processor time [s per ms], and the error of the cage's position [m]; ours is the least of
    several, so that both take about as long to be measured. Infinite where a program gives up."""
    times = _times(SAMPLE if name == "flexcage" else level)
    try:
        runs = [path(level, times) for _ in range(OURS if name == "flexcage" else 1)]
    except RuntimeError:
        return np.inf, np.inf
    stride = len(reference) // len(times)
    error = _far(runs[0][1], reference[stride - 1 :: stride])
    return min(cpu for cpu, _ in runs) / (WINDOW * 1e3), error


def _far(one: np.ndarray, other: np.ndarray) -> float:
    return float(np.linalg.norm((one - other)[:, :2], axis=1).max())


def _best(rows: Sequence[Row]) -> tuple[np.ndarray, np.ndarray]:
    """Errors (falling back from the smallest) and times of the points no cheaper one betters."""
    best: list[tuple[float, float]] = []
    for *_, cpu, error in sorted(rows, key=lambda row: row[2]):
        if not best or error < best[-1][0]:
            best.append((error, cpu))
    errors, times = np.array(best[::-1]).T
    return errors, times


def cost(curve: tuple[np.ndarray, np.ndarray], error: float) -> float:
    """Processor time at an error, log-log; infinite where no point is as precise, and that of the
    cheapest where all are more precise."""
    errors, times = np.log(curve[0]), np.log(curve[1])
    return float(np.exp(np.interp(np.log(error), errors, times, left=np.inf)))


def _ratio(ours: float, theirs: float) -> float | None:
    return round(theirs / ours, 1) if np.isfinite(theirs) and np.isfinite(ours) else None


def _short(value: float) -> float | None:
    return float(f"{value:.3g}") if np.isfinite(value) else None
