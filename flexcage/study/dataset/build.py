"""From a study or a map to a data set: its runs, a recording of each, tables and cards."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from io import BytesIO
from pathlib import Path
from typing import Any

from flexcage.core.binding import path_of
from flexcage.core.errors import InputError
from flexcage.core.output_folders import check_no_file
from flexcage.core.progress import Silent
from flexcage.simulate import load_run
from flexcage.study.dataset import card, labels
from flexcage.study.dataset.folder import DatasetFolder, Settings
from flexcage.study.dataset.recording import parquet, recording_of
from flexcage.study.dataset.splits import splits_of
from flexcage.study.maps import SAMPLE, load_map, run_map
from flexcage.study.results import StudyResults
from flexcage.study.run import run_study
from flexcage.study.spec import Study, load_study, read_file


def build_dataset(
    source: str | Path,
    out: str | Path,
    *,
    settings: Settings | None = None,
    overrides: dict[str, Any] | None = None,
    workers: int | None = None,
    progress: Callable[..., Any] | None = None,
) -> DatasetFolder:
    """Make or go on with the data set in the folder ``out`` of a study or a map, by its file; its
    runs are computed in ``out``/study.

    Recordings that are there are kept, and those of other studies as well. Raises InputError for a
    study without sensors or without runs, for a class none of whose cases finished, and for a
    folder of other files or settings.
    """
    path, folder = path_of(source, "study"), DatasetFolder(out)
    is_map = "unknowns" in read_file(path)
    spec: Any = (load_map if is_map else load_study)(path, overrides=overrides)
    study: Study = spec.study() if is_map else spec
    _check(study, path)
    wanted = _checked(settings or Settings())
    check_no_file(folder.path)
    with folder.held():
        kept = folder.prepare(wanted)
        run = run_map if is_map else run_study
        run(spec, out=folder.study, workers=workers, progress=progress)
        results = StudyResults(folder.study)
        _check_classes(results)
        _record(results, folder, kept, progress)
        write_index(folder, kept)
    return folder


def _check(study: Study, path: Path) -> None:
    if not study.case.sensors:
        raise InputError(
            f"The base case of '{path}' has no sensors; give it [[sensors]], as in "
            "examples/signals.md.",
            where="sensors",
        )
    if study.keep != "runs":
        raise InputError(
            f"'{path}' keeps figures alone (keep = \"figures\"), and signals come from runs; take "
            'keep = "runs".',
            where="keep",
        )


def _checked(settings: Settings) -> Settings:
    edges = settings.edges
    if any(not 0.0 < edge < 1.0 for edge in edges) or list(edges) != sorted(set(edges)):
        words = ", ".join(f"{1e3 * edge:g} mm" for edge in edges)
        raise InputError(
            f"The edges of severities are {words}, but should be rising sizes above 0 mm.",
            where="severity",
        )
    return settings


def _check_classes(results: StudyResults) -> None:
    """InputError for the first label of the study none of whose cases finished."""
    done: dict[tuple[str, str], int] = {}
    reasons: dict[tuple[str, str], str] = {}
    for row in results.rows:
        for column, label in row.planned.point.labels.items():
            if column != SAMPLE:
                done[column, label] = done.get((column, label), 0) + (row.state == "done")
                reasons.setdefault((column, label), row.reason)
    for (column, label), count in done.items():
        if not count:
            raise InputError(
                f"The class '{label}' ({column}) has no finished case: {reasons[column, label]}; "
                "mend it, or leave it out.",
                where=column,
                value=label,
            )
    if not any(row.state == "done" for row in results.rows):
        raise InputError(f"No case of the study finished: {results.rows[0].reason}.", where="study")


def _record(
    results: StudyResults, folder: DatasetFolder, settings: Settings, progress: Any
) -> None:
    """Add the recordings that the folder lacks."""
    todo = [r.planned for r in results.rows if r.state == "done" and not folder.has(r.planned.hash)]
    with (progress or Silent)(len(todo), "recordings") as bar:
        for planned in todo:
            run = load_run(results.folder.case(planned.hash))
            row = results.stored[planned.hash]
            made = recording_of(run, planned, row, folder.name, settings.edges)
            folder.add(planned.hash, made)
            bar.advance()


def write_index(folder: DatasetFolder, settings: Settings) -> None:
    """Tables and cards of all recordings of a folder, which then has all that it should.
    InputError for a class of severity without recordings."""
    records = folder.records()
    rows = [row for record in records for row in record["rows"]]
    truth = [record["truth"] for record in records]
    _check_severities(rows, settings.edges)
    splits = splits_of(truth)
    tables = {
        "metadata.parquet": _table(rows), "truth.parquet": _table(truth),
        "splits.parquet": _table(splits),
    }  # fmt: skip
    folder.write_index({
        **tables, "manifest.json": card.manifest(folder.name, rows, settings),
        "README.md": card.readme(folder.name, rows, truth, splits, settings),
        "croissant.json": card.croissant(folder.name, rows, tables, settings),
    })  # fmt: skip


def _check_severities(rows: Sequence[dict[str, Any]], edges: Sequence[float]) -> None:
    count = Counter(row["fault_severity"] for row in rows)
    for level in range(1, len(edges) + 2) if edges else ():
        if not count[labels.severity_words(level, edges)]:
            raise InputError(
                f"The severity '{labels.severity_words(level, edges)}' has no recording; give "
                "other edges (--severity), or cases of that size.",
                where="severity",
            )


def _table(rows: Sequence[dict[str, Any]]) -> bytes:
    """Rows as a Parquet file; what a row lacks is null. Columns in the order of the first row."""
    import pyarrow as pa

    names = list(dict.fromkeys(name for row in rows for name in row))
    return parquet(pa.table({name: [row.get(name) for row in rows] for name in names}))


def read_table(folder: DatasetFolder, name: str) -> list[dict[str, Any]]:
    """Rows of a table of a data set."""
    import pyarrow.parquet as pq

    content = (folder.path / name).read_bytes()
    rows: list[dict[str, Any]] = pq.read_table(BytesIO(content)).to_pylist()
    return rows
