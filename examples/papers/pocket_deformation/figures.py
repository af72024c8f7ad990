"""The paper's figures from what was computed, laid out as the paper has them: its conditions
overlaid on one axis."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Sequence
from functools import partial
from math import pi
from pathlib import Path

import numpy as np
from claims import BENT1, BENT2, CROSSBEAM, LONGER, SHORTER, SOUND
from judging.panels import Panel, kept, sheet_of
from judging.pictures import COLOURS, overlaid
from matplotlib.axes import Axes
from mesh_error import pinch
from outputs import AFTER, AT, BEFORE, PLACES

from flexcage import Run
from flexcage.render import sheet
from flexcage.results import metrics
from flexcage.results.slip import element_spin

PRINTED = tomllib.loads((Path(__file__).with_name("printed.toml")).read_text("utf-8"))
ROOT = PRINTED["conclusion_2"]["root"][SHORTER]  # MPa
RPM, UM, MPA = 30.0 / pi, 1e6, 1e-6
SIDE = (SOUND, LONGER, SHORTER)
NAMES = {
    SOUND: "undeformed", BENT1: "crossbeam 0.1 mm", BENT2: "crossbeam 0.2 mm",
    LONGER: "side beam +0.3 mm", SHORTER: "side beam -0.3 mm",
}  # fmt: skip
ROLLERS = {BEFORE: "j-1", AT: "j", AFTER: "j+1"}
READINGS = {"hertz": "Hertz contacts", "adams": "IMPACT by ADAMS' defaults"}


def corner(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Largest stress at corners of pockets j-1 and j [MPa] over time [ms]."""
    history = run.stress_history
    here = [k for k, name in enumerate(history.place_names) if name.startswith(PLACES)]
    return run.dataset["time"].values * 1e3, history.places[:, here].max(axis=1) * MPA


def radial(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Distance of the cage's centre from the axis [um] over time [ms]."""
    away = metrics.whirl_radius(run.dataset, about="axis") * UM
    return run.dataset["time"].values * 1e3, away


def shake(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Acceleration of the outer ring along the load [m/s^2], low-passed, over time [ms]."""
    values = run.dataset["outer_acceleration_filtered"].sel(axis2="y")
    return values["time_hf"].values * 1e3, values.values


def cage_speed(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Speed of the cage [rpm] over time [ms]."""
    return run.dataset["time"].values * 1e3, run.dataset["cage_omega"].sel(axis="x").values * RPM


def roller_speed(roller: int) -> Callable[[Run], tuple[np.ndarray, np.ndarray]]:
    """Speed of a roller [rpm] over time [ms], positive as in rolling."""

    def curve(run: Run) -> tuple[np.ndarray, np.ndarray]:
        spin = element_spin(run.dataset).sel(element=roller).values * RPM
        return run.dataset["time"].values * 1e3, spin

    return curve


def in_a_row(
    path: Path, title: str, columns: Sequence[str], unit: str, draw: Callable[[Axes, str], None],
    *, below: str = "time / ms",
) -> str:  # fmt: skip
    """Panels, one a column, on one scale; the file's name."""
    row = [Panel(READINGS.get(c, c), below, unit, partial(draw, column=c), unit) for c in columns]
    return kept(path, lambda: sheet_of(path, title, [row]))


def over_time(computed, folder: Path, name: str, title: str, unit: str, curve, cages) -> str:
    """One curve a cage, overlaid; one panel a reading."""
    readings = computed.readings

    def draw(ax: Axes, column: str) -> None:
        there = readings[column].among({c: NAMES[c] for c in cages})
        overlaid(ax, readings[column], there, curve)
        time, _ = curve(readings[column].run(cages[0]))
        ax.set_xlim(0.5 * time[-1], time[-1])
        if curve is corner and SHORTER in there:
            ax.axhline(ROOT, color=sheet.INK, ls="--", lw=1.0)
            ax.annotate("printed", (0.51 * time[-1], ROOT), va="bottom", fontsize=8)

    return in_a_row(folder / f"{name}.png", title, list(readings), unit, draw)


def orbits(computed, folder: Path, name: str, title: str, cages) -> str:
    """Orbits of the cage's centre, one panel a cage, of the first reading."""
    reading = next(iter(computed.readings.values()))

    def draw(ax: Axes, column: str) -> None:
        run = reading.run(column)
        yz = metrics.orbit(metrics.settled(run.dataset, run.case.output.settle)) * UM
        ax.plot(yz[:, 1], -yz[:, 0], color=COLOURS[1], lw=0.7)
        ring = np.exp(1j * np.linspace(0.0, 2.0 * pi, 200)) * run.case.land.clearance * UM
        ax.plot(ring.real, ring.imag, color="0.6", lw=0.8, ls="--")
        ax.set(aspect="equal", xlim=(-380, 380), ylim=(-280, 280))

    return in_a_row(
        folder / f"{name}.png", title, list(cages), "down / um", draw, below="across the load / um"
    )


def roller_speeds(computed, folder: Path, name: str, title: str, cages) -> str:
    """Speeds of rollers j-1, j and j+1: one panel a roller, one curve a cage."""
    reading = next(iter(computed.readings.values()))

    def draw(ax: Axes, column: str) -> None:
        roller = next(k for k, n in ROLLERS.items() if n == column)
        there = reading.among({c: NAMES[c] for c in cages})
        overlaid(ax, reading, there, roller_speed(roller))
        time = reading.run(cages[0]).dataset["time"].values * 1e3
        ax.set_xlim(0.5 * time[-1], time[-1])

    return in_a_row(folder / f"{name}.png", title, list(ROLLERS.values()), "speed / rpm", draw)


def draw(computed, folder: Path) -> dict[str, str]:
    """All pictures by the figure that they repeat."""
    histories = (
        (
            "8",
            "Figure 8: equivalent stress, displaced crossbeam",
            "stress / MPa",
            corner,
            CROSSBEAM,
        ),
        ("9", "Figure 9: radial displacement of the cage", "distance / um", radial, CROSSBEAM),
        ("11", "Figure 11: acceleration of the outer ring", "m/s²", shake, CROSSBEAM),
        ("12", "Figure 12: cage speed", "speed / rpm", cage_speed, CROSSBEAM),
        ("14", "Figure 14: equivalent stress, displaced side beam", "stress / MPa", corner, SIDE),
        ("15", "Figure 15: radial displacement of the cage", "distance / um", radial, SIDE),
        ("17", "Figure 17: acceleration of the outer ring", "m/s²", shake, SIDE),
        ("18", "Figure 18: cage speed", "speed / rpm", cage_speed, SIDE),
    )
    found = {
        key: over_time(computed, folder, f"figure_{key}", title, unit, curve, cages)
        for key, title, unit, curve, cages in histories
    }
    found["10"] = orbits(computed, folder, "figure_10", "Figure 10: orbit, crossbeam", CROSSBEAM)
    found["16"] = orbits(computed, folder, "figure_16", "Figure 16: orbit, side beam", SIDE)
    found["13"] = roller_speeds(
        computed, folder, "figure_13", "Figure 13: roller speeds, crossbeam", CROSSBEAM
    )
    found["19"] = roller_speeds(
        computed, folder, "figure_19", "Figure 19: roller speeds, side beam", SIDE
    )
    return found | {"pinch": kept(folder / "pinch.png", partial(pinch, computed, folder))}
