"""A data set in shards: one made, all merged."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any

from flexcage.study.dataset.build import asked_of, check_classes, keeper_of, write_index
from flexcage.study.dataset.folder import DatasetFolder, Settings
from flexcage.study.dataset.gathering import take_recordings
from flexcage.study.desk import Crew
from flexcage.study.folder import Folder
from flexcage.study.plan import Plan, make_plan
from flexcage.study.results import StudyResults
from flexcage.study.sharded import (
    ShardState,
    begin_shard,
    check_planned,
    compute_shard,
    missing_of,
    state_of,
)
from flexcage.study.shards import Shard, check_shards, shard_folder, shard_of


def plan_dataset(
    source: str | Path,
    out: str | Path,
    *,
    settings: Settings | None = None,
    overrides: dict[str, Any] | None = None,
) -> Plan:
    """Check all cases of a data set and write its settings and its plan; nothing is computed.

    Shards that begin there then take both. Arguments and errors as ``build_dataset``.
    """
    asked, folder = asked_of(source, settings, overrides), DatasetFolder(out)
    plan = make_plan(asked.study)
    folder.prepare(asked.settings)
    Folder(folder.study.resolve()).prepare(plan)
    return plan


def build_shard(
    source: str | Path,
    out: str | Path,
    shard: str,
    *,
    settings: Settings | None = None,
    overrides: dict[str, Any] | None = None,
    workers: int | None = None,
    progress: Callable[..., Any] | None = None,
) -> ShardState:
    """Make what a ``shard`` ("3/10": the third of ten disjoint parts) lacks of a data set, in
    ``out``/shards/3-of-10; ``merge_dataset`` gathers the shards.

    Arguments and errors as ``build_dataset`` and ``study.run_shard``; a class without cases is
    refused when all are merged.
    """
    asked, number = asked_of(source, settings, overrides), shard_of(shard)
    whole = DatasetFolder(out)
    kept = whole.prepare(asked.settings)
    main = Folder(whole.study.resolve())
    part = begin_shard(asked.study, main, number)
    own = DatasetFolder(shard_folder(whole.path, number))
    keeper = keeper_of(own.path, whole.name, kept)
    with own.held():
        own.prepare(kept)
        crew = Crew(workers, keeper=keeper, elsewhere=whole.has)
        compute_shard(part, Folder(own.study.resolve()), main, crew, progress)
        folder = Folder(own.study.resolve())
        return state_of(part, folder, main, number, lambda n: own.has(n) or whole.has(n))


def merge_dataset(
    out: str | Path, *, other_version: bool = False
) -> tuple[DatasetFolder, list[Shard]]:
    """Gather what shards have made of the data set in the folder ``out``, with tables and cards;
    and the shards that are missing or not complete. Nothing is computed.

    Raises InputError as ``study.merge_study``, and for a class without cases where no shard is
    missing.
    """
    folder = DatasetFolder(out)
    count = next(iter(check_shards(folder.path))).count
    study = Folder(folder.study.resolve())
    check_planned(study)
    with folder.held():
        kept = folder.prepare(folder.settings())
        names = {case.hash for case in study.about()[1]}
        take_recordings(folder, names, mixed=other_version)
        results = StudyResults(study.path)
        results.write()
        lacking = missing_of(results, count, folder.has)
        if not lacking:
            check_classes(results, folder)
        write_index(folder, kept, whole=not lacking)
    return folder, lacking
