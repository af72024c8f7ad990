"""Recordings that shards have made, moved to their data set."""

from __future__ import annotations

import os

from flexcage.core.errors import InputError
from flexcage.study.dataset.folder import DatasetFolder
from flexcage.study.folder import Folder
from flexcage.study.shards import gather, remove_empty, shards_in


def take_recordings(folder: DatasetFolder, wanted: set[str], *, mixed: bool = False) -> None:
    """Move what the shards of a data set have made: recordings, and the rows of the cases
    ``wanted``. Killed at any moment, it can be called again.

    Raises InputError as ``shards.gather``, and for a recording that is there with other content.
    """
    paths = list(shards_in(folder.path).values())
    if not paths:
        return
    shards = [DatasetFolder(path) for path in paths]
    studies = [Folder(shard.study) for shard in shards]
    gather(Folder(folder.study.resolve()), studies, wanted, mixed=mixed)
    for shard in shards:
        with shard.held():
            for record in shard.records():
                _take(record, shard, folder)
    remove_empty(folder.path, paths)


def _take(record: dict, shard: DatasetFolder, folder: DatasetFolder) -> None:
    """Move a recording, its record last."""
    name = str(record["hash"])
    if folder.has(name):
        _check_same(record, shard, folder)
        for file in (*record["files"], f"records/{name}.json"):
            (shard.path / file).unlink(missing_ok=True)
        return
    for file in record["files"]:
        if (shard.path / file).is_file():
            os.replace(shard.path / file, folder.path / file)
        elif not (folder.path / file).is_file():  # moved before a kill
            raise InputError(
                f"'{shard.path / file}' is not there, which the recording {name} has; compute the "
                f"shard again after removing '{shard.path / 'records' / name}.json'.",
                where="shards",
                value=file,
            )
    os.replace(shard.path / "records" / f"{name}.json", folder.path / "records" / f"{name}.json")


def _check_same(record: dict, shard: DatasetFolder, folder: DatasetFolder) -> None:
    there = folder.record(str(record["hash"]))
    if (there["rows"], there["files"]) != (record["rows"], record["files"]):
        raise InputError(
            f"Recording {record['hash']} is in '{shard.path}' and in '{folder.path}' with other "
            "content; remove it from one of them.",
            where="shards",
            value=record["hash"],
        )
