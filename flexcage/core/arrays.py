"""Arrays and sparse matrices in .npz files, whoever wrote them: the only code that reads them.

No pickle is opened, sizes are known before memory is taken, and a sparse matrix is checked whole:
SciPy's compiled products follow its indices wherever they point, out of memory as well.
"""

from __future__ import annotations

import zipfile
import zlib
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np
from numpy.lib import format as npy

from flexcage.core.memory import free_memory, in_bytes
from flexcage.core.reading import members_of

if TYPE_CHECKING:
    import scipy.sparse as sp


class Damaged(ValueError):
    """A file that is not what its name says: a reason that a sentence may tell."""


SPARSE = ("data", "indices", "indptr", "shape")  # what a sparse matrix is stored as
#: What ``read_arrays`` raises for a file that was cut short or changed.
UNREADABLE = (zipfile.BadZipFile, zlib.error, EOFError, KeyError, RuntimeError, ValueError)
_SUFFIX = ".npy"
_KINDS = "biufcUS?"  # of numbers and texts


def read_arrays(
    file: str | Path | IO[bytes], *, wanted: Callable[[str], bool] = lambda name: True
) -> dict[str, np.ndarray]:
    """The ``wanted`` arrays of an .npz file by their names.

    Damaged for an array of objects, one that is not as long as it says, and for more than the
    machine's memory has room for; OSError or another of ``UNREADABLE`` for what is no such file.
    """
    with zipfile.ZipFile(file) as members:
        found = {
            name.removesuffix(_SUFFIX): info
            for name, info in members_of(members).items()
            if name.endswith(_SUFFIX)
        }
        chosen = {name: info for name, info in found.items() if wanted(name)}
        memory, whole = free_memory(), sum(info.file_size for info in chosen.values())
        if whole > memory:
            raise Damaged(f"its arrays take {in_bytes(whole)}, and {in_bytes(memory)} are free")
        for name, info in chosen.items():
            with members.open(info) as stream:
                _check_head(name, stream, info.file_size)
        arrays = {}
        for name, info in chosen.items():
            with members.open(info) as stream:
                arrays[name] = npy.read_array(stream, allow_pickle=False)
        return arrays


def _check_head(name: str, stream: IO[bytes], size: int) -> None:
    """Refuse an array whose head says another size than its part of the file has."""
    version = npy.read_magic(stream)
    read = {(1, 0): npy.read_array_header_1_0, (2, 0): npy.read_array_header_2_0}.get(version)
    if read is None:
        raise Damaged(f"its array {name} is of version {version[0]}.{version[1]}")
    shape, _, kind = read(stream)
    if kind.kind not in _KINDS or kind.hasobject:
        raise Damaged(f"its array {name} holds objects, and numbers and texts alone are read")
    count = 1
    for length in shape:
        count *= int(length)  # of any size: integers of NumPy would wrap
    if min(shape, default=0) < 0 or stream.tell() + count * kind.itemsize != size:
        raise Damaged(f"its array {name} is not as long as it says")


def sparse_matrix(parts: Mapping[str, np.ndarray], name: str) -> sp.csr_matrix:
    """The matrix by rows of which these are the parts (``SPARSE``); Damaged, which names the
    matrix, for parts that make none."""
    missing = [part for part in SPARSE if part not in parts]
    if missing:
        raise Damaged(f"its sparse matrix {name} lacks {name}.{missing[0]}")
    data, indices, pointers, shape = (np.asarray(parts[part]) for part in SPARSE)
    rows, columns = _shape(shape, name)
    for part, values in (("indices", indices), ("indptr", pointers)):
        if values.dtype.kind not in "iu" or values.ndim != 1:
            raise Damaged(f"{name}.{part} of its sparse matrix is no list of whole numbers")
    if data.dtype.kind not in "fiu":
        raise Damaged(f"{name}.data has {data.size} numbers of no real kind")
    if data.shape != indices.shape:
        raise Damaged(
            f"{name}.data has {data.size} numbers, and {name}.indices {indices.size}: they should "
            "be as many"
        )
    if len(pointers) != rows + 1:
        raise Damaged(
            f"{name}.indptr has {len(pointers)} numbers, but a matrix of {rows} rows has {rows + 1}"
        )
    pointers, indices = pointers.astype(np.int64), indices.astype(np.int64)
    if pointers[0] != 0 or pointers[-1] != len(data) or (np.diff(pointers) < 0).any():
        raise Damaged(
            f"{name}.indptr should rise from 0 to {len(data)}, the number of entries, and goes "
            f"from {pointers[0]} to {pointers[-1]}"
        )
    if len(indices) and not 0 <= indices.min() <= indices.max() < columns:
        first, last = int(indices.min()), int(indices.max())
        from_one = " (they count from one)" if (first, last) == (1, columns) else ""
        raise Damaged(
            f"{name}.indices go from {first} to {last}{from_one}, and columns of the matrix are 0 "
            f"to {columns - 1}"
        )
    import scipy.sparse as sp

    made = sp.csr_matrix((data, indices, pointers), shape=(rows, columns))
    made.check_format(full_check=True)
    return made


def _shape(shape: Any, name: str) -> tuple[int, int]:
    if shape.shape != (2,) or shape.dtype.kind not in "iu" or min(shape) < 0:
        raise Damaged(f"{name}.shape should be two whole numbers")
    return int(shape[0]), int(shape[1])
