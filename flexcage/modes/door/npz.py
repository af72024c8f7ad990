"""Bodies as NumPy arrays in an .npz file, with the names of ``contents``.

A sparse matrix stands there by its parts: K.data, K.indices, K.indptr, K.shape.
"""

from __future__ import annotations

import zipfile
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from flexcage.modes.door.body import ReducedBody
from flexcage.modes.door.contents import Contents, from_matrices, to_matrices, unreadable

_PARTS = ("data", "indices", "indptr", "shape")


def read(path: Path, *, where: str) -> Contents:
    """The arrays of the file, sparse ones put together."""
    try:
        with np.load(path, allow_pickle=False) as file:
            arrays = {name: file[name] for name in file.files}
        return from_matrices(_with_sparse(arrays), path, where=where)
    except (OSError, ValueError, KeyError, zipfile.BadZipFile, EOFError) as error:
        if hasattr(error, "where"):
            raise
        raise unreadable(path, error, where=where) from error


def write(body: ReducedBody, path: Path) -> None:
    """Write a body's matrices; sparse ones by their parts."""
    arrays: dict[str, Any] = {}
    for name, value in to_matrices(body).items():
        if sp.issparse(value):
            rows = sp.csr_matrix(value)
            arrays |= {f"{name}.{part}": np.asarray(getattr(rows, part)) for part in _PARTS}
        else:
            arrays[name] = value
    with path.open("wb") as file:
        np.savez(file, **arrays)


def _with_sparse(arrays: dict[str, np.ndarray]) -> dict[str, Any]:
    found: dict[str, Any] = {n: a for n, a in arrays.items() if n.partition(".")[2] not in _PARTS}
    for name in sorted({n.partition(".")[0] for n in arrays} - found.keys()):
        data, indices, indptr, shape = (arrays[f"{name}.{part}"] for part in _PARTS)
        found[name] = sp.csr_matrix((data, indices, indptr), shape=tuple(shape))
    return found
