"""Rings solved part by part and harmonic by harmonic, against the whole ring."""

import dataclasses
from types import MappingProxyType

import numpy as np
import pytest
from solids import ring

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.ribbon.defects import MissingRivet
from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.round_pocket.defects import EnlargedPocket, WebCrack
from flexcage.cages.window.cage import WindowCage
from flexcage.cages.window.defects import CrossbeamDefect, SideBeamDefect
from flexcage.case.presets import load_preset
from flexcage.fem.condensed import CondensedRing
from flexcage.fem.dissected import DissectedBody
from flexcage.fem.free import FreeBodySolver, HeldBody
from flexcage.fem.modal import free_modes
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.options import MeshOptions
from flexcage.modes.pockets import pocket_loads

BRASS = MATERIALS["brass"]
POCKETS = 9
CAGE = WindowCage(
    bore=40e-3, outside_diameter=47e-3, width=16e-3, pocket_width=9e-3, pocket_length=8.25e-3
)
BENT = CrossbeamDefect(crossbeam=3, displacement=0.2e-3)
SIDE = SideBeamDefect(pocket=5, side="-x", displacement=-0.3e-3)
DEFECTS = {
    "sound": (),
    "bent crossbeam": (BENT,),
    "bent crossbeam 0": (dataclasses.replace(BENT, crossbeam=0, shape="shifted"),),
    "side beam": (SIDE,),
    "both": (BENT, SIDE),
}
KINDS = {"sound": 1, "bent crossbeam": 2, "bent crossbeam 0": 2, "side beam": 3, "both": 4}
BALL_CAGE = BallCage(bore=20e-3, outside_diameter=26e-3, width=12e-3, pocket_diameter=6e-3)
BALL_POCKETS, BALL_PITCH = 8, 23e-3
CRACKED = {  # (defects, kinds of parts)
    "a crack": ((WebCrack(web=2, share=0.3),), 2),
    "cracks around the first pocket": (
        (WebCrack(web=0, share=0.2), WebCrack(web=1, share=0.4, side="-x")),
        3,
    ),
    "two alike": ((WebCrack(web=2, share=0.25), WebCrack(web=5, share=0.25)), 2),
    "beside an enlarged pocket": (
        (EnlargedPocket(pocket=4, increase=0.2e-3), WebCrack(web=4, share=0.3)),
        5,  # the wall draws along what is within one and a half sectors
    ),
}


def built(cage, pockets, pitch, defects):
    return build_cage_mesh(
        cage,
        pocket_count=pockets,
        pitch_diameter=pitch,
        defects=defects,
        options=MeshOptions(fineness="coarse"),
    )


def cage_mesh(defects=()):
    return built(CAGE, POCKETS, 43.5e-3, defects)


def without_sectors(thing):
    """A mesh or model that does not tell how it was made, as one from a user's file."""
    return dataclasses.replace(thing, info=MappingProxyType({}))


def solvers_of(mesh, kinds):
    """A cage's solver by parts, of which there are so many kinds, and as a whole."""
    model = assemble(mesh, BRASS)
    by_parts = FreeBodySolver(model)
    whole = FreeBodySolver(without_sectors(model), kind="superlu")
    assert isinstance(by_parts.solver, CondensedRing) and isinstance(whole.solver, HeldBody)
    assert len(by_parts.solver.kinds) == kinds
    return by_parts, whole


@pytest.fixture(scope="module", params=[*DEFECTS, *CRACKED])
def pair(request):
    name = request.param
    if name in DEFECTS:
        return solvers_of(cage_mesh(DEFECTS[name]), KINDS[name])
    defects, kinds = CRACKED[name]
    return solvers_of(built(BALL_CAGE, BALL_POCKETS, BALL_PITCH, defects), kinds)


def test_a_cage_without_a_rivet_is_solved_by_parts():
    ribbon = load_preset("15x37x10").cage
    mesh = built(ribbon, 7, 26e-3, (MissingRivet(web=0),))
    model = assemble(mesh, BRASS, order=1)
    by_parts, whole = FreeBodySolver(model), FreeBodySolver(without_sectors(model))
    assert isinstance(by_parts.solver, CondensedRing) and len(by_parts.solver.kinds) == 2
    ours, theirs = free_modes(by_parts, 8)[0], free_modes(whole, 8)[0]
    np.testing.assert_allclose(np.sqrt(ours), np.sqrt(theirs), rtol=1e-8)


@pytest.mark.parametrize("order", [1, 2])
@pytest.mark.parametrize("which", ["sound", "both"])
def test_a_ring_from_sectors_has_the_matrices_of_all_elements(which, order):
    mesh = cage_mesh(DEFECTS[which])
    ours, theirs = (assemble(m, BRASS, order=order) for m in (mesh, without_sectors(mesh)))
    assert ours.sectors is not None and theirs.sectors is None
    np.testing.assert_array_equal(ours.nodes, theirs.nodes)
    assert abs(ours.K - theirs.K).max() < 1e-12 * abs(theirs.K).max()
    assert abs(ours.mass_scalar - theirs.mass_scalar).max() < 1e-12 * theirs.mass_scalar.max()


def test_static_answers_equal_those_of_the_whole_ring(pair):
    by_parts, whole = pair
    anywhere = np.random.default_rng(0).normal(size=(whole.model.n_dof, 3))
    one_node = np.zeros((whole.model.n_dof, 3))
    one_node[-3:] = np.eye(3)
    pockets = [] if "pocket0_wall" in whole.model.groups else [0, 2, 5, 8]
    for loads in (*(pocket_loads(whole.model, k, POCKETS) for k in pockets), one_node, anywhere):
        expected = whole.solve(loads)
        assert np.abs(by_parts.solve(loads) - expected).max() < 1e-8 * np.abs(expected).max()


def test_free_modes_equal_those_of_the_whole_ring(pair):
    by_parts, whole = pair
    ours, shapes = free_modes(by_parts, 12)
    theirs, expected = free_modes(whole, 12)
    np.testing.assert_allclose(np.sqrt(ours), np.sqrt(theirs), rtol=1e-8)
    model = whole.model
    np.testing.assert_allclose(shapes.T @ model.mass_times(shapes), np.eye(len(ours)), atol=1e-10)
    within = shapes @ (shapes.T @ model.mass_times(expected))
    assert np.abs(within - expected).max() < 1e-8 * np.abs(expected).max()


def test_every_harmonic_is_searched_far_enough():
    """Many modes of few harmonics, and the first ones alone: none of either is missed."""
    model = assemble(cage_mesh(), BRASS, order=1)
    by_parts, whole = FreeBodySolver(model), FreeBodySolver(without_sectors(model))
    for count in (1, 60):
        ours, theirs = free_modes(by_parts, count)[0], free_modes(whole, count)[0]
        np.testing.assert_allclose(np.sqrt(ours), np.sqrt(theirs), rtol=1e-8)


def test_a_moved_vertex_makes_its_part_another_kind():
    mesh = cage_mesh()
    points = mesh.points.copy()
    points[3 * len(points) // 4] += 1e-9
    model = assemble(dataclasses.replace(mesh, points=points), BRASS)
    theirs = assemble(without_sectors(dataclasses.replace(mesh, points=points)), BRASS)
    assert abs(model.K - theirs.K).max() < 1e-12 * abs(theirs.K).max()
    assert not FreeBodySolver(model).solver.is_cyclic


def test_meshes_without_sectors_are_solved_as_a_whole():
    solid, _ = ring(20e-3, 23e-3, 10e-3, (1, 1, 24))
    assert isinstance(FreeBodySolver(assemble(solid, BRASS)).solver, DissectedBody)
    mesh = cage_mesh()
    shuffled = mesh.tets[np.random.default_rng(0).permutation(len(mesh.tets))]
    stale = assemble(dataclasses.replace(mesh, tets=shuffled), BRASS)
    assert stale.sectors is None and isinstance(FreeBodySolver(stale).solver, DissectedBody)
