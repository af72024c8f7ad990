"""Files of bodies as their programs, editors and other systems leave them: the same numbers."""

from __future__ import annotations

import re

import numpy as np
import pytest
from exchange_bodies import box, craig_bampton
from test_exchange_formats import CORNERS, abaqus_element

from flexcage.core.errors import InputError
from flexcage.modes.exchange import punch
from flexcage.modes.exchange.formats import read_body, write_body


@pytest.fixture(scope="module")
def body():
    return craig_bampton(box(), CORNERS, 0)


@pytest.fixture
def deck(body, tmp_path):
    lines = [f"{i + 1}, {x:.15g}, {y:.15g}, {z:.15g}" for i, (x, y, z) in enumerate(body.nodes)]
    (tmp_path / "box.inp").write_text("\n".join(["*NODE", *lines, ""]))
    return tmp_path / "box.inp"


def with_d(text: bytes) -> bytes:
    """Numbers as Fortran's double precision prints them."""
    return re.sub(rb"(?<=\d)[eE](?=[-+]\d)", b"D", text)


DIALECTS = {
    "latin-1": lambda text: text.replace(b"** ", b"** gr\xf6\xdfe ", 1),
    "utf-8": lambda text: text.replace(b"** ", "** größe ".encode(), 1),
    "with its mark": lambda text: b"\xef\xbb\xbf" + text,
    "windows": lambda text: text.replace(b"\n", b"\r\n"),
    "D": with_d,
    "d": lambda text: with_d(text).replace(b"D+", b"d+").replace(b"D-", b"d-"),
    "tabs": lambda text: text.replace(b", ", b",\t"),
    "blank lines": lambda text: text.replace(b"*MATRIX", b"\n*MATRIX"),
}


@pytest.mark.parametrize("name", DIALECTS)
def test_a_substructure_in_every_dialect(body, deck, tmp_path, name):
    text = abaqus_element(body.stiffness, body.mass, CORNERS + 1).encode()
    changed = DIALECTS[name](text)
    assert changed != text
    (tmp_path / "box.mtx").write_bytes(changed)
    read = read_body(tmp_path / "box.mtx", nodes=deck)
    np.testing.assert_allclose(read.stiffness, body.stiffness, rtol=1e-12, atol=1.0)
    np.testing.assert_allclose(read.mass, body.mass, rtol=1e-12, atol=1e-15)


PUNCHES = {
    "latin-1": lambda text: b"$ gr\xf6\xdfe\n" + text,
    "windows": lambda text: text.replace(b"\n", b"\r\n"),
    "E": lambda text: re.sub(rb"(?<=\d)D(?=[-+]\d)", b"E", text),
    "named continuations": lambda text: text.replace(b"\n*  ", b"\n*C "),
}


@pytest.mark.parametrize("grids", [False, True])
@pytest.mark.parametrize("name", PUNCHES)
def test_a_punch_in_every_dialect(body, deck, tmp_path, name, grids):
    """DMIG entries with their grids, or alone: their grids stand in another deck then."""
    pytest.importorskip("pyyeti")
    path = write_body(body, tmp_path / "box.pch")
    text = path.read_bytes() if grids else b"".join(path.read_bytes().partition(b"DMIG")[1:])
    changed = PUNCHES[name](text)
    assert changed != text
    path.write_bytes(changed)
    read = read_body(path, nodes="" if grids else deck)
    np.testing.assert_allclose(read.stiffness, body.stiffness, rtol=1e-8, atol=10.0)


def test_matrices_of_single_entries_are_told_a_way(deck, tmp_path):
    for text, words in (
        ("1,1, 1,1, 2.5e9\n1,2, 1,1, 1.0e8\n", r"Abaqus' \*MATRIX OUTPUT writes them; write"),
        ("** of Abaqus\n1 2 2.5D+09\n", r"Abaqus' \*MATRIX OUTPUT writes them; write"),
        ("%%MatrixMarket matrix coordinate real symmetric\n3 3 1\n1 1 2.0\n", "scipy.io.mmread"),
    ):
        (tmp_path / "box.mtx").write_text(text)
        with pytest.raises(InputError, match=words) as caught:
            read_body(tmp_path / "box.mtx", nodes=deck)
        assert "into an .npz as K and M" in str(caught.value)


@pytest.mark.parametrize("ending", [".npz", ".op4", ".pch", ".mtx"])
def test_what_libraries_say_of_their_insides_is_not_told(tmp_path, ending):
    """Files of nothing and of anything: one sentence of ours."""
    if ending in (".op4", ".pch"):
        pytest.importorskip("pyyeti")
    path = tmp_path / f"box{ending}"
    for content in (b"", b"\x00\xff\x10" * 300, b"hello, world\n" * 40):
        path.write_bytes(content)
        with pytest.raises(InputError) as caught:
            read_body(path)
        said = str(caught.value)
        for word in ("invalid literal", "unpack", "codec", "Errno", "index", "NoneType", "pickle"):
            assert word not in said, said
        assert "(there is nothing in it)" in said if not content else said.endswith(".")


def test_a_punch_of_all_nodes_is_refused_before_it_takes_memory(body, tmp_path, monkeypatch):
    """pyYeti makes full matrices of all: 24 columns here, of which six copies take 28 kB."""
    pytest.importorskip("pyyeti")
    path = write_body(body, tmp_path / "box.pch")
    monkeypatch.setattr(punch, "total_memory", lambda: 20e3)
    with pytest.raises(InputError, match="MAAX|KAAX has 2. columns, which as a full one take"):
        read_body(path)


@pytest.mark.filterwarnings("error")
def test_a_punch_with_damping_is_refused(tmp_path):
    """A complex DMIG matrix; once, its imaginary part was left out."""
    pytest.importorskip("pyyeti")
    entry = "DMIG    {:<8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}{:>8}\n"
    text = "".join(
        entry.format(name, 0, 6, kind, 0, "", "", "", 1)
        + entry.format(name, 1, 1, "", 1, 1, "1.0+6", imaginary, "")
        for name, kind, imaginary in (("KAAX", 4, "1.0+3"), ("MAAX", 2, ""))
    )
    (tmp_path / "k.pch").write_text(f"GRID    {1:>8}{0:>8}{0.0:>8}{1.0:>8}{0.0:>8}\n{text}")
    with pytest.raises(InputError, match="stiffness matrix is complex.*give damping as modes.damp"):
        read_body(tmp_path / "k.pch")
