"""The page of the study of riveted cages and its pictures, written from what was computed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import date
from pathlib import Path

from ball_claim import Found, View, percent, short
from riveted_cage_claims import BASE, PAPER, RADII, WIDTHS

import flexcage
from flexcage.render import sheet
from flexcage.study.verdicts import Verdict

HEAD = (
    "case", "force of a pass [N]", "mean force in contact [N]", "cage slip", "cage tilt [deg]",
    "largest whirl radius [um]", "stress [MPa]",
)  # fmt: skip
#: Forces [N] of the paper's table 3: over the pocket radius at w 6.2 mm, over w at 3.46 mm.
PRINTED = {
    "Rp 3.43": 29.657, "Rp 3.44": 26.27, "Rp 3.45": 25.49, BASE: 25.12, "Rp 3.47": 25.51,
    "Rp 3.48": 26.33,
}  # fmt: skip
PRINTED_WIDTHS = {"w 6.8": 25.49, "w 7.4": 27.61, "w 8.0": 31.162}


def table(found: Mapping[str, Found]) -> str:
    """All figures of all readings as tables of Markdown."""
    return "\n\n".join(f"### {name}\n\n{_reading(View(f))}" for name, f in found.items())


def _reading(view: View) -> str:
    lines = [f"| {' | '.join(HEAD)} |", "|" + " --- |" * len(HEAD)]
    for label in view.found:
        cells = (
            short(view("force", label)), short(view("contact", label)),
            percent(view("slip", label)), short(view("tilt", label), 57.29578),
            short(view("off_plane", label), 1e6), short(view("stress", label), 1e-6),
        )  # fmt: skip
        lines.append(f"| {label} | {' | '.join(cells)} |")
    return "\n".join(lines)


def draw(found: Mapping[str, Found], results: flexcage.StudyResults, folder: Path) -> list[Path]:
    """Forces over pocket radius and width, and the cage's stress in the base case, as PNG."""
    paths = [_sweeps(found, folder / "sweeps.png")]
    for row in results.rows:
        if row.state == "done" and row.planned.point.labels["case"] == BASE:
            run = results.run(row.planned.number, row.planned.repetition)
            pictures = folder / "pictures"
            run.draw(pictures)
            for name in ("stress_peak", "bearing"):
                paths.append((pictures / f"{name}.png").replace(folder / f"{name}.png"))
            for left in pictures.iterdir():
                left.unlink()
            pictures.rmdir()
            break
    return paths


def _sweeps(found: Mapping[str, Found], path: Path) -> Path:
    wide, high, gap, left, top = 460, 330, 110, 84, 128
    sweeps = ((RADII, "pocket radius [mm]", PRINTED), (WIDTHS, "cage width [mm]", PRINTED_WIDTHS))
    colours = (sheet.BLUE, sheet.VERMILION, sheet.PURPLE)
    with sheet.style():
        figure = sheet.new_figure(left + 2 * (wide + gap), top + high + 90)
        sheet.heading(figure, "Ball-cage force of a ball pass", "mean and 95 % interval")
        for k, (cases, name, printed) in enumerate(sweeps):
            ax = sheet.axes_at(figure, (left + k * (wide + gap), top, wide, high))
            for colour, (reading, f) in zip(colours, found.items()):
                view = View(f)
                there = [label for label in cases if view.has([label])]
                values = view.all("force", there)
                ax.errorbar(
                    [1e3 * cases[label] for label in there], [v.value for v in values],
                    [v.margin for v in values], color=colour, marker="o", ms=4, lw=1.2,
                    capsize=3, label=reading,
                )  # fmt: skip
            ax.plot([1e3 * cases[label] for label in printed], printed.values(), color="0.5",
                    marker="s", ms=4, lw=1.0, ls="--", label="paper, table 3")  # fmt: skip
            ax.set(xlabel=name, ylabel="N", ylim=(0.0, None))
            if k == 0:
                ax.legend(frameon=False, fontsize=8)
        return sheet.save(figure, path)
def page(found, judged): return ""
