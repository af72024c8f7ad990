"""CalculiX on the cage of a ball bearing: free frequencies of the 7010C's polyimide cage.

``python tests/verification/test_ball_calculix.py`` solves the coarse mesh with ccx and stores what
it answers. Another gmsh may mesh the cage a little differently, which the stored comparison allows
for; that with ccx itself is on the same elements, with CalculiX's rule for the mass and with
flexcage's own (see ``test_calculix``).
"""

from __future__ import annotations

import json
import tempfile
from dataclasses import replace
from pathlib import Path

import calculix
import numpy as np
import pytest
from skfem import ElementTetP2
from skfem.quadrature import get_quadrature
from skfem.refdom import RefTet

from flexcage.cages.build import build_cage_mesh
from flexcage.case.presets import load_preset
from flexcage.fem import elements
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.fem.model import FEModel, assemble
from flexcage.mesh.options import MeshOptions

STORED = Path(__file__).parent / "data" / "calculix_7010c.json"
COUNT = 10
PRINTED = 1e-6  # the last of seven digits
MASS_RULE = 1e-4  # largest change of these frequencies by the mass rule
OTHER_MESH = 5e-3  # what another version of the mesher may change


def cage_model() -> FEModel:
    """Quadratic model of the cage on the coarse mesh."""
    preset = load_preset("7010C-PI")
    mesh = build_cage_mesh(
        preset.cage,
        pocket_count=preset.bearing.ball_count,
        pitch_diameter=preset.bearing.pitch_diameter,
        options=MeshOptions(fineness="coarse"),
    )
    return assemble(mesh, preset.cage.material)


def ccx_frequencies(model: FEModel) -> np.ndarray:
    with tempfile.TemporaryDirectory() as folder:
        return calculix.free_frequencies(model, Path(folder))[:COUNT]


def frequencies(model: FEModel) -> np.ndarray:
    return np.sqrt(free_modes(FreeBodySolver(model), COUNT)[0][:COUNT]) / (2.0 * np.pi)


@pytest.fixture(scope="module")
def model():
    return cage_model()


def test_frequencies_are_the_stored_ones(model):
    stored = json.loads(STORED.read_text(encoding="utf-8"))
    np.testing.assert_allclose(frequencies(model), stored["frequencies_hz"], rtol=OTHER_MESH)


@pytest.mark.slow
@pytest.mark.skipif(not calculix.available(), reason="ccx is not installed")
def test_frequencies_are_those_of_calculix(model):
    theirs = ccx_frequencies(model)
    np.testing.assert_allclose(frequencies(model), theirs, rtol=MASS_RULE)
    rule = get_quadrature(RefTet, 2)
    volumes, density = model.element_geometry[1], model.material.density
    blocks = elements.mass_blocks(ElementTetP2(), rule, volumes, density)
    pattern = elements.BlockPattern(model.cells, len(model.nodes))
    same_rule = replace(model)
    vars(same_rule)["_matrices"] = model.K, pattern.scalar(pattern.sum(blocks))
    np.testing.assert_allclose(frequencies(same_rule), theirs, rtol=PRINTED)


if __name__ == "__main__":
    cage = cage_model()
    stored = {
        "source": f"CalculiX {calculix.version()}",
        "nodes": len(cage.nodes),
        "frequencies_hz": ccx_frequencies(cage).tolist(),
    }
    STORED.write_text(json.dumps(stored, indent=1) + "\n", encoding="utf-8")
