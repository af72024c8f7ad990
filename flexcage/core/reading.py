"""Files that may come from a stranger, read without running or allocating what they ask for.

JSON texts and archives, of which every size is compared with the bytes that are there before memory
is taken (arrays: ``arrays``). All that is wrong is a ValueError.
"""

from __future__ import annotations

import json
import zipfile
from pathlib import Path
from typing import Any

import numpy as np

KINDS = "biufcUS"  # of numpy's types: numbers and texts
LONGEST_JSON = 2**28  # bytes
MOST_MEMBERS = 100_000
PACKED = 1000  # times that what a file holds may be larger than the file itself, and besides
ALLOWANCE = 2**28  # bytes: short files of zeros are packed tighter


def json_of(text: str | bytes) -> Any:
    """The value of a JSON text; ValueError for one that is none, too long, or too deep."""
    if len(text) > LONGEST_JSON:
        raise ValueError(f"its text has {len(text):,} bytes")
    try:
        return json.loads(text)
    except RecursionError:
        raise ValueError("its values are nested too deep") from None


def read_json(path: Path) -> Any:
    """The value in a JSON file. ValueError as ``json_of``, OSError from the disk."""
    size = path.stat().st_size
    if size > LONGEST_JSON:
        raise ValueError(f"it has {size:,} bytes")
    return json_of(path.read_bytes())


def table_of(value: Any, **kinds: type | tuple[type, ...]) -> dict[str, Any]:
    """A mapping whose entries ``kinds`` are there and of these types; ValueError for another."""
    if not isinstance(value, dict):
        raise ValueError("it holds no table")
    for name, kind in kinds.items():
        if not isinstance(value.get(name), kind) or isinstance(value[name], bool):
            raise ValueError(f"its entry '{name}' is missing, or of another type")
    return value


def check_size(size: int, stored: int) -> None:
    """ValueError if ``stored`` bytes say that they hold ``size``: over so many times as much."""
    if not 0 <= size <= ALLOWANCE + PACKED * stored:
        raise ValueError(f"it claims to hold {size:,} bytes in {stored:,}")


def stored_members(archive: zipfile.ZipFile) -> dict[str, zipfile.ZipInfo]:
    """Members of an archive by name, none of them packed, and together no larger than it;
    ValueError otherwise."""
    members = members_of(archive)
    for name, info in members.items():
        if info.compress_type != zipfile.ZIP_STORED:
            raise ValueError(f"its member '{name}' is packed")
    return members


def members_of(archive: zipfile.ZipFile) -> dict[str, zipfile.ZipInfo]:
    """Members of an archive by name; ValueError where they overlap or two have the same name."""
    members, file = archive.infolist(), archive.fp
    assert file is not None
    there = file.seek(0, 2)
    if len(members) > MOST_MEMBERS:
        raise ValueError(f"it has {len(members):,} members")
    if sum(info.compress_size for info in members) > there:
        raise ValueError("its members overlap")
    named = {info.filename: info for info in members}
    if len(named) < len(members):
        raise ValueError("two of its members have the same name")
    return named


def check_type(dtype: np.dtype, what: str) -> None:
    """ValueError unless the type is one of numbers or of texts."""
    if dtype.hasobject or dtype.kind not in KINDS or dtype.names is not None:
        raise ValueError(f"'{what}' holds values of type {dtype}")
