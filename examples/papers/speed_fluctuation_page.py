"""The page of the study of fluctuating speed and its pictures, written from what was computed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import date
from math import pi
from pathlib import Path

import numpy as np
from ball_claim import Found, View, percent, run_of, short, tables
from speed_fluctuation_claims import CASES, CONSTANT, PAPER
from speed_fluctuation_reasons import reasons

import flexcage
from flexcage.render import sheet
from flexcage.results import metrics
from flexcage.study.verdicts import Verdict

RPM = 30.0 / pi
#: The paper's tables 6 and 7 by LS-DYNA: mean cage speed [rpm] and its fluctuation [%].
PRINTED = {CONSTANT: "922.42 / 2.89", "A 6 %": "921.13 / 6.40 (T7), 918.66 / 6.48 (T6)",
           "A 6 %, N 2": "918.66 / 6.48"}  # fmt: skip
HEAD = (
    "case", "cage speed [rpm]", "fluctuation, at 1 kHz / of all samples",
    "ring's sine: share / amplitude", "its amplitude in balls", "balls off even spacing [um]",
    "largest distance [um]", "strongest line",
    "force on the cage [N]: of a pass / largest", "ring's range [um]", "force ripple",
    "follows its place", "ball force [N]: least / most", "cage slip", "stress [MPa]",
)  # fmt: skip


def table(found: Mapping[str, Found]) -> str:
    """All figures of all readings as tables of Markdown."""
    return tables(found, HEAD, _cells)


def _cells(view: View, label: str) -> tuple[str, ...]:
    def pair(one: str, other: str, shown=percent) -> str:
        return " / ".join(shown(view(k, label)) for k in (one, other))

    return (
        short(view("speed", label), RPM),
        pair("swing", "swing_raw"),
        pair("follows", "gain"),
        percent(view("ball_gain", label)),
        short(view("excursion", label), 1e6),
        short(view("distance", label), 1e6),
        percent(view("orbit_line", label)),
        pair("pocket_peak", "pocket_most", short),
        short(view("ring_range", label), 1e6),
        percent(view("ripple", label)),
        percent(view("by_place", label)),
        pair("force_least", "force_most", short),
        percent(view("cage_slip", label)),
        short(view("stress", label), 1e-6),
    )


def beside_the_paper(found: Mapping[str, Found]) -> str:
    """Mean cage speed and fluctuation of every reading beside the paper's."""
    head = ("case", "paper (LS-DYNA)", *found)
    lines = [f"| {' | '.join(head)} |", "|" + " --- |" * len(head)]
    for label in CASES:
        cells = [
            f"{short(view('speed', label), RPM)} / {short(view('swing', label), 100.0)}"
            for view in map(View, found.values())
        ]
        lines.append(f"| {label} | {PRINTED.get(label, '')} | {' | '.join(cells)} |")
    return "\n".join(lines)


def draw(results: flexcage.StudyResults, folder: Path) -> list[Path]:
    """The cage's speed beside the ring's, and orbits of its centre, as PNG."""
    runs = {label: run for label in CASES if (run := run_of(results, label)) is not None}
    return [_speeds(runs, folder / "cage_speed.png"), _orbits(runs, folder / "orbits.png")]


def _speeds(runs: Mapping[str, flexcage.Run], path: Path) -> Path:
    """The cage's speed over the run, and what it would be if balls rolled without slip."""
    wide, high, gap, top = 560, 190, 66, 128
    rows = (len(runs) + 1) // 2
    with sheet.style():
        figure = sheet.new_figure(2 * (wide + 110), top + rows * (high + gap) + 30)
        note = "blue: the cage; grey: the cage of balls that roll without slip"
        sheet.heading(figure, "Cage speed under a fluctuating inner ring", note)
        for k, (label, run) in enumerate(runs.items()):
            ds, numbers = run.dataset, run.numbers
            t = ds["time"].values * 1e3
            cage = ds["cage_omega"].sel(axis="x").values * RPM
            share = numbers.kinematics(1.0).cage_speed
            ring = share * ds["inner_speed"].values * RPM
            place = (90 + k % 2 * (wide + 110), top + k // 2 * (high + gap), wide, high)
            ax = sheet.axes_at(figure, place)
            ax.plot(t, ring, color="0.65", lw=1.2)
            ax.plot(t, cage, color=sheet.BLUE, lw=0.8)
            ax.set(xlim=(0.0, t[-1]), ylim=(800, 1080), ylabel="rpm")
            ax.set_title(label, loc="left")
            if k >= len(runs) - 2:
                ax.set_xlabel("time [ms]")
        return sheet.save(figure, path)


def _orbits(runs: Mapping[str, flexcage.Run], path: Path) -> Path:
    """Orbit of the cage's centre in every case, all on one scale."""
    size, gap, top, left = 300, 84, 128, 100
    rows = (len(runs) + 2) // 3
    with sheet.style():
        figure = sheet.new_figure(left + 3 * (size + gap), top + rows * (size + gap) + 30)
        note = "from the outer ring's axis, settled part; load and gravity point down"
        sheet.heading(figure, "Orbits of the cage centre", note)
        orbits = {
            k: 1e6 * metrics.orbit(metrics.settled(r.dataset, r.case.output.settle))[:, ::-1]
            * (1.0, -1.0) for k, r in runs.items()
        }  # fmt: skip
        reach = 1.05 * max(float(np.abs(o).max()) for o in orbits.values())
        for k, (label, orbit) in enumerate(orbits.items()):
            place = (left + k % 3 * (size + gap), top + k // 3 * (size + gap), size, size)
            ax = sheet.axes_at(figure, place)
            ax.plot(*orbit.T, color=sheet.BLUE, lw=0.6)
            ax.set(xlim=(-reach, reach), ylim=(-reach, reach))
            ax.set_title(label, loc="left")
            if k >= len(runs) - 3:
                ax.set_xlabel("z [um]")
            if k % 3 == 0:
                ax.set_ylabel("-y [um]")
        return sheet.save(figure, path)


def page(found: Mapping[str, Found], judged: Sequence[Verdict]) -> str:
    """The page beside the study's case."""
    claims = "\n".join(f"| {v.key} | {v.claim} | **{v.outcome}** | {v.range} |" for v in judged)
    return f"""# A 7603025 whose speed fluctuates

"Effect of Rotational Speed Fluctuation Parameters on Dynamic Characteristics of Angular Contact
Ball Bearings", {PAPER}, as a study. Written by `speed_fluctuation.py --page` on
{date.today():%-d %B %Y} with flexcage {flexcage.__version__}: 0.45 s of motion as in the paper (15
turns of the ring, 7 of the cage), of which the first fifth is left out; three starts of the base
reading, one of the others.

## How the paper was read

- It prints no geometry. Balls that pass inner and outer ring 34,000 times a minute at 2000 rpm make
  17 balls, and its speeds a pitch circle of 42.4 mm with balls of 5.55 mm: smaller than those of a
  catalogue bearing of this size. Grooves, shoulders, cage and pockets are assumptions
  (`flexcage presets 7603025`).
- n = 2000 rpm (1 + A sin(N w t)), w one turn of the ring: A of 0, 3, 6, 9 % at N = 1, and N of 1,
  2, 3 at A = 6 %. The inner ring is held against tilt, as the paper's degrees of freedom say.
- Friction is 0.1 / 0.002 (static / dynamic) at balls and rings, 0.15 / 0.02 at the cage. How it
  goes from one to the other is not said. The base reading has the static value at 0.1 m/s and the
  dynamic one from 1 m/s on; LS-DYNA takes the static one at all speeds unless it is given a decay.
  Both constants at all speeds are readings of their own.
- "Fluctuation" of the cage's speed was read as half of its range over its mean, of samples every
  millisecond as the paper has; the table has that of all samples too.
- Tables 6 and 7 of the paper give the same case (A = 6 %, N = 1) two values, of which one is that
  of N = 2.

## Verdicts

"±" is half of a 95 % interval: by block bootstrap over ball passes, of ranges and spectra by
Student's t over thirds of the record.

|  | claim of the paper | by the base reading | by reading |
| --- | --- | --- | --- |
{claims}

## What decides them
{reasons(found)}

## Beside the paper's tables

Mean cage speed [rpm] / fluctuation [%]; its test gives 927 rpm, the kinematics 935.

{beside_the_paper(found)}

![Cage speed](cage_speed.png)

![Orbits of the cage centre](orbits.png)

## All figures

{table(found)}

## Repeat it

```sh
python examples/papers/speed_fluctuation.py --workers 2 --page
```
"""
