"""Root stress, compliance and frequency of the named meshes against much finer fillets."""

from dataclasses import dataclass

import numpy as np
import pytest
from stress_cage import CAGE, POCKETS

from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.fem.model import assemble
from flexcage.geometry.cages import WindowCage
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.build import build_cage_mesh
from flexcage.mesh.options import MeshOptions
from flexcage.modes.pockets import pocket_loads
from flexcage.stress.operators import VertexStress, von_mises
from flexcage.stress.places import root_places


@dataclass(frozen=True)
class Reading:
    """A cage's answers: rows are loads of 1 N, crossbeam (uniform, middle) and side beam."""

    frequency: float
    compliance: np.ndarray  # (3,) m/N
    root: np.ndarray  # (3,) Pa/N


def read(cage, pockets, pitch_diameter, *, frequency=False, **options):
    """Loads are on pocket 0: all of its front face, a line across its middle, its +x side face."""
    mesh = build_cage_mesh(
        cage, pocket_count=pockets, pitch_diameter=pitch_diameter, options=MeshOptions(**options)
    )
    model = assemble(mesh, MATERIALS["brass"])
    solver = FreeBodySolver(model)
    # a line is a band of half-width 0.5 mm across the face
    line = model.face_weights(
        model.group("pocket0_front"), lambda p: np.exp(-((p[:, 0] / 0.5e-3) ** 2))[None]
    ).toarray()
    uniform = pocket_loads(model, 0, pockets)
    middle = np.outer(line / line.sum(), [0.0, 0.0, 1.0]).ravel()
    loads = np.column_stack([uniform[:, 0], middle, uniform[:, 4]])
    moved = solver.solve(loads)
    places = root_places(model, pockets)
    crossbeam = [f"pocket0_root_front{s}x" for s in "+-"] + [f"pocket1_root_rear{s}x" for s in "+-"]
    side_beam = ["pocket0_root_front+x", "pocket0_root_rear+x"]
    root = np.zeros(3)
    for rows, names in (([0, 1], crossbeam), ([2], side_beam)):
        stress = VertexStress(model, np.concatenate([places[n] for n in names]))
        fields = moved[:, rows].reshape(-1, 3, len(rows))
        root[rows] = von_mises(stress(fields)).max(axis=0)
    first = np.sqrt(free_modes(solver, 1)[0][0]) / (2.0 * np.pi) if frequency else np.nan
    return Reading(float(first), np.einsum("ij,ij->j", loads, moved), root)


def test_medium_mesh_resolves_the_fillets():
    """Twelve pockets: within 10 % of six edges on an arc at a third of the size around them."""
    medium = read(CAGE, POCKETS, 43.5e-3)
    finer = read(CAGE, POCKETS, 43.5e-3, fillet_size=0.131e-3)
    np.testing.assert_allclose(medium.root, finer.root, rtol=0.10)
    np.testing.assert_allclose(medium.compliance, finer.compliance, rtol=0.03)


@pytest.mark.slow
def test_root_stress_of_the_n1013_has_converged():
    """Medium (4 edges on an arc) and fine (5) against the fine mesh with 8 edges: 178,000 nodes."""
    cage = WindowCage(
        bore=78.9e-3, outside_diameter=86.6e-3, width=16e-3, pocket_width=8.2e-3,
        pocket_length=8.25e-3, fillet_radius=0.5e-3,
    )  # fmt: skip
    arc = 0.5 * np.pi * cage.fillet_radius
    args = (cage, 22, 82.5e-3)
    best = read(*args, fineness="fine", fillet_size=arc / 8.0, frequency=True)
    for fineness, root, compliance, frequency in (
        ("medium", 0.08, 0.05, 4e-3),
        ("fine", 0.10, 0.005, 1e-3),
    ):
        ours = read(*args, fineness=fineness, frequency=True)
        np.testing.assert_allclose(ours.root, best.root, rtol=root)
        np.testing.assert_allclose(ours.compliance, best.compliance, rtol=compliance)
        assert ours.frequency == pytest.approx(best.frequency, rel=frequency)
    assert best.root[1] == pytest.approx(0.29e6, rel=0.05)  # a line load on a crossbeam's middle
