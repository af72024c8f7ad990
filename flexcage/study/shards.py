"""Shards: disjoint parts of a study's cases that processes compute without knowing of each other.

Each has a folder of its own, ``shards/<i>-of-<n>/`` in that of the study: so no two machines write
to one folder, nothing rests on the locks of a disk that they share, and shards may be computed on
disks that know nothing of each other. ``gather`` moves what they have computed to the study.
"""

from __future__ import annotations

import os
import shutil
from collections.abc import Collection, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

from flexcage.core.errors import InputError
from flexcage.core.writing import sync
from flexcage.results.figures.effort import is_wall_time
from flexcage.study.case_row import CaseRow
from flexcage.study.folder import SHARDS, Folder
from flexcage.study.plan import Planned

_BETWEEN = "-of-"
_NOTHING = ("zarr.json", "settings.json")  # files that say nothing of any case
_NAMED = 6  # missing shards that a sentence names


@dataclass(frozen=True)
class Shard:
    """The ``index``-th of ``count`` parts, from 1."""

    index: int
    count: int

    def __str__(self) -> str:
        return f"{self.index}/{self.count}"

    @property
    def name(self) -> str:
        """Of its folder."""
        return f"{self.index}{_BETWEEN}{self.count}"

    def part(self, cases: Sequence[Planned]) -> tuple[Planned, ...]:
        """Its own of all cases of a plan, in the plan's order."""
        numbers = dealt(cases, self.count)
        return tuple(c for c, number in zip(cases, numbers) if number == self.index)


def shard_of(text: str) -> Shard:
    """The shard that "3/10" names."""
    index, _, count = text.partition("/")
    if index.isdecimal() and count.isdecimal() and 1 <= int(index) <= int(count):
        return Shard(int(index), int(count))
    raise InputError(
        f"The shard is '{text}', but should be I/N, the I-th of N parts from 1 on, as 3/10.",
        where="shard",
        value=text,
    )


def dealt(cases: Sequence[Planned], count: int) -> list[int]:
    """Number of the shard, from 1, of every case.

    Cases are dealt round by kind, and within a kind in the order of their hashes: shards have
    equally many but for one, and of every kind as well.
    """
    kinds = _kinds(cases, len(cases) // count)
    order = sorted(range(len(cases)), key=lambda k: (kinds[k], cases[k].hash))
    found = [0] * len(cases)
    for place, k in enumerate(order):
        found[k] = place % count + 1
    return found


def _kinds(cases: Sequence[Planned], most: int) -> list[tuple[str, ...]]:
    """The kind of every case: labels and values, those that vary least first, as long as there are
    at most so many kinds."""
    points = [{**case.point.labels, **case.point.values} for case in cases]
    names = dict.fromkeys(name for point in points for name in point)
    columns = [[str(point.get(name)) for point in points] for name in names]
    kinds: list[tuple[str, ...]] = [()] * len(cases)
    for column in sorted(columns, key=lambda values: len(set(values))):
        finer = [(*kind, value) for kind, value in zip(kinds, column)]
        if len(set(finer)) > most:
            break
        kinds = finer
    return kinds


def shard_folder(study: Path, shard: Shard) -> Path:
    """Where a shard of the study or data set in the folder ``study`` is."""
    return study / SHARDS / shard.name


def shards_in(study: Path) -> dict[Shard, Path]:
    """Folders of the shards that are there; InputError for shards of different counts."""
    found = {}
    for path in sorted((study / SHARDS).glob(f"*{_BETWEEN}*")):
        index, _, count = path.name.partition(_BETWEEN)
        if index.isdecimal() and count.isdecimal() and path.is_dir() and not path.is_symlink():
            found[Shard(int(index), int(count))] = path
    counts = sorted({shard.count for shard in found})
    if len(counts) > 1:
        raise InputError(
            f"'{study / SHARDS}' holds shards of {counts[0]} and of {counts[1]} parts; remove "
            "those of one.",
            where="shards",
        )
    return dict(sorted(found.items(), key=lambda item: item[0].index))


def check_shards(study: Path) -> dict[Shard, Path]:
    """The same; InputError if there are none."""
    found = shards_in(study)
    if not found:
        raise InputError(
            f"'{study}' holds no shards to merge; 'flexcage study run STUDY -o {study} --shard "
            "1/N' computes one, and 'flexcage dataset' likewise.",
            where="shards",
            value=str(study),
        )
    return found


def gather(
    into: Folder, shards: Iterable[Folder], wanted: set[str], *, mixed: bool = False
) -> None:
    """Move the finished cases of shards to their study, those of ``wanted`` hashes, and the reasons
    of those that failed. Killed at any moment, it can be called again.

    Raises InputError for a shard that is being computed, for a case that is there with other
    figures and, unless ``mixed``, for cases of different physics.
    """
    into.make()
    first = None if mixed else _first_row(into)
    for shard in shards:
        with shard.held():
            _take_cages(shard, into)
            for name in wanted.intersection(shard.finished()):
                row = shard.row(name)
                if row is not None:
                    first = first or (None if mixed else row)
                    _check_physics(row, first, shard.path)
                    _take(row, shard, into)
            for name in wanted.intersection(shard.failures()):
                if into.row(name) is None:
                    os.replace(shard.reason(name), into.reason(name))
                else:  # it was tried again elsewhere
                    shard.reason(name).unlink()
        sync(into.cases)


def _first_row(folder: Folder) -> CaseRow | None:
    name = next(folder.finished(), None)
    return folder.row(name) if name else None


def _check_physics(row: CaseRow, first: CaseRow | None, folder: Path) -> None:
    if first is not None and row.origin.physics != first.origin.physics:
        raise InputError(
            f"'{folder}' was computed by flexcage {row.origin}, and other cases by "
            f"{first.origin}; compute it anew with the same, or add --other-version, which table "
            "and page then say.",
            where="shards",
            value=row.origin.physics,
        )


def _take(row: CaseRow, shard: Folder, into: Folder) -> None:
    """Move a finished case to the study, unless it is there already with the same figures."""
    there = into.row(row.hash)
    if there is None:
        os.rename(shard.case(row.hash), into.case(row.hash))
        into.reason(row.hash).unlink(missing_ok=True)
        return
    if _figures(row) != _figures(there):
        raise InputError(
            f"Case {row.hash} is in '{shard.path}' and in '{into.path}' with other figures; remove "
            "it from one of them.",
            where="shards",
            value=row.hash,
        )
    shutil.rmtree(shard.case(row.hash))


def _figures(row: CaseRow) -> dict[str, object]:
    return {k: f.value for k, f in row.figures.items() if not is_wall_time(k)}


def _take_cages(shard: Folder, into: Folder) -> None:
    """Move the files of cages that kept runs share."""
    for file in sorted((shard.path / "cages").glob("*.zip")):
        (into.path / "cages").mkdir(exist_ok=True)
        os.replace(file, into.path / "cages" / file.name)  # named by its content


def missing(cases: Sequence[Planned], lacking: Collection[str], count: int) -> list[Shard]:
    """Shards, of ``count``, that own any of the cases whose hashes are ``lacking``."""
    numbers = zip(cases, dealt(cases, count))
    return [Shard(k, count) for k in sorted({n for case, n in numbers if case.hash in lacking})]


def missing_words(shards: Sequence[Shard], command: str) -> str:
    """A sentence that names missing shards, and what computes them; nothing for none."""
    if not shards:
        return ""
    names = ", ".join(str(shard.index) for shard in shards[:_NAMED])
    more = f" and {len(shards) - _NAMED} more" if len(shards) > _NAMED else ""
    what = f"shard{'s' * (len(shards) > 1)} {names}{more} of {shards[0].count}"
    return f"Missing: {what}; compute it with '{command} --shard {shards[0]}', or bring its folder."


def unmerged_words(study: Path) -> str:
    """A sentence on what shards hold that is not merged; nothing for nothing."""
    shards = shards_in(study)
    found = [{*folder.finished(), *folder.failures()} for folder in map(Folder, shards.values())]
    if not any(found):
        return ""
    cases, held = sum(map(len, found)), sum(map(bool, found))
    count = next(iter(shards)).count
    return (
        f"Not merged: {cases} case{'s' * (cases > 1)} in {held} of {count} shards; 'flexcage study "
        f"merge {study}' gathers them."
    )


def remove_empty(study: Path, shards: Iterable[Path]) -> None:
    """Remove the folders of shards in which nothing is left."""
    for path in shards:
        if not any(p.is_file() and p.name not in _NOTHING for p in path.rglob("*")):
            shutil.rmtree(path)
    folder = study / SHARDS
    if folder.is_dir() and not any(folder.iterdir()):
        folder.rmdir()
