"""What the report of a study shows, read from its folder."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from flexcage.core.units import typeset
from flexcage.report.blocks import Image, PageTable
from flexcage.report.page import PageTooLarge, write_page
from flexcage.report.study_page import StudyAccount, study_page
from flexcage.study.axes import Grid, Points, Zip
from flexcage.study.page_stress import Shown, common_scale, stress_images, stress_of, to_show
from flexcage.study.page_tables import (
    abscissas,
    audit_table,
    cases_table,
    first_rows,
    outputs,
    point_names,
    statistics_table,
)
from flexcage.study.words import in_words

if TYPE_CHECKING:
    from flexcage.study.record import StudyRecord

_MOST_FAILURES = 20  # reasons written out


def write_study_page(
    results: StudyRecord,
    path: str | Path,
    *,
    points: Sequence[int] | None = None,
    progress: Callable[..., Any] | None = None,
) -> Path:
    """Write the report of a study; ``points`` are those whose stress is shown (default: six)."""
    shown, chosen = to_show(results, points)
    cages, lacking = stress_of(results, shown, progress)
    chosen = " ".join(filter(None, [results.without_stress(), lacking or chosen]))
    with TemporaryDirectory() as folder:
        images, why = stress_images(cages, Path(folder))
        notes = [chosen, why]
        while True:
            kept = images[: len(cages)] if images else []
            account = _account(results, cages, kept, " ".join(filter(None, notes)))
            try:
                return write_page(study_page(account), path)
            except PageTooLarge:
                if not cages:
                    raise
                cages = cages[: len(cages) // 2]
                notes = [chosen, why, f"Only the first {len(cages)} fitted into the page."]


def _account(
    results: StudyRecord, cages: list[Shown], images: list[Image], chosen: str
) -> StudyAccount:
    study, folder = results.about, results.folder.path
    return StudyAccount(
        name=study.name,
        folder=folder,
        status=results.status(),
        varied=_varied(results),
        named=[_named(axis) for axis in study.axes if _has_names(axis)],
        base=list(study.in_words),
        statistics=statistics_table(results),
        cases=cases_table(results),
        audits=audit_table(results),
        outputs=outputs(results),
        abscissas=abscissas(results),
        points=point_names(results),
        failures=_warnings(results),
        stress=[shown.cage for shown in cages],
        scale=common_scale(cages),
        images=images,
        chosen=chosen,
        assumptions=study.assumptions,
        study_text=study.text,
        commands="flexcage study run study.toml -o runs/again\nflexcage report runs/again",
    )


def _varied(results: StudyRecord) -> list[str]:
    study, count = results.about, len(first_rows(results))
    paths = [path for axis in study.axes for path in axis.paths]

    def named(path: str) -> str:
        return f"{in_words(path, study.base, paths)} ({path})"

    lines = [_axis_in_words(axis, named) for axis in study.axes]
    times = study.repeat.count
    many = f"{count} points" if count != 1 else "One point"
    total = f"{many}, every combination of these." if len(study.axes) > 1 else f"{many}."
    if times > 1:
        total += (
            f" Each was computed {times} times, the cage started at "
            f"{typeset(study.repeat.push, 'mm/s')} in another random direction: means and "
            "intervals are over these repetitions."
        )
    return [*lines, total]


def _axis_in_words(axis: Any, named: Callable[[str], str]) -> str:
    """What an axis varies; ``named`` gives a path in words."""
    if isinstance(axis, Grid):
        return f"{named(axis.path)}: {', '.join(map(str, axis.values))}."
    if isinstance(axis, Zip):
        parts = (f"{named(p)}: {', '.join(map(str, values))}" for p, values in axis.values.items())
        return f"Together {'; '.join(parts)}."
    if _has_names(axis):
        return f"{axis.name}: {', '.join(str(point['label']) for point in axis.points)}."
    if isinstance(axis, Points):
        return f"Cases: {'; '.join(str(point) for point in axis.expand())}."
    parts = (f"{named(path)} from {low} to {high}" for path, (low, high) in axis.ranges.items())
    kind = {"lhs": "a Latin hypercube", "sobol": "a Sobol sequence"}.get(axis.type, axis.type)
    return f"{axis.count} points of {kind} in {'; '.join(parts)}."


def _has_names(axis: Any) -> bool:
    return isinstance(axis, Points) and all("label" in point for point in axis.points)


def _named(axis: Any) -> PageTable:
    """A row for every point of an axis: its name, and what it changes in the base case."""
    rows = [[str(p["label"]), "; ".join(_changes(p)) or "nothing"] for p in axis.points]
    return PageTable((axis.name, "changes"), rows)


def _changes(point: Mapping[str, Any]) -> Iterator[str]:
    for path, value in point.items():
        if path == "defects":
            yield from map(_change, value)
        elif path != "label":
            yield f"{path} {value}"


def _change(defect: Mapping[str, Any]) -> str:
    rest = (f"{k} {v}" for k, v in defect.items() if k != "type")
    return f"{str(defect['type']).replace('_', ' ')}: {', '.join(rest)}"


def _warnings(results: StudyRecord) -> list[str]:
    names = point_names(results)
    lines = [
        f"Point {r.planned.number}, repetition {r.planned.repetition} "
        f"({names[r.planned.number]}) failed: {r.reason}"
        for r in results.rows
        if r.state == "failed"
    ]
    if len(lines) > _MOST_FAILURES:
        more = len(lines) - _MOST_FAILURES
        lines = [*lines[:_MOST_FAILURES], f"{more} more failed; the table of cases has them all."]
    if results.count("open"):
        lines.append(
            f"{results.count('open')} of {len(results.rows)} cases are not computed yet; 'flexcage "
            "study resume' computes them."
        )
    return [*lines, *results.warning_lines()]
