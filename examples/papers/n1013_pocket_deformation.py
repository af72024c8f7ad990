"""Lubricants 2025, 13(11), 495 as a study: five cages in an N1013, and what becomes of its claims.

    python examples/papers/n1013_pocket_deformation.py --quick     # a look, ten minutes
    python examples/papers/n1013_pocket_deformation.py --stages base,rigid
    python examples/papers/n1013_pocket_deformation.py             # all of it: an hour and a half

A quick look is on a coarse mesh and too short for most claims: they stay undecided. The study's
folder (default runs/n1013_pocket_deformation) holds what ``flexcage study`` writes, and beside it
verdicts.json and figures/. What is computed already is not computed again.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import n1013_figures as figures
import n1013_page as page
import n1013_pinch as pinch
from n1013_claims import CLAIMS
from n1013_view import BASE, CAGES, CROSSBEAM, LONGER, RIGID, SHORTER, SOUND, View, rows_of

import flexcage
from flexcage.core.errors import FlexcageError, InputError
from flexcage.core.progress import Progress
from flexcage.results.known import FLEXIBLE, KNOWN
from flexcage.study.folder import Folder
from flexcage.study.plan import make_plan
from flexcage.study.spec import Repeat, Study
from flexcage.study.verdicts import Verdict, write_verdicts

TEXT = Path(__file__).with_suffix("") / "study.toml"
OUT = Path("runs/n1013_pocket_deformation")
QUICK = {"solver.duration": "60 ms", "mesh.fineness": "coarse"}


@dataclass(frozen=True)
class Stage:
    """A part of the study: which cages in which variations, and how many starts of each."""

    cages: tuple[str, ...]
    variations: tuple[str, ...]
    starts: int
    hours: float  # measured, of one core
    keep: str = "figures"


#: In the order of computation: what matters most comes first.
STAGES = {
    "base": Stage(CAGES, (BASE,), 3, 0.2, "runs"),
    "rigid": Stage(CAGES, (RIGID,), 2, 0.05),
    "crossbeam": Stage(CROSSBEAM, ("Cq - Dw 0.15", "Cq - Dw 0.25"), 1, 0.1),
    "side_beam": Stage((SOUND, LONGER, SHORTER), ("Cp - Lw 0.20", "Cp - Lw 0.30"), 1, 0.1),
    "friction": Stage(CAGES, ("creep / 10", "traction 2"), 1, 0.1),
    "rollers": Stage(CAGES, ("Z 21",), 1, 0.05),
    "rest": Stage((), (), 3, 0.8),  # every combination and start that is still missing
}


def load(*, quick: bool = False) -> Study:
    """The whole study; a quick one has the base clearances alone, one short start of each."""
    study = flexcage.load_study(TEXT, overrides=QUICK if quick else None)
    if not quick:
        return study
    study = replace(study, name=f"{study.name}-quick")
    return part(study, Stage(CAGES, (BASE,), 1, 0.0, "runs"))


def part(study: Study, stage: Stage) -> Study:
    """The cases of one stage."""
    if not stage.cages:
        return study
    wanted = {"cage": stage.cages, "variation": stage.variations}
    axes = tuple(
        replace(axis, points=tuple(p for p in axis.points if p["label"] in wanted[axis.name]))
        for axis in study.axes
    )
    starts = Repeat(count=stage.starts, push=study.repeat.push, seed=study.repeat.seed)
    rigid = set(stage.variations) == {RIGID}
    outputs = tuple(
        o for o in study.outputs if not (rigid and o in KNOWN and KNOWN[o].needs == FLEXIBLE)
    )
    return replace(study, axes=axes, repeat=starts, keep=stage.keep, outputs=outputs)


def compute(study: Study, stages: Sequence[str], out: Path, *, workers: int) -> None:
    """Compute what the folder lacks of the stages, one after the other."""
    for name in stages:
        wanted = part(study, STAGES[name])
        count, hours = len(make_plan(wanted).cases), STAGES[name].hours
        print(f"{name}: {count} cases, about {hours:g} h of one core if none is there yet")
        flexcage.run_study(wanted, out=out, workers=workers, progress=Progress)
    Folder(out).prepare(make_plan(study))  # the folder's study is the whole of it again


def evaluate(out: Path, *, draw: bool = True) -> list[Verdict]:
    """Verdicts of what the folder holds; they, the tables and the figures are written into it."""
    results = flexcage.StudyResults(out)
    results.write()
    rows = rows_of(results)
    variations = tuple(p["label"] for p in results.study.axes[1].points)
    squeezed = pinch.pinch_map(results.study.case)
    found = [claim.verdict(rows, variations) for claim in CLAIMS]
    found.append(pinch.verdict(squeezed, View(rows)))
    found = [page.with_reason(verdict, View(rows)) for verdict in found]
    write_verdicts(out, found)
    if draw:
        figures.draw(results, rows, squeezed, out / "figures")
    return found


def main(arguments: Sequence[str] | None = None) -> list[Verdict]:
    """Compute, evaluate, and print the verdicts."""
    options = _parser().parse_args(arguments)
    if options.quick and options.page:
        raise InputError("The page is that of the whole study; leave out --quick or --page.")
    out = options.out or (OUT.with_name(f"{OUT.name}_quick") if options.quick else OUT)
    study = load(quick=options.quick)
    if options.quick:
        flexcage.run_study(study, out=out, workers=options.workers, progress=Progress)
    else:
        compute(study, _chosen(options.stages), out, workers=options.workers)
    found = evaluate(out, draw=not options.no_figures)
    for verdict in found:
        print(f"{verdict.key:8} {verdict.outcome:14} {verdict.claim}")
    if options.page:
        page.write(flexcage.StudyResults(out), found, out / "figures")
    return found


def _chosen(text: str) -> list[str]:
    names = [name.strip() for name in text.split(",") if name.strip()]
    for name in names:
        if name not in STAGES:
            raise InputError(f"There is no stage '{name}'; choose from {', '.join(STAGES)}.")
    return names


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--quick", action="store_true", help="one short start of every cage")
    parser.add_argument(
        "--stages", default=",".join(STAGES), help="parts to compute, in order; '' for none"
    )
    parser.add_argument("--no-figures", action="store_true", help="draw nothing anew")
    parser.add_argument("-o", "--out", type=Path, help="the study's folder")
    parser.add_argument("--workers", type=int, default=1, help="processes")
    parser.add_argument("--page", action="store_true", help="write README.md beside this script")
    return parser


if __name__ == "__main__":
    try:
        main()
    except FlexcageError as exc:
        print(f"Error: {exc}", file=sys.stderr)
        sys.exit(2 if isinstance(exc, InputError) else 1)
