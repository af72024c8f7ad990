"""A cage's basis from a body: what flexcage wrote comes back, what others wrote fits or not."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
from modes_cage import CAGE, POCKETS, cage_mesh
from test_bases import dynamic_answer, own_residual

from flexcage.cages.build import reduce_cage
from flexcage.core.errors import InputError
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.modes.exchange.body import MODAL, ReducedBody, rigid_motions
from flexcage.modes.exchange.cage import body_of, full_body_of, imported_model
from flexcage.modes.exchange.formats import read_body, write_body
from flexcage.modes.pockets import pocket_loads
from flexcage.modes.registry import basis_of_body, build_basis
from flexcage.modes.spec import ModesSpec


def taken(body, solver, **spec):
    return basis_of_body(body, solver, pocket_count=POCKETS, spec=ModesSpec(**spec))


@pytest.mark.parametrize("ending", [".npz", ".op4", ".mtx"])
def test_what_flexcage_writes_comes_back_to_the_bit(solver, basis, tmp_path, ending):
    if ending == ".op4":
        pytest.importorskip("pyyeti")
    path = write_body(body_of(basis, solver.model), tmp_path / f"cage{ending}")
    back = taken(read_body(path), solver)
    assert back.kind == basis.kind
    for name in ("shapes", "stiffness", "mass", "frequencies"):
        np.testing.assert_array_equal(getattr(back, name), getattr(basis, name), err_msg=name)
    for name in ("shapes", "stiffness", "compliance"):
        found, wanted = getattr(back.residual, name), getattr(basis.residual, name)
        np.testing.assert_array_equal(found, wanted, err_msg=name)
    assert back.residual.far_coupling == pytest.approx(basis.residual.far_coupling, rel=1e-9)
    assert back.fit.carried == pytest.approx(1.0, abs=1e-9)
    assert back.fit.stiffness == pytest.approx(1.0, abs=1e-6)


def test_rounding_in_what_flexcage_writes_is_not_refused(solver, basis, tmp_path):
    """A residual stiffness with an eigenvalue of -2e-9 of the largest, as coarse meshes have it."""
    stiffness = basis.residual.stiffness
    values, vectors = np.linalg.eigh(stiffness)
    lacking = (values[0] + 2e-9 * values[-1]) * np.outer(vectors[:, 0], vectors[:, 0])
    rounded = dataclasses.replace(basis.residual, stiffness=stiffness - lacking)
    worse = dataclasses.replace(basis, residual=rounded)
    assert np.linalg.eigvalsh(rounded.stiffness)[0] < -1e-9 * values[-1]
    back = taken(read_body(write_body(body_of(worse, solver.model), tmp_path / "cage.npz")), solver)
    assert np.abs(back.residual.stiffness - rounded.stiffness).max() < 5e-9 * values[-1]


@pytest.fixture(scope="module")
def craig_bampton(solver):
    spec = ModesSpec(kind="craig_bampton")
    return build_basis(solver.model, pocket_count=POCKETS, spec=spec, solver=solver)


@pytest.fixture(scope="module")
def foreign(solver, craig_bampton):
    """The same space as another program has it: rigid motions among its coordinates, all mixed,
    nodes in another order and with one more."""
    model = solver.model
    rigid = rigid_motions(model.nodes)
    shapes = np.concatenate([rigid * [1, 1, 1, 50, 50, 50], craig_bampton.shapes], axis=2)
    rng = np.random.default_rng(7)
    mix = np.linalg.qr(rng.standard_normal((shapes.shape[2],) * 2))[0]
    shapes = shapes @ mix
    order = rng.permutation(len(model.nodes))
    flat = shapes.reshape(model.n_dof, -1)
    extra = np.zeros((1, 3, shapes.shape[2]))
    return ReducedBody(
        stiffness=flat.T @ (model.K @ flat),
        mass=flat.T @ model.mass_times(flat),
        nodes=np.vstack([model.nodes[order], [[0.0, 1e-3, 0.0]]]),
        dofs=np.tile([MODAL, 0], (shapes.shape[2], 1)),
        shapes=np.concatenate([shapes[order], extra]),
        source="cage.op4",
    )


def without_extra(body):
    """Rigid motions show in the shapes of the cage's own nodes alone."""
    return dataclasses.replace(body, nodes=body.nodes[:-1], shapes=body.shapes[:-1])


def test_a_mixed_body_has_the_frequencies_of_its_space(solver, craig_bampton, foreign):
    back = taken(without_extra(foreign), solver, dynamic="all")
    assert back.size == craig_bampton.size  # the six rigid motions are left out
    np.testing.assert_allclose(back.frequencies, craig_bampton.frequencies, rtol=1e-5)
    loads = pocket_loads(solver.model, 3, POCKETS)
    ours, theirs = (loads.T @ dynamic_answer(b, loads) for b in (back, craig_bampton))
    np.testing.assert_allclose(ours, theirs, atol=1e-6 * np.abs(theirs).max())


def test_its_higher_modes_become_residual_flexibility(solver, craig_bampton, foreign):
    back = taken(without_extra(foreign), solver)
    assert back.size in (24, 25) and back.residual is not None
    loads = pocket_loads(solver.model, 3, POCKETS)
    ours = loads.T @ (dynamic_answer(back, loads) + own_residual(back, 3, loads))
    theirs = loads.T @ dynamic_answer(craig_bampton, loads)
    np.testing.assert_allclose(ours, theirs, atol=1e-6 * np.abs(theirs).max())
    assert 0.99 < back.fit.carried < 1.0


def test_a_body_of_few_modes_has_no_residual_and_says_what_it_carries(solver):
    spec = ModesSpec(kind="free_free", count=40)
    free = build_basis(solver.model, pocket_count=POCKETS, spec=spec, solver=solver)
    body = dataclasses.replace(body_of(free, solver.model), kind=())
    back = taken(body, solver)
    assert back.residual is None and back.size == free.size  # too few to be parted: all dynamic
    loads = pocket_loads(solver.model, 0, POCKETS)[:, [0, 4]]
    full = np.einsum("ij,ij->j", loads, solver.solve(loads))
    part = np.einsum("ij,ij->j", loads, dynamic_answer(free, loads))
    assert back.fit.carried == pytest.approx((part / full).min(), rel=1e-6)
    assert back.fit.carried < 0.97


@pytest.fixture(scope="module")
def linear():
    return assemble(cage_mesh(), MATERIALS["brass"], order=1)


def test_full_matrices_are_reduced_here(linear, tmp_path):
    """Residual flexibility and all: the basis is that of the same matrices assembled here."""
    spec = ModesSpec(count=12)
    body = read_body(write_body(full_body_of(linear), tmp_path / "cage.npz"))
    model = imported_model(body, linear, spec)
    theirs = build_basis(model, pocket_count=POCKETS, spec=spec)
    ours = build_basis(linear, pocket_count=POCKETS, spec=spec)
    np.testing.assert_allclose(theirs.frequencies, ours.frequencies, rtol=1e-7)
    wanted = ours.residual.compliance
    np.testing.assert_allclose(theirs.residual.compliance, wanted, atol=1e-6 * np.abs(wanted).max())


def test_full_matrices_of_another_material_count_as_given(linear, tmp_path):
    """Twice the modulus in the file, that of the case in the elements: frequencies times sqrt 2."""
    spec = ModesSpec(count=6, kind="free_free")
    body = full_body_of(linear)
    stiff = dataclasses.replace(body, stiffness=2.0 * body.stiffness)
    theirs = build_basis(imported_model(stiff, linear, spec), pocket_count=POCKETS, spec=spec)
    ours = build_basis(linear, pocket_count=POCKETS, spec=spec)
    np.testing.assert_allclose(theirs.frequencies, np.sqrt(2.0) * ours.frequencies, rtol=1e-7)


def test_a_reduction_takes_its_body_from_the_file(basis, solver, tmp_path):
    """Interface, table and key; the file counts by its bytes, wherever it lies."""
    path = write_body(body_of(basis, solver.model), tmp_path / "cage.npz")
    other = tmp_path / "copy.npz"
    other.write_bytes(path.read_bytes())
    made = [
        reduce_cage(cage_mesh(), cage=CAGE, defects=(), spec=ModesSpec(body=str(file)))
        for file in (path, other, "")
    ]
    assert made[0].key == made[1].key != made[2].key
    np.testing.assert_array_equal(made[0].interface.modes, made[2].interface.modes)
    np.testing.assert_array_equal(made[0].interface.compliance, made[2].interface.compliance)
    np.testing.assert_allclose(made[0].table.share, made[2].table.share, rtol=1e-12)
    assert made[0].fit is not None and made[2].fit is None


def test_a_body_whose_file_is_gone_is_not_the_cages_own(basis, solver, tmp_path):
    """With the cage's own basis on disk, from before."""
    spec = ModesSpec()
    reduce_cage(cage_mesh(), cage=CAGE, defects=(), spec=spec)
    for name in ("body", "body_nodes"):
        gone = dataclasses.replace(spec, **{name: str(tmp_path / "gone.npz")})
        with pytest.raises(InputError, match=r"There is no file '.*gone\.npz'") as caught:
            reduce_cage(cage_mesh(), cage=CAGE, defects=(), spec=gone)
        assert caught.value.where == f"modes.{name}"


# --- what does not fit ---------------------------------------------------------------------------


def refused(body, solver, words, **spec):
    with pytest.raises(InputError, match=words) as caught:
        taken(body, solver, **spec)
    assert str(caught.value).endswith(".") and "\n" not in str(caught.value)


def test_a_body_in_millimetres_is_named(solver, foreign):
    in_mm = dataclasses.replace(foreign, nodes=1e3 * foreign.nodes)
    refused(in_mm, solver, 'set modes.body_units = "mm-t-s"')


def test_a_body_in_grams_is_named(solver, foreign):
    own = without_extra(foreign)
    in_mm_kg = dataclasses.replace(own, mass=1e3 * own.mass, stiffness=1e3 * own.stiffness)
    refused(
        in_mm_kg, solver, "its mass is .* kg, that of the cage's mesh .* kg; give cage.material"
    )


def test_another_inertia_than_that_of_the_geometry(solver, foreign):
    """Mass added to the turning about x alone, as a lumped mass on a radius would not."""
    own = without_extra(foreign)
    turn = own.mass @ own.rigid[:, 3]
    heavier = own.mass + 0.1 * np.outer(turn, turn) / (own.rigid[:, 3] @ turn)
    refused(dataclasses.replace(own, mass=heavier), solver, "its inertia about x is")


def test_shapes_in_another_unit_than_the_matrices(solver, basis):
    free = dataclasses.replace(basis, residual=None)
    body = dataclasses.replace(body_of(free, solver.model), kind=(), source="cage.npz")
    wrong = dataclasses.replace(body, shapes=1.1 * body.shapes)
    refused(wrong, solver, "the mass of mode .* but its shape on the cage's mesh makes")


def test_nodes_of_another_mesh(solver, foreign):
    moved = dataclasses.replace(foreign, nodes=foreign.nodes + 2e-5)
    refused(moved, solver, "none within .* um of .* of the 8,748 nodes .* mesh.file")


def test_a_body_without_shapes_or_mass(solver, foreign):
    refused(
        dataclasses.replace(foreign, shapes=None), solver, "write their shapes as a matrix SHAPES"
    )
    refused(dataclasses.replace(foreign, mass=None), solver, "has no mass matrix")


def test_kinds_that_are_not_those_of_the_pockets(solver, basis):
    body = body_of(basis, solver.model)
    fewer = np.arange(body.size - 5)
    cut = dataclasses.replace(
        body,
        stiffness=body.stiffness[np.ix_(fewer, fewer)],
        mass=body.mass[np.ix_(fewer, fewer)],
        shapes=body.shapes[:, :, fewer],
        dofs=body.dofs[fewer],
        kind=body.kind[:-5],
    )
    refused(cut, solver, "139 residual coordinates, but a cage of 12 pockets has 96 or 144")
