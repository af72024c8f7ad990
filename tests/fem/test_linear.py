import logging

import numpy as np
import pytest
import scipy.sparse as sp
from solids import box

from flexcage.core.errors import InputError, RunFailed
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.linear import available_kinds, linear_solver
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.cage_mesh import CageMesh

BRASS = MATERIALS["brass"]


@pytest.fixture(scope="module")
def model():
    return assemble(box((8e-3, 2e-3, 2e-3), (6, 2, 2)), BRASS)


@pytest.mark.parametrize("kind", available_kinds())
def test_kinds_solve_one_and_many_right_hand_sides(model, kind):
    matrix = (model.K + 1e10 * sp.kron(model.mass_scalar, sp.eye(3))).tocsr()
    rhs = np.random.default_rng(1).normal(size=(model.n_dof, 5))
    solver = linear_solver(matrix, kind=kind)
    many = solver.solve(rhs)
    assert np.abs(matrix @ many - rhs).max() < 1e-9 * np.abs(rhs).max()
    np.testing.assert_allclose(solver.solve(rhs[:, 0]), many[:, 0], rtol=1e-7)


def test_superlu_in_threads_gives_the_same(model, monkeypatch):
    matrix = (model.K + 1e10 * sp.kron(model.mass_scalar, sp.eye(3))).tocsr()
    rhs = np.random.default_rng(1).normal(size=(model.n_dof, 7))
    solver = linear_solver(matrix, kind="superlu")
    monkeypatch.setenv("OMP_NUM_THREADS", "1")
    alone = solver.solve(rhs)
    monkeypatch.setenv("OMP_NUM_THREADS", "3")
    np.testing.assert_allclose(solver.solve(rhs), alone, rtol=1e-10, atol=1e-20)


@pytest.mark.parametrize("kind", available_kinds())
def test_loose_parts_are_refused_with_a_sentence(model, kind):
    shifted = model.points + [0.0, 0.0, 5e-3]
    points = np.vstack([model.points, shifted])
    tets = np.vstack([model.tets, model.tets + len(model.points)])
    two = assemble(CageMesh(points, tets), BRASS, order=1)
    with pytest.raises(RunFailed, match="loose parts"):
        FreeBodySolver(two, kind=kind).factor()


def test_choice_is_logged_and_checked(model, caplog):
    with caplog.at_level(logging.DEBUG, logger="flexcage.fem.linear"):
        linear_solver(sp.eye(4, format="csr"), kind="superlu")
    assert "SuperLU" in caplog.text
    with pytest.raises(InputError, match="not one of auto"):
        linear_solver(sp.eye(4, format="csr"), kind="magic")
