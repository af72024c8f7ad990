"""Writing files so that a kill at any moment leaves the old content or the new one."""

from __future__ import annotations

import io
import os
import shutil
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any
from zipfile import BadZipFile
from zlib import error as BadStream

import numpy as np

from flexcage.core.arrays import read_arrays
from flexcage.core.errors import InputError, RunFailed, is_full, unwritable

#: What ``load`` raises for a file that was cut short or changed.
UNREADABLE = (BadZipFile, BadStream, EOFError, KeyError, ValueError)


def make_room(path: Path, overwrite: bool) -> None:
    """Make sure that ``path`` is an empty folder that can be written."""
    try:
        if path.exists() and any(path.iterdir()):
            if not overwrite:
                raise InputError(
                    f"{path} exists already and is not empty; choose another folder, or say that "
                    "it is to be overwritten.",
                    where="path",
                    value=str(path),
                )
            shutil.rmtree(path)
        path.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise unwritable(f"The folder '{path}'", error, path=path) from error


@contextmanager
def disk(path: Path, kept: int) -> Iterator[None]:
    """Turn an error of the disk into a sentence that says what is kept."""
    try:
        yield
    except OSError as error:
        full = is_full(error)
        what = "the disk is full" if full else (error.strerror or str(error))
        raise RunFailed(
            f"Results could not be written to {path}: {what}; the first {kept:,} samples are kept "
            f"and readable, and the run can be resumed{' once there is room' if full else ''}."
        ) from error


def save(path: Path, arrays: Mapping[str, Any]) -> None:
    """Arrays to a file in one move, on disk before this returns."""
    buffer = io.BytesIO()
    named: dict[str, Any] = {k: np.asarray(v) for k, v in arrays.items()}
    np.savez(buffer, **named)
    replace(path, buffer.getvalue())


def load(path: Path) -> dict[str, np.ndarray]:
    """The arrays of a file that ``save`` wrote; one of ``UNREADABLE`` for a damaged one."""
    return read_arrays(path)


def replace(path: Path, content: bytes) -> None:
    """Write a file so that either the old or the new content is there after any kill."""
    temporary = path.with_name(path.name + ".new")
    with open(temporary, "wb") as file:
        file.write(content)
        file.flush()
        os.fsync(file.fileno())
    _rename(temporary, path)


def move_into_place(temporary: Path, path: Path) -> None:
    """Give a file that was written beside ``path`` its name, once all in it is on disk."""
    handle = os.open(temporary, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
    _rename(temporary, path)


def _rename(temporary: Path, path: Path) -> None:
    os.replace(temporary, path)
    if os.name == "posix":
        folder = os.open(path.parent, os.O_RDONLY)
        try:
            os.fsync(folder)
        finally:
            os.close(folder)


def joined(parts: Iterable[Mapping[str, np.ndarray]]) -> dict[str, np.ndarray]:
    """Tables one after the other, column by column."""
    filled = [p for p in parts if p]
    if not filled:
        return {}
    return {k: np.concatenate([np.atleast_1d(p[k]) for p in filled]) for k in filled[0]}
