"""The paper's Figures 6 to 11 from what was computed, and its tables laid beside."""

from __future__ import annotations

import tomllib
from pathlib import Path

import numpy as np
from claims import SPEEDS
from outputs import PLANE, at_plane, axial, setup_of
from paper_figures import bands, claim_map, stress
from paper_page import Picture, Table

from flexcage.render import sheet
from flexcage.results import instrument, metrics

PRINTED = tomllib.loads((Path(__file__).with_name("printed.toml")).read_text("utf-8"))
MM = 1e3
BETTER, PRINTED_MODEL = "better model", "as printed"  # columns of readings
TEST, MODEL = "map of the test", "map of the model"  # columns of maps
COLOURS = {TEST: sheet.BLUE, MODEL: sheet.ORANGE}
MARKS = {BETTER: ("o", sheet.GREEN), PRINTED_MODEL: ("s", sheet.PURPLE)}
AXIS = "10000"  # rpm, of Figures 6 to 8


def tracks(run):
    """Centre and axis (n, 3) of the settled cage, readings (n, 5), and what equations 7 and 8 make
    of them (n, 2)."""
    ds = metrics.settled(run.dataset, run.case.output.settle)
    centre, axis = instrument.of_run(ds)
    setup = setup_of(run.case.cage)
    shown = instrument.readings(centre, axis, setup, seed=1)
    return centre, axis, shown, instrument.by_tilt_angles(shown, setup), ds["time"].values


def whole_record(reading, speed: str) -> float:
    """Difference of whirl radii [m] of the first start from its very beginning, centred, on."""
    centre, _ = instrument.of_run(reading.run(speed).dataset)
    return float(np.ptp(np.hypot(centre[:, 1], centre[:, 2])))


def draw(computed, folder: Path) -> list[Picture]:
    """All pictures, in the paper's order."""
    better, printed = (computed.readings[c] for c in (BETTER, PRINTED_MODEL))
    motion(better.run(AXIS), folder / "figure_6_7.png", "Cage motion at 10,000 rpm, better model")
    simulated(printed.run(AXIS), folder / "figure_8.png")
    orbits(computed, folder / "figure_9_10.png")
    ratios(computed, folder / "figure_11.png")
    differences(computed, folder / "tables_4_5.png")
    title, of = "Where the whirl grows and tends to a circle", "the map of the test"
    claim_map(computed, TEST, "003-3", folder / "map_003_3.png", title, of)
    return [
        Picture("figure_6_7.png", "Figures 6 and 7: readings and centre at 10,000 rpm",
                "First start of the better model. Left: what the radial lasers show, and the "
                "centre by the paper's equations. Right: an axial reading and equation 10."),
        Picture("figure_8.png", "Figure 8: simulated motion at 10,000 rpm",
                "First start of the paper's own model: the cage's axis in the sensors' plane, its "
                "centre, and its axial motion."),
        Picture("figure_9_10.png", "Figures 9 and 10: the centre in space",
                "Above the better model, below the paper's own, first start at each speed; x "
                "along the axis, gravity down."),
        Picture("figure_11.png", "Figure 11: whirl ratio over speed",
                "Dots are starts, bands the middle 80 % of points of a map. The paper prints no "
                "numbers here: its curves fall to 10,000 rpm and rise."),
        Picture("tables_4_5.png", "Tables 4 and 5: differences of whirl radii",
                "Crosses and triangles are the numbers that the paper prints."),
        Picture("map_003_3.png", "Map of claim 003-3",
                "Blue points hold, red ones do not; lines are shares over quarters of a range."),
        *stress(
            computed, folder, "Stress of the cage at 10,000 rpm",
            "Better model with a flexible cage, 60 ms: equivalent stress at its largest. "
            "The paper has no such figure: its cage is rigid.",
        ),
    ]  # fmt: skip


def motion(run, path: Path, title: str) -> Path:
    """Figures 6 and 7: radial readings and the solved centre, an axial reading and equation 10."""
    _, _, shown, solved, time = tracks(run)
    with sheet.style():
        figure = sheet.new_figure(1500, 560)
        sheet.heading(figure, title, "mm; as lasers show it (6) and as the equations solve it (7)")
        for k, (yz, name) in enumerate(((shown[:, :2], "6a measured"), (solved, "7a solved"))):
            _across(figure, (90 + k * 370, 150, 290, 290), yz, name)
        for k, (x, name) in enumerate(((shown[:, 2], "6b one axial reading"),
                                       (axial(shown), "7b centre"))):  # fmt: skip
            _along(figure, (880, 150 + k * 175, 560, 115), time, x, name)
        return sheet.save(figure, path)


def simulated(run, path: Path) -> Path:
    """Figure 8: origin, centre, axial motion."""
    centre, axis, _, _, time = tracks(run)
    with sheet.style():
        figure = sheet.new_figure(1500, 560)
        sheet.heading(figure, "Simulated motion at 10,000 rpm, the paper's own model", "mm")
        _across(figure, (90, 150, 290, 290), at_plane(centre, axis, PLANE), "8a origin")
        _across(figure, (460, 150, 290, 290), centre[:, 1:], "8b centre")
        _along(figure, (880, 150, 560, 290), time, centre[:, 0], "8c axial displacement")
        return sheet.save(figure, path)


def _across(figure, place, yz: np.ndarray, name: str) -> None:
    """A track (n, 2) of y and z across the axis, gravity down."""
    ax = sheet.axes_at(figure, place)
    ax.plot(yz[:, 1] * MM, -yz[:, 0] * MM, color=sheet.BLUE, lw=0.5)
    ax.set(xlim=(-0.4, 0.4), ylim=(-0.4, 0.4), title=name)


def _along(figure, place, time: np.ndarray, x: np.ndarray, name: str) -> None:
    """A motion (n,) over time in ms."""
    ax = sheet.axes_at(figure, place)
    ax.plot((time - time[0]) * 1e3, x * MM, color=sheet.BLUE, lw=0.6)
    ax.set_title(f"{name}, over ms", loc="left")


def orbits(computed, path: Path) -> Path:
    """Figures 9 and 10: the centre in space at each speed."""
    side, left, top = 280, 130, 130
    with sheet.style():
        figure = sheet.new_figure(left + 4 * (side + 50), top + 2 * (side + 60))
        sheet.heading(figure, "The cage's centre in space", "mm")
        for i, column in enumerate((BETTER, PRINTED_MODEL)):
            sheet.text_at(figure, 20, top + i * (side + 60) + 0.5 * side, column)
            for k, speed in enumerate(SPEEDS):
                centre = tracks(computed.readings[column].run(speed))[0] * MM
                place = (left + k * (side + 50), top + i * (side + 60), side, side)
                ax = sheet.axes_at(figure, place, projection="3d")
                ax.plot(centre[:, 0], centre[:, 2], -centre[:, 1], color=sheet.BLUE, lw=0.5)
                ax.set(xlim=(-0.4, 0.4), ylim=(-0.4, 0.4), zlim=(-0.4, 0.4))
                ax.set_title(f"{int(speed):,} rpm", fontsize=9)
                for axis in (ax.xaxis, ax.yaxis, ax.zaxis):
                    axis.set_ticks((-0.3, 0.0, 0.3))
                    axis.set_tick_params(labelsize=6, pad=-3)
        return sheet.save(figure, path)


def _over_speed(ax, computed, output: str, factor: float) -> None:
    """Maps and readings over the ring's speed."""
    bands(ax, computed, output, {s: int(s) for s in SPEEDS}, factor, colours=COLOURS, marks=MARKS,
          shift=60.0)  # fmt: skip
    ax.set(xlabel="inner ring [rpm]", xlim=(3600, 11400))


def ratios(computed, path: Path) -> Path:
    """Figure 11."""
    with sheet.style():
        figure = sheet.new_figure(1480, 620)
        sheet.heading(figure, "Whirl ratio over speed", "(largest - least)/mean whirl radius")
        ax = sheet.axes_at(figure, (100, 130, 850, 400))
        _over_speed(ax, computed, "ratio", 1.0)
        ax.set(ylim=(0.0, 2.0), ylabel="whirl ratio")
        ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0))
        return sheet.save(figure, path)


def differences(computed, path: Path) -> Path:
    """Differences over speed, with the printed numbers of Tables 4 and 5."""
    with sheet.style():
        figure = sheet.new_figure(1480, 620)
        sheet.heading(figure, "Difference of whirl radii of the centre", "largest - least, mm")
        ax = sheet.axes_at(figure, (100, 130, 850, 400))
        _over_speed(ax, computed, "difference", MM)
        for table, row, marker, name in (
            ("table_4", "solved", "X", "paper, measured (Table 4, solved)"),
            ("table_5", "centroid", "^", "paper, simulated (Table 5, centroid)"),
        ):
            numbers = PRINTED[table][row]
            ax.plot([int(s) for s in numbers], list(numbers.values()), marker, ms=8.0,
                    color=sheet.INK, label=name)  # fmt: skip
        ax.set(ylim=(0.0, 0.8), ylabel="mm")
        ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0))
        return sheet.save(figure, path)


def tables(computed) -> list[Table]:
    """Tables 3 to 5 of the paper beside what was computed."""
    head = ("quantity", "rpm", "paper", *computed.readings, *computed.maps)
    rpm = 30.0 / np.pi
    asked = (
        ("Table 3: cage speed [rpm]", "speed", "table_3", "simulated", rpm),
        ("Table 4: measured difference [mm]", "raw", "table_4", "measured", MM),
        ("Table 4: solved difference [mm]", "solved", "table_4", "solved", MM),
        ("Table 4: error [%]", "error", "table_4", "error", 100.0),
        ("Table 5: origin [mm]", "origin", "table_5", "origin", MM),
        ("Table 5: centroid [mm]", "difference", "table_5", "centroid", MM),
        ("Table 5: error [%]", "origin_error", "table_5", "error", 100.0),
    )
    rows = []
    for title, output, table, row, factor in asked:
        for speed in SPEEDS:
            printed = PRINTED[table][row].get(speed)
            rows.append((
                title, f"{int(speed):,}", "-" if printed is None else f"{printed:g}",
                *(r.said(output, speed, factor) for r in computed.readings.values()),
                *(m.middle(output, speed, factor) for m in computed.maps.values()),
            ))  # fmt: skip
    title = "Readings: mean of all starts ± 95 %. Maps: median (middle 80 % of points)"
    return [Table(title, head, rows)]
