"""The page of the study of riveted cages and its pictures, written from what was computed."""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from datetime import date
from pathlib import Path
from tempfile import TemporaryDirectory

from ball_claim import Found, View, percent, run_of, short, tables
from riveted_cage_claims import BASE, PAPER, RADII, WIDTHS

import flexcage
from flexcage.render import sheet
from flexcage.study.verdicts import Verdict

HEAD = (
    "case", "force of a pass [N]", "mean force in contact [N]", "cage slip", "cage tilt [deg]",
    "largest whirl radius [um]", "stress [MPa]", "nominal stress of rivets [MPa]",
)  # fmt: skip
#: Forces [N] of the paper's table 3: over the pocket radius at w 6.2 mm, over w at 3.46 mm.
PRINTED = {
    "Rp 3.43": 29.657, "Rp 3.44": 26.27, "Rp 3.45": 25.49, BASE: 25.12, "Rp 3.47": 25.51,
    "Rp 3.48": 26.33,
}  # fmt: skip
PRINTED_WIDTHS = {"w 6.8": 25.49, "w 7.4": 27.61, "w 8.0": 31.162}


def table(found: Mapping[str, Found]) -> str:
    """All figures of all readings as tables of Markdown."""
    return tables(found, HEAD, _cells)


def _cells(view: View, label: str) -> tuple[str, ...]:
    return (
        short(view("force", label)), short(view("contact", label)),
        percent(view("slip", label)), short(view("tilt", label), 57.29578),
        short(view("off_plane", label), 1e6), short(view("stress", label), 1e-6),
        short(view("rivet", label), 1e-6),
    )  # fmt: skip


def draw(found: Mapping[str, Found], results: flexcage.StudyResults, folder: Path) -> list[Path]:
    """Forces over pocket radius and width, and the cage's stress in the base case, as PNG."""
    paths = [_sweeps(found, folder / "sweeps.png")]
    run = run_of(results, BASE)
    if run is not None:
        with TemporaryDirectory() as drawn:
            run.draw(drawn)
            for name in ("stress_peak.png", "bearing.png"):
                paths.append(Path(shutil.copy(Path(drawn) / name, folder / name)))
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
                ax.legend(
                    frameon=False,
                    fontsize=8,
                    ncol=4,
                    loc="lower left",
                    bbox_to_anchor=(-0.03, 1.01),
                )
        return sheet.save(figure, path)


def page(found: Mapping[str, Found], judged: Sequence[Verdict]) -> str:
    """The page beside the study's case."""
    claims = "\n".join(f"| {v.key} | {v.claim} | **{v.outcome}** | {v.range} |" for v in judged)
    return f"""# A riveted cage under an overturning moment

"Failure Inducement Factor Analysis and Optimal Design Method of Ball Bearing Cage for Aviation
Motor", {PAPER}, as a study. Written by `riveted_cage.py --page` on {date.today():%-d %B %Y} with
flexcage {flexcage.__version__}: 0.1 s of motion (15 turns of the ring, 6 of the cage), of which the
first fifth is left out; three starts of every case, six with balls of 6.747 mm.

## How the paper was read

- It gives no number of balls: seven of its 6.47 mm are the most that can be filled in. 6.47 mm is
  no standard ball; 6.747 mm (17/64 inch) is, and leaves the pockets a third of the play. Both are
  readings.
- Its 82.5 N m on one such bearing press a ball with 4.4 GPa. A tenth of it is taken (2.4 GPa,
  8.65 mrad), with 20 N axially.
- Pockets are spheres; the "cage width" of 4.4 to 8 mm is read as where they end at both sides. By
  that reading a cage as broad as the shoulders allow (3.2 mm) falls apart below 6.13 mm, and the
  paper's best, 6.0 to 6.2 mm, would have necks of 0.06 mm: so the sweep begins at 6.3 mm, and the
  modified cage of 6.1 mm was given 6.2.
- "Slip" is the cage's, behind balls that roll at a contact angle of zero. It is negative here:
  under the moment balls roll at up to 25 degrees and carry the cage ahead.
- Stress of rivets is nominal, that of a shank of 1.2 mm which bears alone what goes from half to
  half: the halves hold together under the rivets' heads. Rivet, sheets and fit with contact and
  friction follow below (`riveted_cage_rivet.py`).
- Stress is that of a coarse mesh, which reads necks a fifth low.

## Verdicts

"±" is half of a 95 % interval, from starts and from block bootstrap over ball passes.

|  | claim of the paper | by the base reading | by reading |
| --- | --- | --- | --- |
{claims}

## What decides them
{reasons(found)}

{fits()}

![Forces over pocket radius and width](sweeps.png)

![Stress of the base case](stress_peak.png)

![The bearing of the base case](bearing.png)

## All figures

{table(found)}

## Repeat it

```sh
python examples/papers/riveted_cage.py --workers 2 --page
```
"""


def reasons(found: Mapping[str, Found]) -> str:
    """What decides the claims, with the figures that show it."""
    names = ("flexible", "rigid", "balls of 6.747 mm")
    soft, rigid, full = (View(found.get(name, {})) for name in names)

    def n(view: View, key: str, label: str, factor: float = 1.0) -> str:
        return short(view(key, label), factor)

    def force(view: View, *labels: str) -> str:
        return ", ".join(n(view, "force", label) for label in labels)

    def rivet(*labels: str) -> str:
        return ", ".join(n(soft, "rivet", label, 1e-6) for label in labels)

    def slip(view: View, label: str) -> str:
        return percent(view("slip", label))

    return f"""
- **Forces (001-1).** The paper's 25 to 35 N are those of balls of 6.747 mm:
  {force(full, "Rp 3.43")}, {force(full, "Rp 3.44", "Rp 3.45")}, {force(full, BASE)},
  {force(full, "Rp 3.47", "Rp 3.48")} N at its radii of 3.43 to 3.48 mm, least at its best radius,
  3.46 mm. That the least lies within the paper's radii was looked at after the whole sweep, which
  goes on to 3.60 mm: there the force falls again, to {force(full, "Rp 3.60")} N, as balls no
  longer reach their walls. With 6.47 mm the play is three times as large, and the force is
  {force(rigid, BASE)} N (rigid) and {force(soft, BASE)} N.
- **What pushes.** Under the moment every ball's contact angle goes from 25 to -25 degrees and
  back in a turn, so that balls run ahead of the cage and fall behind it by some 0.1 mm, about the
  play of the pockets. Small pockets hold them back by force; in large ones they do not touch.
- **Rigid or flexible.** The sheet gives way: {force(soft, BASE)} N a pass where a rigid cage has
  {force(rigid, BASE)} N, {force(soft, "Pd 20")} and {force(rigid, "Pd 20")} N at 20 um of
  clearance, {force(soft, "f 0.505/0.515")} and {force(rigid, "f 0.505/0.515")} N in the closest
  grooves. A closed cage (7.4 mm wide and more) is stiffer: {force(soft, "w 7.4")} N for
  {force(soft, "w 6.3")} N.
- **Width (001-3).** Over the widths that leave a cage in one piece the flexible cage's force
  rises with width, {force(soft, "w 6.3", BASE, "w 6.8", "w 7.4", "w 8.0")} N, because it becomes
  stiffer; a rigid cage's hardly changes, {force(full, "w 6.3", BASE, "w 6.8", "w 7.4", "w 8.0")}
  N with balls of 6.747 mm. The paper's rise towards narrow cages lies where this reading has
  none.
- **Rivets (001-1, 001-4)** are stressed as balls push the cage. The joints' shear and bending make
  {rivet("Rp 3.43", "Rp 3.44", "Rp 3.45", BASE, "Rp 3.47", "Rp 3.48")} MPa in a shank over the radii
  of 3.43 to 3.48 mm, {rivet("Rp 3.60")} MPa at 3.60 mm, and {rivet("t 0.7", BASE, "t 1.0")} MPa
  over the sheet's thickness. The modified cage spares them, as the paper wants it to:
  {rivet("modified 9000")} MPa for the original's {rivet("original 9000")}.
- **Necks.** What breaks such a cage first is not its rivets: beside open sides the sheet is left
  with necks, {n(soft, "stress", "w 6.3", 1e-6)} MPa at 6.3 mm of width,
  {n(soft, "stress", BASE, 1e-6)} at 6.5, {n(soft, "stress", "w 6.8", 1e-6)} at 6.8 and
  {n(soft, "stress", "w 7.4", 1e-6)} when closed; in the modified cage (6.2 mm)
  {n(soft, "stress", "modified 9000", 1e-6)} MPa, far beyond any sheet. The original one, closed,
  has {n(soft, "stress", "original 9000", 1e-6)} MPa.
- **Grooves and clearance (001-5, 001-6).** Both act through contact angles. Closer grooves make
  them larger, so the cage goes further ahead ({slip(full, "f 0.505/0.515")} to
  {slip(full, "f 0.520/0.530")} with balls of 6.747 mm) and balls push harder
  ({force(full, "f 0.505/0.515")} to {force(full, "f 0.520/0.530")} N). In the size of the slip,
  which the paper may mean, it falls with wider grooves as claimed, and rises with clearance
  ({slip(full, "Pd 5")}, {slip(full, BASE)}, {slip(full, "Pd 15")}, {slip(full, "Pd 20")}); as a
  lag it does the opposite.
- **Speed (001-8).** In size the slip falls a little with speed, as centrifugal force brings
  contact angles down: {slip(full, "modified 7000")}, {slip(full, "modified 8000")} and
  {slip(full, "modified 9000")} with balls of 6.747 mm. The original cage is less ahead
  ({slip(full, "original 9000")}): its balls hardly push it.
- **Thickness (001-4)** changes a flexible cage's force by no more than the intervals:
  {force(soft, "t 0.7", BASE, "t 1.0")} N.
"""


def fits() -> str:
    """The section on the rivet over its fit, from what ``riveted_cage_rivet.py`` wrote."""
    import pandas as pd

    folder = Path(__file__).with_name("riveted_cage")
    table = pd.read_csv(folder / "fits.csv").set_index("play [um]")
    peaks = {words.split(",")[0]: words for words in table if words.endswith("again [MPa]")}
    rows = [
        f"| {play:g} | " + " | ".join(f"{row[p]:.0f}" for p in peaks.values())
        + f" | {row['range at the root [MPa]']:.0f} |"
        for play, row in table.iterrows()
    ]  # fmt: skip
    heads = "| play, um | " + " | ".join(peaks) + " | range at the root |"
    nominal = table["nominal range [MPa]"].iloc[0]
    largest = table["range at the root [MPa]"].max()
    return f"""## The rivet over its fit (001-7)

Rivet, sheets and holes in contact with friction, under the loads of one run of the base case's most
stressed rivet; assumed: heads clamp with 100 N, friction 0.15, root radius 0.1 mm. Stress in MPa at
the largest load, linear elastic.

{heads}
| --- {"| --- " * (len(peaks) + 1)}|
{chr(10).join(rows)}

- "With play the largest stress is at the root of the head" holds. "Under interference it is at the
  edge of the head" does not: at root and holes' edges, which interference presses, it is larger.
- Interference raises every peak, as the paper says. Without it the size of the play is no matter:
  friction under the clamped heads carries the loads, and the shank does not reach its holes.
- The load hardly reaches the root: a nominal range of {nominal:.0f} MPa becomes at most
  {largest:.0f} MPa there. By the modified Neuber rule (lives.csv: three soft steels, both readings
  of K_f) the cycle is elastic, and lasts beyond 1e11 cycles. Clamp and interference alone bring the
  root to the yield stress of soft steel or beyond; the model stays elastic there.
- No second program confirms the loaded joint: with interference CalculiX has 9 % more at the root,
  and about 40 MPa of range where this model has 15. Ranges, K_t, lives may be off by that factor.
- One run, one start; clamp, friction, root radius and loads of 25 N a ball are not varied yet."""
