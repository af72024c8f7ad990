from dataclasses import replace

import numpy as np
import pytest
from modes_cage import CAGE, DEFECTS, assert_same_fields, cage_mesh

from flexcage.bodies.cage import flexible_from_reduction
from flexcage.cages.build import reduce_cage
from flexcage.cages.window.interface import WINDOW_INTERFACES
from flexcage.modes import reduction
from flexcage.modes.spec import ModesSpec


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path))
    return tmp_path


def never(*args, **kwargs):
    raise AssertionError("made again")


def test_a_cached_basis_is_the_one_that_was_built(monkeypatch):
    mesh, spec = cage_mesh(), ModesSpec(count=4)
    built = reduce_cage(mesh, cage=CAGE, defects=(), spec=spec)
    monkeypatch.setattr(reduction, "build_basis", never)
    stored = reduce_cage(mesh, cage=CAGE, defects=(), spec=spec)
    assert (stored.basis.name, stored.basis.kind) == (built.basis.name, built.basis.kind)
    assert built.basis.geometric is None and stored.basis.geometric is None
    for name in ("shapes", "stiffness", "mass", "frequencies"):
        np.testing.assert_array_equal(getattr(stored.basis, name), getattr(built.basis, name))
    ours, theirs = stored.basis.residual, built.basis.residual
    assert ours.far_coupling == theirs.far_coupling
    for name in ("shapes", "stiffness", "compliance"):
        np.testing.assert_array_equal(getattr(ours, name), getattr(theirs, name))


def test_geometric_stiffening_comes_with_the_basis_and_with_the_cached_one():
    """A ring of brass at 1 rad/s: the ovals gain (n^2-1)^2/(n^2+1) = 9/5 (rad/s)^2, a cage nearly
    so; no mode loses."""
    mesh, spec = cage_mesh(), ModesSpec(count=4, crossbeams=False, geometric_stiffening=True)
    built = reduce_cage(mesh, cage=CAGE, defects=(), spec=spec).basis
    stored = reduce_cage(mesh, cage=CAGE, defects=(), spec=spec).basis
    assert built.geometric is not None and built.geometric.shape == (5, 5)
    np.testing.assert_array_equal(stored.geometric, built.geometric)
    gain = np.linalg.eigvalsh(built.geometric)
    assert gain[0] > 0.0
    in_plane = np.einsum("nai,nai->i", built.shapes[:, 1:], built.shapes[:, 1:]) / np.einsum(
        "nai,nai->i", built.shapes, built.shapes
    )
    oval = np.diag(built.geometric)[:4][in_plane[:4] > 0.8]
    assert len(oval) == 2
    np.testing.assert_allclose(oval, 1.8, rtol=0.1)


def test_a_run_needs_neither_matrices_nor_shapes_of_a_stored_reduction(monkeypatch):
    """Body and interface come from disk as they were made; what is asked for later is made then."""
    mesh, spec = cage_mesh(DEFECTS), ModesSpec(count=4)
    built = reduce_cage(mesh, cage=CAGE, defects=DEFECTS, spec=spec)
    body = flexible_from_reduction(built, spec)
    with monkeypatch.context() as patch:
        patch.setattr(reduction, "assemble", never)
        patch.setattr(reduction, "basis_from", never)
        stored = reduce_cage(mesh, cage=CAGE, defects=DEFECTS, spec=spec)
        again = flexible_from_reduction(stored, spec)
    assert_same_fields(stored.interface, built.interface)
    for name, value in body.data._asdict().items():
        np.testing.assert_array_equal(getattr(again.data, name), value, err_msg=name)
    assert type(again.data.mass) is float and type(again.data.plain) is int
    assert (stored.model.K != built.model.K).nnz == 0
    np.testing.assert_array_equal(stored.basis.shapes, built.basis.shapes)


def test_another_damping_makes_another_body_of_the_same_reduction():
    spec = ModesSpec(count=4)
    cage = reduce_cage(cage_mesh(), cage=CAGE, defects=(), spec=spec)
    some, twice = (
        flexible_from_reduction(cage, replace(spec, damping=d)).data for d in (0.01, 0.02)
    )
    np.testing.assert_allclose(twice.dff, 2.0 * some.dff)
    assert np.all(np.diag(some.dff) > 0.0)
    np.testing.assert_array_equal(twice.SS, some.SS)


def test_a_basis_made_anew_gets_an_interface_and_a_body_of_its_own(monkeypatch, folder):
    """Another build of the solver may find other modes of equal frequency, or the same reversed."""
    mesh, spec = cage_mesh(), ModesSpec(count=4)
    built = reduce_cage(mesh, cage=CAGE, defects=(), spec=spec)
    body = flexible_from_reduction(built, spec)
    (entry,) = (folder / "arrays" / "basis").glob("*.npz")
    entry.unlink()
    reversed_ = replace(built.basis, shapes=-built.basis.shapes)
    monkeypatch.setattr(reduction, "build_basis", lambda *args, **kwargs: reversed_)
    other = reduce_cage(mesh, cage=CAGE, defects=(), spec=spec)
    np.testing.assert_array_equal(other.interface.modes, -built.interface.modes)
    np.testing.assert_array_equal(flexible_from_reduction(other, spec).data.S, -body.data.S)


def test_a_stored_basis_that_is_gone_when_asked_for_is_made_again(folder):
    mesh, spec = cage_mesh(), ModesSpec(count=4)
    built = reduce_cage(mesh, cage=CAGE, defects=(), spec=spec)
    stored = reduce_cage(mesh, cage=CAGE, defects=(), spec=spec)
    (entry,) = (folder / "arrays" / "basis").glob("*.npz")
    entry.unlink()
    np.testing.assert_array_equal(stored.basis.shapes, built.basis.shapes)


def test_defects_and_sizes_name_the_interface():
    """On one mesh, as from a file, what the case says of pockets is the interface's own."""
    mesh, spec = cage_mesh(), ModesSpec(count=4)
    sound = reduce_cage(mesh, cage=CAGE, defects=(), spec=spec).interface
    bent = reduce_cage(mesh, cage=CAGE, defects=DEFECTS, spec=spec).interface
    longer = replace(CAGE, pocket_length=CAGE.pocket_length + 1e-5)
    other = reduce_cage(mesh, cage=longer, defects=(), spec=spec).interface
    assert not sound.offset.any() and bent.offset.any()
    assert other.stations[0, 0] == pytest.approx(sound.stations[0, 0] - 1e-5 * 3.0 / 7.0)


def test_a_cage_on_disk_is_read_without_matrices(monkeypatch):
    mesh, spec = cage_mesh(), ModesSpec(count=4)
    built = reduce_cage(mesh, cage=CAGE, defects=(), spec=spec)
    stored = reduce_cage(mesh, cage=CAGE, defects=(), spec=spec)
    for name in ("assemble_ring", "assemble_whole"):
        monkeypatch.setattr(f"flexcage.fem.model.{name}", never)
    np.testing.assert_array_equal(stored.model.nodes, built.model.nodes)
    np.testing.assert_array_equal(stored.shown.shapes, built.shown.shapes)


def test_the_same_cage_is_known_by_content():
    mesh, spec = cage_mesh(), ModesSpec(count=4)
    one = reduce_cage(mesh, cage=CAGE, defects=(), spec=spec)
    again = reduce_cage(cage_mesh(), cage=replace(CAGE), defects=(), spec=spec)
    bent = reduce_cage(mesh, cage=CAGE, defects=DEFECTS, spec=spec)
    fewer = reduce_cage(mesh, cage=CAGE, defects=(), spec=ModesSpec(count=3))
    assert one.same_as(again)
    assert not one.same_as(bent) and not one.same_as(fewer)
    assert one.once("a", lambda: [1]) is one.once("a", never)


def test_an_edited_cage_type_from_outside_has_its_interface_made_anew(monkeypatch):
    """The interface is kept on disk by all that it depends on, the type's own file included."""
    made = []

    def reduced(cage):
        made.append(cage)
        return WINDOW_INTERFACES.reduced(cage)

    interfaces = replace(WINDOW_INTERFACES, reduced=reduced)
    for edit, times in (("", 1), ("", 1), ("edited", 2), ("edited", 2)):
        monkeypatch.setattr(reduction, "source_of", lambda name, edit=edit: edit)
        cage = reduction.CageReduction(cage_mesh(), CAGE, (), ModesSpec(count=4), 2, interfaces)
        assert cage.interface.stations.shape == (4, 7) and len(made) == times
