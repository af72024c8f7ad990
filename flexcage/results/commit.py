"""What a run on disk counts as committed: ``_run/commit.json``, the one file that makes a block.

It says how many blocks and samples there are, and vouches for all else that gives numbers their
meaning: it holds its own checksum and those of the arrays' metadata with case and labels, of the
checkpoint and of the summary. A change in any of them is told on reading.
"""

from __future__ import annotations

import hashlib
import json
import re
from pathlib import Path
from typing import Any

from flexcage import _version
from flexcage.core.errors import InputError
from flexcage.core.reading import read_json, table_of
from flexcage.core.writing import replace

FORMAT = 6  # see ``store``
SIDE = "_run"  # folder beside the arrays: commit, checkpoint, steps, events
COMMIT = "commit.json"
_CHECKSUM = "checksum"
_CHECKPOINT = re.compile(r"(checkpoint-\d{6,}\.npz)?")


def continued(commit: dict[str, Any], version: str, physics: str) -> dict[str, Any]:
    """The commit of a run that another flexcage, or an edited one, goes on with."""
    seam = {"sample": commit["n_time"], "version": version, "physics": physics}
    return {**commit, "continued": [*commit.get("continued", ()), seam]}


def first_commit(metadata: str) -> dict[str, Any]:
    """The commit of a run without blocks, whose arrays have these metadata by their checksum."""
    return {
        "format": FORMAT, "blocks": 0, "n_time": 0, "n_time_hf": 0, "checkpoint": "",
        "metadata": metadata, "files": {},
    }  # fmt: skip


def checksum(content: bytes) -> str:
    """64 digits that change with the content."""
    return hashlib.sha256(content).hexdigest()


def write_commit(path: Path, commit: dict[str, Any]) -> None:
    """Commit, in one move. OSError from the disk."""
    content = {**commit, _CHECKSUM: _own_checksum(commit)}
    replace(path / SIDE / COMMIT, json.dumps(content).encode())


def read_commit(path: Path) -> dict[str, Any]:
    """What a run on disk counts as committed; InputError for one of another format, and for one
    that was changed."""
    try:
        commit = read_json(path / SIDE / COMMIT)
    except FileNotFoundError:
        raise InputError(
            f"{path} holds no run of flexcage (it has no {SIDE}/{COMMIT}).",
            where="path",
            value=str(path),
        ) from None
    except (OSError, ValueError) as error:
        raise InputError(f"The commit file of {path} cannot be read: {error}.") from error
    found = commit.get("format") if isinstance(commit, dict) else None
    if found != FORMAT:
        raise InputError(
            f"The run in {path} is stored in format {found}, and this flexcage "
            f"({_version.__version__}) reads format {FORMAT}: "
            "open it with the flexcage that wrote it, or run the case again.",
            where="path",
            value=str(path),
        )
    return _checked(path, commit)


def _checked(path: Path, commit: dict[str, Any]) -> dict[str, Any]:
    """The commit without its checksum; InputError for one that was changed."""
    own = commit.pop(_CHECKSUM, None)
    try:
        table_of(commit, format=int, blocks=int, n_time=int, n_time_hf=int, checkpoint=str)
        counts = (commit[name] for name in ("blocks", "n_time", "n_time_hf"))
        known = min(counts) >= 0 and _CHECKPOINT.fullmatch(commit["checkpoint"])
        for seam in commit.get("continued", ()):
            table_of(seam, sample=int, version=str, physics=str)
        table_of(commit, metadata=str, files=dict)
        known = known and own == _own_checksum(commit)
    except ValueError:
        known = False
    if not known:
        raise damaged(path, f"has a file {SIDE}/{COMMIT} that was changed afterwards")
    return commit


def _own_checksum(commit: dict[str, Any]) -> str:
    return checksum(json.dumps(commit, sort_keys=True).encode())


def vouched(
    commit: dict[str, Any], name: str, content: bytes, *, and_before: bool = True
) -> dict[str, Any]:
    """The commit as it vouches for a file's new content too. ``and_before``: it goes on to vouch
    for the content before, which is the one that is there after a kill between the two."""
    before = commit["files"].get(name, [])[-1:] if and_before else []
    return {**commit, "files": {**commit["files"], name: [*before, checksum(content)]}}


def vouches(commit: dict[str, Any], name: str, content: bytes) -> bool:
    """Whether a file holds what was committed."""
    return checksum(content) in commit["files"].get(name, ())


def damaged(path: Path, what: str) -> InputError:
    """The error of a run on disk that cannot be what was written."""
    return InputError(
        f"The run in {path} is damaged: it {what}; bring it back from a copy, or run the case "
        "again.",
        where="path",
        value=str(path),
    )
