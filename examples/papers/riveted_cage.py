"""A riveted cage under an overturning moment: pockets, sheet, grooves, clearance and speed.

    python examples/papers/riveted_cage.py             # all, about half an hour of two cores
    python examples/papers/riveted_cage.py --quick     # the pocket radius with a rigid cage

Repeats "Machines 2024, 12(7), 466", prints figures and a verdict on each of its claims;
verdicts.json in the folder of the first reading keeps them. With --page the page and the pictures
beside this script's case are written.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from ball_claim import Found, gathered
from riveted_cage_claims import (
    BASE,
    CLEARANCES,
    GROOVES,
    MODIFIED,
    ORIGINAL,
    RADII,
    SHEETS,
    WIDTHS,
    evaluate,
    verdicts,
)
from riveted_cage_page import draw, page, table

import flexcage
from flexcage.study.spec import Repeat
from flexcage.study.verdicts import Verdict, write_verdicts

FOLDER = Path(__file__).with_suffix("")
OUT = Path("runs/riveted_cage")
FLEXIBLE = "flexible"
BALL = 6.47e-3

#: What a reading changes. 6.47 mm is no standard ball, and leaves pockets 0.45 mm of play.
READINGS: Mapping[str, Mapping[str, Any]] = {
    FLEXIBLE: {},
    "rigid": {"cage.model": "rigid"},
    "balls of 6.747 mm": {"cage.model": "rigid", "bearing.ball_diameter": "6.747 mm"},
}

STARTS = {FLEXIBLE: 3, "rigid": 3, "balls of 6.747 mm": 6}


def points(reading: str) -> list[dict[str, Any]]:
    """Every case of a reading: its label, and the values that it changes."""
    ball = 6.747e-3 if "6.747" in reading else BALL
    cases: dict[str, dict[str, Any]] = {BASE: {}}
    cases |= {k: _cage(radius=r) for k, r in RADII.items() if k != BASE}
    cases |= {k: _cage(width=w) for k, w in WIDTHS.items() if k != BASE}
    cases |= {k: {"cage.thickness": _mm(t)} for k, t in SHEETS.items() if k != BASE}
    cases |= {
        k: {"bearing.radial_clearance": f"{1e6 * c:g} um"}
        for k, c in CLEARANCES.items() if k != BASE
    }  # fmt: skip
    grooves = {k: _grooves(*f, ball) for k, f in GROOVES.items()}
    cases |= {k: g for k, g in grooves.items() if k != BASE}
    for labels, cage in ((ORIGINAL, _cage(3.6e-3, 8e-3)), (MODIFIED, _cage(3.46e-3, 6.2e-3))):
        cases |= {k: {**cage, "drive.speed": f"{k.split()[1]} rpm"} for k in labels}
    return [
        {"label": k, **READINGS[reading], **grooves[BASE], **changed}
        for k, changed in cases.items()
    ]


def _mm(size: float) -> str:
    return f"{1e3 * size:g} mm"


def _cage(radius: float | None = None, width: float | None = None) -> dict[str, str]:
    changed = {} if radius is None else {"cage.pocket_diameter": _mm(2.0 * radius)}
    return changed if width is None else {**changed, "cage.width": _mm(width)}


def _grooves(inner: float, outer: float, ball: float) -> dict[str, str]:
    """Groove radii by the ball's diameter."""
    return {
        "bearing.inner_groove_radius": _mm(inner * ball),
        "bearing.outer_groove_radius": _mm(outer * ball),
    }


def study(reading: str, *, quick: bool = False) -> flexcage.Study:
    """The study of one reading."""
    cases = points(reading)
    if quick:
        cases = [c for c in cases if c["label"] in RADII]
    return flexcage.Study(
        name=f"riveted-cage, {reading}",
        case=flexcage.load_case(
            FOLDER / "case.toml", overrides={"solver.duration": "20 ms"} if quick else None
        ),
        axes=[flexcage.study.Points(tuple(cases), name="case")],
        outputs=["cage_slip_ratio_nominal", "pocket_force_pass_peak", "tilt_mean"],
        repeat=Repeat(count=1 if quick else STARTS[reading], push=20e-3),
    )


def compute(reading: str, out: Path, *, workers: int, quick: bool = False) -> Found:
    """Figures of every finished case of a reading, by label; one entry a start."""
    planned = study(reading, quick=quick)
    return gathered(planned, out, workers=workers, evaluate=lambda _, run: evaluate(run))


def main(arguments: Sequence[str] | None = None) -> list[Verdict]:
    """Compute what is missing, print figures and verdicts."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--quick", action="store_true", help="short runs of one sweep, rigid cage")
    parser.add_argument("-o", "--out", type=Path, help="folder of the studies")
    parser.add_argument("--readings", nargs="+", choices=READINGS, default=list(READINGS))
    parser.add_argument("--workers", type=int, default=1, help="processes")
    parser.add_argument("--page", action="store_true", help="write page and pictures")
    options = parser.parse_args(arguments)
    out = options.out or (OUT.with_name(f"{OUT.name}_quick") if options.quick else OUT)
    readings = ["rigid"] if options.quick else options.readings
    found = {
        r: compute(r, _folder(out, r), workers=options.workers, quick=options.quick)
        for r in readings
    }
    judged = verdicts(found, readings[0])
    write_verdicts(_folder(out, readings[0]), judged)
    print(table(found))
    for verdict in judged:
        print(f"{verdict.key} {verdict.outcome:14} {verdict.claim} ({verdict.range})")
    if options.page:
        draw(found, flexcage.StudyResults(_folder(out, readings[0])), FOLDER)
        (FOLDER / "README.md").write_text(page(found, judged), encoding="utf-8")
    return judged


def _folder(out: Path, reading: str) -> Path:
    return out / reading.replace(" ", "_")


if __name__ == "__main__":
    main()
