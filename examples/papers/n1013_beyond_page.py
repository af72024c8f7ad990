"""Tables, pictures and page of what lies beyond the paper; every number is of the studies."""

from __future__ import annotations

from collections.abc import Sequence
from math import isfinite, nan
from pathlib import Path

import numpy as np
from n1013_page import markdown
from n1013_view import SHOWN, over_starts, written

from flexcage import StudyResults, __version__
from flexcage.render import sheet
from flexcage.results.audit import OF_DRIVE
from flexcage.study.verdicts import Estimate, Line

CLAIMED = 0.44  # rigid cages are widely said to overstate pocket forces by this much
PEAK, BLOW = "pocket_force_pass_peak", "pocket_force_peak"
CORNER, DAMAGE, WORN = "stress_root_pass_peak", "fatigue_damage_rate", "wear_volume_rate"
SPEEDS, LOADS = ("3000", "6000", "9000", "12000"), ("200", "1000", "5000")
MATERIALS = ("brass", "PA66")
_PART = "pocket_slice_force[pocket=4,crossbeam_face=front,slice={}:{}].mean"
PARTS = tuple(_PART.format(k, k + 4) for k in range(0, 64, 4))  # of the roller, all of one length
GROWTH = {
    "dq": ("sound", "dq 0.1", "dq 0.2", "dq 0.25", "dq 0.3"),
    "dp": ("dp -0.3", "dp -0.2", "dp -0.1", "sound", "dp +0.3"),
}
SEVERAL = ("sound", "dq 0.1", "dq 0.2", "two neighbours", "two opposite", "every second",
           "dq and dp")  # fmt: skip
TOGETHER = ("sound", "dq 0.2", "outer spall", "outer spall + dq 0.2", "inner spall",
            "inner spall + dq 0.2", "tilted", "tilted + dq 0.2", "loose seat",
            "loose seat + dq 0.2")  # fmt: skip
CURVES = {
    "sound": "sound", "dq 0.1": "shifted by 0.1 mm", "dq 0.2": "shifted by 0.2 mm",
    "dq 0.2, bent": "bent by 0.2 mm",
}  # fmt: skip
NAMES = {
    **SHOWN,
    PEAK: ("pocket force, mean peak of a roller pass", "N", 1.0),
    BLOW: ("hardest blow in a pocket", "N", 1.0),
    "pocket_force_mean": ("mean force in contact", "N", 1.0),
    DAMAGE: ("damage of the worst corner", "1/h", 3600.0),
    WORN: ("worn volume over the sound cage's", "", 1.0),
}


def figure(results: StudyResults, output: str, *labels: str) -> Estimate:
    """A figure over the repetitions of the point with these labels, NaN where none is done."""
    rows = (row for row in results.rows if tuple(row.planned.point.labels.values()) == labels)
    return over_starts(rows, output)


def excess(peaks: StudyResults, output: str, speed: str, load: str, material: str) -> Estimate:
    """By how much the rigid cage's figure is greater than the flexible one's, as a share."""
    rigid, flexible = (
        figure(peaks, output, speed, load, f"{material}, {kind}") for kind in ("rigid", "flexible")
    )
    if not (isfinite(rigid.value) and isfinite(flexible.value)):
        return Estimate(nan)
    ratio = rigid / flexible
    return Estimate(ratio.value - 1.0, ratio.margin)


def cell(output: str, value: Estimate) -> str:
    _, unit, factor = NAMES[output]
    if output == DAMAGE and isfinite(value.value):
        margin = f" ± {factor * value.margin:.0e}" if isfinite(value.margin) else ""
        return f"{factor * value.value:.1e}{margin} {unit}"
    return written(Line("", factor * value.value, abs(factor * value.margin), unit))


def percent(value: Estimate) -> str:
    return written(Line("", 100.0 * value.value, abs(100.0 * value.margin), "%"))


def peaks_table(peaks: StudyResults) -> str:
    rows = []
    for material in MATERIALS:
        for load in LOADS:
            for speed in SPEEDS:
                found = [
                    figure(peaks, PEAK, speed, load, f"{material}, {kind}")
                    for kind in ("rigid", "flexible")
                ]
                if all(isfinite(f.value) for f in found):
                    over = [percent(excess(peaks, o, speed, load, material)) for o in (PEAK, BLOW)]
                    rows.append([material, f"{int(load):,} N", f"{int(speed):,} rpm",
                                 *(cell(PEAK, f) for f in found), *over])  # fmt: skip
    head = ("cage", "load", "speed", "rigid", "flexible", "rigid is higher by", "hardest blow by")
    return markdown(head, rows)


def cages_table(cages: StudyResults, outputs: Sequence[str], labels: Sequence[str]) -> str:
    """One row an output, one column a cage."""
    rows = []
    for output in outputs:
        values = [figure(cages, output, label) for label in labels]
        if output == WORN:
            values = [value / figure(cages, output, "sound") for value in values]
        if any(isfinite(v.value) for v in values):
            rows.append([NAMES[output][0], *(cell(output, v) for v in values)])
    return markdown(("", *labels), rows)


def middle_share(cages: StudyResults, label: str) -> float:
    """Share of a crossbeam's push on its roller that acts on the roller's middle half."""
    mean = np.array([figure(cages, s, label).value for s in PARTS])
    return float(mean[4:12].sum() / mean.sum())


def share_table(cages: StudyResults) -> str:
    shares = {name: middle_share(cages, label) for label, name in CURVES.items()}
    rows = [[name, f"{100.0 * s:.0f} %" if isfinite(s) else "-"] for name, s in shares.items()]
    return markdown(("crossbeam", "share of the push on the roller's middle half"), rows)


_GROWING = (CORNER, "stress_root", "pocket_force_mean", BLOW, "pinch_force", "cage_slip_ratio",
            "cage_speed_ripple", DAMAGE, WORN)  # fmt: skip
_BESIDE = (CORNER, PEAK, BLOW, "cage_slip_ratio", "cage_speed_ripple", "cage_centre_shift",
           DAMAGE, WORN)  # fmt: skip
_SHAKEN = (CORNER, PEAK, BLOW, "cage_slip_ratio", "cage_speed_ripple",
           "outer_acceleration_filtered[axis2=y].rms",
           "outer_acceleration_filtered[axis2=y].kurtosis", DAMAGE)  # fmt: skip


def tables(peaks: StudyResults, cages: StudyResults) -> str:
    """All tables, as the page has them."""
    return "\n\n".join((
        peaks_table(peaks), cages_table(cages, _GROWING, GROWTH["dq"]),
        cages_table(cages, _GROWING, GROWTH["dp"]), cages_table(cages, _BESIDE, SEVERAL),
        share_table(cages), cages_table(cages, _SHAKEN, TOGETHER),
    ))  # fmt: skip


def verdict(peaks: StudyResults) -> str:
    """What becomes of the claim that rigid cages overstate pocket forces by 44 %."""
    texts = []
    for material in MATERIALS:
        found = [
            e
            for load in LOADS
            for speed in SPEEDS
            if isfinite((e := excess(peaks, PEAK, speed, load, material)).value)
        ]
        if not found:
            continue
        values = [100.0 * e.value for e in found]
        within = sum(abs(e.value - CLAIMED) <= e.margin for e in found)
        texts.append(
            f"{material}: {min(values):.0f} to {max(values):.0f} %, median {np.median(values):.0f} "
            f"%; 44 % lies within the interval at {within} of {len(found)} speeds and loads"
        )
    return "; ".join(texts) + "."


def reading(peaks: StudyResults) -> str:
    """What else differs between rigid and flexible, as medians over speeds and loads."""
    texts = []
    for material in MATERIALS:
        parts = []
        for output, name in (
            ("pocket_force_sum", "sum of pocket forces"),
            ("contact_frequency", "contacts a second"),
            ("pocket_contact", "share of time in contact"),
            ("pocket_force_mean", "force in contact"),
        ):
            found = [
                excess(peaks, output, s, load, material).value for s in SPEEDS for load in LOADS
            ]
            known = [v for v in found if isfinite(v)]
            if known:
                parts.append(f"{name} {100.0 * np.median(known):+.0f} %")
        texts.append(f"{material}: {', '.join(parts) or 'nothing computed'}")
    return "With a rigid cage, as medians over all speeds and loads, " + "; ".join(texts) + "."


def draw(peaks: StudyResults, cages: StudyResults, folder: Path) -> list[Path]:
    """The pictures of the page."""
    return [
        _peaks_picture(peaks, folder / "peaks.png"),
        _growth_picture(cages, folder / "growth.png"),
        _slices_picture(cages, folder / "slices.png"),
    ]


def _peaks_picture(peaks: StudyResults, path: Path) -> Path:
    colours = (sheet.BLUE, sheet.VERMILION, sheet.GREEN)
    with sheet.style():
        figure_ = sheet.new_figure(1240, 640)
        sheet.heading(figure_, "By how much a rigid cage overstates pocket-force peaks",
                      "N1013, mean peak of a roller pass; bars: 95 % intervals")  # fmt: skip
        for i, material in enumerate(MATERIALS):
            ax = sheet.axes_at(figure_, (90 + i * 590, 130, 500, 410))
            for load, colour, shift in zip(LOADS, colours, (-120, 0, 120)):
                found = [excess(peaks, PEAK, s, load, material) for s in SPEEDS]
                ax.errorbar([float(s) + shift for s in SPEEDS], [100 * e.value for e in found],
                            [100 * e.margin for e in found], fmt="o-", capsize=3, color=colour,
                            label=f"{int(load):,} N")  # fmt: skip
            ax.axhline(100 * CLAIMED, color=sheet.FAINT, ls="--", lw=1.0)
            ax.text(4500, 100 * CLAIMED, "44 %", va="bottom", ha="center", color=sheet.FAINT)
            ax.axhline(0.0, color=sheet.FAINT, lw=0.8)
            ax.set(title=f"{material} cage", xlabel="speed of the inner ring [rpm]")
            ax.set(xticks=[int(s) for s in SPEEDS], ylabel="rigid over flexible, less one [%]")
            ax.legend(loc="best")
        return sheet.save(figure_, path)


_TICKS = (10, 20, 50, 100, 200, 500, 1000)  # MPa


def _growth_picture(cages: StudyResults, path: Path) -> Path:
    kinds = (("dq", "crossbeam shifted by dq [mm]"), ("dp", "pocket longer by dp [mm]"))
    with sheet.style():
        figure_ = sheet.new_figure(1240, 640)
        sheet.heading(figure_, "Deformation that grows: stress of pocket corners",
                      "N1013, 6000 rpm, 1000 N; Cq - Dw 0.20 mm, Cp - Lw 0.25 mm")  # fmt: skip
        for i, (kind, label) in enumerate(kinds):
            ax = sheet.axes_at(figure_, (90 + i * 590, 130, 500, 410))
            at = [0.0 if c == "sound" else float(c.split()[1]) for c in GROWTH[kind]]
            for output, colour in ((CORNER, sheet.BLUE), ("stress_root", sheet.VERMILION)):
                found = [figure(cages, output, c) for c in GROWTH[kind]]
                margins = [1e-6 * e.margin if isfinite(e.margin) else 0.0 for e in found]
                ax.errorbar(at, [1e-6 * e.value for e in found], margins, fmt="o-", capsize=3,
                            color=colour, label=NAMES[output][0])  # fmt: skip
            ax.set(xlabel=label, ylabel="stress [MPa]" if i == 0 else "", yscale="log")
            ax.set_yticks(_TICKS, [str(t) for t in _TICKS])
            ax.minorticks_off()
            ax.legend(loc="best")
        return sheet.save(figure_, path)


def _slices_picture(cages: StudyResults, path: Path) -> Path:
    colours = (sheet.FAINT, sheet.SKY, sheet.BLUE, sheet.VERMILION)
    with sheet.style():
        figure_ = sheet.new_figure(1000, 640)
        sheet.heading(figure_, "Where a crossbeam pushes its roller",
                      "mean force on 16 parts of roller j-1, front face")  # fmt: skip
        ax = sheet.axes_at(figure_, (100, 130, 840, 410))
        place = (np.arange(16) + 0.5) / 16.0 - 0.5
        for (label, name), colour in zip(CURVES.items(), colours):
            mean = np.array([figure(cages, s, label).value for s in PARTS])
            ax.plot(place, mean / mean.mean(), "o-", color=colour, label=name)
        ax.set(xlabel="place along the roller, over its effective length")
        ax.set(ylabel="force over its mean along the roller", ylim=(0.0, None))
        ax.legend(loc="best")
        return sheet.save(figure_, path)


def _energy(missing: Sequence[float]) -> str:
    """How far the energy of all runs closes, from what is missing as shares of the drive's work."""
    closed, worst = sum(share <= OF_DRIVE for share in missing), 100.0 * max(missing)
    of = "% of the drive's work"
    if closed == len(missing):
        return f"The energy of each closes to {worst:.2g} {of} or better."
    return (
        f"Energy closes to {100.0 * OF_DRIVE:g} {of} in {closed} of {len(missing)} and to "
        f"{worst:.2g} % or better in the others."
    )


def page(peaks: StudyResults, cages: StudyResults) -> str:
    """README.md of the folder."""
    done = [f"{r.count('done')} of {len(r.rows)} cases of `{r.study.name}`" for r in (peaks, cages)]
    missing = [
        float(row.figures["energy_of_drive"].value or 0.0)
        for r in (peaks, cages)
        for row in r.rows
        if "energy_of_drive" in row.figures
    ]
    failed = [
        f"- {row.planned.point}: {row.reason or 'not computed yet'}"
        for r in (peaks, cages)
        for row in r.rows
        if row.state != "done"
    ]
    return _PAGE.format(
        version=__version__,
        done=" and ".join(done),
        energy=_energy(missing),
        verdict=verdict(peaks),
        reading=reading(peaks),
        peaks=peaks_table(peaks),
        growth_q=cages_table(cages, _GROWING, GROWTH["dq"]),
        growth_p=cages_table(cages, _GROWING, GROWTH["dp"]),
        several=cages_table(cages, _BESIDE, SEVERAL),
        shares=share_table(cages),
        together=cages_table(cages, _SHAKEN, TOGETHER),
        failed="\n".join(failed) or "None.",
    )


_PAGE = """# An N1013 beyond the paper: rigid against flexible, growing, several, together

Written by `n1013_beyond.py --page` (flexcage {version}) from {done}.
{energy} Two starts of each point; ± is half a 95 % interval.
The bearing is that of the [paper's study](../README.md): clearances, housing and lubricant are
assumptions.

## In short

Read from the tables below on 24 November 2026:

- A rigid cage overstates the peaks of pocket forces at every speed and load computed, by 7 %
  (within its interval) to more than double. With brass the excess is larger at high speeds, with
  PA66 it falls with load. The sum of pocket forces stays: the same push comes in harder blows.
- Up to the clearance a growing deformation changes the stress of pocket corners by a few per cent.
  Beyond it a roller is pinched and stress rises twentyfold at once. A crossbeam shifted by 0.25 mm
  or more takes the corners past brass's tensile strength, 370 MPa: such a cage would have given
  way, and the elastic figures only say that it would.
- Shifted crossbeams lower the cage's slip and steady its speed, the more of them the more; once
  they pinch a roller, slip is larger than in a sound cage and the speed least steady.
- Rollers are pushed by the middle of a crossbeam; a bent one pushes with its crest alone.
- A spall of the outer race multiplies the ring's vibration a hundredfold and leaves pocket forces
  and corner stress as they were; a tilt of 1 mrad lowers pocket forces by up to a tenth. Neither
  adds to what a shifted crossbeam does.
- A sound or shifted cage's corners do not tire; those of a pinched one last for tens of thousands
  of hours (dp -0.3 mm), thousands (dq 0.25 mm) or about two (dq 0.3 mm).

## Does a rigid cage overstate pocket forces?

A rigid cage is widely said to overstate them by 44 %. Here the mean peak of a roller pass through
its pocket, over speed and load, is higher with a rigid cage by:

{verdict}

![Rigid against flexible](peaks.png)

{peaks}

{reading}

## Deformation that grows

The crossbeam between pockets 4 and 5 is shifted by dq; pocket 5 is longer by dp. Cq - Dw is 0.20 mm
and Cp - Lw 0.25 mm: beyond, a roller is pinched.

![Corner stress over the deformation](growth.png)

{growth_q}

{growth_p}

## Several deformed pockets at once

{several}

"Two neighbours": crossbeams 5 and 6 by 0.1 mm; "two opposite": 5 and 16 by 0.2 mm; "every second":
eleven crossbeams by 0.1 mm; "dq and dp": crossbeam 5 by 0.2 mm and pocket 12 shorter by 0.2 mm.

## Where a bent crossbeam touches its roller

{shares}

![Force along the roller](slices.png)

## With a spall, a tilted inner ring, or an outer ring loose in its seat

Spalls are 1.5 mm long and 50 um deep, the outer race's in the middle of the loaded zone; the inner
ring is tilted by 1 mrad; the outer ring lies in a bore with 10 um of radial clearance, where the
others sit in an elastic bushing of the same stiffness.

{together}

## Fatigue and wear

Damage is that of the worst pocket corner by rainflow, the FKM guideline's Haigh diagram and Miner's
elementary rule; brass's S-N curve is estimated from its tensile strength, an assumption. Few cycles
do nearly all of it, so 3 turns of the cage give an order of magnitude. Wear is Archard's law; its
coefficient for lubricated brass has no source, so that only ratios between cages are shown.

## What did not run

{failed}

## Repeat it

```sh
pip install '.[fast,study,fatigue]'
python examples/papers/n1013_beyond.py --quick             # minutes
python examples/papers/n1013_beyond.py --page              # all of it: an hour of one core
```
"""
