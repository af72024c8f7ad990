"""Arrays from files of strangers: nothing is run, nothing overruns memory, one sentence each."""

from __future__ import annotations

import io
import pickle
import re
import zipfile

import numpy as np
import pytest
import scipy.sparse as sp

from flexcage.core import arrays as arrays
from flexcage.core.arrays import read_arrays, sparse_matrix
from flexcage.core.errors import InputError
from flexcage.modes.exchange.formats import read_body
from flexcage.modes.storage import interface_from

WHOLE = sp.csr_matrix(np.diag([2.0, 3.0, 4.0]) + 0.1)
PARTS = {
    "data": WHOLE.data, "indices": WHOLE.indices, "indptr": WHOLE.indptr,
    "shape": np.array(WHOLE.shape),
}  # fmt: skip


def test_a_sound_matrix_comes_back():
    assert (sparse_matrix(PARTS, "K") != WHOLE).nnz == 0
    empty = {**PARTS, "data": np.zeros(0), "indices": np.zeros(0, int), "indptr": np.zeros(4, int)}
    assert sparse_matrix(empty, "K").nnz == 0


def changed(part, place, value):
    array = PARTS[part].copy()
    array[place] = value
    return {part: array}


HOSTILE = {
    "column of 2e9": (changed("indices", 4, 2_000_000_000), "K.indices go from 0 to 2000000000"),
    "negative column": (changed("indices", 4, -7), "K.indices go from -7 to 2"),
    "from one": ({"indices": PARTS["indices"] + 1}, "from 1 to 3 (they count from one)"),
    "end of 1e9": (changed("indptr", -1, 10**9), "K.indptr should rise from 0 to 9"),
    "pointer of 1e9": (changed("indptr", 1, 10**9), "K.indptr should rise from 0 to 9"),
    "pointer back": (changed("indptr", 2, 1), "K.indptr should rise from 0 to 9"),
    "from one, rows": ({"indptr": PARTS["indptr"] + 1}, "goes from 1 to 10"),
    "too few rows": ({"indptr": PARTS["indptr"][:2]}, "a matrix of 3 rows has 4"),
    "a vast shape": ({"shape": np.array([2**40, 2**40])}, "1099511627777"),
    "a negative shape": ({"shape": np.array([-3, 3])}, "K.shape should be two whole numbers"),
    "a shape of texts": ({"shape": np.array(["3", "3"])}, "K.shape should be two whole numbers"),
    "fractional": ({"indices": PARTS["indices"] + 0.5}, "K.indices of its sparse matrix is no"),
    "fewer numbers": ({"data": PARTS["data"][:5]}, "K.data has 5 numbers, and K.indices 9"),
    "texts": ({"data": PARTS["data"].astype(str)}, "K.data has 9 numbers of no real kind"),
}  # fmt: skip


@pytest.mark.parametrize("name", HOSTILE)
def test_parts_that_make_no_matrix(name):
    wrong, words = HOSTILE[name]
    with pytest.raises(ValueError, match=re.escape(words)):
        sparse_matrix({**PARTS, **wrong}, "K")


@pytest.mark.parametrize("name", HOSTILE)
def test_a_body_with_such_parts(tmp_path, name):
    """In one sentence that names file and array."""
    parts = {f"K.{part}": value for part, value in {**PARTS, **HOSTILE[name][0]}.items()}
    np.savez(tmp_path / "body.npz", M=np.eye(3), NODES=np.zeros((1, 3)), **parts)
    with pytest.raises(InputError, match=r"body\.npz .*K\."):
        read_body(tmp_path / "body.npz")


def test_a_stored_interface_with_such_parts():
    parts = {
        f"weights.{part}": value for part, value in {**PARTS, **changed("indices", 0, 9)}.items()
    }
    with pytest.raises(InputError, match=r"weights\.indices go from 0 to 9"):
        interface_from(dict, parts)


class Runs:
    """Leaves a file when it is unpickled."""

    def __init__(self, path):
        self.path = path

    def __reduce__(self):
        return (open, (str(self.path), "w"))


def member(content: bytes) -> bytes:
    """An .npz file of one array, ``K.npy``, with this content."""
    file = io.BytesIO()
    with zipfile.ZipFile(file, "w", zipfile.ZIP_DEFLATED) as made:
        made.writestr("K.npy", content)
    return file.getvalue()


def head(shape: tuple[int, ...], kind: str = "<f8") -> bytes:
    file = io.BytesIO()
    np.lib.format.write_array_header_1_0(
        file, {"descr": kind, "fortran_order": False, "shape": shape}
    )
    return file.getvalue()


def test_no_pickle_is_opened(tmp_path):
    mark = tmp_path / "ran"
    file = io.BytesIO()
    np.savez(file, K=np.array([Runs(mark)], dtype=object))
    with pytest.raises(ValueError, match="K holds objects"):
        read_arrays(io.BytesIO(file.getvalue()))
    bare = io.BytesIO(member(head((1,), "|O") + pickle.dumps([Runs(mark)])))
    with pytest.raises(ValueError, match="K holds objects"):
        read_arrays(bare)
    assert not mark.exists()


def test_sizes_are_known_before_memory_is_taken(monkeypatch):
    """Heads that promise more than follows, products that wrap at 2^64, and a bomb of zeros."""
    for shape in [(2**40,), (2**32, 2**32), (-1,), (2**61, 2**61, 2**61)]:
        with pytest.raises(ValueError, match="K is not as long as it says"):
            read_arrays(io.BytesIO(member(head(shape) + bytes(16))))
    bomb = io.BytesIO(member(head((2_000_000,)) + bytes(16_000_000)))
    assert len(bomb.getvalue()) < 50_000 and read_arrays(bomb)["K"].shape == (2_000_000,)
    monkeypatch.setattr(arrays, "free_memory", lambda: 10e6)
    with pytest.raises(ValueError, match="its arrays take 16 MB, and 10 MB are free"):
        read_arrays(bomb)


def test_what_is_no_such_file(tmp_path):
    for content in (b"", b"PK", pickle.dumps({}), member(b"\x93NUMPY\x09\x00"), member(b"")):
        path = tmp_path / "body.npz"
        path.write_bytes(content)
        with pytest.raises(InputError, match=r"body\.npz cannot be read"):
            read_body(path)
