"""Bodies in files: round trips, files as other programs write them, and what is no body."""

from __future__ import annotations

import dataclasses
import re
import sys

import numpy as np
import pytest
import scipy.sparse as sp
from exchange_bodies import STEEL, box, craig_bampton, frequencies, full

from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.modes.exchange.checks import check_free, elastic_modes
from flexcage.modes.exchange.formats import read_body, write_body
from flexcage.modes.exchange.nastran import nastran
from flexcage.modes.exchange.systems import SYSTEMS
from flexcage.modes.exchange.table import body_table

CORNERS = np.array([0, 2, 6, 8, 18, 20, 24, 26])


@pytest.fixture(scope="module")
def model():
    return box()


@pytest.fixture(scope="module")
def body(model):
    return craig_bampton(model, CORNERS, 12)


def needs(ending):
    if ending in (".op4", ".pch"):
        pytest.importorskip("pyyeti")


@pytest.mark.parametrize("ending", [".npz", ".op4", ".mtx"])
def test_a_body_comes_back_to_the_bit(body, tmp_path, ending):
    needs(ending)
    back = read_body(write_body(body, tmp_path / f"box{ending}"))
    for name in ("stiffness", "mass", "nodes", "shapes", "dofs"):
        wanted = getattr(body, name)
        if name in ("stiffness", "mass"):
            wanted = 0.5 * (wanted + wanted.T) if ending == ".mtx" else wanted
        np.testing.assert_array_equal(getattr(back, name), wanted, err_msg=name)


def test_an_op4_as_text_comes_back_to_rounding(body, tmp_path):
    needs(".op4")
    path = write_body(body, tmp_path / "box.op4", binary=False)
    assert path.read_bytes().isascii()
    back = read_body(path)
    np.testing.assert_allclose(back.stiffness, body.stiffness, rtol=1e-15)
    np.testing.assert_array_equal(back.dofs, body.dofs)


def test_a_punch_comes_back_to_its_nine_digits(body, tmp_path):
    needs(".pch")
    back = read_body(write_body(body, tmp_path / "box.pch"))
    assert back.shapes is None  # DMIG has no place for them
    np.testing.assert_array_equal(back.dofs, body.dofs)
    np.testing.assert_allclose(back.nodes, body.nodes, rtol=1e-8)
    np.testing.assert_allclose(frequencies(back), frequencies(body), rtol=1e-6)


def test_sparse_matrices_stay_sparse(model, tmp_path):
    whole = dataclasses.replace(
        full(model), stiffness=model.K, mass=sp.kron(model.mass_scalar, np.eye(3)).tocsr()
    )
    for ending in (".npz", ".op4"):
        needs(ending)
        back = read_body(write_body(whole, tmp_path / f"box{ending}"))
        assert sp.issparse(back.stiffness) and back.is_full
        assert abs(back.stiffness - whole.stiffness).max() == 0.0


def grids(nodes, numbers=None, *, system=0):
    numbers = range(1, len(nodes) + 1) if numbers is None else numbers
    lines = ["$ nodes", "BEGIN BULK"]
    for number, place in zip(numbers, nodes):
        x, y, z = (f"{c:16.9E}" for c in place)
        lines += [f"GRID*   {number:16d}{system:16d}{x}{y}", f"*       {z}"]
    return "\n".join([*lines, "ENDDATA", ""])


def test_nastran_matrices_with_their_grids(model, body, tmp_path):
    """KAAX and MAAX of an a-set: boundary grids in rising order, then the modal points."""
    needs(".op4")
    op4 = nastran("op4")
    path, deck = tmp_path / "extse.op4", tmp_path / "extse.bdf"
    op4.write(str(path), {"kaax": body.stiffness, "maax": body.mass})
    deck.write_text(grids(model.nodes[CORNERS], 10 + CORNERS))
    back = read_body(path, nodes=deck)
    assert len(back.boundary) == 8 and (back.dofs[24:, 0] == -1).all() and back.shapes is None
    np.testing.assert_allclose(frequencies(back), frequencies(body), rtol=1e-9)
    check_free(back, where="body")
    whole = back.rigid.T @ back.mass @ back.rigid
    assert whole[0, 0] == pytest.approx(model.mass, rel=1e-9)


def test_six_degrees_of_freedom_a_grid(tmp_path):
    """A stiff beam of two grids (Euler-Bernoulli, L = 0.4 m): both rotations and rigid motions."""
    needs(".op4")
    op4 = nastran("op4")
    length, EI, EA, GJ = 0.4, 3.0, 7.0, 2.0
    k = np.zeros((12, 12))
    k[np.ix_([0, 6], [0, 6])] = EA / length * np.array([[1, -1], [-1, 1]])
    k[np.ix_([3, 9], [3, 9])] = GJ / length * np.array([[1, -1], [-1, 1]])
    bend = EI / length**3 * np.array([
        [12, 6 * length, -12, 6 * length],
        [6 * length, 4 * length**2, -6 * length, 2 * length**2],
        [-12, -6 * length, 12, -6 * length],
        [6 * length, 2 * length**2, -6 * length, 4 * length**2],
    ])  # fmt: skip
    k[np.ix_([1, 5, 7, 11], [1, 5, 7, 11])] = bend
    turn = np.diag([1.0, -1.0, 1.0, -1.0])
    k[np.ix_([2, 4, 8, 10], [2, 4, 8, 10])] = turn @ bend @ turn
    op4.write(str(tmp_path / "beam.op4"), {"KAA": k, "MAA": np.eye(12)})
    (tmp_path / "beam.bdf").write_text(grids([[0.1, 0.2, 0.3], [0.5, 0.2, 0.3]]))
    beam = read_body(tmp_path / "beam.op4", nodes=tmp_path / "beam.bdf")
    assert beam.dofs[5].tolist() == [0, 5] and beam.dofs[6].tolist() == [1, 0]
    check_free(beam, where="body")


def abaqus_element(stiffness, mass, nodes):
    """A substructure as Abaqus prints it: four numbers a line, a comma at the end of a row."""
    lines = [
        "** ABAQUS SUBSTRUCTURE Z1",
        f"*USER ELEMENT, NODES= {len(nodes)}, LINEAR",
        "** ELEMENT NODES",
    ]
    lines += [
        f"**    {', '.join(str(n) for n in nodes[i : i + 4])}" for i in range(0, len(nodes), 4)
    ]
    lines += ["1, 2, 3"]
    for name, matrix in (("STIFFNESS", stiffness), ("MASS", mass)):
        lines.append(f"*MATRIX,TYPE={name}")
        for i in range(len(matrix)):
            row = [f"{v:22.15e}" for v in matrix[i, : i + 1]]
            lines += [", ".join(row[j : j + 4]) + "," for j in range(0, len(row), 4)]
    return "\n".join(lines) + "\n"


def test_an_abaqus_substructure_in_millimetres(model, tmp_path):
    """N, mm, t: stiffness in N/mm, mass in t; nodes from the deck that made it."""
    static = craig_bampton(model, CORNERS, 0)
    text = abaqus_element(static.stiffness * 1e-3, static.mass * 1e-3, CORNERS + 1)
    (tmp_path / "z1.mtx").write_text(text)
    deck = ["*NODE, NSET=ALL"] + [f"{i + 1}, {x:.12g}, {y:.12g}, {z:.12g}"
                                  for i, (x, y, z) in enumerate(model.nodes * 1e3)]  # fmt: skip
    deck += ["*NSET, NSET=Seat", "1, 3", "*NSET, NSET=row, GENERATE", "7, 27, 10"]
    (tmp_path / "job.inp").write_text("\n".join(deck) + "\n")
    read = read_body(tmp_path / "z1.mtx", nodes=tmp_path / "job.inp", units="mm-t-s")
    np.testing.assert_allclose(read.stiffness, static.stiffness, rtol=1e-12, atol=1e-3)
    np.testing.assert_allclose(read.mass, static.mass, rtol=1e-12, atol=1e-18)
    np.testing.assert_allclose(read.nodes, model.nodes, rtol=1e-10)
    assert read.interface["seat"].tolist() == [0, 2] and read.interface["row"].tolist() == [
        6,
        16,
        26,
    ]


def test_a_substructure_in_the_layout_of_calculix(model, tmp_path):
    """It lists a node once for every degree of freedom, and one component a line."""
    static = craig_bampton(model, CORNERS, 0)
    lines = abaqus_element(static.stiffness, static.mass, np.repeat(CORNERS + 1, 3)).splitlines()
    dofs = ["         1"] + [f"{i + 1:10d},{i % 3 + 1:10d}" for i in range(1, 24)]
    at, stop = lines.index("1, 2, 3"), lines.index("*MATRIX,TYPE=MASS")
    (tmp_path / "box.mtx").write_text("\n".join([*lines[:at], *dofs, *lines[at + 1 : stop], ""]))
    deck = ["*NODE"] + [
        f"{i + 1},{x:.15g},{y:.15g},{z:.15g}" for i, (x, y, z) in enumerate(model.nodes)
    ]
    (tmp_path / "box.inp").write_text("\n".join([*deck, ""]))
    read = read_body(tmp_path / "box.mtx", nodes=tmp_path / "box.inp")
    np.testing.assert_array_equal(read.dofs, static.dofs)
    np.testing.assert_allclose(read.stiffness, static.stiffness, rtol=1e-9)
    assert read.mass is None
    with pytest.raises(InputError, match="no mass matrix, which motion needs"):
        check_free(read, where="body")


def test_rows_of_calculix_that_nobody_condensed_are_refused(model, tmp_path):
    """Version 2.20 writes K_rr of a bar's retained corners as assembled (to its 13 digits); the
    condensed one has forces between any two nodes and passes."""
    held = (3 * CORNERS[:, None] + np.arange(3)).ravel()
    assembled = full(model).stiffness[np.ix_(held, held)]
    condensed = craig_bampton(model, CORNERS, 0).stiffness
    deck = ["*NODE"] + [
        f"{i + 1},{x:.15g},{y:.15g},{z:.15g}" for i, (x, y, z) in enumerate(model.nodes)
    ]
    (tmp_path / "box.inp").write_text("\n".join([*deck, ""]))
    for stiffness, refused in ((assembled, True), (condensed, False)):
        lines = abaqus_element(stiffness, stiffness, CORNERS + 1).splitlines()
        lines = [
            "**",
            "** GENERATION OF SUBSTRUCTURE",
            *lines[1 : lines.index("*MATRIX,TYPE=MASS")],
        ]
        (tmp_path / "box.mtx").write_text("\n".join([*lines, ""]))
        if refused:
            with pytest.raises(
                InputError, match="28 pairs of the 8 nodes .* CalculiX wrote the rows"
            ):
                read_body(tmp_path / "box.mtx", nodes=tmp_path / "box.inp")
        else:
            assert read_body(tmp_path / "box.mtx", nodes=tmp_path / "box.inp").size == 24


@pytest.mark.parametrize("units", SYSTEMS)
def test_units_keep_mass_and_frequencies(body, tmp_path, units):
    """A body in other units, written by hand: one length, mass and time each."""
    s = SYSTEMS[units]
    moves = np.where(body.dofs[:, 0] >= 0, s.length, 1.0)  # modal coordinates keep their scale
    energy = s.mass * s.length**2 / s.time**2
    foreign = dataclasses.replace(
        body,
        stiffness=body.stiffness * np.outer(moves, moves) / energy,
        mass=body.mass * np.outer(moves, moves) / (energy * s.time**2),
        nodes=body.nodes / s.length,
        shapes=body.shapes * moves / s.length,
    )
    back = read_body(write_body(foreign, tmp_path / "box.npz"), units=units)
    np.testing.assert_allclose(frequencies(back), frequencies(body), rtol=1e-8)
    np.testing.assert_allclose(back.shapes, body.shapes, rtol=1e-12)
    mass = back.rigid[:, 0] @ back.mass @ back.rigid[:, 0]
    assert mass == pytest.approx(STEEL.density * 40e-3 * 20e-3 * 10e-3, rel=1e-9)


def test_the_table_says_mass_centre_and_frequencies(model, body):
    text = body_table(body)
    middle = model.nodes.mean(axis=0) * 1e3
    assert f"mass {model.mass:.5g} kg" in text
    assert f"centre ({', '.join(f'{c:.4g}' for c in middle)}) mm" in text
    assert f"{frequencies(body)[0]:9.1f} Hz" in text


def test_elastic_modes_are_those_of_the_matrices(body):
    values, turns = elastic_modes(body, where="body")
    np.testing.assert_allclose(np.sqrt(values) / (2 * np.pi), frequencies(body), rtol=1e-9)
    stiffness, mass = body.dense()
    np.testing.assert_allclose(turns.T @ mass @ turns, np.eye(len(values)), atol=1e-9)
    assert np.abs(body.rigid.T @ mass @ turns).max() < 1e-9


# --- what is no body -----------------------------------------------------------------------------


def broken(body, **changes):
    return dataclasses.replace(body, **changes)


def asymmetric(matrix):
    out = matrix.copy()
    out[0, 1] += 0.01 * np.abs(matrix).max()
    return out


def negative(matrix):
    values, vectors = np.linalg.eigh(matrix)
    values[-3] *= -0.5
    return (vectors * values) @ vectors.T


BAD = {
    "asymmetric": (
        lambda b: broken(b, stiffness=asymmetric(b.stiffness)),
        "stiffness matrix is not symmetric",
    ),
    "negative": (
        lambda b: broken(b, stiffness=negative(b.stiffness)),
        "1 of its 36 eigenvalues are negative",
    ),
    "zero": (lambda b: broken(b, mass=0.0 * b.mass), "the mass matrix is zero"),
    "not finite": (lambda b: broken(b, mass=b.mass * np.nan), "no real numbers"),
    "other sizes": (lambda b: broken(b, mass=b.mass[:9, :9]), "9 x 9, but with 36 coordinates"),
    "shapes of others": (lambda b: broken(b, shapes=b.shapes[:, :, :4]), "should have 36 columns"),
}  # fmt: skip


@pytest.mark.parametrize("name", BAD)
def test_matrices_that_are_none(body, tmp_path, name):
    change, words = BAD[name]
    path = tmp_path / "box.npz"
    made = change(body)
    arrays = {"K": made.stiffness, "M": made.mass, "NODES": made.nodes}
    arrays |= {"SHAPES": made.shapes.reshape(81, -1)}
    np.savez(path, **arrays)
    with pytest.raises(InputError, match=re.escape(words)) as caught:
        read_body(path)
    assert str(caught.value).count(". ") == 0 and "box.npz" in str(caught.value)


def test_a_body_that_is_held_says_which_motion(body):
    spring = body.stiffness.copy()
    spring[2, 2] += 1e-3 * spring[2, 2]  # of corner 0 along z
    with pytest.raises(InputError, match="resists being (moved along z|turned about)"):
        check_free(broken(body, stiffness=spring), where="body")


def test_a_body_in_two_parts_has_a_singular_stiffness(body):
    zero = np.zeros_like(body.stiffness)
    twice = broken(
        body,
        stiffness=np.block([[body.stiffness, zero], [zero, body.stiffness]]),
        mass=np.block([[body.mass, zero], [zero, body.mass]]),
        dofs=np.vstack([body.dofs, body.dofs]),
        shapes=np.concatenate([body.shapes, body.shapes], axis=2),
    )
    with pytest.raises(InputError, match="singular: beside its rigid motions 6 of 66 motions"):
        elastic_modes(twice, where="body")


def test_coordinates_without_mass_follow_statically(body):
    """A massless coordinate beside the body, on a spring to one of its own: nothing changes but
    for the compliance; a mass matrix of lower rank is no mistake."""
    n, k = body.size, 1e7
    stiffness, mass = np.zeros((n + 1, n + 1)), np.zeros((n + 1, n + 1))
    stiffness[:n, :n], mass[:n, :n] = body.stiffness, body.mass
    stiffness[np.ix_([n - 1, n], [n - 1, n])] += k * np.array([[1.0, -1.0], [-1.0, 1.0]])
    more = broken(
        body,
        stiffness=stiffness,
        mass=mass,
        dofs=np.vstack([body.dofs, [[-1, 0]]]),
        shapes=np.concatenate([body.shapes, body.shapes[:, :, :1]], axis=2),
    )
    values, _ = elastic_modes(more, where="body")
    np.testing.assert_allclose(np.sqrt(values) / (2 * np.pi), frequencies(body), rtol=1e-8)


FILES = {
    "cage.mnf": "modal neutral file, whose format is closed; write the same reduction",
    "cage.cdb": "Ansys mesh without matrices",
    "cage.full": "Ansys matrix file in binary",
    "cage.mat": "is of MATLAB; read it by scipy.io.loadmat, and write arrays K, M, NODES",
    "cage.op2": "is Nastran's OUTPUT2 in binary; write Nastran's EXTSEOUT(DMIGPCH)",
    "cage.unv": "is a universal file, whose datasets hold modes or responses and no stiffness",
    "cage.rst": "is an Ansys database in binary; export its matrices in APDL",
    "cage.bdf": "is a Nastran deck; name it as body_nodes",
    "cage.pch.gz": "is packed; unpack it",
    "cage.xyz": "no file of a reduced body that can be read: .npz, .op4, .pch, .mtx",
    "none.npz": "There is no file",
}


@pytest.mark.parametrize("name", FILES)
def test_files_that_are_refused(tmp_path, name):
    if not name.startswith("none"):
        (tmp_path / name).write_bytes(b"?")
    with pytest.raises(InputError, match=re.escape(FILES[name])):
        read_body(tmp_path / name)


def arrays_of(body, **changed):
    """What an .npz of a script holds: coordinates named, as in ``changed``."""
    labels = np.stack([body.dofs[:, 0] + 1, body.dofs[:, 1] + 1], axis=1)
    return {"K": body.stiffness, "M": body.mass, "NODES": body.nodes, "DOFS": labels, **changed}


ARRAYS = {
    "components from 0": (lambda b: {"DOFS": b.dofs + [1, 0]}, "count components from 0; count"),
    "all from 0": (lambda b: {"DOFS": b.dofs}, "from 0; count both from 1"),
    "nodes from 0": (lambda b: {"DOFS": b.dofs + [0, 1]}, "count nodes from 0; count both"),
    "components over 6": (lambda b: {"DOFS": b.dofs + [1, 7]}, "have the component 9, but"),
    "texts": (lambda b: {"K": b.stiffness.astype(str)}, "K is texts, but should be a table of"),
    "a vector": (lambda b: {"M": np.diag(b.mass)}, "M is an array of 1 dimensions, but"),
    "nodes as texts": (lambda b: {"NODES": b.nodes.astype(str)}, "NODES is texts, but should be a"),
    "nodes transposed": (lambda b: {"NODES": b.nodes.T}, "should have 3 columns; write it transp"),
    "nodes with numbers": (
        lambda b: {"NODES": np.column_stack([np.arange(len(b.nodes)), b.nodes])},
        "x 4, but should have 3 columns.",
    ),
    "labels transposed": (lambda b: {"DOFS": b.dofs.T + 1}, "should have 2 columns; write it tran"),
    "shapes transposed": (
        lambda b: {"SHAPES": b.shapes.reshape(-1, b.size).T, "DOFS": None},
        "columns; write it transposed",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", ARRAYS)
def test_arrays_in_another_order_are_refused(model, body, tmp_path, name):
    """Once, those of another width went into rows of the right one, in a wrong order, and labels
    from 0 made modal coordinates of nodes' own."""
    change, words = ARRAYS[name]
    plain = full(model)
    modal = body if name.startswith("shapes") else plain
    arrays = arrays_of(plain) if modal is plain else {"K": body.stiffness, "M": body.mass,
                                                       "NODES": body.nodes}  # fmt: skip
    arrays |= change(modal)
    np.savez(tmp_path / "box.npz", **{k: v for k, v in arrays.items() if v is not None})
    with pytest.raises(InputError, match=re.escape(words)):
        read_body(tmp_path / "box.npz")


def test_one_sparse_matrix_is_told_how_to_write_two(body, tmp_path):
    sp.save_npz(tmp_path / "k.npz", sp.csr_matrix(body.stiffness))
    with pytest.raises(InputError, match="is one sparse matrix, .* each as K.data"):
        read_body(tmp_path / "k.npz")


@pytest.mark.parametrize("ending", [".npz", ".op4", ".mtx", ".pch"])
def test_files_that_are_cut_short(body, tmp_path, ending):
    needs(ending)
    path = write_body(body, tmp_path / f"box{ending}")
    path.write_bytes(path.read_bytes()[: 3000 if ending == ".npz" else 9000])
    with pytest.raises(InputError):
        read_body(path)


def test_nodes_must_be_somewhere(body, tmp_path):
    np.savez(tmp_path / "box.npz", K=body.stiffness, M=body.mass)
    with pytest.raises(InputError, match="name a deck with them .* as body_nodes"):
        read_body(tmp_path / "box.npz")
    with pytest.raises(InputError, match="no file of nodes"):
        read_body(tmp_path / "box.npz", nodes=tmp_path / "nodes.txt")


def test_grids_that_move_in_a_system_of_their_own(model, body, tmp_path):
    """Two corners move in a system turned about z, matrices with them: the same body comes back."""
    needs(".op4")
    op4 = nastran("op4")
    turn = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])  # rows: x, y, z of it
    whole = np.eye(body.size)
    for corner in (1, 4):
        own = slice(3 * corner, 3 * corner + 3)
        whole[own, own] = turn
    path, deck = tmp_path / "extse.op4", tmp_path / "extse.asm"
    op4.write(
        str(path), {"KXX": whole @ body.stiffness @ whole.T, "MXX": whole @ body.mass @ whole.T}
    )
    lines = ["CORD2R*                7               0 0.000000000E+00 0.000000000E+00",
             "*        0.000000000E+00 0.000000000E+00 0.000000000E+00 0.100000000E+01",
             "*        0.000000000E+00 0.100000000E+01 0.000000000E+00"]  # fmt: skip
    for k, place in enumerate(model.nodes[CORNERS]):
        x, y, z = (f"{c:16.9E}" for c in place)
        lines += [f"GRID*   {k + 1:16d}{0:16d}{x}{y}", f"*       {z}{7 if k in (1, 4) else 0:16d}"]
    deck.write_text("\n".join([*lines, ""]))
    back = read_body(path, nodes=deck)
    np.testing.assert_allclose(back.stiffness, body.stiffness, atol=1e-9 * body.stiffness.max())
    np.testing.assert_allclose(back.mass, body.mass, atol=1e-9 * body.mass.max())
    check_free(back, where="body")


def test_shapes_with_rotations(model, body, tmp_path):
    """Six rows a node, as PHIG has them: the translations are taken."""
    needs(".op4")
    op4 = nastran("op4")
    six = np.zeros((len(model.nodes), 6, body.size))
    six[:, :3] = body.shapes
    six[:, 3:] = 7.0
    arrays = {"KAA": body.stiffness, "MAA": body.mass, "PHIG": six.reshape(-1, body.size)}
    op4.write(str(tmp_path / "cage.op4"), arrays)
    (tmp_path / "cage.bdf").write_text(grids(model.nodes))
    back = read_body(tmp_path / "cage.op4", nodes=tmp_path / "cage.bdf")
    np.testing.assert_array_equal(back.shapes, body.shapes)


def test_a_reader_that_is_not_installed_is_named(body, tmp_path, monkeypatch):
    needs(".op4")
    path = write_body(body, tmp_path / "box.op4")
    for name in [n for n in sys.modules if n == "pyyeti" or n.startswith("pyyeti.")]:
        monkeypatch.setitem(sys.modules, name, None)
    monkeypatch.setitem(sys.modules, "pyyeti", None)
    with pytest.raises(EnvironmentLacks, match=re.escape("pip install '.[bodies]'")):
        read_body(path)


def test_reading_leaves_numpys_texts_alone(body, tmp_path):
    """pyYeti asks for twelve digits in all texts, files of results among them."""
    needs(".op4")
    before = np.get_printoptions()
    read_body(write_body(body, tmp_path / "box.op4"))
    assert np.get_printoptions() == before and str(np.float64(0.1 + 0.2)) == "0.30000000000000004"
