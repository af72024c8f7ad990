"""Beyond Lubricants 2025, 13(11), 495: what the paper leaves open about its N1013, as two studies.

    python examples/papers/n1013_beyond.py --quick     # a look: short runs on a coarse mesh
    python examples/papers/n1013_beyond.py --page      # all, and the page beside the studies

``peaks.toml``: pocket forces of rigid and flexible cages over speed and load, brass and PA66.
``cages.toml``: deformations that grow, several at once, bent crossbeams, spalls and a tilted ring.
What is computed already is not computed again. Needs ``pip install '.[fast,study,fatigue]'``.
"""

from __future__ import annotations

import argparse
from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

from n1013_beyond_page import draw, page, tables

import flexcage
from flexcage.core.progress import Progress
from flexcage.study.spec import Repeat, Study

FOLDER = Path(__file__).with_suffix("")
OUT = Path("runs/n1013_beyond")
STUDIES = ("peaks", "cages")
QUICK = {"mesh.fineness": "coarse", "output.rate": "50 kHz"}


def load(name: str, *, quick: bool = False) -> Study:
    """One of the studies; a quick one has short runs of the first four points of its last axis."""
    study = flexcage.load_study(FOLDER / f"{name}.toml", overrides=QUICK if quick else None)
    if not quick:
        return study
    *before, last = study.axes
    axes = [replace(axis, points=axis.points[1:2]) for axis in before]
    axes.append(replace(last, points=last.points[:4]))
    case = study.case.replace("solver.duration", "30 ms")
    short = [replace(axis, points=tuple(map(shortened, axis.points))) for axis in axes]
    return replace(study, case=case, axes=tuple(short), repeat=Repeat())


def shortened(point: Mapping[str, Any]) -> dict[str, Any]:
    """The point without a duration of its own."""
    return {path: value for path, value in point.items() if path != "solver.duration"}


def main(arguments: Sequence[str] | None = None) -> str:
    """Compute what is missing; print the tables and write the page if asked."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--quick", action="store_true", help="a few short runs")
    parser.add_argument("-o", "--out", type=Path, help="folder of both studies")
    parser.add_argument("--workers", type=int, default=1, help="processes")
    parser.add_argument("--no-compute", action="store_true", help="only what the folders hold")
    parser.add_argument("--page", action="store_true", help="write README.md beside the studies")
    options = parser.parse_args(arguments)
    out = options.out or (OUT.with_name(f"{OUT.name}_quick") if options.quick else OUT)
    if not options.no_compute:
        for name in STUDIES:
            study = load(name, quick=options.quick)
            flexcage.run_study(study, out=out / name, workers=options.workers, progress=Progress)
    peaks, cages = (flexcage.StudyResults(out / name) for name in STUDIES)
    text = tables(peaks, cages)
    print(text)
    if options.page:
        draw(peaks, cages, FOLDER)
        (FOLDER / "README.md").write_text(page(peaks, cages), encoding="utf-8")
    return text


if __name__ == "__main__":
    main()
