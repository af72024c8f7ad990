"""Files that may come from a stranger, read without running or allocating what they ask for.

JSON texts, and archives of arrays (.npz), of which every size is compared with the bytes that are
there before memory is taken, and of which none may hold Python objects (numpy's way to store those
is a pickle, which runs code). All that is wrong is a ValueError.
"""

from __future__ import annotations

import json
import zipfile
import zlib
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from math import prod
from pathlib import Path
from typing import IO, Any

import numpy as np

KINDS = "biufcUS"  # of numpy's types: numbers and texts
LONGEST_JSON = 2**28  # bytes
MOST_MEMBERS = 100_000
PACKED = 1000  # times that what a file holds may be larger than the file itself, and besides
DEFLATED = 100  # the same of a zip file
BESIDE = 2**28  # bytes: short files of zeros are packed tighter


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


def check_size(size: int, stored: int, times: int = PACKED) -> None:
    """ValueError if ``stored`` bytes say that they hold ``size``: over so many times as much."""
    if not 0 <= size <= BESIDE + times * stored:
        raise ValueError(f"it claims to hold {size:,} bytes in {stored:,}")


def read_npz(
    source: Path | IO[bytes], *, only: Sequence[str] = (), without: Sequence[str] = ()
) -> dict[str, np.ndarray]:
    """The arrays of an .npz archive, or those named. KeyError for one that is not there, ValueError
    for an archive that is damaged, claims more than it holds, or holds objects of Python."""
    with _as_value_error(), zipfile.ZipFile(source) as archive:
        members = {name.removesuffix(".npy"): info for name, info in _members(archive).items()}
        names = only or [name for name in members if name not in without]
        return {name: _array(archive, members[name]) for name in names}


def stored_members(archive: zipfile.ZipFile) -> dict[str, zipfile.ZipInfo]:
    """Members of an archive by name, none of them packed, and together no larger than it;
    ValueError otherwise."""
    members = _members(archive)
    for name, info in members.items():
        if info.compress_type != zipfile.ZIP_STORED:
            raise ValueError(f"its member '{name}' is packed")
    return members


def _members(archive: zipfile.ZipFile) -> dict[str, zipfile.ZipInfo]:
    members, file = archive.infolist(), archive.fp
    assert file is not None
    there = file.seek(0, 2)
    if len(members) > MOST_MEMBERS:
        raise ValueError(f"it has {len(members):,} members")
    if sum(info.compress_size for info in members) > there:
        raise ValueError("its members overlap")
    check_size(sum(info.file_size for info in members), there, DEFLATED)
    named = {info.filename: info for info in members}
    if len(named) < len(members):
        raise ValueError("two of its members have the same name")
    return named


def _array(archive: zipfile.ZipFile, info: zipfile.ZipInfo) -> np.ndarray:
    """One array, after its header was compared with the size of its member."""
    with archive.open(info) as stream:
        version = np.lib.format.read_magic(stream)
        if version == (1, 0):
            shape, _, dtype = np.lib.format.read_array_header_1_0(stream)
        elif version == (2, 0):
            shape, _, dtype = np.lib.format.read_array_header_2_0(stream)
        else:
            raise ValueError(f"'{info.filename}' is in numpy's format {version}")
        check_type(dtype, info.filename)
        if min(shape, default=0) < 0 or prod(shape) * dtype.itemsize != (
            info.file_size - stream.tell()
        ):
            raise ValueError(f"'{info.filename}' has not the size that its shape {shape} wants")
    with archive.open(info) as stream:
        return np.lib.format.read_array(stream, allow_pickle=False)


def check_type(dtype: np.dtype, what: str) -> None:
    """ValueError unless the type is one of numbers or of texts."""
    if dtype.hasobject or dtype.kind not in KINDS or dtype.names is not None:
        raise ValueError(f"'{what}' holds values of type {dtype}")


@contextmanager
def _as_value_error() -> Iterator[None]:
    """What zipfile, zlib and numpy raise for a damaged archive."""
    try:
        yield
    except (
        zipfile.BadZipFile, zlib.error, EOFError, NotImplementedError, RuntimeError, SyntaxError,
        TypeError, OverflowError,
    ) as error:  # fmt: skip
        raise ValueError(str(error) or type(error).__name__) from error
