"""Two runs compared: their figures, a picture of their cage forces, and a page of both."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from flexcage.case import Case, description
from flexcage.core.binding import path_of
from flexcage.core.errors import InputError
from flexcage.core.listing import PAGE
from flexcage.core.writing import replace
from flexcage.results.compared import Comparison
from flexcage.run import Run
from flexcage.run.foreseen import reported_at_once
from flexcage.simulate import load_run, simulate

MODELS = ("rigid", "flexible")


def compare_runs(runs: dict[str, Run], *, out: str | Path | None = None) -> Comparison:
    """Two runs compared by their names. Into the folder ``out``, if given, go ``compare.txt`` (all
    figures), ``compare.json``, ``forces.png`` and ``report.html``, which shows them all."""
    first, second = runs.values()
    found = Comparison(
        {name: run.summary for name, run in runs.items()}, first.case.difference(second.case)
    )
    if out is not None:
        _write(found, runs, path_of(out, "out"))
    return found


def compare(first: str | Path, second: str | Path, *, out: str | Path | None = None) -> Comparison:
    """Compare two stored runs, named by their folders, as ``compare_runs``."""
    if path_of(first, "first").resolve() == path_of(second, "second").resolve():
        raise InputError(
            f"compare was given the run '{first}' twice; name two runs.", where="compare"
        )
    runs = [load_run(path) for path in (first, second)]
    return compare_runs(dict(zip(short_names(first, second), runs)), out=out)


def compare_case(
    case: Case, *, out: str | Path | None = None, progress: Callable[..., Any] | None = None
) -> Comparison:
    """Run one case with a rigid and with a flexible cage, and compare them as ``compare_runs``;
    the runs go into ``out`` too."""
    case.its_cage  # noqa: B018  (says so where there is none)
    cases = {model: case.replace("cage.model", model) for model in MODELS}
    with reported_at_once(cases.values()):
        runs = {
            model: simulate(
                each, out=path_of(out, "out") / model if out else None, progress=progress
            )
            for model, each in cases.items()
        }
    return compare_runs(runs, out=out)


def short_names(first: str | Path, second: str | Path) -> tuple[str, str]:
    """Names of two folders without the folders that both lie in."""
    parts, common = [Path(first).resolve().parts, Path(second).resolve().parts], 0
    while all(len(p) > common + 1 for p in parts) and len({p[common] for p in parts}) == 1:
        common += 1
    one, other = (str(Path(*p[common:])) for p in parts)
    return one, other


def _write(found: Comparison, runs: dict[str, Run], out: Path) -> None:
    from flexcage.render import compare_forces
    from flexcage.render.sheet import label
    from flexcage.report.comparison_page import comparison_page
    from flexcage.report.page import write_page

    out.mkdir(parents=True, exist_ok=True)
    replace(out / "compare.txt", (found.text(every=True, width=PAGE) + "\n").encode())
    replace(out / "compare.json", (found.to_json() + "\n").encode())
    cases = [run.case for run in runs.values()]
    title = " and ".join(dict.fromkeys(case.name for case in cases))
    pictures = [
        compare_forces(
            {name: run.dataset for name, run in runs.items()}, out / "forces.png",
            settle=max(case.output.settle for case in cases), note=label(title),
        )
    ] if all(case.cage for case in cases) else []  # fmt: skip
    page = comparison_page(
        found,
        {name: description.in_words(run.case) for name, run in runs.items()},
        {name: run.case.to_toml() for name, run in runs.items()},
        pictures,
        title=title,
    )
    write_page(page, out / "report.html")
