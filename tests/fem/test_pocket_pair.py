"""Forces on the walls of one pocket against hexahedra of another mesh and another element.

Three pairs of opposite unit forces, each on walls of pocket 0. The deflection is the pair's work,
the sum of both walls' displacements: what a squeezed roller sees.

* balanced: along the normals of the parallel walls. No resultant, so the ring does not ovalise.
* tangential: each along the tangent at its own crossbeam, pi/Z off the normal. The resultant,
  0.285 N along the radius, is balanced by inertia and ovalises the ring.
* axial: on both side-beam faces.
"""

import dataclasses

import numpy as np
import pytest
from hex_cage import HexCage

from flexcage.cages.build import build_cage_mesh
from flexcage.case.presets import load_preset
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import assemble

POCKETS = 22
WIDTH = 1.5e-3  # of the bump of pressure [m]: smooth, and away from fillets, which hexahedra lack


def tangent(angle):
    return np.array([0.0, -np.sin(angle), np.cos(angle)])


STEP = np.pi / POCKETS
LOADS = {
    "one crossbeam": {"front": tangent(0.0)},
    "balanced": {"front": tangent(0.0), "rear": -tangent(0.0)},
    "tangential": {"front": tangent(STEP), "rear": -tangent(-STEP)},
    "axial": {"side+x": np.array([1.0, 0.0, 0.0]), "side-x": np.array([-1.0, 0.0, 0.0])},
}


@pytest.fixture(scope="module")
def preset():
    found = load_preset("N1013")
    return found.bearing, dataclasses.replace(found.cage, fillet_radius=0.25e-3)


@pytest.fixture(scope="module")
def tetrahedra(preset):
    bearing, cage = preset
    mesh = build_cage_mesh(cage, pocket_count=POCKETS, pitch_diameter=bearing.pitch_diameter)
    return FreeBodySolver(assemble(mesh, cage.material))


def our_load(model, face, direction):
    axis = 2 if face.startswith("side") else 0
    weights = model.face_weights(
        model.group(f"pocket0_{face}"), lambda p: np.exp(-((p[:, axis] / WIDTH) ** 2))[None]
    ).toarray()[0]
    return np.outer(weights / weights.sum(), direction).ravel()


def test_deflections_equal_those_of_hexahedra(preset, tetrahedra):
    """Within 1 %; the balanced pair deflects little because it does not ovalise the ring."""
    cage = preset[1]
    hexahedra = HexCage(cage, POCKETS, cage.material)
    assert hexahedra.mass == pytest.approx(tetrahedra.model.mass, rel=2e-3)
    ours, theirs = {}, {}
    for name, forces in LOADS.items():
        load = sum(our_load(tetrahedra.model, face, d) for face, d in forces.items())
        ours[name] = load @ tetrahedra.solve(load[:, None])[:, 0]
        load = sum(hexahedra.load(face, d, WIDTH) for face, d in forces.items())
        theirs[name] = load @ hexahedra.solve(load)
    for name in LOADS:
        assert ours[name] == pytest.approx(theirs[name], rel=0.01), name
    assert 3.0 < ours["tangential"] / ours["balanced"] < 4.0
    assert 7.0 < ours["one crossbeam"] / ours["balanced"] < 9.0
