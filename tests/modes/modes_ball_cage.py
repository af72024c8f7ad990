"""A small ball cage of eight pockets on the coarse mesh, sound and with defects."""

from __future__ import annotations

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.round_pocket.defects import (
    DisplacedPocket,
    ElongatedPocket,
    EnlargedPocket,
    WebCrack,
)
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.options import MeshOptions

POCKETS = 8
BALL_CAGE = BallCage(
    material=MATERIALS["polyimide"],
    bore=20e-3,
    outside_diameter=26e-3,
    width=12e-3,
    pocket_diameter=6e-3,
)
BALL_DEFECTS = (
    EnlargedPocket(pocket=2, increase=0.4e-3),
    ElongatedPocket(pocket=4, direction="axial", elongation=0.8e-3),
    DisplacedPocket(pocket=6, axial=0.3e-3, circumferential=0.2e-3),
    WebCrack(web=1, share=0.3),
)


def ball_mesh(defects=(), fineness="coarse"):
    return build_cage_mesh(
        BALL_CAGE,
        pocket_count=POCKETS,
        pitch_diameter=23e-3,
        defects=defects,
        options=MeshOptions(fineness=fineness),
    )
