"""The paper's figures from what was computed, laid out as the paper has them: its conditions
overlaid on one axis, orbits beside each other on one scale."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import pi
from pathlib import Path

import numpy as np
from claims import LOADS, RAMPS, SPEEDS, WAVES
from judging.panels import Panel, arrow, kept, sheets_of
from judging.pictures import bands, overlaid, rendered, starts
from matplotlib.axes import Axes
from outputs import mass_centre

import flexcage
from flexcage import Run
from flexcage.render import sheet
from flexcage.results import metrics

PRINTED = tomllib.loads((Path(__file__).with_name("printed.toml")).read_text("utf-8"))
UM, PERCENT, RPM, DEG = 1e6, 100.0, 30.0 / pi, 180.0 / pi
READINGS = {"printed": "as printed", "better": "better model"}
TINTS = {"printed": sheet.INK, "better": sheet.GREEN}
ALL_SPEEDS = {n: f"{int(n):,} rpm" for n in ("4000", "6000", "8000", "10000", "12000")}
FEW_SPEEDS = {n: ALL_SPEEDS[n] for n in SPEEDS}
ALL_LOADS = {"8000": "5,000 N", "radial 9000 N": "9,000 N", LOADS[1]: "12,500 N"}
STEPS = {f"both {step}": f"{step} mm" for step in ("0.02", "0.08", "0.14")}
WAVE_NAMES, RAMP_NAMES = ({name: name for name in names} for names in (WAVES, RAMPS))

Curve = Callable[[Run], tuple[np.ndarray, np.ndarray]]


def settled(run: Run):
    """The settled part of a run."""
    return metrics.settled(run.dataset, run.case.output.settle)


def by_place(name: str, race: int = 0) -> Curve:
    """A variable of one ball at a race over its place from the load [deg], as it passes, in the
    order of time; lines are broken where a turn begins. An angle is there while it touches."""

    def curve(run: Run) -> tuple[np.ndarray, np.ndarray]:
        ds = settled(run)
        psi = ds["element_position"].sel(cyl="psi").isel(element=0).values
        at = np.degrees(np.mod(psi - run.case.load.direction + pi, 2.0 * pi) - pi)
        value = ds[name].isel(element=0, race=race).values.astype(float)
        if name == "contact_angle":
            touch = ds["race_force"].isel(element=0, race=race).values > 0.0
            value = np.where(touch, value * DEG, np.nan)
        value[1:][np.abs(np.diff(at)) > 180.0] = np.nan
        return at, value

    return curve


def in_equilibrium(ax: Axes, run: Run, race: int, *, angle: bool) -> None:
    """The static solution (equations 8 to 12) over the place from the load [deg]."""
    found = flexcage.solve_static(run.case).elements
    at = np.degrees(np.mod(found.azimuth - run.case.load.direction + pi, 2.0 * pi) - pi)
    values = found.angle[:, race] * DEG if angle else found.force[:, race]
    order = np.argsort(at)
    label = None if ax.lines else "equilibrium"
    ax.plot(at[order], values[order], "o", ms=2.5, color="0.35", zorder=4, label=label)


def cage_speed(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Speed of the cage [rpm] over time [ms]."""
    return run.dataset["time"].values * 1e3, run.dataset["cage_omega"].sel(axis="x").values * RPM


def ring_speed(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Speed of the inner ring [rpm] over time [ms], settled."""
    ds = settled(run)
    return ds["time"].values * 1e3, ds["inner_speed"].values * RPM


def axial(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Axial displacement of the inner ring from that at the start [um] over time [ms]."""
    x = run.dataset["inner_position"].sel(axis="x").values
    return run.dataset["time"].values * 1e3, (x - x[0]) * UM


def slip(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Slip of the cage [%] over time [ms], settled."""
    ds = settled(run)
    ideal = run.numbers.nominal.kinematics(1.0).cage_speed * ds["inner_speed"].values
    return ds["time"].values * 1e3, (1.0 - ds["cage_omega"].sel(axis="x").values / ideal) * PERCENT


def force(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Force of one ball on the inner ring [N] over time [ms]."""
    found = run.dataset["race_force"].isel(element=0, race=0).values
    return run.dataset["time"].values * 1e3, found


@dataclass(frozen=True)
class Pictures:
    """Draws what was computed, sheet by sheet, into a folder."""

    computed: object
    folder: Path

    def row(self, names: Mapping[str, str], curve: Curve, unit: str, *, below: str = "time / ms",
            title: str = "", static: int | None = None) -> list[Panel]:  # fmt: skip
        """A panel a reading: conditions overlaid, and where ``static`` names a race its
        equilibrium under every condition."""

        def draw(column: str) -> Callable[[Axes], None]:
            def drawn(ax: Axes) -> None:
                reading = self.computed.readings[column]
                if static is not None:
                    for c in reading.among(names):
                        in_equilibrium(ax, reading.run(c), static, angle="deg" in unit)
                    ax.set(xlim=(-180, 180), xticks=(-180, -90, 0, 90, 180))
                overlaid(ax, reading, reading.among(names), curve)

            return drawn

        scale = f"{title} {unit} {below}"
        return [
            Panel(f"{title}{READINGS[c]}", below, unit, draw(c), scale)
            for c in self.computed.readings
        ]

    def forces(self, names: Mapping[str, str], title: str) -> list[Panel]:
        """One ball's force on the inner ring over its place: a panel a reading."""
        return self.row(names, by_place("race_force"), "force / N", title=title, static=0,
                        below="place from the load / deg")  # fmt: skip

    def angles(self, names: Mapping[str, str], title: str) -> list[Panel]:
        """Contact angles of one ball over its place, of the better reading: a panel a race."""
        column = list(self.computed.readings)[-1]

        def draw(race: int) -> Callable[[Axes], None]:
            def drawn(ax: Axes) -> None:
                reading = self.computed.readings[column]
                for c in reading.among(names):
                    in_equilibrium(ax, reading.run(c), race, angle=True)
                overlaid(ax, reading, reading.among(names), by_place("contact_angle", race))
                ax.set(xlim=(-180, 180), xticks=(-180, -90, 0, 90, 180))

            return drawn

        below, unit = "place from the load / deg", "angle / deg"
        return [Panel(f"{title}{race} race", below, unit, draw(k)) for k, race in
                enumerate(("inner", "outer"))]  # fmt: skip

    def orbits(self, names: Mapping[str, str], title: str, column: str) -> list[Panel]:
        """Orbits of the cage's mass centre, a panel a condition, all on one scale about their
        middles."""
        reading, found = self.computed.readings[column], {}
        for c in reading.among(names):
            run = reading.run(c)
            found[c] = mass_centre(settled(run), run)[0] * UM * (-1.0, 1.0)
        middles = {c: 0.5 * (yz.max(axis=0) + yz.min(axis=0)) for c, yz in found.items()}
        reach = 0.55 * max((np.ptp(yz, axis=0).max() for yz in found.values()), default=1.0)

        def draw(c: str) -> Callable[[Axes], None]:
            def drawn(ax: Axes) -> None:
                up, across = middles[c]
                ax.plot(found[c][:, 1], found[c][:, 0], color=TINTS[column], lw=0.6)
                ax.set(xlim=(across - reach, across + reach), ylim=(up - reach, up + reach))

            return drawn

        return [Panel(f"{title}{names[c]}, {READINGS[column]}", "z / um", "up / um", draw(c),
                      square=True) for c in found]  # fmt: skip

    def over(self, output: str, axis: Mapping[str, float], sample: str, factor: float) -> Callable:
        """An output over an axis of conditions: settings and starts of both readings."""

        def drawn(ax: Axes) -> None:
            if sample in self.computed.samples:
                known = self.computed.samples[sample]
                there = {c: at for c, at in axis.items() if c in known.conditions}
                bands(ax, known, output, there, factor)
            for column, reading in self.computed.readings.items():
                starts(ax, reading, output, axis, factor, colour=TINTS[column],
                       label=READINGS[column])  # fmt: skip
            ax.legend(loc="best", fontsize=8, frameon=False)

        return drawn

    def of_waves(self, ax: Axes) -> None:
        """The largest force under each wave of the speed."""
        places = {wave: float(k) for k, wave in enumerate(WAVES)}
        self.over("peak", places, "waves", 1.0)(ax)
        ax.set_xticks(list(places.values()), list(places))


def draw(computed, folder: Path) -> dict[str, str]:
    """All sheets by the figures that they repeat."""
    p = Pictures(computed, folder)
    columns = list(computed.readings)
    first, last = columns[0], columns[-1]
    speeds = {c: float(c) for c in ALL_SPEEDS}
    loads = {c: float(n.split()[0].replace(",", "")) for c, n in ALL_LOADS.items()}
    steps = {c: float(n.split()[0]) for c, n in STEPS.items()}

    def ratio(axis: Mapping[str, float], sample: str, below: str) -> Panel:
        return Panel("deviation ratio", below, "ratio / %", p.over("deviation", axis, sample,
                     PERCENT))  # fmt: skip

    def block(names, axis, sample, below) -> list[list[Panel]]:
        return [p.forces(names, "Force, "), p.orbits(names, "", first), p.orbits(names, "", last),
                [ratio(axis, sample, below)], p.angles(names, "Angle, ")]  # fmt: skip

    rows = {
        "5_6": lambda: [[Panel("cage speed", "ring speed / rpm", "cage speed / rpm",
                       p.over("speed", speeds, "speeds", RPM))], p.forces(FEW_SPEEDS, "")],
        "7_9": lambda: block(ALL_SPEEDS, speeds, "speeds", "ring speed / rpm")[1:],
        "10_13": lambda: block(ALL_LOADS, loads, "loads", "radial load / N"),
        "14_17": lambda: block(STEPS, steps, "clearance", "clearance of pockets and races / mm"),
        "18_21": lambda: [p.row(WAVE_NAMES, ring_speed, "ring speed / rpm")[:1],
                  p.orbits(WAVE_NAMES, "", first), p.orbits(WAVE_NAMES, "", last),
                  [Panel("largest force", "", "force / N", p.of_waves)],
                  p.row(WAVE_NAMES, axial, "axial place / um"),
                  p.row(WAVE_NAMES, slip, "cage slip / %")],
        "22_25": lambda: [p.orbits(RAMP_NAMES, "", first), p.orbits(RAMP_NAMES, "", last),
                  p.row(RAMP_NAMES, force, "force / N"),
                  p.row(RAMP_NAMES, axial, "axial place / um"),
                  p.row(RAMP_NAMES, cage_speed, "cage speed / rpm")],
    }  # fmt: skip
    path = folder / "bearing.png"
    hero = kept(path, lambda: rendered(computed.readings[last].run(LOADS[1]), "bearing", path))
    return {"sketch": sketch(folder / "sketch.png"), "bearing": hero, **sheets_of(folder, rows)}


def sketch(path: Path) -> str:
    """The bearing in section and from the side, with the symbols of the page; the file's name."""
    with sheet.style():
        figure = sheet.new_figure(900, 430)
        sheet.heading(figure, "Bearing, loads and what is read", "")
        section = sheet.axes_at(figure, (60, 100, 360, 290))
        along_the_axis = sheet.axes_at(figure, (480, 100, 360, 290))
        draw_section(section)
        draw_front(along_the_axis)
        for ax in (section, along_the_axis):
            ax.set(aspect="equal")
            ax.axis("off")
        sheet.save(figure, path)
    return path.name


def draw_section(ax: Axes) -> None:
    """A ball between its grooves, and the contact angles."""
    turn, lean, gap = np.linspace(0.0, 2.0 * pi, 200), 0.3, 0.1
    ax.fill(np.cos(turn), np.sin(turn), color="0.85")
    for sign, text, colour in ((1.0, "outer race: Q_e, α_e", sheet.BLUE),
                               (-1.0, "inner race: Q_i, α_i", sheet.VERMILION)):  # fmt: skip
        to = sign * np.array([np.sin(lean), np.cos(lean)])
        arc = np.arctan2(to[1], to[0]) + np.linspace(-0.8, 0.8, 60)
        groove = -gap * to[:, None] + (1.0 + gap) * np.stack([np.cos(arc), np.sin(arc)])
        ax.plot(*groove, color=colour, lw=2.0)
        ax.plot([0.0, 1.5 * to[0]], [0.0, 1.5 * to[1]], color=colour, lw=0.9, ls="--")
        ax.text(*(1.65 * to), text, color=colour, fontsize=9, ha="center", va="center")
    ax.plot([0.0, 0.0], [-1.5, 1.5], color="0.6", lw=0.8)
    arrow(ax, (-2.2, -1.1), (-1.2, -1.1), "axial load F_x")
    arrow(ax, (1.9, 0.5), (1.9, -0.6), "radial load F_r")
    ax.plot([-2.4, 2.4], [-2.2, -2.2], color="0.6", lw=0.8, ls="-.")
    ax.text(2.4, -2.15, "axis x", fontsize=9, ha="right", va="bottom")
    ax.set(xlim=(-2.8, 2.8), ylim=(-2.4, 2.0))


def draw_front(ax: Axes) -> None:
    """Rings, balls and cage along the axis: the load, a ball's place, the cage's mass centre."""
    turn = np.linspace(0.0, 2.0 * pi, 300)
    for radius, colour in ((1.45, sheet.BLUE), (1.0, sheet.VERMILION), (1.22, "0.6")):
        ax.plot(radius * np.cos(turn), radius * np.sin(turn), color=colour, lw=1.4)
    for k in range(18):
        at = 2.0 * pi * k / 18
        ax.fill(1.22 * np.cos(at) + 0.16 * np.cos(turn), 1.22 * np.sin(at) + 0.16 * np.sin(turn),
                color="0.8")  # fmt: skip
    arrow(ax, (0.0, 0.55), (0.0, -0.55), "F_r")
    ax.plot(0.12, -0.08, "x", color=sheet.GREEN, ms=9, mew=2)
    ax.text(0.2, -0.12, "mass centre", color=sheet.GREEN, fontsize=9, va="top")
    ax.annotate("place 0", (0.0, -1.45), (0.0, -1.85), ha="center", fontsize=9)
    ax.annotate("place 90", (1.45, 0.0), (1.55, 0.0), va="center", fontsize=9)
    ax.set(xlim=(-2.2, 2.2), ylim=(-2.0, 1.6))
