"""Bodies as NumPy arrays in an .npz file, with the names of ``contents``.

A sparse matrix stands there by its parts: K.data, K.indices, K.indptr, K.shape.
"""

from __future__ import annotations

import zipfile
import zlib
from pathlib import Path
from typing import Any

import numpy as np
import scipy.sparse as sp

from flexcage.core.arrays import SPARSE, read_arrays, sparse_matrix
from flexcage.modes.exchange.body import ReducedBody
from flexcage.modes.exchange.contents import Contents, from_matrices, to_matrices, unreadable


def read(path: Path, *, where: str) -> Contents:
    """The arrays of the file, sparse ones put together."""
    try:
        return from_matrices(_with_sparse(read_arrays(path)), path, where=where)
    except (OSError, ValueError, zipfile.BadZipFile, zlib.error, EOFError, RuntimeError) as error:
        if hasattr(error, "where"):
            raise
        raise unreadable(path, error, where=where) from error


def write(body: ReducedBody, path: Path) -> None:
    """Write a body's matrices; sparse ones by their parts."""
    arrays: dict[str, Any] = {}
    for name, value in to_matrices(body).items():
        if sp.issparse(value):
            rows = sp.csr_matrix(value)
            arrays |= {f"{name}.{part}": np.asarray(getattr(rows, part)) for part in SPARSE}
        else:
            arrays[name] = value
    with path.open("wb") as file:
        np.savez(file, **arrays)


def _with_sparse(arrays: dict[str, np.ndarray]) -> dict[str, Any]:
    parts: dict[str, dict[str, np.ndarray]] = {}
    found: dict[str, Any] = {}
    for full_name, array in arrays.items():
        name, _, part = full_name.partition(".")
        if part in SPARSE:
            parts.setdefault(name, {})[part] = array
        else:
            found[full_name] = array
    return found | {name: sparse_matrix(own, name) for name, own in parts.items()}
