"""The page of the vibro-impact study and its pictures, written from what was computed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import date
from math import degrees
from pathlib import Path

import numpy as np
from ball_claim import Found, View, percent, run_of, short, tables
from c7010_vibro_claims import PAPER, SPEEDS
from c7010_vibro_figures import by_azimuth
from c7010_vibro_reasons import reasons

import flexcage
from flexcage.render import sheet
from flexcage.results import metrics
from flexcage.study.verdicts import Verdict

HEAD = (
    "case", "peak force [N]", "no contact, on / off the load", "deviation ratio, raw / 2 kHz",
    "orbit radius [um]", "strongest line", "inner / outer angle [deg]",
    "axial: mean / range [um]", "cage slip", "slip ripple", "pocket force [N]", "stress [MPa]",
)  # fmt: skip


def table(found: Mapping[str, Found]) -> str:
    """All figures of all readings as tables of Markdown."""
    return tables(found, HEAD, _cells)


def _cells(view: View, label: str) -> tuple[str, ...]:
    return (
        short(view("peak", label)),
        " / ".join(percent(view(k, label)) for k in ("empty_loaded", "empty_opposite")),
        " / ".join(percent(view(k, label)) for k in ("deviation_raw", "deviation")),
        short(view("radius", label), 1e6),
        percent(view("line", label)),
        " / ".join(short(view(k, label), degrees(1.0)) for k in ("inner_angle", "outer_angle")),
        f"{short(view('axial', label), 1e6)} / {short(view('axial_range', label), 1e6)}",
        percent(view("cage_slip", label)),
        percent(view("ball_ripple", label)),
        short(view("pocket_peak", label)),
        short(view("stress", label), 1e-6),
    )


def statics_beside(results: flexcage.StudyResults) -> str:
    """The quasi-static ball equations beside the runs: the heaviest ball's load and angles."""
    head = ("speed", "load, static [N]", "mean in the run [N]", "inner angle, static [deg]",
            "in the run [deg]", "balls that bear, static", "bear half of the time")  # fmt: skip
    lines = [f"| {' | '.join(head)} |", "|" + " --- |" * len(head)]
    for label in SPEEDS:
        run = run_of(results, label)
        if run is None:
            continue
        balls = flexcage.solve_static(run.case).elements
        _, force, angle = by_azimuth(run)
        top = int(np.argmax(balls.force[:, 0]))
        lines.append(
            f"| {label} | {balls.force[top, 0]:.1f} | {force[0]:.1f} | "
            f"{degrees(balls.angle[top, 0]):.2f} | {degrees(angle[0]):.2f} | "
            f"{int((balls.force[:, 0] > 0.0).sum())} | {_bearing_half(run)} |"
        )
    return "\n".join(lines)


def _bearing_half(run: flexcage.Run) -> int:
    """Sectors in which a ball touches the inner race half of the time or more."""
    ds = metrics.settled(run.dataset, run.case.output.settle)
    psi = ds["element_position"].transpose("time", "element", "cyl").sel(cyl="psi").values
    at = np.round((psi - run.case.load.direction) * 18 / (2.0 * np.pi)).astype(int) % 18
    touching = ds["race_force"].sel(race="inner").transpose("time", "element").values > 0.0
    return sum(bool(touching[at == k].mean() >= 0.5) for k in range(18))


def draw(results: flexcage.StudyResults, folder: Path) -> list[Path]:
    """Orbits over speed, forces round the bearing, and one ball's over time, as PNG."""
    runs = {label: run for label in SPEEDS if (run := run_of(results, label)) is not None}
    return [
        _orbits(runs, folder / "orbits.png"),
        _round(runs, folder / "round.png"),
        _ball(runs, folder / "ball.png"),
    ]


def _orbits(runs: Mapping[str, flexcage.Run], path: Path) -> Path:
    """Orbit of the cage's centre at every speed, in all of its play and close up."""
    size, gap, top, left = 290, 80, 150, 120
    with sheet.style():
        figure = sheet.new_figure(left + len(runs) * (size + gap), top + 2 * size + gap + 70)
        note = "from the outer ring's axis, settled part; load and gravity point down"
        sheet.heading(figure, "Orbits of the cage centre over speed", note)
        orbits = {
            k: 1e6 * metrics.orbit(metrics.settled(r.dataset, r.case.output.settle))[:, ::-1]
            * (1.0, -1.0) for k, r in runs.items()
        }  # fmt: skip
        reach = 1.05 * max(float(np.abs(o).max()) for o in orbits.values())
        close = 1.05 * max(float(np.abs(o - o.mean(axis=0)).max()) for o in orbits.values())
        for k, (label, orbit) in enumerate(orbits.items()):
            for row, (middle, limit) in enumerate(
                ((np.zeros(2), reach), (orbit.mean(axis=0), close))
            ):
                place = (left + k * (size + gap), top + row * (size + gap), size, size)
                ax = sheet.axes_at(figure, place)
                ax.plot(*orbit.T, color=sheet.BLUE, lw=0.5)
                ax.set(xlim=middle[0] + np.array([-limit, limit]),
                       ylim=middle[1] + np.array([-limit, limit]))  # fmt: skip
                ax.set_title(label if row == 0 else "close up")
                if row:
                    ax.set_xlabel("z [um]")
                if k == 0:
                    ax.set_ylabel("-y [um]")
        return sheet.save(figure, path)


def _ball(runs: Mapping[str, flexcage.Run], path: Path) -> Path:
    """Inner contact force of one ball over two turns of the cage, at the lowest and highest
    speed."""
    wide, high, gap, top = 1300, 240, 84, 124
    ends = [list(runs.items())[0], list(runs.items())[-1]]
    with sheet.style():
        figure = sheet.new_figure(wide + 140, top + 2 * (high + gap) + 50)
        note = "inner race, two turns of the cage; shaded: no contact"
        sheet.heading(figure, "Contact force of ball 0", note)
        for row, (label, run) in enumerate(ends):
            ds = metrics.settled(run.dataset, run.case.output.settle)
            turns = (metrics.cage_angle(ds) - metrics.cage_angle(ds)[0]) / (2.0 * np.pi)
            force = ds["race_force"].sel(race="inner").isel(element=0).values
            part = turns <= 2.0
            ax = sheet.axes_at(figure, (100, top + row * (high + gap), wide, high))
            ax.plot(turns[part], force[part], color=sheet.BLUE, lw=0.8)
            ax.fill_between(turns[part], 0.0, 1.0, where=force[part] <= 0.0, color="0.85", lw=0.0,
                            transform=ax.get_xaxis_transform(), zorder=0)  # fmt: skip
            ax.set(xlim=(0.0, 2.0), ylim=(0.0, None), ylabel="N")
            ax.set_title(label, loc="left")
        ax.set_xlabel("turns of the cage")
        return sheet.save(figure, path)


def _round(runs: Mapping[str, flexcage.Run], path: Path) -> Path:
    """Mean inner contact force and angle over azimuth, run and quasi-static equations."""
    wide, high, gap, top = 560, 330, 90, 110
    colours = (sheet.BLUE, sheet.VERMILION, "#009E73")
    with sheet.style():
        figure = sheet.new_figure(2 * (wide + gap) + 40, top + high + 90)
        title = "Round the bearing: full dynamics and quasi-static equations"
        note = "inner race; points: mean of a run, lines: quasi-static solution"
        sheet.heading(figure, title, note)
        axes = [sheet.axes_at(figure, (gap + k * (wide + gap), top, wide, high)) for k in (0, 1)]
        for colour, (label, run) in zip(colours, list(runs.items())[::2], strict=False):
            at, force, angle = by_azimuth(run)
            balls = flexcage.solve_static(run.case).elements
            there = np.degrees((at + np.pi) % (2.0 * np.pi) - np.pi)
            order = np.argsort(there)
            for ax, values, lines in (
                (axes[0], force, balls.force[:, 0]),
                (axes[1], np.degrees(angle), np.degrees(balls.angle[:, 0])),
            ):
                ax.plot(there[order], values[order], "o", ms=4, color=colour, label=label)
                ax.plot(there[order], lines[order], "-", lw=1.2, color=colour)
        for ax, name in zip(axes, ("contact force [N]", "contact angle [deg]"), strict=True):
            ax.set(xlabel="azimuth from the load [deg]", ylabel=name, xlim=(-180, 180))
            ax.set_xticks(range(-180, 181, 60))
        axes[0].legend(frameon=False)
        return sheet.save(figure, path)


def page(
    results: flexcage.StudyResults, found: Mapping[str, Found], judged: Sequence[Verdict]
) -> str:
    """The page beside the study's case."""
    claims = "\n".join(f"| {v.key} | {v.claim} | **{v.outcome}** | {v.range} |" for v in judged)
    return f"""# A 7010C under vibro-impacts

{PAPER} as a study. Written by `c7010_vibro_impact.py --page` on {date.today():%-d %B %Y} with
flexcage {flexcage.__version__}: 0.3 s of motion, of which the first 40 % are left out; two starts
of the base reading, one of the others.

## How the paper was read

- Its table has an axial load alone, which all balls bear alike; its figures show balls that lose
  their load. The base reading here is a radial load P with P/3 axially so that the rings stay
  together; `axial` and `combined` (P both ways) are variations.
- The cage's modulus of 28.3 GPa is a misprint of PA66's 2.83 GPa. Its mass of 27 g needs 2840
  kg/m^3 in the section assumed; the base keeps PA66's 1150, and one case takes 27 g.
- "Clearance" was read as the pockets' and as the radial internal clearance, which goes with the
  contact angle: 11.7, 23.6 and 31.3 degrees for 0.02, 0.08 and 0.14 mm.
- Cylindrical pockets do not hold a cage across the axis
  ([why](../../../flexcage/system/README.md#balls-and-the-limits-of-their-model)): pockets are whole
  spheres, an assumption, but cylinders where a land guides the cage (0.2 mm of radial clearance).
- Waves: a fifth of the load at 100 Hz, or a tenth of the speed at 50 Hz. Accelerations: 4000 to
  12,000 rpm in 0.4, 0.2 and 0.1 s. Friction 0.05 on races, 0.1 in pockets, full from 50 mm/s on
  (10 mm/s in "steeper friction"); unbalance none, or 1 g mm at every speed. All assumptions: the
  paper has them in figures, or not at all.

## Verdicts

"±" is half of a 95 % interval: by block bootstrap over ball passes, of ranges and spectra by
Student's t over thirds of the record.

|  | claim of the paper | by the base reading | by reading |
| --- | --- | --- | --- |
{claims}

## What decides them
{reasons(found)}

## Quasi-static equations beside the runs

The heaviest ball, by the quasi-static equations with (f - 0.5) D for the distance of the centres
(the paper's print has f - 1) and without a race that controls, and by the mean of the runs.

{statics_beside(results)}

![Force and angle round the bearing](round.png)

![Contact force of one ball](ball.png)

![Orbits of the cage centre](orbits.png)

## All figures

{table(found)}

## Repeat it

```sh
python examples/papers/c7010_vibro_impact.py --workers 2 --page
```
"""
