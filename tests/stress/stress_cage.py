"""A small cage of twelve pockets on the coarse mesh, sound and with defects, reduced by Ritz."""

from __future__ import annotations

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.window.cage import WindowCage
from flexcage.cages.window.defects import CrossbeamDefect, SideBeamDefect
from flexcage.cages.window.interface import cage_interface
from flexcage.cages.window.places import WINDOW_PLACES
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.options import MeshOptions
from flexcage.modes.registry import build_basis
from flexcage.stress.recovery import StressRecovery

POCKETS = 12
CAGE = WindowCage(
    bore=40e-3, outside_diameter=47e-3, width=16e-3, pocket_width=7e-3, pocket_length=8.25e-3
)
DEFECTS = (
    CrossbeamDefect(crossbeam=3, displacement=0.2e-3),
    SideBeamDefect(pocket=5, side="-x", displacement=-0.3e-3),
)


def make_recovery(defects, spec):
    mesh = build_cage_mesh(
        CAGE,
        pocket_count=POCKETS,
        pitch_diameter=43.5e-3,
        defects=defects,
        options=MeshOptions(fineness="coarse"),
    )
    solver = FreeBodySolver(assemble(mesh, MATERIALS["brass"]))
    basis = build_basis(solver.model, pocket_count=POCKETS, spec=spec, solver=solver)
    interface = cage_interface(
        solver.model, basis, pocket_count=POCKETS, cage=CAGE, defects=defects
    )
    return StressRecovery(solver.model, basis, interface, places=WINDOW_PLACES, solver=solver)
