"""Files of arrays, and folders for them, with errors of the disk as sentences."""

from __future__ import annotations

import io
import shutil
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.core.arrays import read_arrays
from flexcage.core.errors import InputError, RunFailed, is_full, unwritable
from flexcage.core.writing import replace


def prepare_folder(path: Path, overwrite: bool) -> None:
    """Make sure that ``path`` is an empty folder that can be written."""
    try:
        if path.exists() and any(path.iterdir()):
            if not overwrite:
                raise InputError(
                    f"{path} exists already and is not empty; choose another folder, remove this "
                    "one, or go on with its run (in Python, resume=True).",
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
    replace(path, npz_of(arrays))


def npz_of(arrays: Mapping[str, Any]) -> bytes:
    """Arrays as an .npz file holds them."""
    buffer = io.BytesIO()
    named: dict[str, Any] = {k: np.asarray(v) for k, v in arrays.items()}
    np.savez(buffer, **named)
    return buffer.getvalue()


def load(path: Path) -> dict[str, np.ndarray]:
    """The arrays of a file that ``save`` wrote; one of ``arrays.UNREADABLE`` for a damaged one."""
    return read_arrays(path)


def joined(parts: Iterable[Mapping[str, np.ndarray]]) -> dict[str, np.ndarray]:
    """Tables one after the other, column by column."""
    filled = [p for p in parts if p]
    if not filled:
        return {}
    return {k: np.concatenate([np.atleast_1d(p[k]) for p in filled]) for k in filled[0]}
