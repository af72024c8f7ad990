"""The paper's figures from what was computed, laid out as the paper has them: cage speeds overlaid,
orbits and forces a panel a condition, on one scale; numbers that it prints are marked."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import cos, pi, sin
from pathlib import Path

import numpy as np
from claims import A3, A6, A9, CONSTANT, N2, N3
from judging.panels import Panel, arrow, kept, sheet_of, sheets_of
from judging.pictures import bands, overlaid, starts
from matplotlib.axes import Axes

from flexcage import Run
from flexcage.render import sheet
from flexcage.results import metrics

PRINTED = tomllib.loads((Path(__file__).with_name("printed.toml")).read_text("utf-8"))
RPM, UM, NM, PERCENT = 30.0 / pi, 1e6, 1e9, 100.0
READINGS = {"printed": "as printed", "better": "better model"}
TINTS = {"printed": sheet.INK, "better": sheet.GREEN}
BY_A = {CONSTANT: 0.0, A3: 3.0, A6: 6.0, A9: 9.0}  # %
BY_N = {CONSTANT: 0.0, A6: 1.0, N2: 2.0, N3: 3.0}
NAMES_A = {c: f"A = {a:.0f} %" for c, a in BY_A.items()}
NAMES_N = {c: f"N = {n:.0f}" for c, n in BY_N.items()}
LEVELS = {
    "LS-DYNA 922": PRINTED["table_5"]["ls_dyna"]["speed"], "test 927": PRINTED["text"]["test"],
    "theory 935": PRINTED["table_5"]["theory"]["speed"],
}  # fmt: skip
LAST = 120.0  # ms that are drawn of a curve over time: four turns of the ring

Curve = Callable[[Run], tuple[np.ndarray, np.ndarray]]


def settled(run: Run):
    """The settled part of a run."""
    return metrics.settled(run.dataset, run.case.output.settle)


def cage_speed(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Speed of the cage [rpm] over time [ms], from the start on."""
    return run.dataset["time"].values * 1e3, run.dataset["cage_omega"].sel(axis="x").values * RPM


def last_of(curve: Curve) -> Curve:
    """The last turns of a curve."""

    def last(run: Run) -> tuple[np.ndarray, np.ndarray]:
        time, values = curve(run)
        late = time >= time[-1] - LAST
        return time[late], values[late]

    return last


def pocket_force(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Largest force between one ball and the cage since the sample before [N] over time [ms]."""
    ds = run.dataset
    return ds["time"].values * 1e3, metrics.pocket_peaks(ds).values.max(axis=2)[:, 0]


def race_force(run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Force of one ball on the inner ring [N] over time [ms]."""
    force = run.dataset["race_force"].sel(race="inner", element=0).values
    return run.dataset["time"].values * 1e3, force


@dataclass(frozen=True)
class Pictures:
    """Panels of what was computed."""

    computed: object

    def row(self, names: Mapping[str, str], curve: Curve, unit: str, *, whole: bool = False,
            marked: bool = False) -> list[Panel]:  # fmt: skip
        """A panel a reading: conditions overlaid, the last turns or all; printed speeds marked."""

        def draw(column: str) -> Callable[[Axes], None]:
            def drawn(ax: Axes) -> None:
                reading = self.computed.readings[column]
                overlaid(ax, reading, reading.among(names), curve if whole else last_of(curve))
                end = max(line.get_xdata()[-1] for line in ax.lines)
                ax.set_xlim(min(line.get_xdata()[0] for line in ax.lines), end)
                for name, value in LEVELS.items() if marked else ():
                    ax.axhline(value, color="0.5", lw=0.8, ls="--")
                    ax.annotate(
                        name,
                        (end, value),
                        fontsize=7,
                        ha="right",
                        va="top" if "theory" in name else "bottom",
                    )
                if marked:
                    ax.set_ylim(900.0, 945.0)

            return drawn

        return [
            Panel(READINGS[c], "time / ms", unit, draw(c), unit) for c in self.computed.readings
        ]

    def orbits(self, names: Mapping[str, str], body: str, column: str, factor: float,
               unit: str) -> list[Panel]:  # fmt: skip
        """Orbits of the cage or of the inner ring about their mean place: a panel a condition, all
        on one scale; the load is down."""
        reading, found = self.computed.readings[column], {}
        for c in reading.among(names):
            yz = metrics.centre_of(settled(reading.run(c)), body) * factor
            found[c] = yz - 0.5 * (yz.min(axis=0) + yz.max(axis=0))
        reach = 1.05 * max((np.abs(yz).max() for yz in found.values()), default=1.0)

        def draw(c: str) -> Callable[[Axes], None]:
            def drawn(ax: Axes) -> None:
                ax.plot(found[c][:, 1], -found[c][:, 0], color=TINTS[column], lw=0.5)
                ax.set(xlim=(-reach, reach), ylim=(-reach, reach))

            return drawn

        return [Panel(f"{names[c]}, {READINGS[column]}", f"z / {unit}", f"-y / {unit}", draw(c),
                      square=True) for c in found]  # fmt: skip

    def pocket_forces(self, names: Mapping[str, str], column: str) -> list[Panel]:
        """Force between one ball and the cage over the last turns, a panel a condition."""

        reading = self.computed.readings[column]

        def draw(c: str) -> Callable[[Axes], None]:
            def drawn(ax: Axes) -> None:
                time, force = last_of(pocket_force)(reading.run(c))
                ax.plot(time, force, color=TINTS[column], lw=0.6)
                ax.set(xlim=(time[0], time[-1]), ylim=(0.0, None))

            return drawn

        return [Panel(f"{names[c]}, {READINGS[column]}", "time / ms", "force / N", draw(c), column,
                      square=True) for c in reading.among(names)]  # fmt: skip

    def over(self, output: str, axis: Mapping[str, float], factor: float, unit: str, below: str,
             table: str = "", against: str = "") -> Panel:  # fmt: skip
        """An output over the conditions: settings, starts of both readings, printed numbers; over
        what each has at the condition ``against``."""

        def drawn(ax: Axes) -> None:
            if "model" in self.computed.samples:
                bands(ax, self.computed.samples["model"], output, axis, factor, against=against)
            for column, reading in self.computed.readings.items():
                starts(ax, reading, output, axis, factor, colour=TINTS[column],
                       label=READINGS[column], against=against)  # fmt: skip
            shown = PRINTED[table][output] if table else {}
            if shown:
                ax.plot([axis[c] for c in shown], list(shown.values()), "^", ms=7, mfc="none",
                        color=sheet.VERMILION, label="printed")  # fmt: skip
            ax.legend(loc="best", fontsize=8, frameon=False)

        return Panel("", below, unit, drawn)


def draw(computed, folder: Path) -> dict[str, str]:
    """All sheets by the figures that they repeat."""
    p = Pictures(computed)
    first = next(iter(computed.readings))
    a, n = "A / %", "N"
    still = {CONSTANT: "constant speed"}

    def speeds(names, axis, table, below) -> list[list[Panel]]:
        return [p.row(names, cage_speed, "cage speed / rpm"),
                [p.over("speed", axis, RPM, "mean speed / rpm", below, table),
                 p.over("swing", axis, PERCENT, "fluctuation A_c / %", below, table)]]  # fmt: skip

    def change(output, what, axis, below) -> Panel:
        return p.over(output, axis, 1.0, f"{what}, constant speed: 1", below,
                      against=CONSTANT)  # fmt: skip

    def cage(names, axis, below) -> list[list[Panel]]:
        return [p.orbits(names, "cage", first, UM, "um"), p.pocket_forces(names, first),
                [change("distance", "distance", axis, below),
                 change("one_force", "force", axis, below)]]  # fmt: skip

    def ring(names, axis, below) -> list[list[Panel]]:
        return [p.orbits(names, "inner", first, NM, "nm"),
                [change("ring_range", "range of orbit", axis, below),
                 change("ripple", "ripple", axis, below)],
                p.row(names, race_force, "force / N")]  # fmt: skip

    rows = {
        "5": lambda: [p.row(still, cage_speed, "cage speed / rpm", whole=True, marked=True)],
        "6": lambda: speeds(NAMES_A, BY_A, "table_6", a), "7_9": lambda: cage(NAMES_A, BY_A, a),
        "10_12": lambda: ring(NAMES_A, BY_A, a), "13": lambda: speeds(NAMES_N, BY_N, "table_7", n),
        "14_19": lambda: [*cage(NAMES_N, BY_N, n), *ring(NAMES_N, BY_N, n)],
    }  # fmt: skip
    hero = kept(folder / "hero.png", lambda: sheet_of(
        folder / "hero.png", "The cage follows the ring", [[p.over(
            "swing", BY_A, PERCENT, "fluctuation of the cage A_c / %",
            "fluctuation of the ring A / %", "table_6",
        )]],
    ))  # fmt: skip
    return {"sketch": sketch(folder / "sketch.png"), "hero": hero, **sheets_of(folder, rows)}


def sketch(path: Path) -> str:
    """The bearing in section, and the ring's speed, with the symbols of the page."""
    with sheet.style():
        figure = sheet.new_figure(900, 400)
        sheet.heading(figure, "Bearing, loads and speed", "")
        section = sheet.axes_at(figure, (60, 90, 360, 270))
        draw_section(section)
        section.set(aspect="equal")
        section.axis("off")
        ax = sheet.axes_at(figure, (520, 110, 330, 210))
        turn = np.linspace(0.0, 2.0, 300)
        for count, colour in ((1, sheet.BLUE), (3, sheet.VERMILION)):
            ax.plot(turn, 1.0 + 0.06 * np.sin(2.0 * pi * count * turn), color=colour,
                    label=f"N = {count}")  # fmt: skip
        ax.axhline(1.0, color="0.6", lw=0.8)
        ax.set(xlabel="turns of the ring", ylabel="n_i / n_0", ylim=(0.9, 1.14))
        ax.annotate("A", (0.27, 1.03), fontsize=11)
        ax.legend(fontsize=8, frameon=False, loc="upper right", ncol=2)
        sheet.save(figure, path)
    return path.name


def draw_section(ax: Axes) -> None:
    """A ball between its races at 60 degrees, the loads, the pitch circle."""
    turn, lean = np.linspace(0.0, 2.0 * pi, 200), pi / 3.0
    ax.fill(np.cos(turn), np.sin(turn), color="0.85")
    to = np.array([sin(lean), cos(lean)])
    for sign, text, colour in ((1.0, "outer race", sheet.BLUE),
                               (-1.0, "inner race", sheet.VERMILION)):  # fmt: skip
        arc = np.arctan2(sign * to[1], sign * to[0]) + np.linspace(-0.7, 0.7, 60)
        groove = -0.1 * sign * to[:, None] + 1.1 * np.stack([np.cos(arc), np.sin(arc)])
        ax.plot(*groove, color=colour, lw=2.0)
        ax.text(*(1.5 * sign * to), text, color=colour, fontsize=9, ha="left" if sign > 0 else
                "right", va="center")  # fmt: skip
    ends = np.outer(to, (-1.5, 1.5))
    ax.plot(*ends, color=sheet.INK, lw=0.9, ls="--")
    ax.plot([0.0, 0.0], [0.0, 1.5], color="0.6", lw=0.8)
    ax.text(0.25, 1.05, "α", fontsize=11)
    ax.annotate("", (1.0, -1.25), (-1.0, -1.25), arrowprops={"arrowstyle": "<->"})
    ax.text(0.0, -1.3, "D_w", fontsize=10, ha="center", va="top")
    arrow(ax, (-3.1, 0.9), (-2.1, 0.9), "F_a 3500 N")
    arrow(ax, (2.6, -0.3), (2.6, -1.2), "F_r 1200 N")
    ax.plot([-3.0, 3.0], [-2.2, -2.2], color="0.6", lw=0.8, ls="-.")
    ax.annotate("", (-2.6, 0.0), (-2.6, -2.2), arrowprops={"arrowstyle": "<->"})
    ax.text(-2.5, -1.4, "d_m/2", fontsize=10)
    ax.set(xlim=(-3.6, 3.4), ylim=(-2.4, 1.8))
