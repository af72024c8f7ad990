"""A study in shards: its plan written beforehand, one shard computed, all merged."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from flexcage.core.binding import expect, path_of
from flexcage.core.errors import InputError
from flexcage.study.cluster import default_workers, require_packages
from flexcage.study.desk import Crew
from flexcage.study.folder import Folder
from flexcage.study.plan import Plan, make_plan, modes_key
from flexcage.study.results import StudyResults
from flexcage.study.run import compute, take_shards
from flexcage.study.shards import Shard, check_shards, missing, shard_folder, shard_of
from flexcage.study.spec import Study


@dataclass(frozen=True)
class ShardState:
    """What became of a shard: its folder, and how many of its cases are done, failed and open."""

    shard: Shard
    folder: Path
    done: int
    failed: int
    open: int

    def __str__(self) -> str:
        total = self.done + self.failed + self.open
        return (
            f"Shard {self.shard}: {self.done} of {total} cases done, {self.failed} failed, "
            f"{self.open} open"
        )


def plan_study(study: Study, *, out: str | Path) -> Plan:
    """Check all cases of a study and write its plan into the folder ``out``; nothing is computed.

    Shards that begin there then take it, instead of building all cases again. Raises InputError for
    a mistake in the plan.
    """
    expect(study, Study, "study", "flexcage.load_study reads one from a file")
    plan = make_plan(study)
    Folder(path_of(out, "out").resolve()).prepare(plan)
    return plan


def run_shard(
    study: Study,
    *,
    out: str | Path,
    shard: str,
    workers: int | None = None,
    retry: bool = False,
    progress: Callable[..., Any] | None = None,
) -> ShardState:
    """Compute what a ``shard`` ("3/10": the third of ten disjoint parts) lacks of a study, in
    ``out``/shards/3-of-10.

    One worker (the default where this process may use one core) is this process itself. Cases that
    the shard or the study's own folder has are not computed again. Any number of shards may run at
    once, here or on other machines, each once; ``merge_study`` gathers them. Errors as
    ``run_study``.
    """
    expect(study, Study, "study", "flexcage.load_study reads one from a file")
    main = Folder(path_of(out, "out").resolve())
    number = shard_of(shard)
    part = begin_shard(study, main, number)
    folder = Folder(shard_folder(main.path, number))
    compute_shard(part, folder, main, Crew(workers, retry=retry), progress)
    return state_of(part, folder, main, number)


def begin_shard(study: Study, main: Folder, shard: Shard) -> Plan:
    """The shard's part of the plan, which the study's folder then has."""
    stored = main.planned_by_this(study)
    whole = Plan(study, stored) if stored else make_plan(study)
    if len(whole.cases) < shard.count:
        raise InputError(
            f"The study has {len(whole.cases)} cases, fewer than {shard.count} shards; take at "
            "most as many shards as cases.",
            where="shard",
            value=str(shard),
        )
    if not stored:
        main.begin_shards(whole)
    cases = shard.part(whole.cases)
    if not stored:
        return Plan(study, cases)
    return Plan(study, tuple(replace(c, modes=modes_key(whole.case(c))) for c in cases))


def compute_shard(
    part: Plan, folder: Folder, main: Folder, crew: Crew, progress: Callable[..., Any] | None
) -> None:
    """Compute what a shard's folder, and the study's own, lack of its part of the plan."""
    alone = (crew.workers or default_workers()) == 1
    if not alone:
        require_packages()

    def elsewhere(name: str) -> bool:
        if crew.elsewhere is not None and crew.elsewhere(name):
            return True
        failed = not crew.retry and main.failure(name) is not None
        return failed or (crew.keeper is None and main.row(name) is not None)

    with folder.held():
        folder.make()
        compute(part, folder, replace(crew, alone=alone, elsewhere=elsewhere), progress)


def state_of(
    part: Plan, folder: Folder, main: Folder, shard: Shard, has: Callable[[str], bool] | None = None
) -> ShardState:
    """How far a shard is, by its own folder and the study's. A case whose hash a data set ``has``
    is done as well."""
    both, names = (folder, main), {c.hash for c in part.cases}
    done = {n for n in names if any(f.row(n) for f in both) or (has is not None and has(n))}
    failed = {n for n in names - done if any(f.failure(n) for f in both)}
    left = len(names) - len(done) - len(failed)
    return ShardState(shard, folder.path, len(done), len(failed), left)


def merge_study(
    out: str | Path, *, other_version: bool = False
) -> tuple[StudyResults, list[Shard]]:
    """Gather what shards have computed of the study in the folder ``out``, and its tables; with the
    shards that are missing or not complete. Nothing is computed.

    Raises InputError for a folder without shards or with those of different counts, for a shard
    that is being computed, for a case that two have with other figures and, unless
    ``other_version``, for cases of different physics.
    """
    folder = Folder(path_of(out, "out").resolve())
    shards = check_shards(folder.path)
    check_planned(folder)
    with folder.held():
        take_shards(folder.about()[1], folder, other_version=other_version)
        results = StudyResults(folder.path)
        results.write()
    return results, missing_of(results, next(iter(shards)).count)


def check_planned(folder: Folder) -> None:
    """InputError for shards that were brought to a folder without the study's plan."""
    if not (folder.path / "plan.json").is_file():
        raise InputError(
            f"'{folder.path}' holds shards and no plan of their study; bring its plan.json and "
            "study.toml as well, or 'flexcage study run STUDY' there, which takes the shards over "
            "and computes what they lack.",
            where="shards",
            value=str(folder.path),
        )


def missing_of(
    results: StudyResults, count: int, has: Callable[[str], bool] | None = None
) -> list[Shard]:
    """Shards, of ``count``, that own cases which are neither done nor failed, nor of a hash that
    the data set ``has``."""
    lacking = {row.planned.hash for row in results.rows if row.state == "open"}
    lacking = {name for name in lacking if has is None or not has(name)}
    return missing(results.planned, lacking, count)
