"""A small ball cage of six pockets on the coarse mesh, sound and with defects, reduced."""

from __future__ import annotations

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.round_pocket.defects import EnlargedPocket, WebCrack
from flexcage.cages.round_pocket.interface import ball_cage_interface
from flexcage.cages.round_pocket.places import ROUND_PLACES
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.options import MeshOptions
from flexcage.modes.registry import build_basis
from flexcage.modes.spec import ModesSpec
from flexcage.stress.recovery import StressRecovery

BALL_POCKETS = 6
BALL_CAGE = BallCage(
    material=MATERIALS["polyimide"],
    bore=16e-3,
    outside_diameter=22e-3,
    width=12e-3,
    pocket_diameter=6e-3,
)
BALL_DEFECTS = (EnlargedPocket(pocket=2, increase=0.4e-3), WebCrack(web=5, share=0.3))


def ball_recovery(defects=(), fineness="coarse", **spec):
    mesh = build_cage_mesh(
        BALL_CAGE,
        pocket_count=BALL_POCKETS,
        pitch_diameter=19e-3,
        defects=defects,
        options=MeshOptions(fineness=fineness),
    )
    solver = FreeBodySolver(assemble(mesh, BALL_CAGE.material))
    basis = build_basis(
        solver.model, pocket_count=BALL_POCKETS, spec=ModesSpec(**spec), solver=solver
    )
    interface = ball_cage_interface(
        solver.model,
        basis,
        pocket_count=BALL_POCKETS,
        cage=BALL_CAGE,
        defects=defects,
        solver=solver,
    )
    return StressRecovery(solver.model, basis, interface, places=ROUND_PLACES, solver=solver)
