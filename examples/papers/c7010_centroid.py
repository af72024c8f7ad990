"""A 7010C's cage measured by virtual lasers, after a paper on measured centroid trajectories.

    python examples/papers/c7010_centroid.py             # 48 runs, half an hour of one core
    python examples/papers/c7010_centroid.py --quick     # 40 ms of the first case at each speed

Prints cage speeds, whirl and deflection error for every speed and variation, and a verdict on each
of the paper's five claims; verdicts.json in the study's folder keeps them. With --page the page
beside the study's text is written, and its picture.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

import numpy as np
from c7010_centroid_figures import Found, evaluate
from c7010_centroid_page import PAPER, draw, page, table

import flexcage
from flexcage.core.progress import Progress
from flexcage.study.spec import Study
from flexcage.study.verdicts import FAILS, HOLDS, Line, Verdict, range_of, write_verdicts

FOLDER = Path(__file__).with_suffix("")
OUT = Path("runs/c7010_centroid")
SPEEDS = (4000, 7000, 10000, 11000)
BASE = "0.2 g mm"
RPM, MM = 30.0 / np.pi, 1e3


def load(*, quick: bool = False) -> Study:
    """The whole study; a quick one has short runs of the first variation."""
    study = flexcage.load_study(
        FOLDER / "study.toml", overrides={"solver.duration": "40 ms"} if quick else None
    )
    if not quick:
        return study
    speed, variation = study.axes
    return replace(study, axes=(speed, replace(variation, points=variation.points[:1])))


Table = Mapping[tuple[str, str], Found]


def verdicts(found: Table) -> list[Verdict]:
    """The paper's five claims, by the base variation, and where else they hold."""
    claims = {
        "003-1": ("The deflection error is positive, 3 to 5.4 %, least at 10,000 rpm",
                  lambda f: _errors_fall(f)),
        "003-2": ("The whirl ratio decreases to 10,000 rpm, then rises",
                  lambda f: _order([x.ratio for x in f])),
        "003-3": ("The mean whirl radius grows with speed up to 10,000 rpm",
                  lambda f: f[0].mean < f[1].mean < f[2].mean),
        "003-4": ("The axial raw signal is periodic at the cage's frequency, the corrected is not",
                  lambda f: all(x.axial_raw > 0.5 > x.axial_solved for x in f)),
        "003-5": ("The cage's speed is within 1 % of equation 18",
                  lambda f: all(abs(x.speed / x.theory - 1.0) < 0.01 for x in f)),
    }  # fmt: skip
    names = list(dict.fromkeys(variation for _, variation in found))
    rows = {v: [found[str(s), v] for s in SPEEDS if (str(s), v) in found] for v in names}
    whole = {v: f for v, f in rows.items() if len(f) == len(SPEEDS)}
    out = []
    for key, (text, holds) in claims.items():
        where = {v: HOLDS if holds(f) else FAILS for v, f in whole.items()}
        base = BASE if BASE in where else next(iter(where))
        out.append(Verdict(
            key=key, claim=text, outcome=where[base], source=PAPER,
            range=range_of(where),
            figures=tuple(_lines(whole[base])),
        ))  # fmt: skip
    return out


def _errors_fall(found: Sequence[Found]) -> bool:
    errors = [f.error for f in found]
    return all(0.02 < e < 0.08 for e in errors) and int(np.argmin(errors)) == 2


def _order(values: Sequence[float]) -> bool:
    return values[0] > values[1] > values[2] < values[3]


def _lines(found: Sequence[Found]) -> list[Line]:
    lines = []
    for rpm, f in zip(SPEEDS, found, strict=True):
        lines.append(Line(f"{rpm} rpm: cage speed", f.speed * RPM, unit="rpm"))
        lines.append(Line(f"{rpm} rpm: whirl radius, max - min", f.difference * MM, unit="mm"))
    return lines


def main(arguments: Sequence[str] | None = None) -> list[Verdict]:
    """Compute what is missing, print figures and verdicts."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--quick", action="store_true", help="short runs of the first case")
    parser.add_argument("-o", "--out", type=Path, help="the study's folder")
    parser.add_argument("--workers", type=int, default=1, help="processes")
    parser.add_argument("--page", action="store_true", help="write the page beside the study")
    options = parser.parse_args(arguments)
    study = load(quick=options.quick)
    out = options.out or (OUT.with_name(f"{OUT.name}_quick") if options.quick else OUT)
    flexcage.run_study(study, out=out, workers=options.workers, progress=Progress)
    results = flexcage.StudyResults(out)
    found = {}
    for row in results.rows:
        labels = row.planned.point.labels
        if row.state == "done":
            run = results.run(row.planned.number, row.planned.repetition)
            found[labels["speed"], labels["variation"]] = evaluate(run)
        elif row.state == "failed":
            print(f"{row.planned.point} failed: {row.reason}")
    judged = verdicts(found)
    write_verdicts(out, judged)
    print(table(found))
    for verdict in judged:
        print(f"{verdict.key} {verdict.outcome:14} {verdict.claim} ({verdict.range})")
    if options.page:
        draw(results, FOLDER / "orbits.png")
        (FOLDER / "README.md").write_text(page(found, judged), encoding="utf-8")
    return judged


if __name__ == "__main__":
    main()
