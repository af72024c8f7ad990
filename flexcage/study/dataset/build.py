"""From a study or a map to a data set: a recording of each case, tables and cards."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from io import BytesIO
from pathlib import Path
from typing import Any

from flexcage.core.binding import path_of
from flexcage.core.errors import InputError
from flexcage.core.output_folders import check_no_file
from flexcage.study.cluster import require_packages
from flexcage.study.dataset import card, labels
from flexcage.study.dataset.folder import DatasetFolder, Settings
from flexcage.study.dataset.gathering import take_recordings
from flexcage.study.dataset.keeping import RecordingKeeper
from flexcage.study.dataset.recording import parquet
from flexcage.study.dataset.splits import splits_of
from flexcage.study.desk import Crew
from flexcage.study.folder import Folder
from flexcage.study.maps import SAMPLE, Map, keep_map, load_map
from flexcage.study.plan import Planned, make_plan
from flexcage.study.results import StudyResults
from flexcage.study.run import check_physics, run_plan
from flexcage.study.spec import Study, load_study, read_file


def build_dataset(
    source: str | Path,
    out: str | Path,
    *,
    settings: Settings | None = None,
    overrides: dict[str, Any] | None = None,
    workers: int | None = None,
    other_version: bool = False,
    progress: Callable[..., Any] | None = None,
) -> DatasetFolder:
    """Make or go on with the data set in the folder ``out`` of a study or a map, by its file.

    Each case is recorded by its worker as soon as it is finished; its figures stay in
    ``out``/study, and its run as well where the file says ``keep = "runs"``. Recordings that are
    there are kept, also those of other studies, and not computed again. ``workers``,
    ``other_version`` and ``progress`` are those of ``run_study``. Raises InputError for a study
    without sensors or without cases, for a class none of whose cases finished, for a folder of
    other files or settings and, unless ``other_version``, for cases of other physics.
    """
    require_packages()
    asked, folder = asked_of(source, settings, overrides), DatasetFolder(out)
    check_no_file(folder.path)
    with folder.held():
        kept = folder.prepare(asked.settings)
        plan, study = make_plan(asked.study), Folder(folder.study.resolve())
        check_physics(plan, study, allowed=other_version)
        study.prepare(plan)
        if asked.map is not None:
            keep_map(asked.map, plan, study)
        take_recordings(folder, {c.hash for c in plan.cases}, mixed=other_version)
        keeper = keeper_of(folder.path, folder.name, kept)
        results = run_plan(plan, study, Crew(workers, keeper=keeper), progress=progress)
        check_classes(results, folder)
        write_index(folder, kept)
    return folder


@dataclass(frozen=True)
class Asked:
    """The study of which a data set is made, the map that it is of, if it is, and settings."""

    study: Study
    settings: Settings
    map: Map | None = None


def asked_of(
    source: str | Path, settings: Settings | None, overrides: dict[str, Any] | None
) -> Asked:
    """What is asked for by the file of a study or a map, checked.

    Runs stay only where the file itself says so: a study alone would keep them.
    """
    path = path_of(source, "study")
    table = read_file(path)
    is_map = "unknowns" in table
    spec: Any = (load_map if is_map else load_study)(path, overrides=overrides)
    study: Study = spec.study() if is_map else spec
    if not study.case.sensors:
        raise InputError(
            f"The base case of '{path}' has no sensors; give it [[sensors]], as in "
            "examples/signals.md.",
            where="sensors",
        )
    study = replace(study, keep=table.get("keep", "figures"))
    return Asked(study, _checked(settings or Settings()), spec if is_map else None)


def keeper_of(folder: Path, name: str, settings: Settings) -> Callable[[Planned], RecordingKeeper]:
    """What a worker keeps of each case in the data set ``folder`` called ``name``."""
    where = str(folder.resolve())
    return lambda planned: RecordingKeeper(where, name, settings.edges, planned)


def _checked(settings: Settings) -> Settings:
    edges = settings.edges
    if any(not 0.0 < edge < 1.0 for edge in edges) or list(edges) != sorted(set(edges)):
        words = ", ".join(f"{1e3 * edge:g} mm" for edge in edges)
        raise InputError(
            f"The edges of severities are {words}, but should be rising sizes above 0 mm.",
            where="severity",
        )
    return settings


def check_classes(results: StudyResults, folder: DatasetFolder) -> None:
    """InputError for the first label of the study none of whose cases is recorded."""
    done: dict[tuple[str, str], int] = {}
    reasons: dict[tuple[str, str], str] = {}
    recorded = [folder.has(row.planned.hash) for row in results.rows]
    for row, has in zip(results.rows, recorded):
        for column, label in row.planned.point.labels.items():
            if column != SAMPLE:
                done[column, label] = done.get((column, label), 0) + has
                reasons.setdefault((column, label), row.reason)
    for (column, label), count in done.items():
        if not count:
            raise InputError(
                f"The class '{label}' ({column}) has no finished case: {reasons[column, label]}; "
                "mend it, or leave it out.",
                where=column,
                value=label,
            )
    if not any(recorded):
        raise InputError(f"No case of the study finished: {results.rows[0].reason}.", where="study")


def write_index(folder: DatasetFolder, settings: Settings, *, whole: bool = True) -> None:
    """Tables and cards of all recordings of a folder. InputError for a class of severity without
    recordings, if these are the ``whole`` data set."""
    records = folder.records()
    rows = [row for record in records for row in record["rows"]]
    truth = [record["truth"] for record in records]
    if whole:
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
