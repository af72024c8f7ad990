"""Meshes from a file: those that repeat are solved by sectors, others by dense fronts."""

import dataclasses
from types import MappingProxyType

import numpy as np
import pytest
from own_mesh import renumbered
from solids import box
from test_condensed import BENT, POCKETS, SIDE, cage_mesh

from flexcage.fem.condensed import CondensedRing
from flexcage.fem.dissected import DissectedBody
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.io import read_mesh, write_mesh
from flexcage.modes.pockets import pocket_loads

BRASS = MATERIALS["brass"]


@pytest.fixture(scope="module")
def read(tmp_path_factory):
    """read(*defects): the cage's mesh as another program numbers it, read from a file."""

    def make(*defects):
        path = tmp_path_factory.mktemp("own") / "own.msh"
        write_mesh(renumbered(cage_mesh(defects)), path)
        return read_mesh(path, pocket_count=POCKETS)

    return make


def as_a_whole(model):
    """The same model solved by another program's sparse factor, as if nothing repeated."""
    return FreeBodySolver(dataclasses.replace(model, info=MappingProxyType({})), kind="superlu")


def assert_same_answers(ours, theirs):
    model = theirs.model
    anywhere = np.random.default_rng(0).normal(size=(model.n_dof, 70))
    for loads in (pocket_loads(model, 2, POCKETS), anywhere):
        expected = theirs.solve(loads)
        assert np.abs(ours.solve(loads) - expected).max() < 1e-8 * np.abs(expected).max()
    (own, shapes), (values, expected) = (free_modes(s, 12) for s in (ours, theirs))
    np.testing.assert_allclose(np.sqrt(own), np.sqrt(values), rtol=1e-8)
    within = shapes @ (shapes.T @ model.mass_times(expected))
    assert np.abs(within - expected).max() < 1e-8 * np.abs(expected).max()


def test_a_mesh_that_repeats_is_solved_by_harmonics(read):
    model = assemble(read(), BRASS)
    solver = FreeBodySolver(model)
    assert isinstance(solver.solver, CondensedRing)
    assert solver.solver.is_cyclic and len(solver.solver.kinds) == 1
    assert_same_answers(solver, as_a_whole(model))


def test_a_mesh_with_defects_is_solved_by_parts(read):
    model = assemble(read(BENT, SIDE), BRASS)
    solver = FreeBodySolver(model)
    assert isinstance(solver.solver, CondensedRing)
    assert not solver.solver.is_cyclic and len(solver.solver.kinds) == 4
    assert_same_answers(solver, as_a_whole(model))


@pytest.mark.parametrize("order", [1, 2])
def test_sectors_of_a_file_give_the_matrices_of_all_elements(read, order):
    mesh = read(SIDE)
    ours = assemble(mesh, BRASS, order=order)
    theirs = assemble(dataclasses.replace(mesh, info=MappingProxyType({})), BRASS, order=order)
    assert ours.sectors is not None and theirs.sectors is None
    assert abs(ours.K - theirs.K).max() < 1e-12 * abs(theirs.K).max()
    assert abs(ours.mass_scalar - theirs.mass_scalar).max() < 1e-12 * theirs.mass_scalar.max()


def test_a_mesh_that_does_not_repeat_is_solved_by_dense_fronts():
    """Connections that say nothing of sectors, all points a little apart from a turn."""
    mesh = renumbered(cage_mesh())
    apart = np.random.default_rng(0).uniform(-1e-6, 1e-6, mesh.points.shape)
    model = assemble(dataclasses.replace(mesh, points=mesh.points + apart), BRASS)
    solver = FreeBodySolver(model)
    assert isinstance(solver.solver, DissectedBody)
    assert_same_answers(solver, as_a_whole(model))


def test_a_solid_off_its_axis_is_solved_by_dense_fronts():
    model = assemble(box((0.02, 0.01, 0.01), (4, 3, 2)), BRASS)
    ours, theirs = FreeBodySolver(model), as_a_whole(model)
    assert isinstance(ours.solver, DissectedBody)
    loads = np.random.default_rng(0).normal(size=(model.n_dof, 3))
    expected = theirs.solve(loads)
    assert np.abs(ours.solve(loads) - expected).max() < 1e-8 * np.abs(expected).max()
