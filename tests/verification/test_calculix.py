"""CalculiX on the same elements: free frequencies, deflection and stress of a loaded crossbeam.

The stiffness of a straight quadratic tetrahedron is the same in both programs. The mass is not:
CalculiX integrates it by the stiffness' four points, flexcage exactly. So frequencies are compared
twice: with CalculiX's rule in flexcage's assembly, where nothing should differ but the seven digits
that CalculiX prints, and with flexcage's own, where the difference is that of the rules.
"""

from __future__ import annotations

import json
from dataclasses import replace

import calculix
import numpy as np
import pytest
from scipy.spatial import cKDTree
from skfem import ElementTetP2
from skfem.quadrature import get_quadrature
from skfem.refdom import RefTet

from flexcage.fem import elements
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.linear import linear_solver
from flexcage.fem.modal import free_modes
from flexcage.stress.operators import gauss_stress

PRINTED = 1e-6  # the last of seven digits, which is 1e-7 to 1e-6 of a number
MASS_RULE = 2e-5  # largest change of the first 20 frequencies of the coarse mesh by the mass rule


@pytest.fixture(scope="module", params=calculix.CAGES)
def cage(request):
    """A cage's name and model."""
    return request.param, calculix.cage_model(request.param)


@pytest.fixture(scope="module")
def ours(cage):
    """flexcage's answers in the form of CalculiX's."""
    model = cage[1]
    u = _supported(model)
    points, _ = get_quadrature(RefTet, 2)
    bary = np.vstack([1.0 - points.sum(axis=0), points])
    place = np.einsum("mq,ema->eqa", bary, model.points[model.tets]).reshape(-1, 3)
    stress = gauss_stress(model, u)[0].reshape(-1, 6)
    return calculix.Answer(
        _frequencies(model), np.hstack([model.nodes, u]), np.hstack([place, stress])
    )


@pytest.fixture(scope="module")
def by_four_points(cage):
    """Frequencies [Hz] with the mass integrated as CalculiX does."""
    model = cage[1]
    rule = get_quadrature(RefTet, 2)
    blocks = elements.mass_blocks(
        ElementTetP2(), rule, model.element_geometry[1], model.material.density
    )
    pattern = elements.BlockPattern(model.cells, len(model.nodes))
    other = replace(model)
    vars(other)["_matrices"] = model.K, pattern.scalar(pattern.sum(blocks))
    return _frequencies(other)


def _frequencies(model):
    values, _ = free_modes(FreeBodySolver(model), calculix.FREQUENCIES)
    return np.sqrt(values[: calculix.FREQUENCIES]) / (2.0 * np.pi)


def _supported(model):
    """Displacement (N, 3) under the pressure, with the held nodes' dofs left out."""
    load = np.zeros((len(model.nodes), 3))
    for triangle in np.concatenate([model.group(name) for name in calculix.LOADED]):
        a, b, c = model.points[triangle]
        outward = np.cross(b - a, c - a)
        weights = model.face_weights(triangle[None], lambda p: np.ones((1, len(p))))
        spread = weights.toarray()[0]
        load -= calculix.PRESSURE * np.outer(spread, outward / np.linalg.norm(outward))
    held = (3 * calculix.held_nodes(model)[:, None] + np.arange(3)).ravel()
    free = np.setdiff1d(np.arange(model.n_dof), held)
    u = np.zeros(model.n_dof)
    u[free] = linear_solver(model.K[free][:, free].tocsr()).solve(load.ravel()[free])
    return u.reshape(-1, 3)


def miss(ours, theirs):
    """Largest difference at the reference's places over the largest reference value."""
    theirs = np.asarray(theirs)
    distance, at = cKDTree(ours[:, :3]).query(theirs[:, :3])
    assert distance.max() < 1e-7  # a place is printed to seven digits
    return np.abs(ours[at, 3:] - theirs[:, 3:]).max() / np.abs(theirs[:, 3:]).max()


def compare(ours, by_four_points, frequencies, displacement, stress):
    np.testing.assert_allclose(by_four_points, frequencies, rtol=PRINTED)
    np.testing.assert_allclose(ours.frequencies, frequencies, rtol=MASS_RULE)
    assert miss(ours.displacement, displacement) < PRINTED
    assert miss(ours.stress, stress) < PRINTED


def test_equals_the_stored_answers(cage, ours, by_four_points):
    stored = json.loads(calculix.STORED.read_text(encoding="utf-8"))["cages"][cage[0]]
    stored = (stored["frequencies_hz"], stored["displacement_m"], stored["stress_pa"])
    compare(ours, by_four_points, *stored)


@pytest.mark.slow
@pytest.mark.skipif(not calculix.available(), reason="ccx is not installed")
def test_equals_calculix_itself(cage, ours, by_four_points):
    """Every node and Gauss point."""
    theirs = calculix.solve(cage[1])
    compare(ours, by_four_points, theirs.frequencies, theirs.displacement, theirs.stress)
