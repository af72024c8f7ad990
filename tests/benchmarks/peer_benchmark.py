"""Work and precision of flexcage's integrator and of others on one residual, from some states."""

from __future__ import annotations

import logging
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from importlib.util import find_spec
from pathlib import Path
from typing import Any

import exudyn_benchmark
import numpy as np
from peers import Path as Integration
from peers import Peers
from settled import NUDGE, Forces, Settled
from solver_benchmark import COUNTS, LOOSER, REFERENCE, kernel_times, second_method

import flexcage

log = logging.getLogger(__name__)

STATES = 4  # the calmest: one window by itself makes a ratio half or twice as large
WINDOW = 1e-3  # [s] from a stored state: later, no reference of the cage's forces stands
EQUAL = 1e-2  # force error at which processor times are compared
LEVELS = {"larger": (1e-1, 3e-2, 1e-2), "race": (1e-2, 3e-3, 1e-3, 3e-4, 1e-4)}
REPEATS = 3
FLEXCAGE = "flexcage"
PEERS = {  # key of the ratio: curves of which the cheapest counts
    "ida": ("IDA, order 2", "IDA, order 5"),
    "ida_dense": ("IDA, dense matrix",),
    "ida_alone": ("IDA, differences",),
    "scipy_bdf": ("SciPy BDF",),
    "scipy_bdf_alone": ("SciPy BDF, differences",),
    "scipy_radau": ("SciPy Radau",),
    "lsoda": ("LSODA",),
    "bdf": ("flexcage BDF, order 2", "flexcage BDF, order 5"),
}
SHARES = (10.0, 3.0, 1.0, 0.3, 0.1, 0.03, 0.01, 3e-3, 1e-3, 3e-4)  # of the default tolerance
QUICK: dict[str, Any] = {  # whether it runs
    "window": 0.15e-3, "calm": 0, "shares": (1.0, 0.1), "repeats": 1,
    "exudyn": exudyn_benchmark.QUICK,
}  # fmt: skip
MARKS, COLORS = "osDdPXH^>v<", (*(f"C{i}" for i in range(10)), "black")  # of the curves drawn
GROUPS: dict[str, Callable[[tuple[float, float]], float]] = {
    "larger": max, "race": lambda error: error[0], "cage": lambda error: error[1],
}  # fmt: skip

Method = tuple[Callable[[Peers, float], Integration], Sequence[float]]  # and its shares or steps


@dataclass(frozen=True)
class Point:
    """One integration, or the mean of those from all states (errors: root mean square): its
    tolerance's share or step, processor time [s per ms], errors, counts."""

    level: float
    cpu: float
    error: tuple[float, float]  # races, cage
    steps: int
    residuals: int
    jacobians: int

    def row(self) -> list[float]:
        """As printed."""
        values = (self.level, self.cpu, *self.error)
        return [*(float(f"{v:.3g}") for v in values), self.steps, self.residuals, self.jacobians]


def measure(
    case: flexcage.Case,
    *,
    plot: Path | None = None,
    window: float = WINDOW,
    calm: int = STATES,
    shares: Sequence[float] | None = None,
    repeats: int = REPEATS,
    exudyn: Mapping[str, Any] | None = None,
) -> dict[str, Any]:
    """All figures that README.md lists; ``shares`` instead of every method's own, ``exudyn``:
    options of that part."""
    if find_spec("sksundae") is None:
        raise SystemExit("peer needs SUNDIALS: install scikit-sundae, as the extra 'peer' does")
    settled = Settled(case, calm=calm)
    methods = _methods()
    if shares is not None:
        methods = {name: (method, shares) for name, (method, _) in methods.items()}
    apart: dict[str, list] = {"tolerance_next": [], "second_method": [], "nudged": []}
    found = []
    for state in settled.states:
        settled.stored = state
        peers = Peers(settled, window)
        reference = settled.window(window, **REFERENCE)
        others = (
            settled.window(window, **LOOSER),
            second_method(settled, peers.times),
            settled.window(window, **REFERENCE, aside=NUDGE),
        )
        for errors, other in zip(apart.values(), others):
            errors.append(_short(other.error(reference)))
        found.append(_curves(peers, reference, methods, repeats))
    curves = _together(found)
    if plot is not None:
        draw(curves, plot)
    return {
        **{f"{key}_ratio": ratio(curves, names, EQUAL) for key, names in PEERS.items()},
        **exudyn_benchmark.measure(**(exudyn or {})),
        "equal_error": EQUAL,
        "ratios_by_error": {
            f"{group} {level:g}": {
                key: ratio(curves, names, level, group=group) for key, names in PEERS.items()
            }
            for group, levels in LEVELS.items()
            for level in levels
        },
        "window_ms": window * 1e3,
        "reference": apart,
        "columns": ["share or step", "cpu_s_per_ms", "error_race", "error_cage", "steps",
                    "residuals", "jacobians"],
        "curves": {name: [p.row() for p in points] for name, points in curves.items()},
        **kernel_times(settled, window),
    }  # fmt: skip


def _methods() -> dict[str, Method]:
    """Each integrator and the tolerances, as shares of the default, or steps that it takes."""

    def scipy(method: str, own: bool = False) -> Callable[[Peers, float], Integration]:
        return lambda peers, share: peers.scipy(share, method=method, own=own)

    return {
        "flexcage": (_flexcage, SHARES),
        "flexcage BDF, order 2": (lambda p, share: _flexcage(p, share, method="bdf"), SHARES),
        "flexcage BDF, order 5": (
            lambda p, share: _flexcage(p, share, method="bdf", max_order=5), SHARES,
        ),
        "IDA, order 2": (lambda p, share: p.ida(share, max_order=2), SHARES),
        "IDA, order 5": (lambda p, share: p.ida(share, max_order=5), SHARES),
        "IDA, dense matrix": (
            lambda p, share: p.ida(share, max_order=5, matrix="dense"), SHARES[1:-1],
        ),
        "IDA, differences": (
            lambda p, share: p.ida(share, max_order=5, matrix="own"), SHARES[2:-1],
        ),
        "SciPy BDF": (scipy("BDF"), SHARES[2:]),
        "SciPy BDF, differences": (scipy("BDF", own=True), SHARES[2:]),
        "SciPy Radau": (scipy("Radau"), SHARES[1:9:2]),
        "LSODA": (scipy("LSODA"), SHARES[1:]),
    }  # fmt: skip


def _flexcage(peers: Peers, share: float, **options: Any) -> Integration:
    """The bearing's own integrator: its time as a run samples, its states in full at every one."""
    stride = peers.settled.case.output.vibration_ratio
    cpu = peers.settled.integrate(peers.duration, stride=stride, share=share, **options).cpu
    out = peers.settled.integrate(peers.duration, stride=1, share=share, **options)
    steps, residuals, jacobians = (
        int(out.count[COUNTS[name]]) for name in ("steps", "residuals", "factorisations")
    )
    return Integration(cpu, residuals, jacobians, steps, out.ys, out.yds)


def _forces(peers: Peers, path: Integration) -> Forces:
    return peers.settled.forces(path.ys, path.yds, peers.times)


def _curves(
    peers: Peers, reference: Forces, methods: Mapping[str, Method], repeats: int
) -> dict[str, list[Point]]:
    """All curves, each point at its least processor time of several rounds through them all."""
    found: dict[str, dict[float, Point]] = {name: {} for name in methods}
    for _ in range(repeats):
        for name, (method, levels) in methods.items():
            for level in levels:
                try:
                    path = method(peers, level)
                except RuntimeError as error:
                    log.warning("%s at %g is left out: %s", name, level, error)
                    continue
                cpu, before = path.cpu / (peers.duration * 1e3), found[name].get(level)
                if before is not None:
                    found[name][level] = replace(before, cpu=min(cpu, before.cpu))
                    continue
                error = _forces(peers, path).error(reference)
                found[name][level] = Point(
                    level, cpu, error, path.steps, path.residuals, path.jacobians
                )
    return {
        name: [p for p in points.values() if np.isfinite(p.error).all()]
        for name, points in found.items()
    }


def _together(states: Sequence[Mapping[str, list[Point]]]) -> dict[str, list[Point]]:
    """Every method's mean points, of those levels at which it succeeded from all states."""

    def mean(points: Sequence[Point]) -> Point:
        errors = np.sqrt(np.mean(np.square([p.error for p in points]), axis=0)).tolist()
        counts = np.mean([(p.steps, p.residuals, p.jacobians) for p in points], axis=0)
        steps, residuals, jacobians = counts.round().astype(int).tolist()
        return Point(
            points[0].level, float(np.mean([p.cpu for p in points])), (errors[0], errors[1]),
            steps, residuals, jacobians,
        )  # fmt: skip

    together: dict[str, list[Point]] = {}
    for name, first in states[0].items():
        own = [{p.level: p for p in curves[name]} for curves in states]
        levels = [p.level for p in first if all(p.level in points for points in own)]
        together[name] = [mean([points[level] for points in own]) for level in levels]
    return together


def cost(points: Sequence[Point], level: float, group: str) -> float:
    """Processor time at an error: log-log between the points that no cheaper one betters.

    Infinite where no point is as precise, and not a number where all are more precise.
    """
    best: list[tuple[float, float]] = []
    for point in sorted(points, key=lambda p: p.cpu):
        error = GROUPS[group](point.error)
        if not best or error < best[-1][0]:
            best.append((error, point.cpu))
    errors, times = np.log(np.array(best[::-1])).T
    return float(np.exp(np.interp(np.log(level), errors, times, left=np.inf, right=np.nan)))


def ratio(curves, names: Sequence[str], level: float, *, group: str = "larger") -> float | None:
    """The others' least processor time over flexcage's at an error; None where a curve ends."""
    ours = cost(curves[FLEXCAGE], level, group)
    theirs = [cost(curves[name], level, group) for name in names]
    found = [c for c in theirs if np.isfinite(c)]
    return round(min(found) / ours, 2) if found and np.isfinite(ours) else None


def _short(error: tuple[float, float]) -> list[float]:
    return [float(f"{e:.2e}") for e in error]


def draw(curves, path: Path) -> None:
    """Work-precision plot: error of the races' and of the cage's forces against processor time."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, 2, figsize=(11, 4.8), sharey=True, layout="constrained")
    for axis, group in zip(axes, ("race", "cage"), strict=True):
        for (name, points), mark, color in zip(curves.items(), MARKS, COLORS, strict=True):
            errors, cpu = [GROUPS[group](p.error) for p in points], [p.cpu for p in points]
            axis.loglog(errors, cpu, marker=mark, color=color, ms=4, lw=1, label=name)
        axis.invert_xaxis()
        axis.set(xlabel=f"error of the {group} forces", title=f"{group} forces, first millisecond")
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("processor time per simulated ms [s]")
    handles, labels = axes[0].get_legend_handles_labels()
    figure.legend(handles, labels, fontsize=8, loc="outside right upper")
    figure.savefig(path, dpi=130)
    plt.close(figure)
