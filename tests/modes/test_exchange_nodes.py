"""Nodes of a body from the deck of its program: followed, or refused by name and line."""

from __future__ import annotations

import numpy as np
import pytest
from exchange_bodies import box, craig_bampton

from flexcage.core.errors import InputError
from flexcage.modes.exchange.formats import read_body, write_body
from flexcage.modes.exchange.nodes import read_points

REFUSED = {
    "a.bdf": {
        "GRDSET,,5\nGRID,1,,1.,2.,3.\n": "line 1: the entry GRDSET is not followed",
        "GRID,1,,1.,2.,3.\nINCLUDE 'b.bdf'\n": "line 2: the entry INCLUDE is not followed",
        "GRID,1,,1.,2.,3.\nGRID,1,,1.,2.,4.\n": r"numbers grids twice \(1\)",
        "GRID 1  1. 2. 3.\n": "line 1: 'GRID 1  1. 2. 3.' is no GRID entry, whose fields are eight",
        "GRID           1             1.0 2.0 3.0\n": "line 1: 'GRID .* is no GRID entry",
        "GRID*                 1          0   1.0\n*   2.0\n": r"'GRID\* .* \(sixteen after",
        "CORD1R,1,1,2,3\nGRID,1,,1.,2.,3.\nGRID,4,1,0.,0.,1.\n": "line 1: the entry CORD1R",
    },
    "a.inp": {
        "*NODE\n1,0,0,0\n*TRANSFORM, NSET=A\n1,0,0,0,1,0\n": r"line 3: \*TRANSFORM turns",
        "*NODE\n1,0,0,0\n*NGEN\n1,3,1\n": r"line 3: \*NGEN makes nodes",
        "*NODE, INPUT=b.inp\n": r"line 1: \*NODE takes its data from another file",
        "*NODE, SYSTEM=S\n1,1,0,0\n": r"line 1: \*NODE, SYSTEM=S is not followed",
        "*NODE\n1,0,0,0\n1,0,0,1\n": r"line 3: it numbers nodes twice \(1\)",
        "*NODE\n1,0,0,0\n*NSET, NSET=A\nB\n": "the node set 'B' is not in it",
    },
}


@pytest.mark.parametrize(("name", "text"), [(n, t) for n, of in REFUSED.items() for t in of])
def test_what_is_not_followed_is_refused(tmp_path, name, text):
    if name.endswith(".bdf"):
        pytest.importorskip("pyyeti")
    (tmp_path / name).write_text(text)
    with pytest.raises(InputError, match=REFUSED[name][text]) as caught:
        read_points(tmp_path / name, where="modes.body_nodes")
    assert caught.value.where == "modes.body_nodes" and "empty, cut short" not in str(caught.value)


def test_grids_of_both_widths_with_comments(tmp_path):
    pytest.importorskip("pyyeti")
    (tmp_path / "a.bdf").write_text(
        "GRID           7             1.0     2.0     3.0               $ no, field\n"
        "GRID*                  8                             4.0             5.0\n"
        "*                    6.0\ngrid,9,,7.,8.,9.\n"
    )
    found = read_points(tmp_path / "a.bdf", where="modes.body_nodes")
    assert found.numbers.tolist() == [7, 8, 9]
    np.testing.assert_array_equal(found.places.ravel(), np.arange(1.0, 10.0))


def test_rows_of_an_ansys_block_stand_in_its_columns(tmp_path):
    """The library made node 1001 at the origin of the second row."""
    pytest.importorskip("mapdl_archive")
    row = f"{1:8d}{0:8d}{0:8d}{1.0:20.13E}{2.0:20.13E}{3.0:20.13E}\n"
    head, end = "NBLOCK,6,SOLID,1,1\n(3i8,6e20.13)\n", "N,R5.3,LOC,-1,\n"
    (tmp_path / "a.cdb").write_text(head + row + end)
    found = read_points(tmp_path / "a.cdb", where="modes.body_nodes")
    assert found.numbers.tolist() == [1] and found.places.tolist() == [[1.0, 2.0, 3.0]]
    (tmp_path / "a.cdb").write_text(head + "1 0 0 1.0 2.0 3.0\n" + end)
    with pytest.raises(InputError, match=r"line 3: '1 0 0 1.0 2.0 3.0' is no node by the format"):
        read_points(tmp_path / "a.cdb", where="modes.body_nodes")


def test_nodes_of_a_moved_instance_are_where_it_puts_them(tmp_path):
    (tmp_path / "a.inp").write_text(
        "*PART, NAME=P\n*SYSTEM\n1, 0, 0\n*NODE, SYSTEM=C, NSET=ALL\n1, 2.D0, 90.\n2, 1,,5\n"
        "*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=I, PART=P\n0, 0, 10\n"
        "0, 0, 0, 1, 0, 0, 90.\n*END INSTANCE\n*NSET, NSET=DOWN, INSTANCE=I, GENERATE\n2, 1, -1\n"
        "*END ASSEMBLY\n"
    )
    found = read_points(tmp_path / "a.inp", where="modes.body_nodes")
    assert np.abs(found.places - [[1.0, -10.0, 2.0], [2.0, -15.0, 0.0]]).max() < 1e-12
    assert found.sets["down"].tolist() == [2, 1] and found.sets["all"].tolist() == [1, 2]


def test_grids_that_stand_twice_alike_are_one(tmp_path):
    pytest.importorskip("pyyeti")
    (tmp_path / "a.bdf").write_text("GRID,7,,1.,2.,3.\nGRID,7,,1.,2.,3.\n")
    assert read_points(tmp_path / "a.bdf", where="modes.body_nodes").numbers.tolist() == [7]


@pytest.mark.parametrize("coding", ["latin-1", "utf-8-sig", "utf-16"])
@pytest.mark.parametrize(("ending", "comment"), [(".mtx", "** "), (".pch", "$ ")])
def test_matrices_with_a_comment_in_any_encoding(tmp_path, ending, comment, coding):
    """One byte of Latin-1 in a comment does not make a file "empty, cut short"."""
    if ending == ".pch":
        pytest.importorskip("pyyeti")
    body = craig_bampton(box(), np.array([0, 2, 6, 8, 18, 20, 24, 26]), 4)
    path = write_body(body, tmp_path / f"box{ending}")
    wanted = read_body(path)
    text = path.read_text()
    path.write_bytes(f"{comment}caf\xe9\r\n{text}".encode(coding))
    np.testing.assert_array_equal(read_body(path).stiffness, wanted.stiffness)
