"""Geometric stiffness against scikit-fem's assembly, an identity, and spinning bars and rings."""

import dataclasses

import numpy as np
import pytest
import skfem
from fem_shapes import box, ring
from scipy.integrate import quad
from scipy.linalg import eig

from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.fem.model import assemble
from flexcage.fem.prestress import geometric_stiffness
from flexcage.geometry.materials import Material
from flexcage.modes.ritz import centrifugal_load
from flexcage.modes.stiffening import spin_stiffness

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


def test_a_bar_spun_across_its_length_stiffens_as_a_beam_under_tension():
    """Flapping along the axis of spin: W^2 int T w'^2 / int rho A w^2 with T = rho A (l^2/4 -
    y^2)/2 and w the free beam's first shape (Southwell's coefficient)."""
    length, side = 100e-3, 2e-3
    mesh = box((length, side, side), (32, 1, 1))
    points = (mesh.points - [0.5 * length, 0.5 * side, 0.5 * side])[:, [1, 0, 2]] * [1.0, -1.0, 1.0]
    model = assemble(dataclasses.replace(mesh, points=points), NO_POISSON)
    solver = FreeBodySolver(model)
    omega2, shapes = free_modes(solver, 2)
    nodal = shapes.reshape(-1, 3, 2)
    flap = spin_stiffness(solver, nodal)
    share = np.einsum("nak,nal->akl", nodal, model.mass_times(shapes).reshape(nodal.shape))
    # the pair of equal frequencies is any mixture of flapping along x and bending along z
    _, mix = np.linalg.eigh(share[0])
    found = mix[:, 1] @ flap @ mix[:, 1]
    k = 4.730040744862704 / length
    ratio = np.cos(0.5 * k * length) / np.cosh(0.5 * k * length)

    def shape(y):
        return np.cos(k * y) + ratio * np.cosh(k * y)

    def slope(y):
        return k * (-np.sin(k * y) + ratio * np.sinh(k * y))

    half = 0.5 * length
    pulled = quad(lambda y: 0.5 * (half**2 - y**2) * slope(y) ** 2, -half, half)[0]
    expected = pulled / quad(lambda y: shape(y) ** 2, -half, half)[0]
    assert found == pytest.approx(expected, rel=5e-3)


@pytest.fixture(scope="module")
def v6_ring():
    """The ring of verification.md, V6, in solid elements: model, omega^2, shapes, stiffening."""
    mesh, _ = ring(49e-3, 51e-3, 10e-3, (2, 1, 96))
    model = assemble(mesh, NO_POISSON)
    solver = FreeBodySolver(model)
    omega2, shapes = free_modes(solver, 8)
    return model, omega2, shapes, spin_stiffness(solver, shapes.reshape(-1, 3, 8))


@pytest.mark.parametrize("linear", [False, True])
@pytest.mark.parametrize(
    ("rpm", "n", "exact", "without"),
    [(6000, 2, (602.0490, 442.0490), (584.459, 424.400)),
     (6000, 3, (1516.9426, 1396.9426), (1494.588, 1374.405)),
     (20000, 2, (913.3004, 379.9671), (733.714, 200.239)),
     (20000, 3, (1844.7132, 1444.7132), (1612.018, 1211.446))],
)  # fmt: skip
def test_spinning_ring_of_solid_elements(v6_ring, rpm, n, exact, without, linear):
    """In the rotating frame, against the closed form with hoop tension, and V6's linear one."""
    model, omega2, shapes, geometric = v6_ring
    spin = rpm * np.pi / 30.0
    nodal = shapes.reshape(-1, 3, 8)
    moved = model.mass_times(shapes).reshape(nodal.shape)
    turned = nodal[:, 1].T @ moved[:, 2]
    gyro = 2.0 * spin * (turned.T - turned)
    softening = -np.einsum("nak,nal->kl", nodal[:, 1:], moved[:, 1:])
    stiffness = np.diag(omega2) + spin**2 * (softening + (0.0 if linear else 1.0) * geometric)
    corner = np.zeros((8, 8))
    values = eig(np.block([[corner, np.eye(8)], [-stiffness, -gyro]]), right=False)
    found = values.imag[values.imag > 1.0] / (2.0 * np.pi)
    expected = without if linear else exact
    near = [found[np.argmin(np.abs(found - f))] for f in expected]
    np.testing.assert_allclose(near, expected, rtol=3e-3 if linear else 2e-3)
