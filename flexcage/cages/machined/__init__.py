"""Machined cages of ball bearings: a hollow cylinder with round pockets."""

from __future__ import annotations

from flexcage.cages.cage_type import CageType
from flexcage.cages.machined import slots
from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.round_pocket.defects import (
    BallCageDefect,
    DisplacedPocket,
    ElongatedPocket,
    EnlargedPocket,
    WebCrack,
)

# specs that ``flexcage.spec`` shows
__all__ = [
    "BallCage",
    "BallCageDefect",
    "DisplacedPocket",
    "ElongatedPocket",
    "EnlargedPocket",
    "WebCrack",
]

CAGE_TYPE = CageType(
    name="machined",
    spec=BallCage,
    holds=("ball",),
    mesh=lambda: slots.mesh,
    interfaces=lambda: slots.interfaces,
    places=lambda: slots.places,
    proposal=lambda: slots.proposal,
    defect_spec=BallCageDefect,
    defects=(EnlargedPocket, ElongatedPocket, DisplacedPocket, WebCrack),
    joins=True,
)
