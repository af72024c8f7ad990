"""The page of the centroid study and its picture, written from what was computed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import date
from math import degrees, pi
from pathlib import Path

import numpy as np
from c7010_centroid_figures import PLANE, PLANES, WRONG, Found
from scipy.stats import spearmanr

import flexcage
from flexcage.render import sheet
from flexcage.results import instrument, metrics
from flexcage.study.verdicts import Verdict

PAPER = "Measurement and Dynamic Analysis of the Centroid Trajectories of ACBB Cages"
RPM, MM = 30.0 / pi, 1e3
MEASURED = {"4000": 0.2311, "10000": 0.2314}  # mm, the paper's differences, corrected
SHOWN = ("0.2 g mm", "1 g mm", "flexible, 1 g mm", "land, 1 g mm")  # in the picture
Table = Mapping[tuple[str, str], Found]


def _sorted(found: Table) -> list[tuple[tuple[str, str], Found]]:
    order = list(dict.fromkeys(variation for _, variation in found))
    return sorted(found.items(), key=lambda item: (order.index(item[0][1]), int(item[0][0])))


def table(found: Table) -> str:
    """All figures as a table of Markdown."""
    head = ("variation | rpm | cage speed [rpm] | against eq. 18 | mean whirl radius [mm] | "
            "max - min [mm] | ratio | whirl per turn of the cage | axial range [mm] | "
            "tilt [deg] | deviation ratio | by sensors [mm] | corrected [mm] | error")  # fmt: skip
    lines = [f"| {head} |", "|" + " --- |" * (head.count("|") + 1)]
    for (rpm, variation), f in _sorted(found):
        lines.append(
            f"| {variation} | {rpm} | {f.speed * RPM:,.1f} | {f.speed / f.theory - 1.0:+.2%} | "
            f"{f.mean * MM:.4f} | {f.difference * MM:.4f} | {f.ratio:.2f} | {f.turns:.2f} | "
            f"{f.axial * MM:.3f} | {degrees(f.tilt):.2f} | {f.deviation:.0%} | "
            f"{f.raw * MM:.4f} | {f.solved * MM:.4f} | {f.error:+.1%} |"
        )
    return "\n".join(lines)


def sweep(found: Table) -> str:
    """Deflection error over the sensors' plane."""
    head = "variation | rpm | " + " | ".join(f"{p * MM:g} mm" for p in PLANES)
    lines = [f"| {head} | radius wrong by {WRONG * MM:g} mm |", "|" + " --- |" * (len(PLANES) + 3)]
    for (rpm, variation), f in _sorted(found):
        if variation in SHOWN:
            cells = " | ".join(f"{e:+.1%}" for e in f.errors)
            lines.append(f"| {variation} | {rpm} | {cells} | {f.by_radius * 1e6:+.3f} um |")
    return "\n".join(lines)


def fits(found: Table) -> str:
    """Which variations have differences within 20 % of the measured ones."""
    near = {
        rpm: [
            f"{v} ({f.difference * MM:.3f} mm)"
            for (n, v), f in _sorted(found)
            if n == rpm and abs(f.difference * MM / wanted - 1.0) <= 0.2
        ]
        for rpm, wanted in MEASURED.items()
    }
    return "; ".join(
        f"at {rpm} rpm ({MEASURED[rpm]} mm): {', '.join(names) or 'none'}"
        for rpm, names in near.items()
    )


def stability(found: Table) -> str:
    """Rank correlation of the deflection error with the steadiness of the motion."""
    error = [abs(f.error) for f in found.values()]
    texts = []
    for name, values in (
        ("the difference of radii", [f.difference for f in found.values()]),
        ("the whirl ratio", [f.ratio for f in found.values()]),
        ("the mean tilt", [f.tilt for f in found.values()]),
    ):
        found_ = spearmanr(error, values)
        texts.append(f"{found_.statistic:+.2f} with {name} (p = {found_.pvalue:.1g})")
    return ", ".join(texts)


def draw(results: flexcage.StudyResults, path: Path) -> Path:
    """Orbits across the axis, and along it, of some variations at every speed."""
    runs: dict[tuple[str, str], flexcage.Run] = {}
    for row in results.rows:
        labels = row.planned.point.labels
        if row.state == "done" and labels["variation"] in SHOWN:
            run = results.run(row.planned.number, row.planned.repetition)
            runs[labels["variation"], labels["speed"]] = run
    speeds = list(dict.fromkeys(speed for _, speed in runs))
    side, gap, top, left = 250, 46, 130, 150
    shown = [v for v in SHOWN if any(v == name for name, _ in runs)]
    with sheet.style():
        figure = sheet.new_figure(
            left + len(speeds) * (side + gap) + 20, top + len(shown) * (side + gap) + 70
        )
        sheet.heading(figure, "Orbits of the cage's centre",
                      "across the axis, gravity down; colour: axial position, "
                      "from -0.2 (dark) to 0.2 mm (light)")  # fmt: skip
        for i, variation in enumerate(shown):
            for k, speed in enumerate(speeds):
                place = (left + k * (side + gap), top + i * (side + gap), side, side)
                ax = sheet.axes_at(figure, place)
                if (variation, speed) in runs:
                    _orbit(ax, runs[variation, speed])
                if i == 0:
                    ax.set_title(f"{int(speed):,} rpm")
                if k == 0:
                    ax.set_ylabel(f"{variation}\n-y [mm]")
                if i == len(shown) - 1:
                    ax.set_xlabel("z [mm]")
        return sheet.save(figure, path)


def _orbit(ax, run: flexcage.Run) -> None:
    ds = metrics.settled(run.dataset, run.case.output.settle)
    centre, _ = instrument.of_run(ds)
    x, y, z = centre[::5].T * MM
    ax.scatter(z, -y, c=x, s=2, cmap="viridis", vmin=-0.2, vmax=0.2, linewidths=0, rasterized=True)
    ax.set(xlim=(-0.4, 0.4), ylim=(-0.4, 0.4), xticks=(-0.3, 0.0, 0.3), yticks=(-0.3, 0.0, 0.3))
    ax.axhline(0.0, color="0.85", lw=0.6, zorder=0)
    ax.axvline(0.0, color="0.85", lw=0.6, zorder=0)


def page(found: Table, judged: Sequence[Verdict]) -> str:
    """The page beside the study's text."""
    claims = "\n".join(f"| {v.key} | {v.claim} | **{v.outcome}** | {v.range} |" for v in judged)
    worst = max(f.beyond for f in found.values())
    slopes = np.array([f.by_radius for f in found.values()])
    return f"""# A 7010C's cage, measured by virtual lasers

"{PAPER}"
as a study. Written by `c7010_centroid.py --page` on {date.today():%-d %B %Y} with flexcage
{flexcage.__version__}. 0.6 s of motion at each speed, of which the first 40 % are left out; 100 N
axial, the inner ring held in tilt, friction as in the paper's model.

Two things the paper does not say decide the orbit: what keeps the cage centred, and its unbalance.
With the cylindrical pockets that one would expect nothing but the balls' traction holds a cage
across the axis, and it is thrown off (README, What the model contains); so pockets are whole
spheres here, an assumption, and in two variations cylinders in a cage that the outer ring guides
with 0.2 mm of radial clearance. The sensors' plane is taken {PLANE * MM:g} mm from the cage's
middle.

|  | claim | at 0.2 g mm | by variation |
| --- | --- | --- | --- |
{claims}

{table(found)}

![Orbits](orbits.png)

## What fits the measurement

The paper measured differences of 0.244 and 0.238 mm at 4000 and 10,000 rpm (0.231 mm both,
corrected) and simulated 0.255 and 0.189 mm; its simulated cage speeds were 1712.5 and 4258.3 rpm
where equation 18 gives 1716.9 and 4292.3. Within 20 % of the measured difference are:
{fits(found)}.

## The sensors

{sweep(found)}

- Over all runs the deflection error goes, by ranks, {stability(found)}.
- The radius that the correction takes hardly matters: {WRONG * MM:g} mm more change a corrected
  difference by {np.abs(slopes).max() * 1e6:.2g} um at most. The plane decides: the error is about
  proportional to its distance.
- Of the readings {worst:.1%} at most are out of the sensors' range of 3 mm.

## What decides the claims

@REASONS@
"""
