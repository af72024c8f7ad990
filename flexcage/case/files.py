"""Files that a case names: which values they are, and where their relative paths start."""

from __future__ import annotations

import dataclasses
import re
from collections.abc import Mapping
from functools import cache
from pathlib import Path
from typing import Any

from flexcage.core.binding import default_of, path_of
from flexcage.core.errors import InputError

_CONTROL = re.compile(r"[\x00-\x1f]")
_LETTERS = {"\n": "n", "\t": "t", "\r": "r", "\b": "b", "\f": "f"}  # after TOML's backslash


@cache
def file_paths(case: type) -> tuple[str, ...]:
    """Dotted paths of the values of a class of cases that are files."""
    return tuple(
        f"{section.name}.{field.name}"
        for section in dataclasses.fields(case)
        if dataclasses.is_dataclass(spec := default_of(section))
        for field in dataclasses.fields(spec)
        if field.metadata.get("file")
    )


def with_files(table: dict[str, Any], folder: Path, paths: tuple[str, ...]) -> dict[str, Any]:
    """Paths of files, made absolute: they were written relative to the case's own folder."""
    for path in paths:
        room, _, name = path.partition(".")
        section = table.get(room)
        file = section.get(name) if isinstance(section, Mapping) else None
        if isinstance(section, Mapping) and isinstance(file, str) and file:
            table = {**table, room: {**section, name: absolute(file, folder, path)}}
    return table


def absolute(file: str | Path, folder: Path, where: str) -> str:
    """Absolute path of a file, so that a run's own case.toml finds it from its folder. Raises
    InputError for a control character, which in TOML a backslash in double quotes makes."""
    if (found := _CONTROL.search(str(file))) and found[0] in _LETTERS:
        meant = "".join(f"\\{_LETTERS[c]}" if c in _LETTERS else c for c in str(file))
        raise InputError(
            f"{where} has a control character, for in double quotes TOML reads "
            f"\\{_LETTERS[found[0]]} as one; write the path in single quotes, '{meant}', or with "
            "'/'.",
            where=where,
            value=str(file),
        )
    return str(folder / path_of(file, where)) if str(file) else ""


def bytes_of(file: str) -> bytes:
    """Content of a file; nothing if it is not there."""
    path = Path(file)
    return path.read_bytes() if path.is_file() else b""
