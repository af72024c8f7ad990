"""A 7010C's cage measured by virtual lasers, after a paper on measured centroid trajectories.

    python examples/papers/c7010_centroid.py             # 60 runs, half an hour of one core
    python examples/papers/c7010_centroid.py --quick     # 40 ms of the first case at each speed

Prints cage speeds, whirl and deflection error for every speed and variation, and a verdict on each
of the paper's five claims; verdicts.json in the study's folder keeps them. With --page the page
beside the study's text is written, and its pictures.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from ball_claim import finished
from c7010_centroid_claims import verdicts
from c7010_centroid_figures import Found, evaluate
from c7010_centroid_page import draw, page, table

import flexcage
from flexcage.core.progress import Progress
from flexcage.study.spec import Study
from flexcage.study.verdicts import Verdict, write_verdicts

FOLDER = Path(__file__).with_suffix("")
OUT = Path("runs/c7010_centroid")


def load(*, quick: bool = False) -> Study:
    """The whole study; a quick one has short runs of the first variation."""
    study = flexcage.load_study(
        FOLDER / "study.toml", overrides={"solver.duration": "40 ms"} if quick else None
    )
    if not quick:
        return study
    speed, variation = study.axes
    return replace(study, axes=(speed, replace(variation, points=variation.points[:1])))


def collect(results: flexcage.StudyResults) -> dict[str, dict[str, list[Found]]]:
    """Figures of every finished case, by variation and speed."""
    found: dict[str, dict[str, list[Found]]] = {}
    for labels, run in finished(results):
        at = found.setdefault(labels["variation"], {})
        at.setdefault(labels["speed"], []).append(evaluate(run))
    return found


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
    found = collect(results)
    judged = verdicts(found)
    write_verdicts(out, judged)
    print(table(found))
    for verdict in judged:
        print(f"{verdict.key} {verdict.outcome:14} {verdict.claim} ({verdict.range})")
    if options.page:
        draw(results, found, FOLDER)
        (FOLDER / "README.md").write_text(page(found, judged), encoding="utf-8")
    return judged


if __name__ == "__main__":
    main()
