"""Which coordinates are modal is told by stiffness where a file does not say: decks that lack a
node, or have one too many."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from exchange_bodies import box, craig_bampton
from test_exchange_formats import CORNERS, abaqus_element, grids

from flexcage.core.errors import InputError
from flexcage.modes.exchange.formats import read_body, write_body
from flexcage.modes.exchange.nastran import nastran


@pytest.fixture(scope="module")
def model():
    return box()


def held(body):
    """The body on a spring at its third node: no rigid motion tells what is wrong, as in a housing
    that stands on the ground."""
    stiffness = body.stiffness.copy()
    stiffness[6:9, 6:9] += 1e9 * np.eye(3)
    return dataclasses.replace(body, stiffness=stiffness)


def outputs(body, nodes, tmp_path):
    """Matrices without the names of their rows, and a deck of ``nodes``."""
    pytest.importorskip("pyyeti")
    path, deck = tmp_path / "housing.op4", tmp_path / "housing.bdf"
    nastran("op4").write(str(path), {"KAAX": body.stiffness, "MAAX": body.mass})
    deck.write_text(grids(nodes))
    return path, deck


@pytest.mark.parametrize("modes", [0, 12])
@pytest.mark.parametrize("lacking", [0, 4, 7])
def test_a_deck_that_lacks_a_grid_is_refused(model, tmp_path, modes, lacking):
    body = held(craig_bampton(model, CORNERS, modes))
    path, deck = outputs(body, model.nodes[CORNERS], tmp_path)
    back = read_body(path, nodes=deck)
    assert len(back.boundary) == 8 and (back.dofs[:, 0] == -1).sum() == modes
    deck.write_text(grids(model.nodes[np.delete(CORNERS, lacking)]))
    words = f"the {modes + 3} after those of its 7 nodes are not modal.* as body_nodes"
    with pytest.raises(InputError, match=words):
        read_body(path, nodes=deck)


@pytest.mark.parametrize("modes", [3, 12])
def test_a_deck_with_a_grid_too_many_is_refused(model, tmp_path, modes):
    body = held(craig_bampton(model, CORNERS, modes))
    nodes = np.concatenate([model.nodes[CORNERS], [[0.0, 0.0, 0.0]]])
    path, deck = outputs(body, nodes, tmp_path)
    with pytest.raises(InputError, match="would be of node 9 have no stiffness in common"):
        read_body(path, nodes=deck)


def test_as_many_modes_as_coordinates_of_nodes_are_no_rotations(model, tmp_path):
    """48 coordinates of 8 nodes may be six of each, or three and 24 modes."""
    body = craig_bampton(model, CORNERS, 24)
    path, deck = outputs(body, model.nodes[CORNERS], tmp_path)
    np.testing.assert_array_equal(read_body(path, nodes=deck).dofs[24:, 0], -1)


def punched(body, tmp_path):
    pytest.importorskip("pyyeti")
    path = write_body(dataclasses.replace(body, numbers=CORNERS + 1), tmp_path / "box.pch")
    first = path.read_text().index("GRID*                 19")
    text = path.read_text()
    path.write_text(text[:first] + text[text.index("GRID*", first + 1) :])
    return path, ""


def element(body, tmp_path):
    path, deck = tmp_path / "box.mtx", tmp_path / "box.inp"
    path.write_text(abaqus_element(body.stiffness, body.mass, CORNERS + 1))
    kept = [(n + 1, *p) for n, p in zip(CORNERS, body.nodes) if n != 18]
    deck.write_text("*NODE\n" + "\n".join(", ".join(map(str, row)) for row in kept))
    return path, deck


def own_element(body, tmp_path):
    path = write_body(dataclasses.replace(body, numbers=CORNERS + 1), tmp_path / "box.mtx")
    lines = path.read_text().splitlines()
    path.write_text("\n".join(line for line in lines if not line.startswith("19, ")))
    return path, ""


def arrays(body, tmp_path):
    dofs = [(n + 1, c) for n in CORNERS for c in (1, 2, 3)]
    keep = CORNERS != 18
    np.savez(
        tmp_path / "box.npz", K=body.stiffness, M=body.mass, NODES=body.nodes[keep],
        NUMBERS=CORNERS[keep] + 1, DOFS=dofs,
    )  # fmt: skip
    return tmp_path / "box.npz", ""


@pytest.mark.parametrize("make", [punched, element, own_element, arrays])
def test_coordinates_of_a_node_without_a_place_are_no_modes(model, tmp_path, make):
    whole = held(craig_bampton(model, CORNERS, 0, shapes=False))
    body = dataclasses.replace(
        whole,
        nodes=model.nodes[CORNERS],
        dofs=np.stack(np.divmod(np.arange(24), 3), axis=1),
    )
    path, deck = make(body, tmp_path)
    with pytest.raises(InputError, match=r"nodes without a place \(19\), and they are not modal"):
        read_body(path, nodes=deck)


def test_coordinates_that_are_named_modal_may_be_coupled(model, tmp_path):
    """Other reductions than Craig and Bampton's, which a file names in full."""
    body = craig_bampton(model, CORNERS, 4, shapes=False)
    mixed = np.eye(28)
    mixed[:24, 24:] = 1e-6
    dofs = [(n + 1, c) for n in CORNERS for c in (1, 2, 3)] + [(99 + i, 0) for i in range(4)]
    np.savez(tmp_path / "box.npz", K=mixed.T @ body.stiffness @ mixed, NODES=model.nodes, DOFS=dofs)
    assert len(read_body(tmp_path / "box.npz").boundary) == 8
