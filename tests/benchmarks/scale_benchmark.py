"""Growth of processor time with the size of the problem, as slopes in log-log axes."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from time import process_time
from typing import Any, NamedTuple

import fe_benchmark
import numpy as np
from settled import Settled

import flexcage
from flexcage.solve import bdf

WINDOW = 3e-3  # [s] after the settled state
REPEATS = 3
SIZES: dict[str, Sequence[Any]] = {
    "rollers": (11, 16, 22, 28),
    "slices": (7, 15, 31, 61),
    "modes": (10, 24, 50, 100),
    "time_ms": (1.0, 2.0, 4.0, 8.0),
    "nodes": ("coarse", "medium", "fine"),
}
QUICK: dict[str, Any] = {  # whether it runs
    "window": 0.2e-3,
    "sizes": {
        "rollers": (11, 12), "slices": (7, 9), "modes": (6, 8), "time_ms": (0.1, 0.2),
        "nodes": ("coarse", "medium"),
    },
}  # fmt: skip


class Row(NamedTuple):
    """One size: processor time [s], and residuals that the integrator evaluated in it."""

    size: float
    cpu: float
    residuals: int = 0


def measure(
    case: flexcage.Case,
    *,
    plot: Path | None = None,
    window: float = WINDOW,
    sizes: Mapping[str, Sequence[Any]] = SIZES,
) -> dict[str, Any]:
    """All figures that README.md lists, of runs of ``window`` [s]."""
    coarse = case.replace("mesh.fineness", "coarse")  # motion does not feel the mesh
    tables = {
        "rollers": [_run(of_family(coarse, z), z, window) for z in sizes["rollers"]],
        "slices": [_run(_sliced(coarse, n), n, window) for n in sizes["slices"]],
        "modes": [_run(coarse.replace("modes.count", n), n, window) for n in sizes["modes"]],
        "time_ms": [_run(coarse, ms, ms * 1e-3) for ms in sizes["time_ms"]],
        "nodes": [_reduced(case.replace("mesh.fineness", name)) for name in sizes["nodes"]],
    }
    if plot is not None:
        draw(tables, plot)
    runs = ("rollers", "slices", "modes", "time_ms")
    return {
        **{f"slope_{name}": slope(rows, lambda r: r.cpu) for name, rows in tables.items()},
        **{
            f"slope_{name}_per_residual": slope(tables[name], lambda r: r.cpu / r.residuals)
            for name in runs[:-1]
        },
        "columns": ["size", "cpu_s", "residuals"],
        **{name: [[r.size, round(r.cpu, 4), r.residuals] for r in tables[name]] for name in tables},
        "window_ms": window * 1e3,
    }


def slope(rows: Sequence[Row], value: Callable[[Row], float]) -> float:
    """Exponent of a power law fitted to values over sizes."""
    sizes, values = np.log([[r.size, value(r)] for r in rows]).T
    return round(float(np.polyfit(sizes, values, 1)[0]), 2)


def of_family(case: flexcage.Case, rollers: int) -> flexcage.Case:
    """The bearing with another number of the same rollers at the same spacing.

    All diameters change by as much as the pitch diameter; speed keeps the races' surface speed,
    load the load of a roller.
    """
    ratio = rollers / case.bearing.roller_count
    wider = case.bearing.pitch_diameter * (ratio - 1.0)
    bearing = ("bore", "outside_diameter", "inner_race_diameter", "outer_race_diameter",
               "rib_diameter")  # fmt: skip
    changes: dict[str, Any] = {
        f"bearing.{name}": getattr(case.bearing, name) + wider for name in bearing
    }
    for name in ("bore", "outside_diameter"):
        changes[f"cage.{name}"] = getattr(case.cage, name) + wider
    return case.replace(
        **changes,
        **{
            "bearing.roller_count": rollers,
            "drive.speed": case.drive.speed / ratio,
            "load.radial": case.load.radial * ratio,
        },
    )


def _sliced(case: flexcage.Case, slices: int) -> flexcage.Case:
    return case.replace(**{f"contacts.{place}.slices": slices for place in ("race", "pocket")})


def _run(case: flexcage.Case, size: float, window: float) -> Row:
    """Processor time of the window [s], from the case's own settled state."""
    settled, stride = Settled(case), case.output.vibration_ratio
    runs = [settled.integrate(window, stride=stride) for _ in range(REPEATS)]
    return Row(size, min(r.cpu for r in runs), int(runs[0].count[bdf.RESIDUALS]))


def _reduced(case: flexcage.Case) -> Row:
    """Processor time from the case to its cage's modes, no cache used."""
    begin = process_time()
    figures = fe_benchmark.measure(case)
    return Row(figures["nodes"], process_time() - begin)


def draw(tables, path: Path) -> None:
    """Processor time against every size, with the fitted slopes."""
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, len(tables), figsize=(16, 3.6), layout="constrained")
    labels = {
        "rollers": "rollers", "slices": "slices of a contact", "modes": "free modes",
        "time_ms": "simulated time [ms]", "nodes": "nodes, mesh to modes",
    }  # fmt: skip
    for axis, (name, rows) in zip(axes, tables.items(), strict=True):
        sizes, times = [r.size for r in rows], [r.cpu for r in rows]
        axis.loglog(sizes, times, "o-")
        axis.loglog(sizes, times[0] * np.array(sizes) / sizes[0], "k:", label="linear")
        axis.set(xlabel=labels[name], title=f"slope {slope(rows, lambda r: r.cpu)}")
        axis.set_xticks(sizes, [f"{size:g}" for size in sizes])
        ends = [times[0], times[-1]]
        axis.set_yticks(ends, [f"{time:.2g}" for time in ends])
        axis.minorticks_off()
        axis.grid(alpha=0.3)
    axes[0].set_ylabel("processor time [s]")
    axes[0].legend()
    figure.savefig(path, dpi=130)
    plt.close(figure)
