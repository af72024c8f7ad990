"""The paper's Figures 5 to 19 from what was computed, and its tables laid beside."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from math import pi
from pathlib import Path

import numpy as np
from claims import CONDITIONS, CONSTANT, OVER_A, OVER_N
from outputs import HARMONICS, analytical
from paper_figures import bands, claim_map, stress
from paper_page import Picture, Table

from flexcage import Run, load_case
from flexcage.render import sheet
from flexcage.results import metrics

PRINTED = tomllib.loads((Path(__file__).with_name("printed.toml")).read_text("utf-8"))
RPM, UM, PERCENT = 30.0 / pi, 1e6, 100.0
BETTER, PRINTED_MODEL = "better model", "as printed"  # columns of readings
MODEL, BEARING = "map of the model", "map of the bearing"  # columns of maps
COLOURS = {MODEL: sheet.ORANGE, BEARING: sheet.BLUE}
MARKS = {BETTER: ("o", sheet.GREEN), PRINTED_MODEL: ("s", sheet.PURPLE)}
AMPLITUDES = {CONSTANT: 0.0, "A 3 %": 3.0, "A 6 %": 6.0, "A 9 %": 9.0}
WAVES = {CONSTANT: 0.0, "A 6 %": 1.0, "N 2": 2.0, "N 3": 3.0}
MAPPED = "002-3b"  # claim whose map is drawn
SKEWED = ("one_force", "swing")  # outputs whose starts and points lie over decades
LAST = 4  # turns of the ring that are drawn of a curve over time
FORCES = "of one ball, N"


def draw(computed, folder: Path) -> list[Picture]:
    """All pictures, in the paper's order."""
    curves = (
        ("figure_5_6_13", "Cage speed", "rpm; grey: the cage of balls that roll without slip",
         _cage_speed, (700.0, 1200.0)),
        ("figure_8_15", "Force between one ball and the cage", FORCES, _pocket_force, None),
        ("figure_12_19", "Force between one ball and the inner ring", FORCES, _race_force, None),
    )  # fmt: skip
    for file, title, note, curve, limits in curves:
        over_time(computed, folder / f"{file}.png", title, note, curve, limits)
    orbits(computed, folder / "figure_7_14.png", "cage")
    orbits(computed, folder / "figure_10_17.png", "inner")
    over_both(
        computed,
        folder / "figure_9_16.png",
        "Cage: largest distance and largest force",
        (("distance", UM, "distance, um"), ("one_force", 1.0, "force of one ball, N")),
    )
    over_both(
        computed,
        folder / "figure_11_18.png",
        "Inner ring: largest distance",
        (("ring_distance", UM, "distance, um"), ("ripple", PERCENT, "force's rest, %")),
    )
    over_both(
        computed,
        folder / "tables_6_7.png",
        "Cage speed: mean and fluctuation",
        (("speed", RPM, "mean, rpm"), ("swing", PERCENT, "fluctuation, %")),
        printed=True,
    )
    title, of = "Where force between ball and cage grows with A and N", "the map of the model"
    claim_map(computed, MODEL, MAPPED, folder / "map_002_3b.png", title, of)
    return [
        Picture("figure_5_6_13.png", "Figures 5, 6 and 13: cage speed over time",
                "First starts, the last four turns of the ring. The paper's Figure 5 has 922 rpm "
                "at constant speed."),
        Picture("figure_7_14.png", "Figures 7 and 14: the cage's centre",
                "First starts, settled part, radial load down; one scale a row."),
        Picture("figure_8_15.png", "Figures 8 and 15: force between one ball and the cage",
                "Largest since the sample before, of ball 0."),
        Picture("figure_9_16.png", "Figures 9 and 16: largest distance and force of the cage",
                "Dots are starts, bands the middle 80 % of points of a map. The paper prints no "
                "numbers: its curves rise with A and N."),
        Picture("figure_10_17.png", "Figures 10 and 17: the inner ring's centre",
                "About its mean place; one scale a row."),
        Picture("figure_11_18.png", "Figures 11 and 18: largest distance of the inner ring",
                "Beside it what a ball's place does not make of its force (Figures 12 and 19)."),
        Picture("figure_12_19.png", "Figures 12 and 19: force between one ball and the inner ring",
                f"Ball 0. Its place alone, {HARMONICS} harmonics of it, makes nearly all."),
        Picture("tables_6_7.png", "Tables 6 and 7: mean and fluctuation of the cage's speed",
                "Triangles and crosses are printed numbers of Tables 6 and 7; A = 6 % and N = 1 "
                "are one case with two numbers."),
        Picture("map_002_3b.png", f"Map of claim {MAPPED}",
                "Blue points hold, red ones do not; lines are shares over quarters of a range."),
        *stress(
            computed, folder, "Stress of the cage at A = 6 %, N = 3",
            "Better model with a flexible cage, 60 ms: equivalent stress at its largest. "
            "The paper's cage is elastic, but it shows no stress.",
        ),
    ]  # fmt: skip


def _cage_speed(run) -> tuple[np.ndarray, np.ndarray | None]:
    ds = run.dataset
    ideal = run.numbers.kinematics(1.0).cage_speed * ds["inner_speed"].values
    return ds["cage_omega"].sel(axis="x").values * RPM, ideal * RPM


def _pocket_force(run) -> tuple[np.ndarray, np.ndarray | None]:
    return metrics.pocket_peaks(run.dataset).values.max(axis=2)[:, 0], None


def _race_force(run) -> tuple[np.ndarray, np.ndarray | None]:
    return run.dataset["race_force"].sel(race="inner", element=0).values, None


def over_time(computed, path: Path, title: str, note: str, curve: Callable,
              limits: tuple[float, float] | None) -> Path:  # fmt: skip
    """A curve of every condition, one row a reading."""
    wide, high, left, top = 250, 190, 215, 130
    with sheet.style():
        figure = sheet.new_figure(
            left + 6 * (wide + 46), top + len(computed.readings) * (high + 80) + 20
        )
        sheet.heading(figure, title, f"{note}; over ms")
        for i, column in enumerate(computed.readings):
            sheet.text_at(figure, 20, top + i * (high + 80) + 0.5 * high, column)
            runs = done(computed.readings[column])
            drawn = {c: (r.dataset["time"].values * 1e3, *curve(r)) for c, r in runs.items()}
            shown = {c: t > t[-1] - 30.0 * LAST for c, (t, _, _) in drawn.items()}
            top_of = max((float(y[shown[c]].max()) for c, (_, y, _) in drawn.items()), default=1.0)
            for c, (t, y, beside) in drawn.items():
                k, s = CONDITIONS.index(c), shown[c]
                place = (left + k * (wide + 46), top + i * (high + 80), wide, high)
                ax = sheet.axes_at(figure, place)
                if beside is not None:
                    ax.plot(t[s], beside[s], color="0.65", lw=1.2)
                ax.plot(t[s], y[s], color=sheet.BLUE, lw=0.7)
                ax.set(xlim=(t[s][0], t[-1]), ylim=limits or (0.0, 1.05 * top_of))
                _once(ax, c, first=k == 0)
        return sheet.save(figure, path)


def _once(ax, title: str, *, first: bool) -> None:
    """A panel of a row on one scale: its title, and numbers up the first one's axis alone."""
    ax.set_title(title, loc="left")
    ax.tick_params(labelleft=first)
    ax.locator_params(axis="x", nbins=3)


def done(reading) -> dict[str, Run]:
    """First starts of a reading, of the conditions that have one."""
    return {c: reading.run(c) for c in CONDITIONS if len(reading.values("speed", c))}


def orbits(computed, path: Path, body: str) -> Path:
    """Orbits of the cage's or the inner ring's centre, one row a reading."""
    side, left, top = 240, 200, 130
    name = {"cage": "cage's centre", "inner": "inner ring's centre, about its mean"}[body]
    with sheet.style():
        figure = sheet.new_figure(
            left + 6 * (side + 50), top + len(computed.readings) * (side + 80) + 20
        )
        sheet.heading(figure, f"Orbits of the {name}", "um; radial load down")
        for i, column in enumerate(computed.readings):
            sheet.text_at(figure, 20, top + i * (side + 80) + 0.5 * side, column)
            found = {}
            for c, run in done(computed.readings[column]).items():
                yz = metrics.centre_of(metrics.settled(run.dataset, run.case.output.settle), body)
                found[c] = UM * (yz - (yz.mean(axis=0) if body == "inner" else 0.0))
            reach = 1.08 * max((float(np.abs(yz).max()) for yz in found.values()), default=1.0)
            for c, yz in found.items():
                k = CONDITIONS.index(c)
                place = (left + k * (side + 50), top + i * (side + 80), side, side)
                ax = sheet.axes_at(figure, place)
                ax.plot(yz[:, 1], -yz[:, 0], color=sheet.BLUE, lw=0.5)
                ax.set(xlim=(-reach, reach), ylim=(-reach, reach))
                _once(ax, c, first=k == 0)
        return sheet.save(figure, path)


def over_both(computed, path: Path, title: str, outputs, *, printed: bool = False) -> Path:
    """Outputs over the amplitude and over the frequency: readings, maps, and printed numbers."""
    wide, high, gap, left, top = 520, 250, 110, 90, 130
    with sheet.style():
        figure = sheet.new_figure(left + 2 * (wide + gap) + 240, top + len(outputs) * (high + 80))
        sheet.heading(figure, title, "over the amplitude A in % (left) and over N at A = 6 %")
        for i, (output, factor, name) in enumerate(outputs):
            for k, axis in enumerate((AMPLITUDES, WAVES)):
                place = (left + k * (wide + gap), top + i * (high + 80), wide, high)
                ax = sheet.axes_at(figure, place)
                bands(ax, computed, output, axis, factor, colours=COLOURS, marks=MARKS,
                      shift=0.015 * max(axis.values()))  # fmt: skip
                if output in SKEWED:
                    ax.set_yscale("log")
                if printed:
                    _numbers(ax, output, axis)
                ax.set(
                    ylabel=name if k == 0 else "",
                    xlim=(-0.12 * max(axis.values()), 1.08 * max(axis.values())),
                )
                if i == len(outputs) - 1:
                    ax.set_xlabel("A, %" if k == 0 else "N")
                if (i, k) == (0, 1):
                    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0))
        return sheet.save(figure, path)


def _numbers(ax, output: str, axis: dict[str, float]) -> None:
    for table, marker in (("table_6", "^"), ("table_7", "X")):
        shown = {c: v for c, v in PRINTED[table][output].items() if c in axis}
        ax.plot(
            [axis[c] for c in shown],
            list(shown.values()),
            marker,
            ms=7.0,
            color=sheet.INK,
            ls="none",
            label=f"paper, Table {table[-1]}",
        )


def middle(joined, output: str, condition: str, factor: float) -> str:
    """Median of a map, and its middle 80 %."""
    found = joined.spread(output, condition)
    if found is None:
        return "-"
    low, mid, high = found * factor
    digits = 1 if abs(mid) >= 100.0 else 2
    return f"{mid:,.{digits}f} ({low:,.{digits}f} to {high:,.{digits}f})"


def tables(computed) -> list[Table]:
    """Tables 5 to 7 of the paper beside what was computed."""
    heads = (*computed.readings, *computed.maps)

    def cells(output: str, condition: str, factor: float) -> tuple[str, ...]:
        return (
            *(r.said(output, condition, factor) for r in computed.readings.values()),
            *(middle(m, output, condition, factor) for m in computed.maps.values()),
        )

    own = analytical(load_case(Path(__file__).with_name("case.toml")).bearing)
    kinds = (
        ("cage speed [rpm]", "speed", RPM), ("velocity of inner contacts [m/s]", "v_inner", 1.0),
        ("velocity of balls [m/s]", "v_ball", 1.0),
        ("balls over the inner ring [1/min]", "passes_inner", 1.0),
        ("balls over the outer ring [1/min]", "passes_outer", 1.0),
    )  # fmt: skip
    five = PRINTED["table_5"]
    rows = [
        (title, f"{five['theory'][key]:g} ({own[key] * factor:,.5g})",
         f"{five['ls_dyna'][key]:g}", *cells(key, CONSTANT, factor))
        for title, key, factor in kinds
    ]  # fmt: skip
    both = []
    for title, key, factor in (("mean speed [rpm]", "speed", RPM),
                               ("mean from the start on [rpm]", "speed_whole", RPM),
                               ("fluctuation [%]", "swing", PERCENT)):  # fmt: skip
        for c in CONDITIONS:
            paper = [
                f"{PRINTED[t][key][c]:g} (T{t[-1]})" for t in ("table_6", "table_7")
                if c in PRINTED[t].get(key, {})
            ]  # fmt: skip
            both.append((title, c, ", ".join(dict.fromkeys(paper)) or "-", *cells(key, c, factor)))
    return [
        Table("Table 5, constant speed; theory as printed and (equations 6 to 10 for the preset). "
              "Readings: mean of all starts ± 95 %; maps: median (middle 80 %)",
              ("quantity", "theory", "LS-DYNA", *heads), rows),
        Table("Tables 6 and 7", ("quantity", "case", "paper", *heads), both),
    ]  # fmt: skip


assert set(PRINTED) == {"table_5", "table_6", "table_7", "text"}
assert set(OVER_A) == set(AMPLITUDES) and set(OVER_N) == set(WAVES)
