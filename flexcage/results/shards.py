"""Files that grow chunk by chunk: shards of Zarr arrays, and tables of a run's blocks.

A file begins with an index, which holds offset and length of every chunk and ends with a checksum:
Zarr's sharding, index at the start. A chunk is written behind all that the index knows, and then
the index in one write, so a kill leaves the file with the chunk or without it. A chunk that is
written again stands behind the old one, which readers of the old index still find.
"""

from __future__ import annotations

import io
import json
import os
from collections.abc import Mapping, Sequence
from io import FileIO
from itertools import groupby
from math import ceil, prod
from pathlib import Path
from typing import Any

import google_crc32c
import numpy as np
from numcodecs import blosc

from flexcage.core.arrays import read_arrays
from flexcage.core.reading import check_size, check_type, json_of, table_of

SLOTS = 200  # chunks of a file at most: their index stays within a page, which no kill cuts
BLOSC: dict[str, Any] = {"cname": "zstd", "clevel": 2, "shuffle": "shuffle", "blocksize": 1 << 20}

_BLOSC_HEADER = 16  # bytes
_NONE = 2**64 - 1  # offset and length of a chunk that is not there
_COLUMNS = "columns"  # of a packed table: type and shape of every column


class Chunks:
    """Numbered chunks in files of ``slots``, at ``folder``/number of the file/``rest``."""

    def __init__(self, folder: Path, slots: int, rest: Sequence[str] = ()) -> None:
        self._folder, self._slots, self._rest = folder, slots, rest

    def write(self, number: int, chunk: bytes) -> None:
        """Write a chunk, in place of one that may be there."""
        file, slot = divmod(number, self._slots)
        path = self._path(file)
        path.parent.mkdir(parents=True, exist_ok=True)
        handle = os.open(path, os.O_RDWR | os.O_CREAT | getattr(os, "O_BINARY", 0), 0o666)
        with open(handle, "r+b", buffering=0) as stream:
            index = self._index(stream)
            if index is None:
                index = np.full((self._slots, 2), _NONE, np.uint64)
                _write_all(stream, with_checksum(index.tobytes()))
            there = index[index[:, 0] != _NONE].sum(axis=1)
            end = int(there.max(initial=self._index_size))
            index[slot] = end, len(chunk)
            for offset, content in ((end, chunk), (0, with_checksum(index.tobytes()))):
                stream.seek(offset)
                _write_all(stream, content)

    def read(self, numbers: Sequence[int]) -> list[bytes | None]:
        """Chunks as they were written, None for those that are not there. ValueError for a damaged
        index, OSError from the disk."""
        found: list[bytes | None] = []
        for file, group in groupby(numbers, lambda number: number // self._slots):
            slots = [number % self._slots for number in group]
            try:
                with open(self._path(file), "rb", buffering=0) as stream:
                    index = self._index(stream)
                    found += [_at(stream, index, slot) for slot in slots]
            except FileNotFoundError:
                found += [None] * len(slots)
        return found

    def holds(self, count: int) -> bool:
        """Whether the first ``count`` chunks are there; ValueError for a damaged index."""
        for file in range(ceil(count / self._slots)):
            try:
                with open(self._path(file), "rb", buffering=0) as stream:
                    index = self._index(stream)
            except FileNotFoundError:
                return False
            if index is None or (index[: count - file * self._slots, 0] == _NONE).any():
                return False
        return True

    def size(self, count: int) -> int:
        """Bytes on disk of the files that hold the first ``count`` chunks."""
        files = (self._path(file) for file in range(ceil(count / self._slots)))
        return sum(path.stat().st_size for path in files if path.exists())

    def _path(self, file: int) -> Path:
        return self._folder.joinpath(str(file), *self._rest)

    @property
    def _index_size(self) -> int:
        return 16 * self._slots + 4

    def _index(self, stream: FileIO) -> np.ndarray | None:
        """Offsets and lengths (slots, 2), None of an empty file. An index that is not whole is read
        once more: the run's writer may have been at it."""
        content = stream.read(self._index_size)
        if not content:
            return None
        try:
            flat = checked(content)
        except ValueError:
            stream.seek(0)
            flat = checked(stream.read(self._index_size))
        return np.frombuffer(flat, np.uint64).reshape(self._slots, 2).copy()


def encoded(values: np.ndarray, order: Sequence[int]) -> bytes:
    """A chunk of an array with its axes in this order, compressed, with a checksum."""
    return with_checksum(_compressed(np.transpose(values, order)))


def decoded(chunk: bytes, shape: Sequence[int], dtype: np.dtype, order: Sequence[int]) -> Any:
    """The values (``shape``) of a chunk; ValueError for a damaged one."""
    flat = np.frombuffer(_decompressed(checked(chunk), prod(shape) * dtype.itemsize), dtype)
    return flat.reshape([shape[k] for k in order]).transpose(np.argsort(order))


def packed(table: Mapping[str, np.ndarray]) -> bytes:
    """A table, one array a column, as one compressed chunk; arrays (n, m) column by column."""
    columns = {name: np.asarray(column) for name, column in table.items()}
    about = {name: (column.dtype.str, column.shape) for name, column in columns.items()}
    parts: dict[str, Any] = {_COLUMNS: np.array(json.dumps(about))}
    parts |= {
        name: np.frombuffer(_compressed(column.T if column.ndim == 2 else column), np.uint8)
        for name, column in columns.items()
        if column.size
    }
    buffer = io.BytesIO()
    np.savez(buffer, **parts)
    return buffer.getvalue()


def unpacked(chunk: bytes) -> dict[str, np.ndarray]:
    """The table of a chunk; one of ``arrays.UNREADABLE`` for a damaged one."""
    parts = read_arrays(io.BytesIO(chunk))
    about = table_of(json_of(str(parts[_COLUMNS])))
    columns = {name: (np.dtype(str(kind)), tuple(shape)) for name, (kind, shape) in about.items()}
    sizes = {name: prod(shape) * dtype.itemsize for name, (dtype, shape) in columns.items()}
    check_size(sum(sizes.values()), len(chunk))
    table = {}
    for name, (dtype, shape) in columns.items():
        check_type(dtype, name)
        content = _decompressed(parts[name].tobytes(), sizes[name]) if name in parts else b""
        order: Any = "F" if len(shape) == 2 else "C"
        table[name] = np.frombuffer(content, dtype).reshape(shape, order=order)
    return table


def with_checksum(content: bytes) -> bytes:
    """Content and, behind it, its CRC-32C."""
    return content + google_crc32c.value(content).to_bytes(4, "little")


def checked(content: bytes) -> bytes:
    """What ``with_checksum`` was given; ValueError if it is not that any more."""
    if len(content) < 4 or google_crc32c.value(content[:-4]) != int.from_bytes(
        content[-4:], "little"
    ):
        raise ValueError("the checksum is another one")
    return content[:-4]


def _compressed(values: np.ndarray) -> bytes:
    return blosc.compress(
        np.ascontiguousarray(values), BLOSC["cname"].encode(), BLOSC["clevel"], blosc.SHUFFLE,
        BLOSC["blocksize"],
    )  # fmt: skip


def _decompressed(packed: bytes, size: int) -> bytes:
    """What was compressed, after its claim was compared with the size that is wanted."""
    if blosc_size(packed) != size:
        raise ValueError(f"a chunk claims to hold {blosc_size(packed):,} bytes, not {size:,}")
    return blosc.decompress(packed)


def blosc_size(packed: bytes) -> int:
    """Bytes that a Blosc buffer claims to hold; ValueError for one that is cut short."""
    if len(packed) < _BLOSC_HEADER or int.from_bytes(packed[12:16], "little") != len(packed):
        raise ValueError("a chunk was cut short or changed")
    return int.from_bytes(packed[4:8], "little")


def _at(stream: FileIO, index: np.ndarray | None, slot: int) -> bytes | None:
    """The chunk of a slot."""
    if index is None or index[slot, 0] == _NONE:
        return None
    offset, length = (int(n) for n in index[slot])
    if offset + length > os.fstat(stream.fileno()).st_size:
        raise ValueError("a chunk was cut off")
    stream.seek(offset)
    return stream.read(length)


def _write_all(stream: FileIO, content: bytes) -> None:
    left = memoryview(content)
    while left:
        left = left[stream.write(left) :]
