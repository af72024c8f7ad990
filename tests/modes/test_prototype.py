"""The cage of another program: a prototype's N1013-like cage, checked with CalculiX.

Of it are known 24 pockets of 8.2 x 8.2 mm with 0.5 mm fillets, E 100 GPa, nu 0.34, rho 8500,
95.15 g and moments of inertia 162.39 (axial) and 84.50 kg mm^2. A bore of 78.5, an outside
diameter of 86.5 and a width of 17 mm give these to 0.15 %. Its first frequency was 903.4 Hz and a
crossbeam's compliance about 1.6e-4 mm/N.
"""

import dataclasses

import numpy as np
import pytest

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.window.cage import WindowCage
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.options import MeshOptions
from flexcage.modes.pockets import pocket_loads

PROTOTYPE = WindowCage(
    bore=78.5e-3, outside_diameter=86.5e-3, width=17e-3, pocket_width=8.2e-3, pocket_length=8.2e-3
)


@pytest.mark.parametrize(
    ("fineness", "tolerance"),
    [("coarse", 0.01), pytest.param("medium", 0.003, marks=pytest.mark.slow)],
)
def test_prototype_cage_agrees(fineness, tolerance):
    mesh = build_cage_mesh(
        PROTOTYPE, pocket_count=24, pitch_diameter=82.5e-3, options=MeshOptions(fineness=fineness)
    )
    brass = dataclasses.replace(MATERIALS["brass"], youngs_modulus=100e9)
    model = assemble(mesh, brass)
    assert model.mass == pytest.approx(95.15e-3, rel=2.5e-3)
    inertia = np.diag(model.inertia)
    np.testing.assert_allclose(inertia, [162.39e-6, 84.50e-6, 84.50e-6], rtol=3e-3)
    solver = FreeBodySolver(model)
    omega2, _ = free_modes(solver, 2)
    np.testing.assert_allclose(np.sqrt(omega2) / (2.0 * np.pi), 903.4, rtol=tolerance)
    load = pocket_loads(model, 0, 24)[:, :1]
    compliance = (load.T @ solver.solve(load)).item()
    assert compliance == pytest.approx(1.6e-7, rel=0.05)  # known to two digits
