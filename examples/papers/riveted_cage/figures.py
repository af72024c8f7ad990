"""The paper's Figures 4 to 12 and Table 4, laid out as the paper has them, from what was
computed."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np
import pandas as pd
from claims import BASE, FORCE, ROOT, SLIP, TILT
from judging.panels import kept
from judging.pictures import COLOURS, bands, rendered, starts
from matplotlib.axes import Axes
from outputs import CLAMP, FRICTION, PLAYS, ROOT_RADIUS, joint
from predict import design_samples
from sketch import draw_sketch

from flexcage import Run
from flexcage.render import sheet
from flexcage.results import metrics
from flexcage.stress.riveted_joint import Fit, JointResult

HERE = Path(__file__).parent
PRINTED = tomllib.loads((HERE / "printed.toml").read_text("utf-8"))
CAGE, RACE, RIVET, JOINT = "cage", "races", "rivets", "joint"  # samples
RIG, MODEL, FLEXIBLE = "as the rig loads it", "as printed", "flexible cage"  # readings
READINGS = {RIG: (sheet.GREEN, "o"), MODEL: (sheet.VERMILION, "s"), FLEXIBLE: ("#b07aa1", "D")}
#: Outputs as figures show them: axis with unit, factor from SI.
SHOWN = {
    FORCE: ("ball-cage force / N", 1.0), ROOT: ("nominal stress of a rivet / MPa", 1e-6),
    SLIP: ("slip of the cage |S_c| / %", 100.0), TILT: ("tilt psi_c / deg", 180.0 / np.pi),
}  # fmt: skip
RADIUS = {"Rp 3.43": 3.43, "Rp 3.44": 3.44, "Rp 3.45": 3.45, BASE: 3.46, "Rp 3.47": 3.47,
          "Rp 3.48": 3.48, "Rp 3.49": 3.49}  # fmt: skip
WIDTH = {"w 4.4": 4.4, "w 5.0": 5.0, "w 5.6": 5.6, BASE: 6.2, "w 6.8": 6.8, "w 7.4": 7.4,
         "w 8.0": 8.0}  # fmt: skip
SHEET = {"t 0.7": 0.7, BASE: 0.8, "t 1.0": 1.0}
INNER = {"f_i 0.505": 0.505, BASE: 0.515, "f_i 0.525": 0.525}
OUTER = {"f_e 0.515": 0.515, BASE: 0.525, "f_e 0.530": 0.530}
PLAY = {"Pd 5": 5.0, BASE: 10.0, "Pd 20": 20.0}
CAGES = {"modified 9000": 0.0, "original 9000": 1.0}
WIDE, HIGH, LEFT, TOP, GAP, BELOW = 400, 260, 90, 125, 100, 115  # px, of panels
BESIDE = 0.02  # mm beside the joint's plane of symmetry, on which faces of elements lie

Axis = Mapping[str, float]
Panel = tuple[str, str, Axis, str, str]  # title, output, axis, its name, sample


def panel(ax: Axes, computed, output: str, axis: Axis, sample: str) -> None:
    """One output over one axis: the sample where it has it, and starts of readings."""
    _, factor = SHOWN[output]
    there = computed.samples.get(sample)
    if there is not None:
        known = {c: at for c, at in axis.items() if c in there.conditions}
        bands(ax, there, output, known, factor)
    for k, (name, (colour, marker)) in enumerate(READINGS.items()):
        reading = computed.readings.get(name)
        if reading is None or output == ROOT and name != FLEXIBLE:
            continue
        places = {c: at for c, at in axis.items() if c in reading.conditions}
        if name == FLEXIBLE and output != ROOT or len(places) < 2:
            continue
        shift = 0.01 * k * float(np.ptp(list(axis.values())))
        starts(ax, reading, output, places, factor, colour=colour, label=name, marker=marker,
               shift=shift)  # fmt: skip


def sweep(computed, folder: Path, name: str, title: str, panels: Sequence[Panel],
          columns: int = 3) -> str:  # fmt: skip
    """A figure of panels; those of one output have one scale. The file's name."""
    lines = -(-len(panels) // columns)
    with sheet.style():
        figure = sheet.new_figure(LEFT + min(columns, len(panels)) * (WIDE + GAP),
                                  TOP + lines * (HIGH + BELOW))  # fmt: skip
        sheet.heading(figure, title, "band: middle 80 % of settings and median; marks: starts of "
                      "readings, least to largest")  # fmt: skip
        drawn: dict[str, list[Axes]] = {}
        for k, (word, output, axis, below, sample) in enumerate(panels):
            row, column = divmod(k, columns)
            place = (LEFT + column * (WIDE + GAP), TOP + row * (HIGH + BELOW), WIDE, HIGH)
            ax = sheet.axes_at(figure, place)
            panel(ax, computed, output, axis, sample)
            printed(ax, output, axis)
            ax.set(xlabel=below, ylabel=SHOWN[output][0])
            ax.set_title(word, loc="left", fontsize=10)
            if len(axis) < 4:
                ax.set_xticks(list(axis.values()))
            if k == 0:
                ax.legend(loc="best", fontsize=7, frameon=False)
            drawn.setdefault(output, []).append(ax)
        if name == "figure_5":
            row, column = divmod(len(panels), columns)
            place = (LEFT + column * (WIDE + GAP), TOP + row * (HIGH + BELOW), WIDE, HIGH)
            orbits(sheet.axes_at(figure, place), computed)
        for axes in drawn.values():
            top = max(ax.get_ylim()[1] for ax in axes)
            for ax in axes:
                ax.set_ylim(0.0, top)
        sheet.save(figure, folder / f"{name}.png")
    return f"{name}.png"


def printed(ax: Axes, output: str, axis: Axis) -> None:
    """The numbers of Table 3's cross that are shown."""
    rows = {id(RADIUS): "radius", id(WIDTH): "width"}
    if output == FORCE and id(axis) in rows:
        numbers = PRINTED["table_3"][rows[id(axis)]]
        ax.plot([float(x) for x in numbers], list(numbers.values()), "X", ms=6, color=sheet.INK,
                label="printed (Table 3)")  # fmt: skip


def orbits(ax: Axes, computed) -> None:
    """Figure 5d: the cage's centre at three radii, one start each, overlaid."""
    reading = computed.readings[RIG]
    for colour, (condition, name) in zip(
        COLOURS, (("Rp 3.49", "3.49 mm"), (BASE, "3.46 mm"), ("Rp 3.43", "3.43 mm"))
    ):
        run = reading.run(condition)
        yz = metrics.orbit(metrics.settled(run.dataset, run.case.output.settle)) * 1e6
        ax.plot(yz[:, 1], -yz[:, 0], lw=0.8, color=colour, label=name)
    ax.set(aspect="equal", xlabel="z / um", ylabel="-y / um")
    ax.set_title("(d) orbit of the cage's centre", loc="left", fontsize=10)
    ax.legend(loc="best", fontsize=7, frameon=False)


def loaded_joint(run: Run, play: float) -> JointResult:
    """The joint of the most stressed rivet of a run through its cycle."""
    cage, bearing = run.case.cage, run.case.bearing
    shape = cage.rivet_joint(bearing.pitch_diameter, bearing.element_count, ROOT_RADIUS)
    _, largest, least = run.rivets.cycle()
    fit = Fit(play=play, clamp=CLAMP, friction=FRICTION)
    return joint(shape, cage.material).cycle(largest, least, fit)


def section(ax: Axes, result: JointResult, most: float):
    """Equivalent stress in the joint's section along the cage, coloured up to ``most`` [MPa]."""
    import pyvista

    bodies = result.bodies
    tets = bodies.tets[:, :4]
    cells = np.column_stack([np.full(len(tets), 4), tets]).ravel()
    kinds = np.full(len(tets), pyvista.CellType.TETRA)
    grid = pyvista.UnstructuredGrid(cells, kinds, bodies.nodes * 1e3)
    grid["stress"] = result.instants["again"].equivalent * 1e-6
    cut = grid.slice(normal="z", origin=(0.0, 0.0, BESIDE)).triangulate()
    triangles = cut.faces.reshape(-1, 4)[:, 1:]
    image = ax.tripcolor(cut.points[:, 1], cut.points[:, 0], triangles, cut["stress"],
                         shading="gouraud", cmap="inferno", vmin=0.0, vmax=most)  # fmt: skip
    ax.set(aspect="equal", xlabel="across / mm", ylabel="along the rivet / mm", xlim=(-1.9, 1.9))
    ax.grid(False)
    return image


def joints(computed, folder: Path) -> str:
    """Figures 4b and 10a to c: stress in the joint, and over its fit; the file's name."""
    run = computed.readings[FLEXIBLE].run(BASE)
    found = {name: loaded_joint(run, play) for name, play in PLAYS.items()}
    top = {k: r.instants["again"].equivalent for k, r in found.items()}
    most = 1e-6 * max(float(np.percentile(stress, 99.8)) for stress in top.values())
    names = {"tight": "interference of 3 um", "loose": "play of 3 um"}
    with sheet.style():
        figure = sheet.new_figure(1560, 570)
        under = "equivalent stress, linear elastic: (a, b) section, (c) largest by place"
        sheet.heading(figure, "Figures 4 and 10: stress of the rivet by its fit", under)
        for k, name in enumerate(("tight", "loose")):
            ax = sheet.axes_at(figure, (100 + k * 410, TOP, 370, 350))
            image = section(ax, found[name], most)
            if k:
                ax.set(ylabel="", yticklabels=())
            ax.set_title(f"({'ab'[k]}) {names[name]}", loc="left", fontsize=10)
        bar = figure.colorbar(image, cax=sheet.axes_at(figure, (900, TOP, 16, 350)))
        bar.set_label("MPa")
        over_fits(sheet.axes_at(figure, (1110, TOP, 400, 350)))
        sheet.save(figure, folder / "figure_10.png")
    return "figure_10.png"


def over_fits(ax: Axes) -> None:
    """Figure 10c, by rivet.py."""
    table = pd.read_csv(HERE / "fits.csv")
    for column, colour in zip((c for c in table if c.endswith("again [MPa]")), COLOURS):
        ax.plot(table["play [um]"], table[column], "o-", ms=4, lw=1.3, color=colour,
                label=column.partition(",")[0])  # fmt: skip
    ax.set(xlabel="play over the diameter / um", ylabel="MPa", ylim=(0.0, None))
    ax.set_title("(c) over the fit", loc="left", fontsize=10)
    ax.legend(loc="best", fontsize=8, frameon=False)


def both_cages(computed, folder: Path) -> str:
    """Table 4 and Figure 12: slip, and stress of rivets, of both cages; the file's name."""
    with sheet.style():
        figure = sheet.new_figure(1420, 500)
        sheet.heading(figure, "Table 4 and Figure 12: both cages at 9000 rpm", "boxes: middle 80 % "
                      "of settings and median; marks: starts of readings")  # fmt: skip
        for k, (output, sample) in enumerate(((SLIP, CAGE), (ROOT, RIVET))):
            ax = sheet.axes_at(figure, (90 + k * 680, TOP, 330, 300))
            of_both(ax, computed, output, sample)
            ax.set(xticks=(0.0, 1.0), xlim=(-0.5, 1.6), ylabel=SHOWN[output][0])
            ax.set_xticklabels(("modified", "original"))
            ax.set_ylim(0.0, None)
            ax.legend(loc="upper left", bbox_to_anchor=(1.0, 1.0), fontsize=7, frameon=False)
        sheet.save(figure, folder / "table_4.png")
    return "table_4.png"


def of_both(ax: Axes, computed, output: str, sample: str) -> None:
    """An output of both cages: settings, starts of readings, printed slips."""
    factor, there = SHOWN[output][1], computed.samples.get(sample)
    for cage, at in CAGES.items() if there is not None else ():
        low, mid, high = np.nanpercentile(there.means[output, cage] * factor, (10.0, 50.0, 90.0))
        ax.bar(at, high - low, 0.4, low, color=sheet.BLUE, alpha=0.2)
        ax.plot([at - 0.2, at + 0.2], [mid, mid], color=sheet.BLUE, lw=1.6,
                label="settings that the text allows" if at == 0.0 else None)  # fmt: skip
    for k, (column, (colour, marker)) in enumerate(READINGS.items()):
        reading = computed.readings.get(column)
        if reading is not None and (output != ROOT or column == FLEXIBLE):
            starts(ax, reading, output, CAGES, factor, colour=colour, label=column, marker=marker,
                   shift=0.28 + 0.06 * k)  # fmt: skip
    for source, marker in (("experimental", "X"), ("artificial", "P")) if output == SLIP else ():
        ax.plot([-0.3, 0.7], list(PRINTED["table_4"][source].values()), marker, ms=8, ls="",
                color=sheet.INK, label=f"printed, {source}")  # fmt: skip


def surface(computed, folder: Path) -> str:
    """Figure 8: the 49 cages of Table 3, and the printed numbers that are shown."""
    with sheet.style():
        figure = sheet.new_figure(1180, 600)
        under = "N; left computed, right the printed cross that is at hand; one scale"
        sheet.heading(figure, "Figure 8, Table 3: ball-cage force over radius and width", under)
        grids, radii, widths = grids_of(design_samples(computed))
        most = max(np.nanmax(grid) for grid in grids)
        for k, (grid, word) in enumerate(zip(grids, ("computed", "printed"))):
            ax = sheet.axes_at(figure, (90 + 550 * k, TOP + 10, 440, 380))
            ax.grid(False)
            ax.imshow(grid, origin="lower", aspect="auto", cmap="viridis", vmin=20.0, vmax=most)
            ax.set(xticks=range(len(radii)), yticks=range(len(widths)),
                   xlabel="pocket radius / mm", ylabel="cage width / mm")  # fmt: skip
            ax.set_title(word, loc="left", fontsize=10)
            ax.set_xticklabels([f"{r:.2f}" for r in radii])
            ax.set_yticklabels([f"{w:g}" for w in widths])
            for i, j in zip(*np.nonzero(np.isfinite(grid))):
                ax.text(j, i, f"{grid[i, j]:.1f}", ha="center", va="center", fontsize=8,
                        color="white" if grid[i, j] < 0.5 * (20.0 + most) else "black")  # fmt: skip
        sheet.save(figure, folder / "figure_8.png")
    return "figure_8.png"


def grids_of(samples) -> tuple[tuple[np.ndarray, np.ndarray], np.ndarray, np.ndarray]:
    """Forces (widths, radii) [N] computed, and printed where shown, with radii and widths [mm]."""
    x, y = samples.x, samples.y
    diameters, widths = np.unique(x[:, 0]), np.unique(x[:, 1])
    own = np.array([[y[(x == (d, w)).all(axis=1)].mean() for d in diameters] for w in widths])
    shown = np.full_like(own, np.nan)
    table = PRINTED["table_3"]
    for j, d in enumerate(diameters):
        shown[np.isclose(widths, 6.2), j] = table["radius"][f"{0.5 * d:.2f}"]
    for i, w in enumerate(widths):
        shown[i, np.isclose(diameters, 6.92)] = table["width"][f"{w:g}"]
    return (own, shown), 0.5 * diameters, widths


def draw(computed, folder: Path) -> dict[str, str]:
    """All pictures by the figure that they repeat."""
    c = computed
    radius = (RADIUS, "pocket radius / mm")
    width = (WIDTH, "cage width / mm")
    thick = (SHEET, "sheet's thickness / mm")
    found = {"sketch": draw_sketch(folder / "sketch.png")}
    if FLEXIBLE in c.readings:
        found["10"] = kept(folder / "figure_10.png", lambda: joints(c, folder))
        path = folder / "stress.png"
        found["stress"] = kept(path, lambda: rendered(
            c.readings[FLEXIBLE].run(BASE), "stress_peak", path))  # fmt: skip
    found["5"] = kept(folder / "figure_5.png", lambda: sweep(
        c, folder, "figure_5", "Figure 5: over the pocket radius", (
        ("(a) force", FORCE, *radius, CAGE), ("(b) rivets", ROOT, *radius, RIVET),
        ("(c) slip", SLIP, *radius, CAGE), ("(c) tilt", TILT, *radius, CAGE))))  # fmt: skip
    found["6"] = sweep(c, folder, "figure_6_7", "Figures 6 and 7: over width and sheet", (
        ("6a force", FORCE, *width, CAGE), ("6c slip", SLIP, *width, CAGE),
        ("6c tilt", TILT, *width, CAGE), ("7a force", FORCE, *thick, CAGE),
        ("7a rivets", ROOT, *thick, RIVET), ("7b slip", SLIP, *thick, CAGE)))  # fmt: skip
    races = ((INNER, "f_i", "ab"), (OUTER, "f_e", "cd"), (PLAY, "radial clearance / um", "ef"))
    found["9"] = sweep(c, folder, "figure_9", "Figure 9: over grooves and clearance", [
        (f"({letters[output != FORCE]}) {word}", output, axis, below, RACE)
        for axis, below, letters in races
        for output, word in ((FORCE, "force"), (SLIP, "slip"), (TILT, "tilt"))])  # fmt: skip
    if (c.out / "design").is_dir():
        found["8"] = surface(c, folder)
    found["t4"] = both_cages(c, folder)
    return found
