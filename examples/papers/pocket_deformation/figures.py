"""The paper's figures from what was computed, laid out as the paper has them: its conditions
overlaid on one axis."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from math import pi
from pathlib import Path

import numpy as np
from claims import BENT1, BENT2, CROSSBEAM, LONGER, SHORTER, SOUND
from judging.panels import Panel, kept, sheets_of
from judging.pictures import COLOURS, Curve, overlaid
from judging.readings import Reading
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


def roller_speed(roller: int) -> Curve:
    """Speed of a roller [rpm] over time [ms], positive as in rolling."""

    def curve(run: Run) -> tuple[np.ndarray, np.ndarray]:
        spin = element_spin(run.dataset).sel(element=roller).values * RPM
        return run.dataset["time"].values * 1e3, spin

    return curve


@dataclass(frozen=True)
class Rows:
    """Rows of panels of the runs that were kept: ``readings`` by column."""

    readings: Mapping[str, Reading]

    def over_time(self, word: str, unit: str, curve: Curve, cages: Sequence[str]) -> list[Panel]:
        """One curve a cage, overlaid; one panel a reading."""

        def draw(ax: Axes, column: str) -> None:
            there = self.readings[column].among({c: NAMES[c] for c in cages})
            overlaid(ax, self.readings[column], there, curve)
            last_half(ax, self.readings[column].run(cages[0]))
            if curve is corner:
                with_printed(ax, SHORTER in there)

        scale = "" if curve is shake else unit
        return [Panel(f"{word}, {READINGS[c]}", "time / ms", unit, partial(draw, column=c), scale)
                for c in self.readings]  # fmt: skip

    def orbits(self, column: str, cages: Sequence[str]) -> list[Panel]:
        """Orbits of the cage's centre of a reading, one panel a cage."""

        def draw(ax: Axes, cage: str) -> None:
            run = self.readings[column].run(cage)
            yz = metrics.orbit(metrics.settled(run.dataset, run.case.output.settle)) * UM
            ax.plot(yz[:, 1], -yz[:, 0], color=COLOURS[1], lw=0.7)
            ring = np.exp(1j * np.linspace(0.0, 2.0 * pi, 200)) * run.case.land.clearance * UM
            ax.plot(ring.real, ring.imag, color="0.6", lw=0.8, ls="--")
            ax.set(aspect="equal", xlim=(-420, 420), ylim=(-420, 420))

        short = READINGS[column].split()[0]
        return [Panel(f"{NAMES[c]}, {short}", "across the load / um", "up / um",
                      partial(draw, cage=c), square=True) for c in cages]  # fmt: skip

    def rollers(self, cages: Sequence[str]) -> list[Panel]:
        """Speeds of rollers j-1, j and j+1 of the first reading: one panel a roller."""
        reading = next(iter(self.readings.values()))

        def draw(ax: Axes, roller: int) -> None:
            overlaid(ax, reading, reading.among({c: NAMES[c] for c in cages}), roller_speed(roller))
            last_half(ax, reading.run(cages[0]))

        return [Panel(f"roller {n}", "time / ms", "speed / rpm", partial(draw, roller=k), "rpm")
                for k, n in ROLLERS.items()]  # fmt: skip


def last_half(ax: Axes, run: Run) -> None:
    """Show the settled half of a record."""
    time = run.dataset["time"].values[-1] * 1e3
    ax.set_xlim(0.5 * time, time)


def with_printed(ax: Axes, shown: bool) -> None:
    """Stress over decades, with the printed number where the shorter pocket is ``shown``."""
    ax.set(yscale="log", ylim=(0.5, 2000.0))
    if shown:
        ax.axhline(ROOT, color=sheet.INK, ls="--", lw=1.0)
        ax.annotate("printed", (0.02, ROOT), xycoords=("axes fraction", "data"), fontsize=8)


def draw(computed, folder: Path) -> dict[str, str]:
    """All pictures by the figures that they repeat."""
    rows = Rows(computed.readings)
    first, last = list(computed.readings)

    def stress(cages: Sequence[str]) -> list[list[Panel]]:
        return [rows.over_time("stress", "stress / MPa", corner, cages),
                rows.over_time("displacement", "distance / um", radial, cages)]  # fmt: skip

    def shakes(cages: Sequence[str]) -> list[list[Panel]]:
        return [rows.over_time("acceleration", "m/s²", shake, cages),
                rows.over_time("cage speed", "speed / rpm", cage_speed, cages)]  # fmt: skip

    sheets = sheets_of(folder, {
        "8_9": lambda: stress(CROSSBEAM),
        "10": lambda: [rows.orbits(c, CROSSBEAM) for c in (first, last)],
        "11_12": lambda: shakes(CROSSBEAM), "13": lambda: [rows.rollers(CROSSBEAM)],
        "14_15": lambda: stress(SIDE), "16": lambda: [rows.orbits(c, SIDE) for c in (first, last)],
        "17_18": lambda: shakes(SIDE), "19": lambda: [rows.rollers(SIDE)],
    })  # fmt: skip
    return sheets | {"pinch": kept(folder / "pinch.png", partial(pinch, computed, folder))}
