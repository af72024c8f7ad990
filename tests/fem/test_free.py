"""Free-body statics and modes against closed forms and invariants."""

import dataclasses

import numpy as np
import pytest
from solids import box, ring

from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.fem.model import assemble
from flexcage.fem.symmetry import find_symmetry
from flexcage.geometry.materials import Material

STEEL = Material(name="V6 steel", youngs_modulus=207e9, poisson_ratio=0.3, density=7800.0)
NO_POISSON = dataclasses.replace(STEEL, poisson_ratio=0.0)
RING = (49e-3, 51e-3, 10e-3)  # bore and rim radius, width


def frequencies(model, count):
    omega2, _ = free_modes(FreeBodySolver(model), count)
    return np.sqrt(omega2) / (2.0 * np.pi)


def test_static_answer_balances_loads_and_holds_no_rigid_motion():
    model = assemble(box((8e-3, 2e-3, 3e-3), (4, 2, 2)), STEEL)
    loads = np.random.default_rng(0).normal(size=(model.n_dof, 3))
    moved = FreeBodySolver(model).solve(loads)
    balanced = model.balance(loads)
    assert np.abs(model.rigid_modes.T @ balanced).max() < 1e-12 * np.abs(loads).sum()
    assert np.abs(model.K @ moved - balanced).max() < 1e-8 * np.abs(loads).max()
    rigid = model.rigid_modes.T @ model.mass_times(moved)
    scale = np.sqrt(np.einsum("ij,ij->j", moved, model.mass_times(moved)))
    assert np.all(np.abs(rigid) < 1e-10 * scale)


def test_static_answer_is_symmetric():
    model = assemble(box((8e-3, 2e-3, 3e-3), (4, 2, 2)), STEEL)
    loads = np.random.default_rng(0).normal(size=(model.n_dof, 6))
    compliance = loads.T @ FreeBodySolver(model).solve(loads)
    np.testing.assert_allclose(compliance, compliance.T, atol=1e-10 * np.abs(compliance).max())


@pytest.mark.parametrize(("order", "cells", "low", "high"), [(1, 4, 1.5, 2.6), (2, 1, 3.0, 6.0)])
def test_frequencies_converge_at_the_elements_order(order, cells, low, high):
    """Eigenvalue errors fall as h^(2p); the finest mesh stands in for the exact solution."""
    size = (16e-3, 4e-3, 4e-3)
    first = [
        frequencies(assemble(box(size, (4 * n, n, n)), STEEL, order=order), 1)[0]
        for n in (cells, 2 * cells)
    ]
    exact = frequencies(assemble(box(size, (24, 6, 6)), STEEL, order=2), 1)[0]
    rate = np.log2((first[0] - exact) / (first[1] - exact))
    assert low < rate < high
    assert first[0] > first[1] > exact  # a consistent mass bounds frequencies from above


def test_modes_are_orthonormal_and_free_of_rigid_motion():
    mesh, _ = ring(*RING, (1, 1, 24))
    model = assemble(mesh, STEEL)
    omega2, shapes = free_modes(FreeBodySolver(model), 20)
    np.testing.assert_allclose(shapes.T @ model.mass_times(shapes), np.eye(20), atol=1e-10)
    assert np.abs(model.rigid_modes.T @ model.mass_times(shapes)).max() < 1e-10
    stiffness = shapes.T @ (model.K @ shapes)
    np.testing.assert_allclose(stiffness, np.diag(omega2), atol=1e-8 * omega2.max())
    pairs = omega2[:12].reshape(-1, 2)  # bending waves of a ring come in pairs
    np.testing.assert_allclose(pairs[:, 0], pairs[:, 1], rtol=1e-6)


def test_symmetry_is_found_and_refused():
    mesh, _ = ring(*RING, (1, 1, 24))
    model = assemble(mesh, STEEL)
    symmetry = find_symmetry(model, 8)
    assert symmetry is not None
    load = np.random.default_rng(0).normal(size=(model.n_dof, 2))
    solver = FreeBodySolver(model)
    turned = solver.solve(symmetry.rotate(load, 3))
    expected = symmetry.rotate(solver.solve(load), 3)
    np.testing.assert_allclose(turned, expected, atol=1e-8 * np.abs(expected).max())
    assert find_symmetry(model, 7) is None
    points = mesh.points.copy()
    points[5] += 1e-5
    assert find_symmetry(assemble(dataclasses.replace(mesh, points=points), STEEL), 8) is None
