"""The paper's Figures 5 to 10 and Table 4 from what was computed, and its tables laid beside."""

from __future__ import annotations

import json
import tomllib
from pathlib import Path

import numpy as np
import pandas as pd
from claims import BASE, CLEARANCES, FORCE, INNER, OUTER, RADII, ROOT, SHEETS, WIDTHS
from paper_figures import stress
from paper_page import Picture, Table, number
from predict import RADII as NAMES
from predict import WIDTHS as SIZES
from predict import additive, design_samples
from scipy.stats import t as student

from flexcage.render import sheet
from flexcage.render.claim_map import draw_claim_map
from flexcage.study.sensitivity import share

HERE = Path(__file__).parent
PRINTED = tomllib.loads((HERE / "printed.toml").read_text("utf-8"))
BETTER, MODEL, FLEXIBLE = "better model", "as printed", "flexible cage"  # columns of readings
CAGE = "map"  # column of the map
RACE = "map of races"  # the same where grooves and clearance vary
COLOURS = {BETTER: sheet.BLUE, MODEL: sheet.ORANGE, FLEXIBLE: sheet.VERMILION}
#: Outputs as figures show them: title with unit, factor from SI.
SHOWN = {
    FORCE: ("ball-cage force [N]", 1.0), ROOT: ("range at rivets' roots [MPa]", 1e-6),
    "rivet": ("nominal rivet stress [MPa]", 1e-6),
    "slip": ("cage slip, eq. 10 [%]", 100.0), "psi": ("inclination psi_c [deg]", 57.29578),
    "whirl": ("largest whirl radius [um]", 1e6),
}  # fmt: skip
PARTS = ("reference", "angle", "curvature", "traction")  # of the slip
TABLE_4 = tuple(f"{cage} {n}" for cage in ("modified", "original") for n in (9000, 8000, 7000))


def at(label: str, base: float) -> float:
    """Where a condition lies along its axis."""
    return base if label == BASE else float(label.split()[1])


def mean(reading, output: str, condition: str) -> tuple[float, float]:
    """Mean over the starts and half of its 95 % interval, SI; NaN where there is none."""
    found = reading.values(output, condition)
    found = found[np.isfinite(found)]
    if len(found) < 2:
        return float("nan"), float("nan")
    half = student.ppf(0.975, len(found) - 1) * found.std(ddof=1) / np.sqrt(len(found))
    return float(found.mean()), float(half)


def panel(ax, computed, output: str, conditions, base: float, name: str) -> None:
    """One output over one axis: all readings, with the intervals of their starts."""
    title, factor = SHOWN[output]
    for column, reading in computed.readings.items():
        rows = [(at(c, base), *mean(reading, output, c)) for c in conditions]
        x, y, half = np.array([row for row in rows if np.isfinite(row[1])]).reshape(-1, 3).T
        if len(x) > 1:
            ax.errorbar(x, y * factor, half * factor, color=COLOURS[column], marker="o", ms=3.5,
                        lw=1.2, capsize=2.5, label=column)  # fmt: skip
    ax.set(xlabel=name, ylabel=title)


def sweep(computed, path: Path, title: str, panels, columns: int) -> Path:
    """A figure of panels ``(output, conditions, base, axis, printed)``."""
    wide, high, left, top, gap = 430, 270, 90, 130, 110
    lines = -(-len(panels) // columns)
    with sheet.style():
        figure = sheet.new_figure(
            left + columns * (wide + gap), top + lines * (high + gap) - gap + 70
        )
        sheet.heading(figure, title, "means of all starts, 95 % intervals")
        for k, (output, conditions, base, name, printed) in enumerate(panels):
            row, column = divmod(k, columns)
            place = (left + column * (wide + gap), top + row * (high + gap), wide, high)
            ax = sheet.axes_at(figure, place)
            panel(ax, computed, output, conditions, base, name)
            if printed:
                ax.plot(list(map(float, printed)), list(printed.values()), "X", ms=6,
                        color=sheet.INK, label="paper, Table 3")  # fmt: skip
            places = [at(c, base) for c in conditions]
            if len(places) == 3:
                ax.set_xticks(places)
            ax.set_xlim(min(places) - 0.05 * np.ptp(places), max(places) + 0.05 * np.ptp(places))
            if output in (FORCE, ROOT, "rivet"):
                ax.set_ylim(0.0, 60.0 if output == FORCE else None)
            if k == 0:
                ax.legend(frameon=False, fontsize=7, ncol=4, loc="lower left",
                          bbox_to_anchor=(0.0, 1.0), borderaxespad=0.1)  # fmt: skip
        return sheet.save(figure, path)


def draw(computed, folder: Path) -> list[Picture]:
    """All pictures, in the paper's order."""
    table = PRINTED["table_3"]
    radius = (RADII, 3.46, "pocket radius [mm]")
    width = (WIDTHS, 6.2, "cage width [mm]")
    sheets = (SHEETS, 0.8, "sheet's thickness [mm]")
    sweep(computed, folder / "figure_5.png", "Figure 5: over the pocket radius", [
        (FORCE, *radius, table["radius"]), (ROOT, *radius, None), ("slip", *radius, None),
        ("psi", *radius, None), ("whirl", *radius, None), ("rivet", *radius, None)], 2)  # fmt: skip
    sweep(computed, folder / "figure_6.png", "Figure 6: over the cage's width", [
        (FORCE, *width, table["width"]), ("slip", *width, None), ("psi", *width, None)],
        3)  # fmt: skip
    sweep(computed, folder / "figure_7.png", "Figure 7: over the sheet's thickness",
          [(o, *sheets, None) for o in (FORCE, ROOT, "slip")], 3)  # fmt: skip
    races = ((INNER, 0.515, "inner conformity"), (OUTER, 0.525, "outer conformity"),
             (CLEARANCES, 10.0, "radial clearance [um]"))  # fmt: skip
    sweep(computed, folder / "figure_9.png", "Figure 9: over grooves and clearance",
          [(o, *axis, None) for axis in races for o in (FORCE, "slip", "psi")], 3)  # fmt: skip
    design(computed, folder / "figure_8.png")
    rivet(folder / "figure_10.png")
    slip(computed, folder / "table_4.png")
    return [
        *stress(
            computed, folder, "Figure 4: stress of the original cage at 9000 rpm",
            "Equivalent stress at its largest, coarse mesh. The paper's figure shows the "
            "joint alone, with the head's root as its weak place.",
        ),
        Picture("figure_5.png", "Figure 5: over the pocket radius",
                "Force with the printed numbers of Table 3 (crosses), range of stress at the roots "
                "of rivets' heads (flexible cage), slip, inclination, whirl, nominal stress of "
                "rivets. Width 6.2 mm. As printed, forces lie above the axis."),
        Picture("figure_6.png", "Figure 6: over the cage's width",
                "The same over the width, at a radius of 3.46 mm. A strip of 3.8 mm is in one "
                "piece from 5.81 mm on; the printed numbers go on to 4.4 mm."),
        Picture("figure_7.png", "Figure 7: over the sheet's thickness",
                "Radius 3.46 mm, width 6.2 mm. Stress: range at the roots of rivets' heads."),
        Picture("figure_8.png", "Figure 8, Table 3: force over radius and width",
                "Left: the 49 points computed (rigid cage, balls of 6.747 mm, strip of 5.6 mm). "
                "Right: what is predicted for the paper's table from its shown cross."),
        Picture("figure_9.png", "Figure 9: over grooves and clearance",
                "Each alone, at a radius of 3.46 mm and a width of 6.2 mm."),
        Picture("figure_10.png", "Figure 10: the rivet over its fit",
                "Largest equivalent stress at four places under the largest load, linear elastic; "
                "play below zero is interference."),
        Picture("table_4.png", "Table 4: slip of the cage at 9000 rpm, in parts",
                "Crosses: measured and the paper's own. Bars: parts of the computed slip, which "
                "sum to the dot. Box: middle 80 % of the map, its median."),
        *maps(computed, folder),
    ]  # fmt: skip


def maps(computed, folder: Path) -> list[Picture]:
    """Where both cages lag by equation 10, as measured."""
    joined = computed.maps[CAGE]
    slips = np.array([joined.means("slip", f"{cage} 9000") for cage in ("modified", "original")])
    outcomes = [bool(two.min() > 0.0) if np.isfinite(two).all() else None for two in slips.T]
    draw_claim_map(
        folder / "map_slip.png", title="Where both cages lag by equation 10, as measured",
        subtitle=f"slip above zero at 9000 rpm, {share(outcomes)} of the map",
        names=joined.names[:-1], ranges=joined.ranges, shares=joined.shares, outcomes=outcomes,
    )  # fmt: skip
    return [Picture("map_slip.png", "Map: where both cages lag, as measured",
                    "Blue points do, red ones do not; lines are shares over quarters of a range. "
                    "Ranges of conformities are those of balls of 6.747 mm.")]  # fmt: skip


def design(computed, path: Path) -> Path:
    """Table 3 as two maps: computed, and predicted from the shown cross."""
    found = table_3()
    samples = design_samples(computed)
    x, y = samples.x, samples.y
    radii, widths = np.unique(x[:, 0]), np.unique(x[:, 1])
    grid = np.array([[y[(x == (r, w)).all(axis=1)].mean() for r in radii] for w in widths])
    predicted = np.array([[found[f"{0.5 * r:.2f} x {w:g}"] for r in radii] for w in widths])
    with sheet.style():
        figure = sheet.new_figure(1360, 640)
        sheet.heading(figure, "Figure 8, Table 3: ball-cage force", "N, mean of the largest a turn")
        for k, (values, name) in enumerate(((grid, "computed"), (predicted, "the paper's table"))):
            ax = sheet.axes_at(figure, (90 + k * 640, 150, 520, 400))
            ax.grid(False)
            ax.imshow(values, origin="lower", aspect="auto", cmap="viridis")
            ax.set(title=name, xlabel="pocket radius [mm]", ylabel="cage width [mm]",
                   xticks=range(7), yticks=range(7))  # fmt: skip
            ax.set_xticklabels([f"{0.5 * r:.2f}" for r in radii])
            ax.set_yticklabels([f"{w:g}" for w in widths])
            middle = 0.5 * (values.min() + values.max())
            for i, j in np.ndindex(7, 7):
                shown = k and (radii[j] == 6.92 or widths[i] == 6.2)
                ax.text(j, i, f"{values[i, j]:.1f}", ha="center", va="center", fontsize=8,
                        weight="bold" if shown else "normal",
                        color="white" if values[i, j] < middle else "black")  # fmt: skip
        return sheet.save(figure, path)


def table_3() -> dict[str, float]:
    """Force [N] of every cell: printed where shown, else predicted."""
    rows = json.loads((HERE / "predictions.json").read_text("utf-8"))
    found = {r["row"]: r["value"] for r in rows if r["table"] == "3"}
    found |= {f"{r} x 6.2": value for r, value in PRINTED["table_3"]["radius"].items()}
    return found | {f"3.46 x {w}": value for w, value in PRINTED["table_3"]["width"].items()}


def rivet(path: Path) -> Path:
    """Figure 10c."""
    table = pd.read_csv(HERE / "fits.csv")
    columns = [c for c in table if c.endswith("again [MPa]")]
    with sheet.style():
        figure = sheet.new_figure(1100, 560)
        sheet.heading(figure, "Figure 10: the rivet over its fit", "equivalent stress, MPa")
        ax = sheet.axes_at(figure, (90, 120, 640, 360))
        for column, colour in zip(columns, sheet.CYCLE):
            ax.plot(table["play [um]"], table[column], marker="o", ms=4, lw=1.3, color=colour,
                    label=column.partition(",")[0])  # fmt: skip
        ax.set(xlabel="play over the diameter [um]", ylabel="MPa", ylim=(0.0, None))
        ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0))
        return sheet.save(figure, path)


def slip(computed, path: Path) -> Path:
    """Table 4 at 9000 rpm: parts of the slip by reading, and the map."""
    colours = (sheet.BLUE, sheet.VERMILION, sheet.ORANGE, sheet.GREEN)
    with sheet.style():
        figure = sheet.new_figure(1440, 600)
        sheet.heading(figure, "Table 4: slip of the cage at 9000 rpm", "%, by equation 10")
        for k, cage in enumerate(("modified", "original")):
            ax = sheet.axes_at(figure, (90 + k * 560, 130, 480, 380))
            names = [*computed.readings, CAGE]
            for i, reading in enumerate(computed.readings.values()):
                up = down = 0.0
                for part, colour in zip(PARTS, colours):
                    value = 100.0 * mean(reading, part, f"{cage} 9000")[0]
                    ax.bar(i, value, 0.5, up if value > 0.0 else down, color=colour,
                           label=part if not i else None)  # fmt: skip
                    up, down = (up + value, down) if value > 0.0 else (up, down + value)
                ax.plot(i, 100.0 * mean(reading, "slip", f"{cage} 9000")[0], "o", color=sheet.INK)
            found = 100.0 * computed.maps[CAGE].means("slip", f"{cage} 9000")
            low, mid, high = np.nanpercentile(found, (10.0, 50.0, 90.0))
            ax.bar(len(names) - 1, high - low, 0.5, low, color="0.75")
            ax.plot(len(names) - 1, mid, "o", color=sheet.INK)
            for source, marker, aside in (("experimental", "X", 0.7), ("artificial", "P", 0.5)):
                ax.axhline(PRINTED["table_4"][source][cage], color="0.4", lw=0.8, ls="--")
                ax.plot(len(names) - aside, PRINTED["table_4"][source][cage], marker, ms=8,
                        color=sheet.INK, label=f"paper, {source}")  # fmt: skip
            ax.axhline(0.0, color=sheet.INK, lw=0.8)
            ax.set(title=f"{cage} cage", xticks=range(len(names)), ylabel="%", ylim=(-7.0, 3.5))
            ax.set_xticklabels(names, fontsize=7)
            if k:
                ax.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0), fontsize=8)
        return sheet.save(figure, path)


def _starts(reading, output: str, condition: str, factor: float) -> str:
    return number(*mean(reading, output, condition), factor=factor)


def tables(computed) -> list[Table]:
    """Table 3's cross and Table 4 of the paper beside what was computed and predicted."""
    rows, predicted = [], {}
    for r in json.loads((HERE / "predictions.json").read_text("utf-8")):
        predicted[r["table"], r["row"]] = f"{r['value']:g} ({r['low']:g} to {r['high']:g})"
    for condition in RADII:
        printed = PRINTED["table_3"]["radius"][f"{at(condition, 3.46):.2f}"]
        rows.append((f"Table 3: {at(condition, 3.46):.2f} x 6.2 [N]", f"{printed:g}", "-",
                     *_cells(computed, FORCE, condition, 1.0)))  # fmt: skip
    for condition in (c for c in WIDTHS if c != BASE):
        width = f"{at(condition, 6.2):g}"
        printed = PRINTED["table_3"]["width"].get(width)
        if printed is not None:
            rows.append((f"Table 3: 3.46 x {width} [N]", f"{printed:g}", "-",
                         *_cells(computed, FORCE, condition, 1.0)))  # fmt: skip
    for condition in TABLE_4:
        cage, speed = condition.split()
        for source in ("experimental", "artificial"):
            shown = speed == "9000"
            printed = f"{PRINTED['table_4'][source][cage]:g}" if shown else "-"
            said = "-" if shown else predicted["4", f"{cage} {speed} {source}"]
            cells = _cells(computed, "slip", condition, 100.0)
            rows.append((f"Table 4: {condition} rpm, {source} [%]", printed, said, *cells))
    head = ("quantity", "paper", "predicted", *computed.readings, CAGE)
    title = (
        "Readings: mean of all starts ± 95 %. Maps: median (middle 80 % of points). Predicted: "
        "90 % interval"
    )
    return [Table(title, head, rows), cross()]


def _cells(computed, output: str, condition: str, factor: float) -> list[str]:
    return [
        *(_starts(r, output, condition, factor) for r in computed.readings.values()),
        computed.maps[CAGE].middle(output, condition, factor),
    ]  # fmt: skip


def cross() -> Table:
    """Table 3: predictions, and beside them what the shown cross alone predicts."""
    alone = additive(PRINTED)
    rows = {r["row"]: r for r in json.loads((HERE / "predictions.json").read_text("utf-8"))}

    def cell(radius: str, width: str) -> str:
        row = f"{radius} x {width}"
        if row not in alone:
            return f"**{table_3()[row]:g}**"
        r = rows[row]
        return f"{r['value']:.1f} ({r['low']:.1f} to {r['high']:.1f}); {alone[row]:.1f}"

    return Table(
        "Table 3 [N]: shown in bold; else predicted (90 %); the sum of the shown cross alone",
        ("radius", *(f"w {w}" for w in SIZES)),
        [(r, *(cell(r, w) for w in SIZES)) for r in NAMES],
    )
