"""Modes made anew are the same ones, whatever signs and directions a solver returned."""

from dataclasses import replace

import numpy as np
import pytest
from modes_cage import DEFECTS, POCKETS, cage_mesh

from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.modes import ritz
from flexcage.modes.orientation import oriented
from flexcage.modes.registry import build_basis
from flexcage.modes.spec import ModesSpec

PAIR = 1e-7


def mixed(basis, seed):
    """The basis as another solver may find it: signs at random, pairs of equal frequency turned."""
    random = np.random.default_rng(seed)
    turn, squares = np.diag(random.choice([-1.0, 1.0], basis.size)), np.diag(basis.stiffness)
    for i in range(basis.size - 1):
        if squares[i + 1] - squares[i] < PAIR * squares[i] and basis.kind[i] == basis.kind[i + 1]:
            c, s = np.cos(a := random.uniform(0.0, 7.0)), np.sin(a)
            turn[i : i + 2, i : i + 2] = np.array([[c, -s], [s, c]]) * random.choice([-1.0, 1.0])
    return replace(basis, shapes=basis.shapes @ turn)


@pytest.mark.parametrize("which", ["basis", "damaged_basis"])
def test_a_basis_turned_by_another_solver_is_brought_back(which, request, solver, damaged_solver):
    basis = request.getfixturevalue(which)
    model = (damaged_solver if which.startswith("damaged") else solver).model
    scale = np.abs(basis.shapes).max()
    for seed in range(3):
        other = mixed(basis, seed)
        assert np.abs(other.shapes - basis.shapes).max() > 0.1 * scale
        back = oriented(other, model, POCKETS)
        np.testing.assert_allclose(back.shapes, basis.shapes, rtol=0.0, atol=1e-9 * scale)


def test_the_geometric_stiffness_turns_with_the_modes(solver):
    spec = ModesSpec(count=4, crossbeams=False, geometric_stiffening=True)
    basis = build_basis(solver.model, pocket_count=POCKETS, spec=spec, solver=solver)
    signs = np.diag([1.0, -1.0, -1.0, 1.0, -1.0])
    other = replace(basis, shapes=basis.shapes @ signs, geometric=signs @ basis.geometric @ signs)
    back = oriented(other, solver.model, POCKETS)
    np.testing.assert_allclose(back.geometric, basis.geometric, rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize("defects", [(), DEFECTS])
def test_two_ways_to_solve_give_one_basis(defects):
    """By parts and harmonics, and of the whole by a sparse factor and random starting vectors."""
    mesh = cage_mesh(defects)
    by_parts = FreeBodySolver(assemble(mesh, MATERIALS["brass"]))
    plain = replace(mesh, info={})
    whole = FreeBodySolver(assemble(plain, MATERIALS["brass"]))
    assert type(by_parts.solver) is not type(whole.solver)
    spec = ModesSpec(count=8)
    one, other = (
        build_basis(s.model, pocket_count=POCKETS, spec=spec, solver=s) for s in (by_parts, whole)
    )
    free = np.array(one.kind) == "free"
    scale = np.abs(one.shapes).max()
    far = np.abs(other.shapes - one.shapes).max(axis=(0, 1)) / scale
    assert far[free].max() < 1e-6 and far.max() < 1e-4


def test_a_basis_of_coupled_modes_is_left_alone(basis, solver):
    stiffness = basis.stiffness.copy()
    stiffness[0, 1] = stiffness[1, 0] = 1e-3 * stiffness[0, 0]
    coupled = replace(basis, shapes=-basis.shapes, stiffness=stiffness)
    assert oriented(coupled, solver.model, POCKETS) is coupled


def test_a_mode_that_moves_no_wall_of_pocket_0_looks_at_the_next(basis, solver):
    """A shape of the fifth pocket alone gets its sign there."""
    model = solver.model
    shape = np.zeros((len(model.nodes), 3, 1))
    nodes = np.unique(model.group("pocket5_front"))
    shape[nodes, 0] = -1.0
    local = ritz.eigen_basis("local", shape.reshape(-1, 1), np.ones(1), ["free"])
    up = oriented(local, model, POCKETS)
    assert up.shapes[nodes, 0].min() == 1.0
    np.testing.assert_array_equal(oriented(up, model, POCKETS).shapes, up.shapes)
