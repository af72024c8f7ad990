"""A body's file says everything once: what stands there twice, in part or unread is told."""

from __future__ import annotations

import numpy as np
import pytest
from exchange_bodies import box, full

from flexcage.core.errors import InputError
from flexcage.modes.exchange.formats import read_body, write_body
from flexcage.modes.exchange.nastran import nastran
from flexcage.modes.exchange.nodes import read_points


@pytest.fixture(scope="module")
def body():
    return full(box())


@pytest.fixture
def arrays(body):
    stiffness, mass = body.dense()
    count = len(body.nodes)
    dofs = np.stack(np.divmod(np.arange(3 * count), 3), axis=1) + 1
    return {"K": stiffness, "M": mass, "NODES": body.nodes, "DOFS": dofs}


def saved(arrays, tmp_path):
    np.savez(tmp_path / "body.npz", **arrays)
    return tmp_path / "body.npz"


def same(count):
    return np.tile([4, 2], (count, 1))


CHANGES = {
    "has 2 matrices 'K'; leave one of them": lambda a: {"k": 2.0 * a["K"]},
    "DOFS has 1.5, but should have whole numbers": lambda a: {"DOFS": a["DOFS"] + 0.5},
    "81 of its coordinates are component 2 of node 4": lambda a: {"DOFS": same(len(a["K"]))},
    "NUMBERS has 27 numbers, among them 7 twice": lambda a: {"NUMBERS": np.r_[np.arange(1, 27), 7]},
    "NUMBERS has 3 numbers, but should have one of its own": lambda a: {"NUMBERS": [1, 2, 3]},
}


@pytest.mark.parametrize("words", CHANGES)
def test_arrays_that_contradict_are_refused(arrays, tmp_path, words):
    assert read_body(saved(arrays, tmp_path)).is_full
    with pytest.raises(InputError, match=words):
        read_body(saved(arrays | CHANGES[words](arrays), tmp_path))


def test_matrices_of_whole_numbers_and_of_true_and_false(arrays, tmp_path):
    """An unsigned difference below zero wraps: a symmetric matrix stays one, another is told."""
    k = np.rint(1e-3 * np.diag(np.arange(1.0, 82.0)) * 1e6).astype(np.uint64)
    back = read_body(saved(arrays | {"K": k}, tmp_path))
    np.testing.assert_array_equal(back.stiffness, k.astype(float))
    k[0, 1], k[1, 0] = 3, 4
    with pytest.raises(InputError, match=r"not symmetric: entries differ by 1.2e-05 of the"):
        read_body(saved(arrays | {"K": k}, tmp_path))
    with pytest.raises(InputError, match="K is an array of true and false, but should be"):
        read_body(saved(arrays | {"K": arrays["K"] != 0.0}, tmp_path))


@pytest.mark.parametrize("ending", [".npz", ".op4", ".pch", ".mtx"])
def test_a_pointer_of_git_lfs_is_told(tmp_path, ending):
    if ending in (".op4", ".pch"):
        pytest.importorskip("pyyeti")
    path = tmp_path / f"body{ending}"
    path.write_text("version https://git-lfs.github.com/spec/v1\noid sha256:4d7a\nsize 9\n")
    with pytest.raises(InputError, match="a pointer of Git LFS; 'git lfs pull' in its folder"):
        read_body(path)


def test_a_matrix_that_stands_twice_in_an_op4_is_refused(arrays, body, tmp_path):
    pytest.importorskip("pyyeti")
    op4 = nastran("op4")
    k, m = arrays["K"], arrays["M"]
    names = ["KAAX", "MAAX", "NODES", "KAAX"]
    op4.write(str(tmp_path / "body.op4"), names, [k, m, arrays["NODES"], 2.0 * k])
    with pytest.raises(InputError, match="has 2 matrices 'KAAX'"):
        read_body(tmp_path / "body.op4")
    op4.write(str(tmp_path / "body.op4"), names[:3], [k, m, arrays["NODES"]], endian=">")
    np.testing.assert_array_equal(read_body(tmp_path / "body.op4").stiffness, k)


def test_a_matrix_that_stands_twice_in_a_punch_is_refused(body, tmp_path):
    pytest.importorskip("pyyeti")
    path = write_body(body, tmp_path / "body.pch")
    once = path.read_text()
    assert read_body(path).is_full
    path.write_text(once + once[once.index("DMIG") :])
    with pytest.raises(InputError, match="has 2 matrices 'KAAX'"):
        read_body(path)


@pytest.mark.parametrize("name", ["C", "BAAX", "K4AAX"])
def test_a_damping_matrix_is_not_passed_over_in_silence(arrays, tmp_path, caplog, name):
    read_body(saved(arrays, tmp_path))
    assert not caplog.records
    read_body(saved(arrays | {name: 1e-5 * arrays["K"]}, tmp_path))
    assert f"has a damping matrix ({name}), which is not read" in caplog.text


def test_grids_after_the_end_of_a_deck_are_none(tmp_path):
    pytest.importorskip("pyyeti")
    path = tmp_path / "nodes.bdf"
    path.write_text("GRID,1,,0.,0.,1.\nGRID,2,,0.,1.,0.\nENDDATA\nGRID,3,,9.,9.,9.\n")
    assert read_points(path, where="nodes").numbers.tolist() == [1, 2]
