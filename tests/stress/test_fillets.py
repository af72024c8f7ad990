"""Stress in fillets by submodels: what corners share, and what leaves them alone.

``test_convergence`` compares it with much finer meshes.
"""

from dataclasses import replace

import numpy as np
import pytest
from stress_cage import CAGE, DEFECTS, POCKETS

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.window.interface import face_stations, station_weights
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.options import MeshOptions
from flexcage.modes.pockets import pocket_frames
from flexcage.stress.fillets import find_fillets
from flexcage.stress.operators import von_mises
from flexcage.stress.surface import SurfaceStress

STATIONS = face_stations(CAGE, 7)


class Cage:
    """The small cage under forces at stations, all on the mesh."""

    def __init__(self, defects=(), **options):
        mesh = build_cage_mesh(
            CAGE, pocket_count=POCKETS, pitch_diameter=43.5e-3, defects=defects,
            options=MeshOptions(**options),
        )  # fmt: skip
        self.model = assemble(mesh, MATERIALS["brass"])
        self.solver = FreeBodySolver(self.model)
        self.weights = station_weights(self.model, STATIONS, POCKETS)
        self.fillets = find_fillets(self.model, STATIONS, POCKETS)

    def moved(self, forces):
        at = np.einsum("kfsa,kab->kfsb", forces, pocket_frames(POCKETS)).reshape(-1, 3)
        return self.solver.solve((self.weights.T @ at).reshape(-1, 1)).reshape(-1, 3, 1)

    def peaks(self, forces):
        """Largest equivalent stress of every corner, by pocket and signs of x and psi."""
        fields = self.moved(forces)
        return {
            (f.corner.pocket, *f.corner.mirror): von_mises(
                f.stress(fields, forces[..., None])
            ).max()
            for f in self.fillets
        }


def force(pocket, face, station, vector):
    out = np.zeros((POCKETS, 4, 7, 3))
    out[pocket, face, station] = vector
    return out


@pytest.fixture(scope="module")
def coarse():
    return Cage(fineness="coarse")


def test_a_sound_cages_corners_share_one_operator(coarse):
    assert len(coarse.fillets) == 4 * POCKETS and {f.kind for f in coarse.fillets} == {0}
    for fillet in coarse.fillets:
        assert set(fillet.owner) == set(fillet.vertices)


def test_turned_and_mirrored_forces_have_turned_and_mirrored_stress(coarse):
    """Front beam of pocket 2 pushed at a station near +x; rear beam of pocket 5 near -x."""
    one = coarse.peaks(force(2, 0, 5, [0.3, 0.2, 1.0]))
    other = coarse.peaks(force(5, 1, 1, [-0.3, 0.2, -1.0]))
    for (pocket, along, across), value in one.items():
        turned = other[(7 - pocket) % POCKETS, -along, -across]
        assert value == pytest.approx(turned, rel=1e-4, abs=1e-3 * max(one.values()))


def test_a_rigid_motion_has_no_stress(coarse):
    motion = coarse.model.rigid_modes.reshape(-1, 3, 6)
    motion = motion / np.abs(motion).max(axis=(0, 1)) * 1e-6
    bent = coarse.moved(force(0, 0, 3, [0.0, 0.0, 1.0]))
    bent *= 1e-6 / np.abs(bent).max()
    for fillet in coarse.fillets[:4]:
        none = von_mises(fillet.stress(motion, None)).max()
        assert none < 1e-4 * von_mises(fillet.stress(bent, None)).max()


def test_only_corners_near_a_defect_have_their_own_operators():
    damaged = Cage(DEFECTS, fineness="coarse")
    common = damaged.fillets[0].kind
    own = {(f.corner.pocket, f.corner.mirror[1]) for f in damaged.fillets if f.kind != common}
    # crossbeam 3 lies between pockets 2 and 3; side beam -x of pocket 5
    assert own == {(2, 1), (3, -1), (5, -1), (5, 1), (4, 1), (6, -1)}


def test_a_mesh_without_fillets_or_repetition_keeps_its_own_stress(coarse):
    bare = replace(
        coarse.model, groups={k: v for k, v in coarse.model.groups.items() if "fillet" not in k}
    )
    assert find_fillets(bare, STATIONS, POCKETS) == []
    points = coarse.model.points.copy()
    inside = np.setdiff1d(np.arange(len(points)), coarse.model.surface)
    points[inside] += np.random.default_rng(0).uniform(-1e-5, 1e-5, (len(inside), 3))
    uneven = replace(coarse.model, points=points)
    assert find_fillets(uneven, STATIONS, POCKETS) == []


def test_points_of_a_vertex_are_kept_together(coarse):
    every = np.arange(len(coarse.model.points))
    surface = SurfaceStress(coarse.model, every, coarse.fillets)
    forces = force(1, 0, 3, [0.0, 0.0, 1.0])
    stress = surface(coarse.moved(forces), forces[..., None])[:, 0]
    equivalent = von_mises(stress)
    expected = [equivalent[surface.owner == v].max() for v in every]
    np.testing.assert_allclose(surface.largest(equivalent), expected)
    np.testing.assert_allclose(von_mises(surface.worst(stress)), expected)
