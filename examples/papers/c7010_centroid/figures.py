"""The paper's Figures 6 to 11 and what its Tables 3 to 5 hold, laid out as the paper has them."""

from __future__ import annotations

import tomllib
from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path

import numpy as np
from claims import SPEEDS
from judging.panels import kept
from judging.pictures import bands, starts
from matplotlib.axes import Axes
from outputs import PLANE, at_plane, axial, form_of, seen
from sketch import draw_sketch

from flexcage import Run
from flexcage.render import sheet
from flexcage.results import instrument, metrics

PRINTED = tomllib.loads((Path(__file__).with_name("printed.toml")).read_text("utf-8"))
MM = 1e3
TEST, MODEL = "test", "model"  # names of samples
CAGE, RUN_UP, SIMULATED = "test cage", "run-up", "as printed"  # columns of readings
AXIS = "10000"  # rpm, of Figures 6 to 8
PLACES = {s: float(s) for s in SPEEDS}
READINGS = {CAGE: (sheet.GREEN, "o"), RUN_UP: ("#b07aa1", "D"), SIMULATED: (sheet.VERMILION, "s")}
SAMPLES = {TEST: sheet.BLUE, MODEL: sheet.ORANGE}
SIDE, TOP = 330, 110  # px

Axial = tuple[np.ndarray, np.ndarray]  # time [ms] and motion [mm]


class Track:
    """The settled cage of a run, what lasers show, and what the paper's equations make of it; mm
    and ms."""

    def __init__(self, run: Run) -> None:
        ds = metrics.settled(run.dataset, run.case.output.settle)
        centre, axis = instrument.of_run(ds)
        shown, solved = seen(run.case, ds, form_of(run.case))
        self.time = (ds["time"].values - ds["time"].values[0]) * MM
        self.centre, self.origin = centre * MM, at_plane(centre, axis, PLANE) * MM
        self.shown, self.solved, self.axial = shown * MM, solved * MM, axial(shown) * MM


def reach_of(*tracks: np.ndarray) -> float:
    """Limit [mm] of axes that show tracks (n, 2) whole: a multiple of 0.1 mm."""
    most = max(float(np.nanmax(np.abs(yz))) for yz in tracks)
    return max(0.1, float(np.ceil(10.0 * most) / 10.0))


def across(ax: Axes, yz: np.ndarray, name: str, reach: float) -> None:
    """A track (n, 2) of y and z across the axis, gravity down."""
    ax.plot(yz[:, 1], -yz[:, 0], color=sheet.BLUE, lw=0.5)
    ax.set(xlim=(-reach, reach), ylim=(-reach, reach), aspect="equal", xlabel="z / mm",
           ylabel="-y / mm")  # fmt: skip
    ax.set_title(name, loc="left", fontsize=10)


def along(ax: Axes, time: np.ndarray, x: np.ndarray, name: str, wide: float) -> None:
    """An axial motion, about its mean, over time."""
    ax.plot(time, x - np.nanmean(x), color=sheet.BLUE, lw=0.7)
    ax.set(xlim=(time[0], time[-1]), ylim=(-wide, wide), xlabel="time / ms", ylabel="x / mm")
    ax.set_title(name, loc="left", fontsize=10)


Row = tuple[Mapping[str, np.ndarray], str, Axial]  # radial tracks, and an axial motion with a name


def rows_of(
    path: Path, heading: tuple[str, str], rows: Sequence[Row], reach: float, wide: float
) -> str:
    """Rows of radial tracks and an axial motion, as the paper has them, on one scale; the file's
    name."""
    left, gap, most = 90, 90, max(len(radial) for radial, _, _ in rows)
    with sheet.style():
        figure = sheet.new_figure(
            left + (most + 1) * (SIDE + gap) + 170, TOP + 20 + len(rows) * (SIDE + 100)
        )
        sheet.heading(figure, *heading)
        for i, (radial, name, (time, x)) in enumerate(rows):
            top = TOP + 20 + i * (SIDE + 100)
            for k, (word, yz) in enumerate(radial.items()):
                place = (left + k * (SIDE + gap), top, SIDE, SIDE)
                across(sheet.axes_at(figure, place), yz, word, reach)
            place = (left + most * (SIDE + gap) + 10, top, SIDE + 150, SIDE)
            along(sheet.axes_at(figure, place), time, x, name, wide)
        sheet.save(figure, path)
    return path.name


def measured_motion(computed, folder: Path) -> str:
    """Figures 6 and 7: the test's cage, as lasers show it and as the equations solve it."""
    test = Track(computed.readings[CAGE].run(AXIS))
    return rows_of(
        folder / "figure_6_7.png",
        ("Figures 6 and 7: as measured, and the centre as the equations solve it",
         "one start of the test's cage, 10,000 rpm"),
        (({"6a radial readings": test.shown[:, :2]}, "6b reading of one axial laser",
          (test.time, test.shown[:, 2])),
         ({"7a radial": test.solved}, "7b axial", (test.time, test.axial))),
        reach_of(test.shown[:, :2], test.solved),
        0.6 * float(max(np.ptp(test.shown[:, 2]), np.ptp(test.axial))),
    )  # fmt: skip


def simulated_motion(computed, folder: Path) -> str:
    """Figure 8: the simulation's cage."""
    own = Track(computed.readings[SIMULATED].run(AXIS))
    return rows_of(
        folder / "figure_8.png",
        ("Figure 8: as simulated", "one start of the paper's own model as printed, 10,000 rpm"),
        (({"(a) origin, in the lasers' plane": own.origin, "(b) centre": own.centre[:, 1:]},
          "(c) axial", (own.time, own.centre[:, 0])),),
        reach_of(own.origin, own.centre[:, 1:]), 0.6 * max(float(np.ptp(own.centre[:, 0])), 0.01),
    )  # fmt: skip


def in_space(computed, folder: Path) -> str:
    """Figures 9 and 10: the centre in space, one panel a speed, on one scale."""
    columns = {CAGE: "9 measured", SIMULATED: "10 simulated"}
    tracks = {(c, s): Track(computed.readings[c].run(s)) for c in columns for s in SPEEDS}
    yz = {(c, s): t.solved if c == CAGE else t.centre[:, 1:] for (c, s), t in tracks.items()}
    reach = reach_of(*yz.values())
    with sheet.style():
        figure = sheet.new_figure(4 * (SIDE + 20) + 60, TOP + 2 * (SIDE + 80))
        sheet.heading(figure, "Figures 9 and 10: the centre in space", "one start each; mm")
        for k, key in enumerate(tracks):
            row, column = divmod(k, len(SPEEDS))
            place = (30 + column * (SIDE + 20), TOP + row * (SIDE + 80), SIDE, SIDE)
            ax = sheet.axes_at(figure, place, projection="3d")
            x = tracks[key].centre[:, 0] - tracks[key].centre[:, 0].mean()
            ax.plot(x, yz[key][:, 1], -yz[key][:, 0], color=sheet.BLUE, lw=0.5)
            ax.set(xlim=(-reach, reach), ylim=(-reach, reach), zlim=(-reach, reach))
            title = f"{columns[key[0]]} ({'abcd'[column]}): {int(key[1]):,} rpm"
            ax.set_title(title, fontsize=10)
            for axis, word in ((ax.xaxis, "x / mm"), (ax.yaxis, "z / mm"), (ax.zaxis, "-y / mm")):
                axis.set_tick_params(labelsize=6, pad=-2)
                axis.set_ticks((-reach, 0.0, reach))
                axis.set_label_text(word, fontsize=8)
        sheet.save(figure, folder / "figure_9_10.png")
    return "figure_9_10.png"


Panel = tuple[str, str, tuple[float | None, float | None], Callable[[Axes], None]]


def over_speed(folder: Path, name: str, title: str, panels: Sequence[Panel]) -> str:
    """Panels (title, axis, limits, drawing) over the ring's speed, two a row, each row on one
    scale: sample, readings, printed numbers."""
    wide, high, left, gap = 460, 280, 90, 100
    columns = min(len(panels), 2)
    with sheet.style():
        figure = sheet.new_figure(
            left + columns * (wide + gap), TOP + 10 + -(-len(panels) // 2) * (high + 100)
        )
        sheet.heading(figure, title, "bands: middle 80 % of settings and median; marks: starts of "
                      "readings, least to largest")  # fmt: skip
        for k in range(0, len(panels), 2):
            axes = []
            for j, (word, unit, _, draw) in enumerate(panels[k : k + 2]):
                place = (left + j * (wide + gap), TOP + 10 + k // 2 * (high + 100), wide, high)
                ax = sheet.axes_at(figure, place)
                draw(ax)
                ax.set(xlabel="inner ring / rpm", ylabel=unit, xlim=(3600, 11400))
                ax.set_title(word, loc="left", fontsize=10)
                ax.legend(loc="upper center", ncols=2, fontsize=8, frameon=False)
                axes.append(ax)
            low, top = zip(*(ax.get_ylim() for ax in axes))
            begin, end = panels[k][2]
            least, most = min(low) if begin is None else begin, max(top) if end is None else end
            for ax in axes:
                ax.set_ylim(least, most + 0.25 * (most - least))  # room for the legend
        sheet.save(figure, folder / f"{name}.png")
    return f"{name}.png"


def panel(
    computed, sample: str, output: str, columns: tuple[str, ...], factor: float,
    printed: Mapping[str, float] | None = None,
) -> Callable[[Axes], None]:  # fmt: skip
    """One panel: an output of a sample and of readings, with the numbers that are printed."""

    def draw(ax: Axes) -> None:
        bands(ax, computed.samples[sample], output, PLACES, factor, colour=SAMPLES[sample])
        for k, column in enumerate(columns):
            colour, marker = READINGS[column]
            starts(ax, computed.readings[column], output, PLACES, factor, colour=colour,
                   label=column, marker=marker, shift=60.0 * k)  # fmt: skip
        if printed:
            ax.plot([float(s) for s in printed], list(printed.values()), "X", ms=8.0,
                    color=sheet.INK, label="printed")  # fmt: skip

    return draw


def draw(computed, folder: Path) -> dict[str, str]:
    """All pictures by what they repeat."""
    c, table, two, own = computed, PRINTED, (CAGE, RUN_UP), (SIMULATED,)
    beyond = {
        s: 100.0 * (table["table_3"]["simulated"][s] / table["table_3"]["theory"][s] - 1.0)
        for s in table["table_3"]["theory"]
    }
    found = {"sketch": draw_sketch(folder / "sketch.png")}
    of_runs = {"6": ("figure_6_7", measured_motion), "8": ("figure_8", simulated_motion),
               "9": ("figure_9_10", in_space)}  # fmt: skip
    for key, (name, drawn) in of_runs.items():
        found[key] = kept(folder / f"{name}.png", partial(drawn, c, folder))
    found["11"] = over_speed(folder, "figure_11", "Figure 11: whirl ratio over speed", (
        ("test: by lasers and equations", "ratio", (0.0, None),
         panel(c, TEST, "solved_ratio", two, 1.0)),
        ("simulation: of the centre", "ratio", (0.0, None), panel(c, MODEL, "ratio", own, 1.0)),
    ))  # fmt: skip
    found["t3"] = over_speed(folder, "table_3", "Table 3: cage speed beyond equation 18", (
        ("simulation", "%", (None, None), panel(c, MODEL, "beyond_theory", own, 100.0, beyond)),
    ))  # fmt: skip
    found["t45"] = over_speed(folder, "tables_4_5", "Tables 4 and 5: differences of whirl radii", (
        ("Table 4, solved", "difference / mm", (0.0, None),
         panel(c, TEST, "solved", two, MM, table["table_4"]["solved"])),
        ("Table 5, centroid", "difference / mm", (0.0, None),
         panel(c, MODEL, "difference", own, MM, table["table_5"]["centroid"])),
        ("Table 4, deflection error", "%", (-20.0, 40.0),
         panel(c, TEST, "error", two, 100.0, table["table_4"]["error"])),
        ("Table 5, deflection error", "%", (-20.0, 40.0),
         panel(c, MODEL, "origin_error", own, 100.0, table["table_5"]["error"])),
    ))  # fmt: skip
    return found
