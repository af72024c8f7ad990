"""Modes of conical cages against thin rings and finer meshes, and stations against the mesh."""

from dataclasses import replace
from functools import cache
from math import pi, radians, sqrt

import numpy as np
import pytest
from conical_cage import CONE, COUNT, MM, cone_mesh

from flexcage.cages.build import reduce_cage
from flexcage.cages.conical.cage import ConicalCage
from flexcage.cages.conical.walls import pocket_walls
from flexcage.cages.window.broken import BrokenCrossbeam
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.modes.pockets import pocket_frames
from flexcage.modes.spec import ModesSpec
from flexcage.stress.fillets import find_fillets
from flexcage.stress.operators import von_mises


def frequencies(model, count=6):
    return np.sqrt(free_modes(FreeBodySolver(model), count)[0]) / (2.0 * pi)


def test_a_nearly_closed_cone_bends_as_a_ring():
    """Bending in its plane without extension (Love): omega^2 = E h^2/(12 rho a^4) n^2 (n^2 - 1)^2 /
    (n^2 + 1), of a strip without Poisson's ratio, for n = 2 and 3. Six small slits hardly count.
    """
    steel = replace(MATERIALS["steel"], name="strip", poisson_ratio=0.0)
    ring = ConicalCage(
        material=steel, cone_angle=radians(0.5), pitch_diameter=40 * MM, offset=0.0,
        thickness=1 * MM, small_rim=3.6 * MM, large_rim=3.6 * MM, pocket_length=0.8 * MM,
        pocket_width_small=0.4 * MM, pocket_width_large=0.4 * MM, fillet_radius=0.1 * MM,
    )  # fmt: skip
    found = frequencies(assemble(cone_mesh(cage=ring, count=6), steel), 6)
    rate = sqrt(steel.youngs_modulus / (12.0 * steel.density)) * 1 * MM / (20 * MM) ** 2
    for n, pair in ((2, slice(0, 2)), (3, slice(4, 6))):  # between them one out of the plane
        love = rate * n * (n**2 - 1) / sqrt(n**2 + 1) / (2.0 * pi)
        assert found[pair] == pytest.approx([love, love], rel=0.01)


@pytest.mark.slow
def test_frequencies_of_a_cone_converge():
    coarse, medium, fine = (frequencies(assemble(cone_mesh(fineness=f), CONE.material), 10)
                            for f in ("coarse", "medium", "fine"))  # fmt: skip
    assert (coarse > medium).all() and (medium > fine).all()  # elements are too stiff
    assert coarse == pytest.approx(fine, rel=0.02)
    assert medium == pytest.approx(fine, rel=7e-3)
    assert fine[0::2] == pytest.approx(fine[1::2], rel=1e-6)  # pairs of a ring


@pytest.mark.slow
def test_a_broken_bar_parts_a_pair_of_modes():
    sound, broken = (
        frequencies(assemble(cone_mesh(*d), CONE.material), 4)
        for d in ((), (BrokenCrossbeam(crossbeam=3),))
    )
    assert (broken < sound * (1.0 + 1e-9)).all()
    assert broken[2] < 0.99 * sound[2]


@cache
def reduction():
    return reduce_cage(cone_mesh(), cage=CONE, defects=(), spec=ModesSpec())


NORMALS = pocket_walls(CONE).normal


def test_stations_of_a_cone_lie_where_they_say():
    """Means of the nodes' own places: the station's coordinate, on the pocket's wall."""
    cage = reduction()
    at = (cage.interface.weights @ cage.model.nodes).reshape(COUNT, 4, -1, 3)
    walls = pocket_walls(CONE)
    for pocket in (0, 7):
        local = CONE.in_pocket(at[pocket].reshape(-1, 3), pocket, COUNT).reshape(4, -1, 3)
        np.testing.assert_allclose(local[:2, :, 0], cage.interface.stations[:2], atol=0.15 * MM)
        np.testing.assert_allclose(local[2:, :, 2], cage.interface.stations[2:], atol=0.15 * MM)
        off = np.einsum("fsa,fa->fs", local - walls.middle[:, None], NORMALS)
        assert np.abs(off).max() < 1e-9
        inside, outside = local[:2, :, 1].min(), local[:2, :, 1].max()
        assert walls.inside < inside and outside < walls.outside


def test_a_pocket_of_a_cone_yields_through_stations_as_in_full():
    """A force spread evenly over a face, along its normal: modes and residual vectors against the
    whole mesh."""
    cage = reduction()
    made, pocket = cage.interface, 4
    frames = CONE.axes  # from (x, r, psi) to (s, n, t)
    for face in range(4):
        normal = NORMALS[face] @ frames
        forces = np.zeros((COUNT, 4, 7, 3))
        forces[pocket, face] = normal / 7.0
        spread = np.einsum("kfsa,kab->kfsb", forces, pocket_frames(COUNT)).reshape(-1, 3)
        nodal = (made.weights.T @ spread).reshape(-1, 1)
        full = (nodal.T @ cage.solver.solve(nodal)).item()
        modal = np.einsum("fsa,fsan->n", forces[pocket], made.modes[pocket])
        pull = made.residual[pocket, face].mean(axis=0)
        drive = modal @ np.linalg.solve(cage.basis.stiffness, modal)
        assert drive + pull @ made.compliance[pocket] @ pull == pytest.approx(full, rel=0.02)


def test_the_table_of_a_cone_s_modes_has_its_bars():
    table = reduction().table
    assert "crossbeam" in table.kind and table.loaded == ("crossbeam", "side_beam")
    total = np.asarray(table.share).sum(axis=0) + table.residual_share
    assert total == pytest.approx([1.0, 1.0])


@pytest.mark.slow
def test_stress_in_fillets_of_a_cone_is_that_of_a_finer_mesh():
    """Peaks at the ends of a bar that is pressed evenly; corners are of two kinds."""
    peaks = []
    for fineness in ("medium", "fine"):
        cage = reduce_cage(cone_mesh(fineness=fineness), cage=CONE, defects=(), spec=ModesSpec())
        forces = np.zeros((COUNT, 4, 7, 3))
        forces[2, 0] = NORMALS[0] @ CONE.axes * 10.0
        spread = np.einsum("kfsa,kab->kfsb", forces, pocket_frames(COUNT)).reshape(-1, 3)
        moved = cage.solver.solve((cage.interface.weights.T @ spread).reshape(-1, 1))
        fillets = find_fillets(cage.model, cage.interface.stations, COUNT)
        assert len(fillets) == 4 * COUNT and len({f.kind for f in fillets}) == 2
        peaks.append({
            (f.corner.pocket, *f.corner.mirror): von_mises(
                f.stress(moved.reshape(-1, 3, 1), forces[..., None])
            ).max()
            for f in fillets
        })  # fmt: skip
    for corner in ((2, 1, 1), (2, -1, 1), (3, 1, -1), (3, -1, -1)):
        assert peaks[0][corner] == pytest.approx(peaks[1][corner], rel=0.05)
