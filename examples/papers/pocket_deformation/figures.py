"""The paper's Figures 8 to 19 from what was computed, and numbers laid beside its tables."""

from __future__ import annotations

import tomllib
from collections.abc import Callable
from math import pi
from pathlib import Path

import numpy as np
from claims import CAGES, SHORTER
from outputs import AFTER, AT, BEFORE, PLACES
from paper_figures import claim_map, stress
from paper_page import Picture, Table
from scipy.interpolate import LinearNDInterpolator

from flexcage import Run
from flexcage.render import sheet
from flexcage.results import metrics
from flexcage.results.slip import element_spin

PRINTED = tomllib.loads((Path(__file__).with_name("printed.toml")).read_text("utf-8"))
ROOT = PRINTED["conclusion_2"]["root"][SHORTER]  # MPa
RPM, UM, MPA, PERCENT = 30.0 / pi, 1e6, 1e-6, 100.0
BETTER, PRINTED_MODEL = "better model", "as printed"  # columns of readings
MAP, FLEXIBLE = "map", "flexible points"  # columns of maps
MAPPED = "000-7"  # claim whose map is drawn
WIDE, HIGH, LEFT, TOP = 250, 170, 210, 130  # px, of panels
FINEST = 700  # bands of a curve
COLOURS = {BEFORE: (sheet.BLUE, "j-1"), AT: (sheet.VERMILION, "j"), AFTER: (sheet.GREEN, "j+1")}

Curves = list[tuple[np.ndarray, str, str]]  # values, colour, name


def draw(computed, folder: Path) -> list[Picture]:
    """All pictures, in the paper's order."""
    histories = (
        (
            "figure_8_14",
            "Stress at corners of pockets j-1 and j",
            "largest, MPa",
            _corner,
            (-10.0, 350.0),
        ),
        ("figure_9_15", "Radial displacement of the cage", "um", _radial, None),
        ("figure_11_17", "Acceleration of the outer ring", "along the load, m/s²", _shake, None),
        ("figure_12_18", "Cage speed", "rpm", _cage_speed, None),
        ("figure_13_19", "Speeds of rollers j-1, j and j+1", "1000 rpm", _rollers, (-5.0, 31.0)),
    )
    shapes = pockets(computed, folder / "figure_2_3.png")
    for file, title, note, curves, limits in histories:
        over_time(computed, folder / f"{file}.png", title, note, curves, limits)
    orbits(computed, folder / "figure_10_16.png")
    title = "Where a moved crossbeam makes roller j-1 slip as printed"
    claim_map(computed, MAP, MAPPED, folder / "map_000_7.png", title)
    return [
        *shapes,
        Picture("figure_8_14.png", "Figures 8 and 14: stress of the cage",
                f"First starts. The dashed line is the printed number, {ROOT} MPa; all others of "
                "the paper's curves have none."),
        Picture("figure_9_15.png", "Figures 9 and 15: radial displacement of the cage",
                "Distance of the cage's centre from the axis."),
        Picture("figure_10_16.png", "Figures 10 and 16: orbit of the cage's centre",
                "Settled part, load down, all on one scale; the circle is the ribs' clearance."),
        Picture("figure_11_17.png", "Figures 11 and 17: acceleration of the outer ring",
                "Along the load, low-passed at 10 kHz."),
        Picture("figure_12_18.png", "Figures 12 and 18: cage speed", "Rows have a scale each."),
        Picture("figure_13_19.png", "Figures 13 and 19: speeds of adjacent rollers",
                "A roller that its pocket holds turns with the cage, backwards in this sense."),
        Picture("map_000_7.png", f"Map of claim {MAPPED}",
                "Blue points hold, red ones do not; lines are shares over quarters of a range."),
        *stress(
            computed, folder, "Figure 5: stress where the shorter pocket pinches its roller",
            "Better model, side beam moved by -0.3 mm: equivalent stress at its largest.",
        ),
    ]  # fmt: skip


def computed_readings(computed, output: str = "lost") -> dict:
    """Readings that have an output of every cage: stress is that of flexible ones alone."""
    return {
        column: r for column, r in computed.readings.items()
        if r.starts and np.isfinite(r.values(output, CAGES[0])).all()
    }  # fmt: skip


def first(reading) -> dict[str, Run]:
    """First starts of a reading, of the cages that have one."""
    return {c: reading.run(c) for c in CAGES if len(reading.values("lost", c))}


def _corner(run) -> tuple[np.ndarray, Curves]:
    history = run.stress_history
    here = [k for k, name in enumerate(history.place_names) if name.startswith(PLACES)]
    values = history.places[:, here].max(axis=1) * MPA
    return run.dataset["time"].values, [(values, sheet.BLUE, "")]


def _radial(run) -> tuple[np.ndarray, Curves]:
    values = metrics.whirl_radius(run.dataset, about="axis") * UM
    return run.dataset["time"].values, [(values, sheet.BLUE, "")]


def _shake(run) -> tuple[np.ndarray, Curves]:
    values = run.dataset["outer_acceleration_filtered"].sel(axis2="y")
    return values["time_hf"].values, [(values.values, sheet.BLUE, "")]


def _cage_speed(run) -> tuple[np.ndarray, Curves]:
    values = run.dataset["cage_omega"].sel(axis="x").values * RPM
    return run.dataset["time"].values, [(values, sheet.BLUE, "")]


def _rollers(run) -> tuple[np.ndarray, Curves]:
    spin = element_spin(run.dataset).transpose("time", "element").values * RPM * 1e-3
    curves = [(spin[:, k], colour, name) for k, (colour, name) in COLOURS.items()]
    return run.dataset["time"].values, curves


def pocket_sides(mesh, radius: float, pocket: int) -> dict[str, np.ndarray]:
    """Walls of a pocket at the circle of ``radius`` [m]: points (n, 2) of places across the pocket
    and along the axis [mm] by the face's name, between the vertices of the face."""
    found = {}
    turn = 2.0 * pi * pocket / mesh.pocket_count
    for face in ("front", "rear", "side+x", "side-x"):
        x, y, z = mesh.points[np.unique(mesh.groups[f"pocket{pocket}_{face}"])].T
        away, across = y * np.cos(turn) + z * np.sin(turn), z * np.cos(turn) - y * np.sin(turn)
        crossbeam = face in ("front", "rear")
        along, value = (x, across) if crossbeam else (across, x)
        at = np.linspace(0.98 * along.min(), 0.98 * along.max(), 41)
        surface = LinearNDInterpolator(np.stack([along, away], axis=1), value, rescale=True)
        wall = surface(at, np.full(len(at), radius))
        found[face] = np.stack([wall, at] if crossbeam else [at, wall], axis=1) * 1e3
    return found


def pocket_size(sides: dict[str, np.ndarray]) -> tuple[float, float]:
    """Width and length [mm] of a pocket across its middle."""

    def middle(face: str, along: int) -> float:
        at = sides[face][np.isfinite(sides[face]).all(axis=1)]
        return float(np.interp(0.0, at[:, 1 - along], at[:, along]))

    return middle("front", 0) - middle("rear", 0), middle("side+x", 1) - middle("side-x", 1)


def pockets(computed, path: Path) -> list[Picture]:
    """The paper's Figures 2 and 3: pockets of the meshed cages, deformed and sound, unrolled."""
    runs = first(computed.readings[BETTER])
    if set(runs) != set(CAGES):
        return []
    radius = 0.5 * runs[CAGES[0]].case.bearing.pitch_diameter
    sound, mesh = runs[CAGES[0]].mesh, None
    wide, high, apart = 520, 190, 1e3 * 2.0 * pi * radius / sound.pocket_count
    with sheet.style():
        figure = sheet.new_figure(70 + 2 * (wide + 60), 120 + 2 * (high + 70))
        sheet.heading(
            figure,
            "Pockets of the meshed cages at the pitch circle",
            "mm across the pockets and along the axis (up); broken lines: the sound cage",
        )
        for k, cage in enumerate(CAGES[1:]):
            place = (70 + (k % 2) * (wide + 60), 120 + (k // 2) * (high + 70), wide, high)
            ax, mesh = sheet.axes_at(figure, place), runs[cage].mesh
            for j, (pocket, (colour, name)) in enumerate(COLOURS.items()):
                for kind, line in ((sound, "--"), (mesh, "-")):
                    sides = pocket_sides(kind, radius, pocket)
                    for at in sides.values():
                        ax.plot(at[:, 0] + (j - 1) * apart, at[:, 1], line, lw=1.2,
                                color="0.6" if kind is sound else colour)  # fmt: skip
                size = "\n".join(f"{x:.2f}" for x in pocket_size(sides))
                ax.text((j - 1) * apart, 0.0, f"{name}\n{size}", ha="center", va="center",
                        fontsize=8, color=colour)  # fmt: skip
            ax.set_title(cage, loc="left")
            ax.set(aspect="equal", ylim=(-6.0, 6.0))
        sheet.save(figure, path)
    count = f"{len(sound.tets):,} quadratic elements of {len(sound.points):,} vertices"
    return [
        Picture(path.name, "Figures 2 and 3: deformed pockets",
                "Width and length of pockets j-1, j and j+1 [mm], measured in the meshes. The side "
                "beam's middle, moved by 0.3 mm, lies between two vertices. Figure 4, a picture of "
                "the paper's model, is not repeated: its cage has 377,400 elements and 87,014 "
                f"nodes, this one {count}."),
    ]  # fmt: skip


def over_time(computed, path: Path, title: str, note: str, curves: Callable,
              limits: tuple[float, float] | None) -> Path:  # fmt: skip
    """Curves of every cage, one row a reading, over ms of the settled part."""
    readings = computed_readings(computed, "corner" if curves is _corner else "lost")
    with sheet.style():
        figure = sheet.new_figure(
            LEFT + len(CAGES) * (WIDE + 46), TOP + len(readings) * (HIGH + 66)
        )
        sheet.heading(figure, title, f"{note}; over ms")
        for i, (column, reading) in enumerate(readings.items()):
            top = TOP + i * (HIGH + 66)
            sheet.text_at(figure, 20, top + 0.5 * HIGH, column)
            found = {c: (run.case.output.settle, *curves(run)) for c, run in first(reading).items()}
            low, high = limits or _limits(found)
            for c, (settle, time, drawn) in found.items():
                place = (LEFT + CAGES.index(c) * (WIDE + 46), top, WIDE, HIGH)
                ax = sheet.axes_at(figure, place)
                settled = time >= settle * time[-1]
                for values, colour, name in drawn:
                    banded(ax, time[settled] * 1e3, values[settled], colour, name)
                if curves is _corner and c == SHORTER:
                    ax.axhline(ROOT, color=sheet.INK, ls="--", lw=1.0)
                ax.set(ylim=(low, high), xlim=(settle * time[-1] * 1e3, time[-1] * 1e3))
                ax.tick_params(labelleft=c == CAGES[0])
                ax.set_title(c, loc="left")
                if len(drawn) > 1 and c == CAGES[0]:
                    ax.legend(loc="center left", fontsize=7)
        return sheet.save(figure, path)


def _limits(found) -> tuple[float, float]:
    """Lowest and highest settled value of a row, with a margin."""
    parts = [v[t >= s * t[-1]] for s, t, drawn in found.values() for v, _, _ in drawn]
    if not parts:
        return 0.0, 1.0
    low, high = min(float(p.min()) for p in parts), max(float(p.max()) for p in parts)
    aside = 0.05 * (high - low) or 1.0
    return low - aside, high + aside


def banded(ax, time: np.ndarray, values: np.ndarray, colour: str, name: str) -> None:
    """A record as the band between its lowest and highest values: no peak is lost."""
    step = max(len(time) // FINEST, 1)
    n = len(time) // step * step
    cut = np.asarray(values[:n], float).reshape(-1, step)
    at = time[:n].reshape(-1, step).mean(axis=1)
    ax.fill_between(at, cut.min(axis=1), cut.max(axis=1), color=colour, lw=0.6, label=name or None)


def orbits(computed, path: Path) -> Path:
    """Orbits of the cage's centre, one row a reading."""
    side = 240
    with sheet.style():
        figure = sheet.new_figure(
            LEFT + len(CAGES) * (side + 56), TOP + len(computed_readings(computed)) * (side + 66)
        )
        sheet.heading(figure, "Orbit of the cage's centre", "um, load down")
        for i, (column, reading) in enumerate(computed_readings(computed).items()):
            sheet.text_at(figure, 20, TOP + (i + 0.5) * (side + 66) - 40, column)
            for c, run in first(reading).items():
                yz = metrics.orbit(metrics.settled(run.dataset, run.case.output.settle)) * UM
                place = (LEFT + CAGES.index(c) * (side + 56), TOP + i * (side + 66), side, side)
                ax = sheet.axes_at(figure, place)
                ax.plot(yz[:, 1], -yz[:, 0], color=sheet.BLUE, lw=0.6)
                ring = np.exp(1j * np.linspace(0.0, 2.0 * pi, 200)) * run.case.land.clearance * UM
                ax.plot(ring.real, ring.imag, color="0.6", lw=0.8, ls="--")
                ax.set(xlim=(-330, 330), ylim=(-330, 330), aspect="equal")
                ax.tick_params(labelleft=c == CAGES[0])
                ax.set_title(c, loc="left")
        return sheet.save(figure, path)


def tables(computed) -> list[Table]:
    """Numbers of every cage by reading and map, beside what the paper prints."""
    asked = (
        ("stress at corners [MPa]", "corner", MPA),
        ("amplitude of radial displacement [um]", "reach", UM),
        ("whirl radius [um]", "whirl", UM),
        ("share of the centre's strongest line [%]", "line", PERCENT),
        ("kurtosis of acceleration", "spikes", 1.0),
        ("cage speed fluctuation [%]", "ripple", PERCENT),
        ("its mean frequency [Hz]", "pitch", 1.0),
        ("Tables 2 and 3: slip of j-1 [%]", "slip_before", PERCENT),
        ("Tables 2 and 3: slip of j [%]", "slip_at", PERCENT),
        ("Tables 2 and 3: slip of j+1 [%]", "slip_after", PERCENT),
    )
    rows = [("stress, conclusion 2 [MPa]", "paper", "-", "-", "-", "-", f"{ROOT}")]
    for title, output, factor in asked:
        for column, reading in computed.readings.items():
            if reading.starts:
                rows.append((title, column, *(reading.said(output, c, factor) for c in CAGES)))
        for column, joined in computed.maps.items():
            if joined.spread(output, CAGES[0]) is not None:
                rows.append((title, column, *(joined.middle(output, c, factor) for c in CAGES)))
    rows = [r for r in rows if set(r[2:]) != {"-"}]
    head = ("quantity", "by", *CAGES)
    return [Table("Mean of all starts ± 95 %; map: median (middle 80 % of points)", head, rows)]
