"""The page of the measured-cage study and its pictures, written from what was computed."""

from __future__ import annotations

from collections.abc import Sequence
from datetime import date
from math import degrees, pi
from pathlib import Path

import numpy as np
from ball_claim import percent, short
from c7010_centroid_claims import BASE, PAPER, SPEEDS, Table
from c7010_centroid_figures import PLANE, PLANES, RADII, Found
from scipy.stats import spearmanr

import flexcage
from flexcage.render import sheet
from flexcage.results import instrument, metrics
from flexcage.study.verdicts import Verdict

RPM, MM = 30.0 / pi, 1e3
MEASURED = {"4000": 0.2311, "10000": 0.2314}  # mm, the paper's differences, corrected
SHOWN = ("0.2 g mm", "1 g mm", "uneven", "flexible + 1 g mm", "land + 1 g mm")  # in the pictures


def _rows(found: Table) -> list[tuple[str, str, Found]]:
    return [(v, s, found[v][s][0]) for v in found for s in SPEEDS if found[v].get(s)]


def table(found: Table) -> str:
    """All figures as a table of Markdown."""
    head = ("variation", "rpm", "cage speed [rpm]", "beyond eq. 18", "mean whirl radius [mm]",
            "max - min [mm]", "ratio", "whirl per turn of the cage", "axial range [mm]",
            "tilt [deg]", "deviation ratio", "by sensors [mm]", "corrected [mm]",
            "error")  # fmt: skip
    lines = [f"| {' | '.join(head)} |", "|" + " --- |" * len(head)]
    for variation, rpm, f in _rows(found):
        cells = (
            short(f.speed, RPM), percent(f.beyond_theory), short(f.mean, MM),
            short(f.difference, MM), short(f.ratio), f"{f.turns:.2f}", short(f.axial, MM),
            short(f.tilt, degrees(1.0)), percent(f.deviation), short(f.raw, MM),
            short(f.solved, MM), percent(f.error),
        )  # fmt: skip
        lines.append(f"| {variation} | {rpm} | {' | '.join(cells)} |")
    return "\n".join(lines)


def sweep(found: Table) -> str:
    """Deflection error over the sensors' plane, and what a wrong radius does."""
    head = [f"{p * MM:g} mm" for p in PLANES] + [f"radius {r * MM:+g} mm" for r in RADII]
    lines = [f"| variation | rpm | {' | '.join(head)} |", "|" + " --- |" * (len(head) + 2)]
    for variation, rpm, f in _rows(found):
        if variation in SHOWN:
            cells = [f"{e:+.1%}" for e in f.errors] + [f"{r * 1e6:+.2f} um" for r in f.by_radius]
            lines.append(f"| {variation} | {rpm} | {' | '.join(cells)} |")
    return "\n".join(lines)


def fits(found: Table) -> str:
    """Which variations have a measured difference within their interval or within 20 %."""
    texts = []
    for rpm, wanted in MEASURED.items():
        near = [
            f"{v} ({short(f.difference, MM)} mm)"
            for v, s, f in _rows(found)
            if s == rpm
            and abs(f.difference.value * MM - wanted) <= max(0.2 * wanted, f.difference.margin * MM)
        ]
        texts.append(f"at {int(rpm):,} rpm ({wanted} mm) {', '.join(near) or 'none'}")
    return "; ".join(texts)


def stability(found: Table) -> str:
    """Rank correlation of the deflection error with the steadiness of the motion."""
    rows = [f for _, _, f in _rows(found)]
    error = [abs(f.error.value) for f in rows]
    texts = []
    for name, key in (
        ("the difference of radii", "difference"), ("the whirl ratio", "ratio"),
        ("the deviation ratio", "deviation"), ("the mean tilt", "tilt"),
    ):  # fmt: skip
        ranks = spearmanr(error, [getattr(f, key).value for f in rows])
        texts.append(f"{ranks.statistic:+.2f} with {name} (p = {ranks.pvalue:.1g})")
    return ", ".join(texts)


def flexibility(found: Table) -> str:
    """What an elastic cage changes: rigid and flexible, case by case, in words."""
    texts = []
    for rigid, flexible in (("0.2 g mm", "flexible"), ("1 g mm", "flexible + 1 g mm")):
        for s in ("4000", "10000"):
            if not (found.get(rigid, {}).get(s) and found.get(flexible, {}).get(s)):
                continue
            a, b = found[rigid][s][0], found[flexible][s][0]
            texts.append(
                f"{rigid} at {int(s):,} rpm, max - min {short(a.difference, MM)} rigid, "
                f"{short(b.difference, MM)} mm flexible; tilt {short(a.tilt, degrees(1.0))} and "
                f"{short(b.tilt, degrees(1.0))} deg; cage speed {a.speed.value * RPM:,.1f} and "
                f"{b.speed.value * RPM:,.1f} rpm"
            )
    return (
        "It changes neither the cage's speed nor, beyond the intervals, the difference of radii; "
        "its tilt differs, to either side: " + ". ".join(texts) + "."
    )


def draw(results: flexcage.StudyResults, found: Table, folder: Path) -> list[Path]:
    """Orbits, motion along the axis, and whirl ratios over speed, as PNG."""
    runs: dict[tuple[str, str], flexcage.Run] = {}
    for row in results.rows:
        labels = row.planned.point.labels
        if row.state == "done" and labels["variation"] in SHOWN:
            run = results.run(row.planned.number, row.planned.repetition)
            runs[labels["variation"], labels["speed"]] = run
    return [_orbits(runs, folder / "orbits.png"), _ratios(found, folder / "ratios.png")]


def _orbits(runs: dict[tuple[str, str], flexcage.Run], path: Path) -> Path:
    """Orbits across the axis, and in space beside them."""
    side, gap, top, left = 240, 66, 150, 200
    shown = [v for v in SHOWN if any(v == name for name, _ in runs)]
    with sheet.style():
        width = left + 2 * len(SPEEDS) * (side + gap)
        figure = sheet.new_figure(width, top + len(shown) * (side + gap) + 50)
        note = "mm; left: across the axis, gravity down; right: in space, x along the axis"
        sheet.heading(figure, "Orbits of the cage's centre", note)
        for i, variation in enumerate(shown):
            for k, speed in enumerate(SPEEDS):
                if (variation, speed) not in runs:
                    continue
                centre = _centre(runs[variation, speed]) * MM
                for half in (0, 1):
                    x = left + (k + half * len(SPEEDS)) * (side + gap)
                    place = (x, top + i * (side + gap), side, side)
                    (_in_space if half else _across)(figure, place, centre)
                    if i == 0:
                        middle, over = x + 0.5 * side, top - 34
                        sheet.text_at(figure, middle, over, f"{int(speed):,} rpm", ha="center")
            sheet.text_at(figure, 24, top + i * (side + gap) + 0.5 * side,
                          variation.replace(" + ", "\n+ "))  # fmt: skip
        return sheet.save(figure, path)


def _centre(run: flexcage.Run) -> np.ndarray:
    """Centre (n, 3) [m] of the settled part."""
    ds = metrics.settled(run.dataset, run.case.output.settle)
    return instrument.of_run(ds)[0][::4]


def _across(figure, place: sheet.Rect, centre: np.ndarray) -> None:
    ax = sheet.axes_at(figure, place)
    ax.plot(centre[:, 2], -centre[:, 1], color=sheet.BLUE, lw=0.5)
    ax.set(xlim=(-0.4, 0.4), ylim=(-0.4, 0.4), xticks=(-0.3, 0.0, 0.3), yticks=(-0.3, 0.0, 0.3))


def _in_space(figure, place: sheet.Rect, centre: np.ndarray) -> None:
    ax = sheet.axes_at(figure, place, projection="3d")
    ax.plot(centre[:, 0], centre[:, 2], -centre[:, 1], color=sheet.BLUE, lw=0.5)
    ax.set(xlim=(-0.4, 0.4), ylim=(-0.4, 0.4), zlim=(-0.4, 0.4))
    for axis in (ax.xaxis, ax.yaxis, ax.zaxis):
        axis.set_ticks((-0.3, 0.0, 0.3))
        axis.set_tick_params(labelsize=6, pad=-3)


def _ratios(found: Table, path: Path) -> Path:
    """Whirl ratio over speed, of every variation, with intervals."""
    wide, high, left, top = 900, 460, 110, 110
    with sheet.style():
        figure = sheet.new_figure(left + wide + 330, top + high + 90)
        sheet.heading(figure, "Whirl ratio over speed", "(max - min)/mean of the whirl radius")
        ax = sheet.axes_at(figure, (left, top, wide, high))
        colours = (sheet.BLUE, sheet.VERMILION, "#009E73", "#CC79A7", sheet.ORANGE)
        shown = [name for name in SHOWN if name in found]
        for i, name in enumerate(shown):
            cases = found[name]
            at = [s for s in SPEEDS if cases.get(s)]
            ratios = [cases[s][0].ratio for s in at]
            shift = 40.0 * (i - 0.5 * len(shown))
            ax.errorbar(
                [int(s) + shift for s in at], [r.value for r in ratios],
                yerr=[r.margin for r in ratios], color=colours[i], lw=1.2,
                marker="osv^D"[i], ms=4, capsize=2, label=name,
            )  # fmt: skip
        ax.set(xlabel="inner ring [rpm]", ylabel="whirl ratio", ylim=(0.0, None))
        ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1.0), frameon=False)
        return sheet.save(figure, path)


def page(found: Table, judged: Sequence[Verdict]) -> str:
    """The page beside the study's text."""
    claims = "\n".join(f"| {v.key} | {v.claim} | **{v.outcome}** | {v.range} |" for v in judged)
    rows = [f for _, _, f in _rows(found)]
    lost, turned = max(f.lost for f in rows), max(abs(r) for f in rows for r in f.by_radius)
    return f"""# A 7010C's cage, measured by virtual lasers

"{PAPER}"
as a study. Written by `c7010_centroid.py --page` on {date.today():%-d %B %Y} with flexcage
{flexcage.__version__}. 0.6 s of motion at each speed, of which the first 40 % are left out; 100 N
axial, the inner ring held in tilt, friction as in the paper's model.

Two things the paper does not say decide the orbit: what keeps the cage centred, and its unbalance.
With the cylindrical pockets that one would expect nothing but the balls' traction holds a cage
across the axis, and it is thrown off
([why](../../../flexcage/system/README.md#balls-and-the-limits-of-their-model)); so pockets are
whole spheres here, an assumption, and in two variations cylinders in a cage that the outer ring
guides with 0.2 mm of radial clearance. The sensors' plane is taken {PLANE * MM:g} mm from the
cage's middle.

## Verdicts

"±" is half of a 95 % interval: of means by block bootstrap over ball passes, of ranges and shares
by Student's t over thirds of the record.

|  | claim of the paper | at {BASE} | by variation |
| --- | --- | --- | --- |
{claims}

## What decides them

- **Orbit.** In pockets that centre it a cage uses up its play, half of the pocket clearance, and
  stays there: on the side of its weight, or, as unbalance and speed grow, on that of its unbalance,
  turning with the cage. In between, where weight and unbalance are of one size, it goes from side
  to side, and there alone the difference of radii is the paper's. At 1 g mm the orbit is chaotic at
  4000 rpm and a circle from 10,000 on, as the paper has it, but the difference falls with it by a
  factor of ten, where the paper measured 0.24 mm at both ends.
- **Uneven balls and pockets** (0.5 and 30 um standard deviation) hold the cage off its play:
  it whirls with its own speed, on a mean radius that grows with speed, as the third claim says.
- **Gravity.** Without it the cage has no side to rest on and wanders.
- **Deflection error.** It is the tilt times the sensors' distance, tenths of a degree times
  {PLANE * MM:g} mm: tens of micrometres whatever the whirl is. As a share it is the paper's 3 to
  5 % only where the difference is tenths of a millimetre.
- **Cage speed.** Equation 18 takes 15 degrees at both races. Under 100 N centrifugal force parts
  the angles, and balls go round faster, the more the faster the ring turns. Where the outer race
  controls the balls it is 1.1 % at 10,000 rpm; the paper's model, 0.8 % slower than equation 18,
  slips.
- **Flexible cage.** {flexibility(found)}

{table(found)}

![Orbits](orbits.png)

![Whirl ratios](ratios.png)

## What fits the measurement

The paper measured differences of 0.244 and 0.238 mm at 4000 and 10,000 rpm (0.231 mm both,
corrected) and simulated 0.255 and 0.189 mm; its simulated cage speeds were 1712.5 and 4258.3 rpm
where equation 18 gives 1716.9 and 4292.3. Within their interval or 20 % of the measured difference
are: {fits(found)}.

## The sensors

Deflection error over the distance of the radial sensors' plane, and what a wrong radius of the cage
changes in a corrected difference:

{sweep(found)}

- Over all runs the size of the deflection error goes, by ranks, {stability(found)}.
- The radius that the correction takes hardly matters ({turned * 1e6:.2g} um at most); the plane
  decides.
- Of the readings {lost:.1%} at most are out of the sensors' range of 3 mm.
"""
