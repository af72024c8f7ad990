"""Two runs compared: a table of their figures and a picture of their cage forces."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

from flexcage.case import Case
from flexcage.results.summary import side_by_side
from flexcage.run import Run
from flexcage.run.foreseen import told_at_once
from flexcage.simulate import load_run, simulate


def compare_runs(runs: dict[str, Run], *, out: str | Path) -> str:
    """Table of the runs' summaries; also written to ``out`` with a plot of their forces."""
    from flexcage.render import compare_forces
    from flexcage.render.sheet import label

    out = Path(out)
    out.mkdir(parents=True, exist_ok=True)
    summaries = {name: run.summary for name, run in runs.items()}
    table = side_by_side(summaries)
    settle = max(run.case.output.settle for run in runs.values())
    compare_forces(
        dict(zip(_tails(list(runs)), (run.dataset for run in runs.values()))),
        out / "forces.png", settle=settle,
        note=" and ".join(dict.fromkeys(label(run.case.name) for run in runs.values())),
    )  # fmt: skip
    (out / "compare.txt").write_text(table + "\n", encoding="utf-8")
    record = {name: summary.to_dict() for name, summary in summaries.items()}
    (out / "compare.json").write_text(json.dumps(record, indent=2), encoding="utf-8")
    return table


def _tails(names: list[str]) -> list[str]:
    """Names of folders without the folders that they all lie in."""
    parts, common = [Path(name).parts for name in names], 0
    while all(len(p) > common + 1 for p in parts) and len({p[common] for p in parts}) == 1:
        common += 1
    return [str(Path(*p[common:])) for p in parts]


def compare(first: str | Path, second: str | Path, *, out: str | Path) -> str:
    """Compare two stored runs, named by their folders."""
    names = [str(Path(path)) for path in (first, second)]
    return compare_runs({name: load_run(name) for name in names}, out=out)


def compare_case(case: Case, *, out: str | Path, progress: Any = None) -> str:
    """Run one case with a rigid and with a flexible cage, and compare them."""
    out = Path(out)
    cases = {model: case.replace("cage.model", model) for model in ("rigid", "flexible")}
    with told_at_once(cases.values()):
        runs = {
            model: simulate(each, out=out / model, progress=progress)
            for model, each in cases.items()
        }
    return compare_runs(runs, out=out)
