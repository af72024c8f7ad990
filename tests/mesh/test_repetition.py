"""Sectors found in meshes that do not say how they were made."""

import dataclasses
from types import MappingProxyType

import numpy as np
import pytest
from own_mesh import renumbered

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.round_pocket.defects import WebCrack
from flexcage.cages.window.cage import WindowCage
from flexcage.cages.window.defects import CrossbeamDefect, SideBeamDefect
from flexcage.fem.sectors import rotation_x
from flexcage.mesh.io import read_mesh, write_mesh
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.repetition import find_repetition

POCKETS = 9
CAGE = WindowCage(
    bore=40e-3, outside_diameter=47e-3, width=16e-3, pocket_width=9e-3, pocket_length=8.25e-3
)
DEFECTS = {
    "sound": (),
    "shifted crossbeam": (CrossbeamDefect(crossbeam=0, displacement=0.2e-3, shape="shifted"),),
    "side beams": (
        SideBeamDefect(pocket=5, side="-x", displacement=-0.3e-3),
        SideBeamDefect(pocket=1, side="+x", displacement=0.3e-3),
    ),
}


def built(defects=(), cage=CAGE, pockets=POCKETS, pitch=43.5e-3):
    return build_cage_mesh(
        cage,
        pocket_count=pockets,
        pitch_diameter=pitch,
        defects=defects,
        options=MeshOptions(fineness="coarse"),
    )


@pytest.mark.parametrize("which", DEFECTS)
def test_the_sectors_of_a_renumbered_mesh_are_found(which):
    mesh = renumbered(built(DEFECTS[which]))
    found = find_repetition(mesh.points, mesh.tets, POCKETS)
    assert found is not None and found.cells.shape == (POCKETS, len(mesh.tets) // POCKETS)
    following = np.sort(found.following[mesh.tets[found.cells]], axis=2)
    np.testing.assert_array_equal(
        following, np.roll(np.sort(mesh.tets[found.cells], axis=2), -1, axis=0)
    )
    np.testing.assert_allclose(found.points, mesh.points, rtol=0.0, atol=1e-16)


def test_sectors_begin_around_the_first_pocket():
    mesh = renumbered(built(DEFECTS["side beams"]))
    found = find_repetition(mesh.points, mesh.tets, POCKETS)
    for k, cells in enumerate(found.cells):
        middles = mesh.points[mesh.tets[cells]].mean(axis=1) @ rotation_x(2.0 * np.pi * k / POCKETS)
        azimuth = np.arctan2(middles[:, 2], middles[:, 1])
        assert np.abs(azimuth).max() < np.pi / POCKETS


@pytest.mark.parametrize("which", ["sound", "side beams"])
def test_points_that_differ_by_a_files_rounding_are_set_right(which):
    """Seven digits in the file: sound sectors become turns of each other again, and nothing
    moves by more than the rounding."""
    mesh = renumbered(built(DEFECTS[which]))
    rough = np.array([[float(f"{x:.6e}") for x in point] for point in mesh.points])
    found = find_repetition(rough, mesh.tets, POCKETS)
    assert found is not None
    assert np.abs(found.points - mesh.points).max() < 1e-8
    own = np.unique(mesh.tets[found.cells[3]])  # sector 3 and the next are sound
    turned = found.points[own] @ rotation_x(2.0 * np.pi / POCKETS).T
    np.testing.assert_allclose(found.points[found.following[own]], turned, rtol=0.0, atol=1e-15)


def test_a_mesh_that_does_not_repeat_has_no_sectors():
    mesh = built()
    assert find_repetition(mesh.points, mesh.tets, POCKETS - 1) is None
    moved = mesh.tets.copy()  # two tetrahedra of one sector share another face
    moved[0] = moved[1]
    assert find_repetition(mesh.points, moved, POCKETS) is None
    assert find_repetition(mesh.points, mesh.tets[1:], POCKETS) is None


def test_a_cracked_mesh_has_no_sectors():
    cage = BallCage(bore=20e-3, outside_diameter=26e-3, width=12e-3, pocket_diameter=6e-3)
    mesh = built((WebCrack(web=2, share=0.3),), cage, 8, 23e-3)
    assert find_repetition(mesh.points, mesh.tets, 8) is None


@pytest.mark.parametrize("unit", ["m", "mm"])
def test_a_file_keeps_its_numbering_and_tells_its_sectors(tmp_path, unit):
    mesh = renumbered(built(DEFECTS["side beams"]))
    scaled = dataclasses.replace(mesh, points=mesh.points * {"m": 1.0, "mm": 1e3}[unit])
    path = write_mesh(dataclasses.replace(scaled, info=MappingProxyType({})), tmp_path / "own.msh")
    read = read_mesh(path, pocket_count=POCKETS, unit=unit)
    np.testing.assert_array_equal(read.tets, mesh.tets)
    np.testing.assert_allclose(read.points, mesh.points, rtol=0.0, atol=1e-16)
    assert read.info["sector_tets"].shape == (POCKETS, len(mesh.tets) // POCKETS)
