"""Geometric stiffness against scikit-fem's assembly, and an identity."""

import dataclasses

import numpy as np
import pytest
import skfem
from solids import box, ring

from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import assemble
from flexcage.fem.prestress import geometric_stiffness
from flexcage.geometry.materials import Material
from flexcage.modes.ritz import centrifugal_load

STEEL = Material(name="V6 steel", youngs_modulus=207e9, poisson_ratio=0.3, density=7800.0)
NO_POISSON = dataclasses.replace(STEEL, poisson_ratio=0.0)


@pytest.mark.parametrize("order", [1, 2])
def test_geometric_stiffness_equals_scikit_fems(order):
    mesh = box((2e-3, 1e-3, 1.5e-3), (2, 2, 2))
    model = assemble(mesh, STEEL, order=order)
    moved = 1e-6 * np.random.default_rng(0).normal(size=(len(model.nodes), 3))
    scalar = skfem.ElementTetP1() if order == 1 else skfem.ElementTetP2()
    basis = skfem.Basis(skfem.MeshTet(mesh.points.T, mesh.tets.T), scalar, intorder=4)
    gradient = np.stack([basis.interpolate(u).grad for u in moved.T])  # (component, axis, e, q)
    strain = 0.5 * (gradient + gradient.swapaxes(0, 1))
    E, nu = STEEL.youngs_modulus, STEEL.poisson_ratio
    sigma = E / (1 + nu) * strain
    trace = E * nu / ((1 + nu) * (1 - 2 * nu)) * np.einsum("aaeq->eq", strain)
    for axis in range(3):
        sigma[axis, axis] += trace

    @skfem.BilinearForm
    def work(u, v, _):
        return np.einsum("aeq,abeq,beq->eq", u.grad, sigma, v.grad)

    expected = work.assemble(basis)
    difference = geometric_stiffness(model, moved.ravel()) - expected
    assert abs(difference).max() < 1e-12 * abs(expected).max()


def test_a_turn_about_the_spin_axis_costs_the_moment_of_inertia():
    """int (sigma_yy + sigma_zz) dV = int rho r^2 dV by virtual work: a rotated body keeps its
    centrifugal load in the old directions, and a translated one feels nothing."""
    mesh, _ = ring(49e-3, 51e-3, 10e-3, (1, 1, 24))
    model = assemble(mesh, STEEL)
    static = FreeBodySolver(model).solve(centrifugal_load(FreeBodySolver(model))[:, None])
    stiffness = geometric_stiffness(model, static)
    turn = np.cross([1.0, 0.0, 0.0], model.nodes)
    cost = np.einsum("ia,ia->", turn, stiffness @ turn)
    assert cost == pytest.approx(model.inertia[0, 0], rel=1e-10)
    assert np.abs(stiffness @ np.ones(len(model.nodes))).max() < 1e-10 * abs(stiffness).max()
