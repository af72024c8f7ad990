"""Stress operators on fields whose stress is known."""

import numpy as np

from flexcage.stress.operators import VertexStress, deviator, gauss_stress, von_mises


def test_von_mises_of_known_states():
    states = np.zeros((4, 6))
    states[0, 0] = 7.0  # uniaxial
    states[1, 3] = 2.0  # shear: sqrt(3) tau
    states[2, :3] = 5.0  # pressure
    states[3] = [3.0, 1.0, 0.0, 0.0, 2.0, 0.0]
    expected = [7.0, 2.0 * np.sqrt(3.0), 0.0, np.sqrt(0.5 * (4 + 1 + 9) + 12)]
    np.testing.assert_allclose(von_mises(states), expected)


def test_deviator_has_the_norm_of_the_equivalent_stress():
    states = np.random.default_rng(0).normal(size=(50, 6))
    np.testing.assert_allclose(np.linalg.norm(deviator(states), axis=-1), von_mises(states))


def test_a_linear_field_has_its_constant_stress_everywhere(recovery):
    model = recovery.model
    gradient = np.random.default_rng(1).normal(size=(3, 3)) * 1e-4
    strain = 0.5 * (gradient + gradient.T)
    modulus, nu = model.material.youngs_modulus, model.material.poisson_ratio
    tensor = modulus / (1 + nu) * (strain + nu / (1 - 2 * nu) * np.trace(strain) * np.eye(3))
    expected = tensor[[0, 1, 2, 0, 1, 0], [0, 1, 2, 1, 2, 2]]
    field = model.nodes @ gradient.T
    scale = np.abs(expected).max()
    gauss, weights = gauss_stress(model, field)
    np.testing.assert_allclose(gauss - expected, 0.0, atol=1e-8 * scale)
    assert np.isclose(weights.sum(), 1.0)
    smooth = VertexStress(model, np.arange(len(model.points)))(field)
    np.testing.assert_allclose(smooth - expected, 0.0, atol=1e-8 * scale)


def test_gauss_stress_carries_the_strain_energy(recovery):
    """The energy of stress and strain at the Gauss points is u^T K u / 2."""
    model = recovery.model
    field = np.random.default_rng(2).normal(size=model.nodes.shape) * 1e-6
    stress, weights = gauss_stress(model, field)
    modulus, nu = model.material.youngs_modulus, model.material.poisson_ratio
    pressure = stress[..., :3].sum(axis=-1, keepdims=True)
    strain = (1 + nu) / modulus * stress
    strain[..., :3] -= nu / modulus * pressure
    density = np.einsum("eqk,eqk,k->eq", stress, strain, [0.5, 0.5, 0.5, 1.0, 1.0, 1.0])
    energy = np.einsum("eq,q,e->", density, weights, model.element_geometry[1])
    flat = field.ravel()
    np.testing.assert_allclose(energy, 0.5 * flat @ (model.K @ flat), rtol=1e-10)
