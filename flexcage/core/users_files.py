"""Files of the user's own that this process has loaded: what is compiled may depend on them."""

from __future__ import annotations

import hashlib
from collections.abc import Iterable
from pathlib import Path

_contents: dict[Path, str] = {}


def remember(files: Iterable[Path]) -> None:
    """Take note of files that are about to be loaded."""
    for file in files:
        _contents[file] = hashlib.sha256(file.read_bytes()).hexdigest()


def forget(files: Iterable[Path]) -> None:
    """Of files that could not be loaded."""
    for file in files:
        _contents.pop(file, None)


def contents_key() -> str:
    """16 digits that change with what the files hold; empty without any."""
    if not _contents:
        return ""
    return hashlib.sha256("".join(sorted(_contents.values())).encode()).hexdigest()[:16]
