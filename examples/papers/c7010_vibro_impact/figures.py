"""The paper's Figures 5 to 25 from what was computed, and its printed number laid beside."""

from __future__ import annotations

import tomllib
from math import degrees, nan, pi
from pathlib import Path

import numpy as np
from claims import ALL_LOADS, ALL_SPEEDS, LOADS, POCKETS, RADIAL, RAMPS, SPEEDS, WAVES
from paper_figures import stress
from paper_page import Picture, Table

from flexcage.render import sheet
from flexcage.results import metrics

PRINTED = tomllib.loads((Path(__file__).with_name("printed.toml")).read_text("utf-8"))
BETTER, PRINTED_MODEL = "better model", "as printed"  # columns of readings
AXIAL, COMBINED = "map, axial load", "map, combined load"  # columns of maps
COLOURS = {AXIAL: sheet.ORANGE, COMBINED: sheet.BLUE}
SWEEPS = {
    "speed, rpm": ALL_SPEEDS, "load, N": ALL_LOADS,
    "clearance of pockets, mm": POCKETS, "radial clearance, mm": RADIAL,
}  # fmt: skip
SECTORS = 18  # of the way round, in which balls' forces and angles are averaged
UM, PERCENT, RPM = 1e6, 100.0, 30.0 / pi


def draw(computed, folder: Path) -> list[Picture]:
    """All pictures, in the paper's order."""
    by_azimuth(computed, folder / "figure_6_10_14.png", angles=False)
    orbits(computed, folder / "figure_7_11_15.png", list(SWEEPS.values()))
    deviations(computed, folder / "figure_8_12_16.png")
    by_azimuth(computed, folder / "figure_9_13_17.png", angles=True)
    over_time(computed, folder / "figure_18_21.png", "Waves of the speed", WAVES)
    orbits(computed, folder / "figure_19_22.png", [WAVES, RAMPS])
    over_time(computed, folder / "figure_23_25.png", "Equal times of acceleration", RAMPS)
    return [
        Picture("figure_6_10_14.png", "Figures 6, 10 and 14: force of balls on the inner ring",
                "First start of the better model, over the way from the load: mean in 18 sectors."),
        Picture("figure_7_11_15.png", "Figures 7, 11 and 15: the cage's centre",
                "First starts, better model, settled part; each panel on its own scale, um."),
        Picture("figure_8_12_16.png", "Figures 8, 12 and 16: deviation ratio",
                "Dots are starts, bars the middle 80 % of points of a map at its conditions. "
                "The triangle is the printed 24.44 %."),
        Picture("figure_9_13_17.png", "Figures 9, 13 and 17: contact angles by place",
                "As above; full lines inner ring, broken lines outer ring."),
        Picture("figure_18_21.png", "Figures 18 and 21: waves of the speed",
                "Speed of the ring (grey) and cage over its share of it, axial motion, cage slip."),
        Picture("figure_19_22.png", "Figures 19 and 22: the cage's centre under waves and "
                "accelerations", "First starts, better model."),
        Picture("figure_23_25.png", "Figures 23 to 25: accelerations for equal times",
                "1000, 2000 and 4000 rad/s^2 for 0.2 s from 4000 rpm on: speeds, axial motion, "
                "cage slip."),
        *stress(
            computed, folder, "Stress of the cage at 8000 rpm",
            "Better model with a flexible cage, 40 ms: equivalent stress at its largest. "
            "The paper has no such figure.",
        ),
    ]  # fmt: skip


def tick(condition: str) -> str:
    """A condition's number: rpm, N, or mm."""
    if condition in ALL_SPEEDS:
        return condition
    return condition.split()[0] if condition.endswith(" N") else condition.split()[-1]


def ticks(name: str, conditions) -> list[str]:
    """Numbers along a sweep; that over load starts with 1500 N, which is the speed "8000"."""
    return ["1500" if name.startswith("load") and c == "8000" else tick(c) for c in conditions]


def done(computed, conditions) -> list[str]:
    """Those of the conditions that the better model has a start of."""
    return [c for c in conditions if len(computed.readings[BETTER].values("speed", c))]


def settled(run):
    """The settled part of a run."""
    return metrics.settled(run.dataset, run.case.output.settle)


def sectors(run) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
    """Middles of sectors from the load on [deg], mean inner force [N], mean inner and outer contact
    angles [deg] of balls that pass them; NaN where none touches."""
    ds = settled(run)
    psi = ds["element_position"].transpose("time", "element", "cyl").sel(cyl="psi").values
    at = np.round((psi - run.case.load.direction) * SECTORS / (2.0 * pi)).astype(int) % SECTORS
    force = ds["race_force"].transpose("time", "element", "race").values
    angle = ds["contact_angle"].transpose("time", "element", "race").values

    def angles(race: int) -> np.ndarray:
        touch = [(at == k) & (force[..., race] > 0.0) for k in range(SECTORS)]
        return np.array([degrees(angle[..., race][m].mean()) if m.any() else nan for m in touch])

    mean = np.array([force[..., 0][at == k].mean() for k in range(SECTORS)])
    return 360.0 * np.arange(SECTORS) / SECTORS, mean, angles(0), angles(1)


def by_azimuth(computed, path: Path, *, angles: bool) -> Path:
    """Forces, or contact angles, over the way round, a panel a sweep and a line a condition."""
    wide, high, left, top = 330, 260, 90, 130
    title = "Contact angles by place, deg" if angles else "Force of balls on the inner ring, N"
    with sheet.style():
        figure = sheet.new_figure(left + 4 * (wide + 60), top + high + 90)
        sheet.heading(figure, title, "over the azimuth from the load, deg")
        for k, (name, conditions) in enumerate(SWEEPS.items()):
            ax = sheet.axes_at(figure, (left + k * (wide + 60), top, wide, high))
            there = done(computed, conditions)
            for colour, c, label in zip(sheet.CYCLE, there, ticks(name, there)):
                at, force, inner, outer = sectors(computed.readings[BETTER].run(c))
                ax.plot(at, inner if angles else force, color=colour, label=label)
                if angles:
                    ax.plot(at, outer, "--", color=colour)
            ax.set_title(name, loc="left")
            ax.set(xlim=(0, 340), xticks=(0, 90, 180, 270))
            if there:
                ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), ncol=4, fontsize=7,
                          handlelength=1.0, columnspacing=1.2)  # fmt: skip
        return sheet.save(figure, path)


def orbits(computed, path: Path, rows) -> Path:
    """Orbits of the cage's centre, a row a sweep."""
    side, gap, left, top = 250, 85, 100, 130
    rows = [found for row in rows if (found := done(computed, row))]
    wide = max((len(row) for row in rows), default=1)
    with sheet.style():
        figure = sheet.new_figure(left + wide * (side + gap), top + len(rows) * (side + gap))
        sheet.heading(figure, "Orbits of the cage's centre", "um; load and gravity down")
        for i, row in enumerate(rows):
            for k, c in enumerate(row):
                yz = UM * metrics.orbit(settled(computed.readings[BETTER].run(c)))
                place = (left + k * (side + gap), top + i * (side + gap), side, side)
                ax = sheet.axes_at(figure, place)
                ax.plot(yz[:, 1], -yz[:, 0], color=sheet.BLUE, lw=0.5)
                middle = [0.5 * (yz[:, j].max() + yz[:, j].min()) for j in (0, 1)]
                reach = 0.55 * max(np.ptp(yz, axis=0))
                ax.set(
                    xlim=(middle[1] - reach, middle[1] + reach),
                    ylim=(-middle[0] - reach, -middle[0] + reach),
                )
                ax.set_title(f"1500 N, {c} rpm" if c in ALL_SPEEDS else c, loc="left")
        return sheet.save(figure, path)


def deviations(computed, path: Path) -> Path:
    """The deviation ratio over every sweep."""
    wide, high, left, top = 330, 260, 90, 130
    with sheet.style():
        figure = sheet.new_figure(left + 4 * (wide + 60), top + high + 120)
        sheet.heading(figure, "Deviation ratio of the speed of the cage's mass centre", "%")
        for k, (name, conditions) in enumerate(SWEEPS.items()):
            ax = sheet.axes_at(figure, (left + k * (wide + 60), top, wide, high))
            for i, c in enumerate(conditions):
                found = computed.readings[BETTER].values("deviation", c) * PERCENT
                ax.plot(np.full(len(found), i), found, "o", ms=3.0, color=sheet.GREEN,
                        label=BETTER if i == 0 else None)  # fmt: skip
                for shift, (column, joined) in zip((0.12, 0.24), computed.maps.items()):
                    colour = COLOURS[column]
                    if c not in joined.parts[0].conditions:
                        continue
                    values = joined.means("deviation", c) * PERCENT
                    if not np.isfinite(values).any():
                        continue
                    low, mid, high_ = np.nanpercentile(values, (10.0, 50.0, 90.0))
                    ax.plot([i + shift] * 2, [low, high_], color=colour, lw=3.0, alpha=0.5)
                    ax.plot(i + shift, mid, "_", color=colour, ms=9.0, mew=2.0,
                            label=column if i == len(conditions) - 1 else None)  # fmt: skip
                if c in PRINTED["deviation"]:
                    ax.plot(i - 0.12, PRINTED["deviation"][c], "^", color=sheet.INK, label="paper")
            ax.set_title(name, loc="left")
            ax.set(xticks=range(len(conditions)), ylim=(0.0, None), xlim=(-0.4, len(conditions)))
            ax.set_xticklabels(ticks(name, conditions))
            if conditions == ALL_LOADS:  # the panel that has the paper's number as well
                ax.legend(loc="upper center", bbox_to_anchor=(0.5, -0.12), ncol=4, fontsize=7)
        return sheet.save(figure, path)


def over_time(computed, path: Path, title: str, conditions) -> Path:
    """Speeds, axial motion of the inner ring and slip of the cage, a column a condition."""
    wide, high, left, top = 420, 170, 100, 130
    with sheet.style():
        figure = sheet.new_figure(left + 3 * (wide + 70), top + 3 * (high + 60) + 10)
        sheet.heading(figure, title, "rpm of the cage (grey: rolling); axial, um; slip, %; over ms")
        for k, c in enumerate(done(computed, conditions)):
            run = computed.readings[BETTER].run(c)
            ds = run.dataset if c in RAMPS else settled(run)
            t = ds["time"].values * 1e3
            ideal = run.numbers.nominal.kinematics(1.0).cage_speed * ds["inner_speed"].values
            cage = ds["cage_omega"].sel(axis="x").values
            axial = ds["inner_position"].sel(axis="x").values * UM
            slip = (1.0 - cage / ideal) * PERCENT
            for i, y in enumerate((cage * RPM, axial, slip)):
                ax = sheet.axes_at(
                    figure, (left + k * (wide + 70), top + i * (high + 60), wide, high)
                )
                if i == 0:
                    ax.plot(t, ideal * RPM, color="0.75", lw=1.2, zorder=3)
                    ax.set_title(c, loc="left")
                ax.plot(t, y, color=sheet.BLUE, lw=0.7)
                ax.set(xlim=(t[0], t[-1]))
        return sheet.save(figure, path)


def starts(reading, output: str, condition: str, factor: float) -> str:
    """Mean of all starts with half its 95 % interval; of fewer starts their mean alone."""
    found = reading.values(output, condition)
    if len(found) < 8:
        return digits(found.mean() * factor) if len(found) else "-"
    return reading.said(output, condition, factor)


def digits(value: float) -> str:
    """Three digits; whole numbers from 100 on."""
    return f"{value:,.0f}" if abs(value) >= 100.0 else f"{value:.3g}"


def tables(computed) -> list[Table]:
    """What the paper's figures are made of, beside the one number that it prints."""
    head = ("quantity", "case", "paper", *computed.readings, *computed.maps)
    asked = (
        ("deviation ratio [%]", "deviation", PERCENT, (*ALL_SPEEDS, *ALL_LOADS[1:], *POCKETS,
                                                      *RADIAL)),
        ("largest force of a ball [N]", "one_peak", 1.0, (*SPEEDS, *LOADS, *POCKETS, *RADIAL)),
        ("inner angle at the load [deg]", "inner_load", 180.0 / pi, (*SPEEDS, *LOADS, *RADIAL)),
        ("outer angle at the load [deg]", "outer_load", 180.0 / pi, (*SPEEDS, *LOADS)),
        ("cage speed [rpm]", "speed", RPM, ALL_SPEEDS),
    )  # fmt: skip
    rows = []
    for title, output, factor, conditions in asked:
        for c in conditions:
            shown = PRINTED["deviation"].get(c) if output == "deviation" else None
            rows.append((
                title, f"{c} rpm" if c in ALL_SPEEDS else c,
                "-" if shown is None else f"{shown:g}",
                *(starts(r, output, c, factor) for r in computed.readings.values()),
                *(m.middle(output, c, factor, digits) for m in computed.maps.values()),
            ))  # fmt: skip
    title = "Readings: mean of all starts ± 95 %. Maps: median (middle 80 % of points)"
    return [Table(title, head, rows)]
