"""The page of the vibro-impact study and its pictures, written from what was computed."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from datetime import date
from math import degrees, isfinite
from pathlib import Path

import numpy as np
from c7010_vibro_claims import PAPER, SPEEDS, Found, View
from c7010_vibro_figures import by_azimuth

import flexcage
from flexcage.render import sheet
from flexcage.results import metrics
from flexcage.study.verdicts import Estimate, Verdict

HEAD = (
    "case", "peak force [N]", "no contact, on / off the load", "deviation ratio, raw / 2 kHz",
    "orbit radius [um]", "strongest line", "inner / outer angle [deg]",
    "axial: mean / range [um]", "cage slip", "slip ripple", "pocket force [N]", "stress [MPa]",
)  # fmt: skip


def table(found: Mapping[str, Found]) -> str:
    """All figures of all readings as tables of Markdown."""
    return "\n\n".join(f"### {name}\n\n{_reading(View(f))}" for name, f in found.items())


def _reading(view: View) -> str:
    lines = [f"| {' | '.join(HEAD)} |", "|" + " --- |" * len(HEAD)]
    for label in view.found:
        cells = (
            _short(view("peak", label)),
            " / ".join(_percent(view(k, label)) for k in ("empty_loaded", "empty_opposite")),
            " / ".join(_percent(view(k, label)) for k in ("deviation_raw", "deviation")),
            _short(view("radius", label), 1e6),
            _percent(view("line", label)),
            " / ".join(
                _short(view(k, label), degrees(1.0)) for k in ("inner_angle", "outer_angle")
            ),
            f"{_short(view('axial', label), 1e6)} / {_short(view('axial_range', label), 1e6)}",
            _percent(view("cage_slip", label)),
            _percent(view("ball_ripple", label)),
            _short(view("pocket_peak", label)),
            _short(view("stress", label), 1e-6),
        )
        lines.append(f"| {label} | {' | '.join(cells)} |")
    return "\n".join(lines)


def _short(figure: Estimate, factor: float = 1.0) -> str:
    value, margin = factor * figure.value, factor * figure.margin
    if not isfinite(value):
        return "-"
    if not isfinite(margin) or margin == 0.0:
        return f"{value:,.4g}"
    digits = max(0, 1 - int(np.floor(np.log10(margin))))
    return f"{value:,.{digits}f} ± {margin:.2g}"


def _percent(figure: Estimate) -> str:
    text = _short(figure, 100.0)
    return text if text == "-" else f"{text} %"


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
    psi = ds["ball_position"].transpose("time", "ball", "cyl").sel(cyl="psi").values
    at = np.round((psi - run.case.load.direction) * 18 / (2.0 * np.pi)).astype(int) % 18
    touching = ds["contact_force"].sel(race="inner").transpose("time", "ball").values > 0.0
    return sum(bool(touching[at == k].mean() >= 0.5) for k in range(18))


def run_of(results: flexcage.StudyResults, label: str) -> flexcage.Run | None:
    """The first start of a case, None if it is not done."""
    for row in results.rows:
        if row.state == "done" and row.planned.point.labels["case"] == label:
            return results.run(row.planned.number, row.planned.repetition)
    return None


def draw(results: flexcage.StudyResults, folder: Path) -> list[Path]:
    """Orbits over speed and forces round the bearing, as PNG."""
    runs = {label: run for label in SPEEDS if (run := run_of(results, label)) is not None}
    return [_orbits(runs, folder / "orbits.png"), _round(runs, folder / "round.png")]


def _orbits(runs: Mapping[str, flexcage.Run], path: Path) -> Path:
    """Orbit of the cage's centre at every speed, to one scale."""
    size, gap, top = 300, 70, 110
    with sheet.style():
        figure = sheet.new_figure(gap + len(runs) * (size + gap), top + size + 90)
        note = "about the outer ring's axis, settled part; load down, gravity with it"
        sheet.heading(figure, "Orbits of the cage centre over speed", note)
        orbits = {k: 1e6 * metrics.orbit(metrics.settled(r.dataset, r.case.output.settle))
                  for k, r in runs.items()}  # fmt: skip
        reach = 1.05 * max(float(np.abs(o).max()) for o in orbits.values())
        for k, (label, orbit) in enumerate(orbits.items()):
            ax = sheet.axes_at(figure, (gap + k * (size + gap), top, size, size))
            ax.plot(orbit[:, 1], -orbit[:, 0], color=sheet.BLUE, lw=0.5)
            ax.set(xlim=(-reach, reach), ylim=(-reach, reach), xlabel="z [um]", title=label)
            ax.axhline(0.0, color="0.8", lw=0.6, zorder=0)
            ax.axvline(0.0, color="0.8", lw=0.6, zorder=0)
            if k == 0:
                ax.set_ylabel("-y [um]")
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

"Vibro-impacts" of a 7010C's cage, {PAPER}, as a study. Written by
`c7010_vibro_impact.py --page` on {date.today():%-d %B %Y} with flexcage {flexcage.__version__}.

## Verdicts

"±" is half of a 95 % interval (block bootstrap over ball passes).

|  | claim of the paper | by the base reading | by reading |
| --- | --- | --- | --- |
{claims}

## Quasi-static equations beside the runs

{statics_beside(results)}

![Orbits of the cage centre](orbits.png)

![Force and angle round the bearing](round.png)

## All figures

{table(found)}
"""
