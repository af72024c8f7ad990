"""A small cage of twelve pockets and its defects, on the coarse mesh."""

from __future__ import annotations

from flexcage.geometry.cages import CrossbeamDefect, SideBeamDefect, WindowCage
from flexcage.mesh.build import build_cage_mesh
from flexcage.mesh.options import MeshOptions

POCKETS = 12
CAGE = WindowCage(
    bore=40e-3, outside_diameter=47e-3, width=16e-3, pocket_width=7e-3, pocket_length=8.25e-3
)
DEFECTS = (
    CrossbeamDefect(crossbeam=3, displacement=0.2e-3),
    SideBeamDefect(pocket=5, side="-x", displacement=-0.3e-3),
)


def cage_mesh(defects=(), fineness="coarse"):
    return build_cage_mesh(
        CAGE,
        pocket_count=POCKETS,
        pitch_diameter=43.5e-3,
        defects=defects,
        options=MeshOptions(fineness=fineness),
    )
