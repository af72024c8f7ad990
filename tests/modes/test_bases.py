"""Reduced bases against full finite-element statics, and against each other."""

import dataclasses
from types import MappingProxyType

import numpy as np
import pytest
from modes_cage import CAGE, POCKETS

from flexcage.cages.window.interface import cage_interface
from flexcage.core.errors import InputError
from flexcage.core.hashing import content_hash
from flexcage.fem.free import FreeBodySolver
from flexcage.modes import registry, ritz
from flexcage.modes.pockets import pocket_loads
from flexcage.modes.registry import build_basis
from flexcage.modes.spec import DampingBand, ModesSpec


def dynamic_answer(basis, loads):
    shapes = basis.shapes.reshape(len(loads), -1)
    return shapes @ np.linalg.solve(basis.stiffness, shapes.T @ loads)


def own_residual(basis, pocket, loads):
    """The residual answer with the coupling between pockets cut."""
    m = basis.residual.compliance.shape[1]
    part = slice(m * pocket, m * pocket + m)
    shapes = basis.residual.shapes[:, :, part].reshape(len(loads), -1)
    return shapes @ (basis.residual.compliance[pocket] @ (shapes.T @ loads))


@pytest.mark.parametrize("pocket", [0, 2, 7])
@pytest.mark.parametrize("which", ["sound", "damaged"])
def test_reduced_deflection_is_the_full_one(request, which, pocket):
    """Modes plus the pocket's own residual vectors carry all of its loads exactly."""
    prefix = "" if which == "sound" else "damaged_"
    solver = request.getfixturevalue(prefix + "solver")
    basis = request.getfixturevalue(prefix + "basis")
    loads = pocket_loads(solver.model, pocket, POCKETS)
    full = solver.solve(loads)
    reduced = dynamic_answer(basis, loads) + own_residual(basis, pocket, loads)
    np.testing.assert_allclose(
        loads.T @ reduced, loads.T @ full, atol=1e-8 * np.abs(loads.T @ full).max()
    )
    assert np.abs(reduced - full).max() < 1e-8 * np.abs(full).max()
    missed = np.abs(dynamic_answer(basis, loads) - full).max(axis=0) / np.abs(full).max(axis=0)
    assert missed[0] > 0.005  # the modes alone are too stiff: the residual is needed


def test_linear_attachments_are_the_first_of_the_quadratic_ones(solver, basis):
    """Vectors do not depend on each other; an interface has zeros for those that are missing."""
    spec = ModesSpec(attachments="linear")
    linear = build_basis(solver.model, pocket_count=POCKETS, spec=spec, solver=solver)
    shapes = basis.residual.shapes.reshape(solver.model.n_dof, POCKETS, 12)[:, :, :8]
    found = linear.residual.shapes.reshape(solver.model.n_dof, POCKETS, 8)
    np.testing.assert_allclose(found, shapes, atol=1e-9 * np.abs(shapes).max())
    interface = cage_interface(solver.model, linear, pocket_count=POCKETS, cage=CAGE)
    assert interface.residual.shape[-1] == 12 and not interface.residual[..., 8:].any()
    np.testing.assert_array_equal(interface.compliance[:, :8, :8], linear.residual.compliance)
    assert not interface.compliance[:, 8:].any() and not interface.compliance[:, :, 8:].any()


def test_partial_contact_deflects_as_the_full_model(solver, basis):
    """A patch in the middle of a crossbeam, outside the span of the loads: within 2 %."""
    model = solver.model
    triangles = model.group("pocket4_front")
    patch = model.face_weights(triangles, lambda p: np.exp(-((p[:, 0] / 1.5e-3) ** 2))[None])
    angle = 2.0 * np.pi * 4 / POCKETS
    direction = [0.0, -np.sin(angle), np.cos(angle)]
    load = np.outer(patch.toarray()[0] / patch.sum(), direction).reshape(-1, 1)
    full = load.T @ solver.solve(load)
    reduced = load.T @ (dynamic_answer(basis, load) + own_residual(basis, 4, load))
    np.testing.assert_allclose(reduced, full, rtol=0.02)


def test_a_radial_and_axial_force_cost_what_the_full_model_says(solver, basis):
    """Friction directions have no residual vector: the answer may be too stiff, never too soft."""
    model = solver.model
    weights = model.face_weights(model.group("pocket1_front"), lambda p: np.ones((1, len(p))))
    for axis in range(3):
        load = np.outer(weights.toarray()[0] / weights.sum(), np.eye(3)[axis]).reshape(-1, 1)
        full = (load.T @ solver.solve(load)).item()
        reduced = (load.T @ (dynamic_answer(basis, load) + own_residual(basis, 1, load))).item()
        assert 0.9 * full < reduced < full * (1.0 + 1e-9)


def test_residual_vectors_are_orthogonal_to_the_modes(solver, basis):
    shapes = basis.shapes.reshape(solver.model.n_dof, -1)
    vectors = basis.residual.shapes.reshape(solver.model.n_dof, -1)
    stiffness = np.sqrt(np.outer(np.diag(basis.stiffness), np.diag(basis.residual.stiffness)))
    assert np.abs(shapes.T @ (solver.model.K @ vectors) / stiffness).max() < 1e-7
    mass = np.sqrt(np.einsum("ij,ij->j", vectors, solver.model.mass_times(vectors)))
    free = shapes[:, [k == "free" for k in basis.kind]]
    assert np.abs(free.T @ solver.model.mass_times(vectors) / mass).max() < 1e-8
    loads = pocket_loads(solver.model, 5, POCKETS)
    work = np.einsum("ij,ij->j", loads, vectors[:, 60:72])
    np.testing.assert_allclose(work, 1.0, rtol=1e-7)  # metres of mean displacement of its face


def test_coordinates_obey_their_stiffness(solver, basis):
    """stiffness a = Psi^T F reproduces the full residual answer for loads at several pockets."""
    loads = (
        pocket_loads(solver.model, 0, POCKETS)[:, :1]
        + pocket_loads(solver.model, 1, POCKETS)[:, 3:4]
    )
    vectors = basis.residual.shapes.reshape(solver.model.n_dof, -1)
    coordinates = np.linalg.solve(basis.residual.stiffness, vectors.T @ loads)
    full = solver.solve(loads)
    assert np.abs(dynamic_answer(basis, loads) + vectors @ coordinates - full).max() < 1e-8 * (
        np.abs(full).max()
    )


def test_coupling_that_is_cut_is_what_a_push_does_to_other_pockets(solver, basis):
    """Beyond what modes carry: under 6 % of what it does where it acts."""
    worst = 0.0
    own = [pocket_loads(solver.model, k, POCKETS) for k in range(POCKETS)]
    for face in range(4):
        push = own[0][:, 2 * face]
        full, kept = solver.solve(push[:, None])[:, 0], dynamic_answer(basis, push[:, None])[:, 0]
        for other in own[1:]:
            there = np.sqrt(np.einsum("ij,ij->j", other, solver.solve(other)))
            ratios = np.abs(other.T @ (full - kept)) / (there * np.sqrt(push @ full))
            worst = max(worst, float(ratios.max()))
    assert worst == pytest.approx(basis.residual.far_coupling, rel=0.02)
    assert worst < 0.06


def test_turned_vectors_equal_solved_ones(solver, basis, monkeypatch):
    monkeypatch.setattr(ritz, "find_symmetry", lambda *args, **kwargs: None)
    solved = build_basis(solver.model, pocket_count=POCKETS, spec=ModesSpec(), solver=solver)
    np.testing.assert_allclose(
        solved.residual.stiffness,
        basis.residual.stiffness,
        atol=1e-6 * np.abs(basis.residual.stiffness).max(),
    )


@pytest.mark.parametrize("which", ["sound", "damaged"])
def test_a_basis_by_parts_is_that_of_the_whole_ring(request, which):
    """A model that does not tell of its sectors is factored whole: the same space comes out."""
    ours = request.getfixturevalue({"sound": "basis", "damaged": "damaged_basis"}[which])
    told = request.getfixturevalue({"sound": "solver", "damaged": "damaged_solver"}[which]).model
    model = dataclasses.replace(told, info=MappingProxyType({}))
    theirs = build_basis(model, pocket_count=POCKETS, spec=ModesSpec())
    assert ours.kind == theirs.kind
    np.testing.assert_allclose(ours.frequencies, theirs.frequencies, rtol=1e-8)
    shapes, expected = (b.shapes.reshape(model.n_dof, -1) for b in (ours, theirs))
    within = shapes @ (shapes.T @ model.mass_times(expected))
    assert np.abs(within - expected).max() < 1e-8 * np.abs(expected).max()
    for name in ("shapes", "stiffness", "compliance"):
        found, wanted = getattr(ours.residual, name), getattr(theirs.residual, name)
        assert np.abs(found - wanted).max() < 1e-8 * np.abs(wanted).max()


@pytest.mark.parametrize(
    ("spec", "tolerance"),
    [
        (ModesSpec(dynamic="all"), 1e-8),
        (ModesSpec(kind="craig_bampton"), 5e-3),  # misses what inertia relief bends: fixed modes
    ],
)
def test_fully_dynamic_bases_give_the_same_static_answer(solver, basis, spec, tolerance):
    other = build_basis(solver.model, pocket_count=POCKETS, spec=spec, solver=solver)
    loads = pocket_loads(solver.model, 3, POCKETS)
    ours = loads.T @ (dynamic_answer(basis, loads) + own_residual(basis, 3, loads))
    theirs = loads.T @ dynamic_answer(other, loads)
    np.testing.assert_allclose(theirs, ours, atol=tolerance * np.abs(ours).max())
    shapes = other.shapes.reshape(solver.model.n_dof, -1)
    gram = shapes.T @ solver.model.mass_times(shapes)
    np.testing.assert_allclose(gram, np.eye(other.size), atol=1e-9)
    assert np.abs(solver.model.rigid_modes.T @ solver.model.mass_times(shapes)).max() < 1e-9
    np.testing.assert_allclose(other.frequencies[:6], basis.frequencies[:6], rtol=5e-3)
    assert np.all(other.frequencies[:6] > basis.frequencies[:6] * (1.0 - 1e-9))


def test_centrifugal_growth_needs_its_mode(solver, basis):
    """Spin of a free cage: the full answer is in the basis, and not in the low free modes."""
    load = ritz.centrifugal_load(solver)[:, None]
    full = solver.solve(load)
    reduced = dynamic_answer(basis, load)
    assert np.abs(reduced - full).max() < 1e-7 * np.abs(full).max()
    low = dataclasses.replace(
        basis, shapes=basis.shapes[:, :, :6], stiffness=basis.stiffness[:6, :6]
    )
    assert np.abs(dynamic_answer(low, load)).max() < 1e-3 * np.abs(full).max()
    radius = np.hypot(solver.model.nodes[:, 1], solver.model.nodes[:, 2])
    radial = np.einsum("na,na->n", full.reshape(-1, 3)[:, 1:], solver.model.nodes[:, 1:]) / radius
    material = solver.model.material
    thin_ring = material.density * 21.75e-3**3 / material.youngs_modulus
    assert 1.0 < radial.mean() / thin_ring < 2.5  # crossbeams are load, side beams carry it


def test_modulus_times_ten_thousand_makes_a_rigid_cage(solver, basis):
    model = solver.model
    lame = tuple(1e4 * x for x in model.form.lame)
    stiff = dataclasses.replace(model, form=dataclasses.replace(model.form, lame=lame))
    scaled = build_basis(
        stiff, pocket_count=POCKETS, spec=ModesSpec(), solver=FreeBodySolver(stiff)
    )
    np.testing.assert_allclose(scaled.frequencies, 100.0 * basis.frequencies, rtol=1e-8)
    np.testing.assert_allclose(
        scaled.residual.compliance,
        1e-4 * basis.residual.compliance,
        atol=1e-11 * np.abs(basis.residual.compliance).max(),
    )


def test_free_modes_alone_have_no_residual(solver):
    alone = build_basis(
        solver.model, pocket_count=POCKETS, spec=ModesSpec(kind="free_free", count=6), solver=solver
    )
    assert alone.residual is None and alone.size == 6


def test_bad_specs_are_refused(solver):
    with pytest.raises(InputError, match="not one of ritz"):
        build_basis(solver.model, pocket_count=POCKETS, spec=ModesSpec(kind="magic"))
    with pytest.raises(InputError, match="modes.count is 1,000,000, but"):
        build_basis(solver.model, pocket_count=POCKETS, spec=ModesSpec(count=10**6))
    with pytest.raises(InputError, match="pocket face groups"):
        build_basis(solver.model, pocket_count=POCKETS + 1, solver=solver)


def test_many_modes_are_warned_of_before_they_are_sought(solver, monkeypatch, caplog):
    def sought(*args, **kwargs):
        raise KeyboardInterrupt

    monkeypatch.setitem(registry.BUILDERS, "ritz", sought)
    for count, said in ((300, False), (301, True)):
        with pytest.raises(KeyboardInterrupt):
            build_basis(
                solver.model, pocket_count=POCKETS, spec=ModesSpec(count=count), solver=solver
            )
        assert ("modes.count is 301: finding so many" in caplog.text) is said


def test_damping_bands_override_the_common_ratio():
    spec = ModesSpec(damping=0.02, bands=(DampingBand(low=1e3, high=2e3, ratio=0.1),))
    np.testing.assert_allclose(
        spec.damping_ratios(np.array([500.0, 1500.0, 2000.0])), [0.02, 0.1, 0.02]
    )


def test_damping_ratios_mode_by_mode():
    """The last holds for the rest, those beyond the last mode for none; a band wins."""
    frequencies = np.array([500.0, 1500.0, 2000.0, 3000.0])
    spec = ModesSpec(damping=0.5, ratios=(0.01, 0.02, 0.03))
    np.testing.assert_array_equal(spec.damping_ratios(frequencies), [0.01, 0.02, 0.03, 0.03])
    np.testing.assert_array_equal(spec.damping_ratios(frequencies[:2]), [0.01, 0.02])
    spec = dataclasses.replace(spec, bands=(DampingBand(low=1e3, high=2e3, ratio=0.1),))
    np.testing.assert_array_equal(spec.damping_ratios(frequencies), [0.01, 0.1, 0.03, 0.03])
    assert content_hash(ModesSpec(ratios=())) == content_hash(ModesSpec())
    assert content_hash(ModesSpec(ratios=(0.01,))) != content_hash(ModesSpec())
