"""Machined cages of ball bearings: a hollow cylinder with round pockets."""

from __future__ import annotations

from typing import TYPE_CHECKING

from flexcage.cages.cage_type import CageType
from flexcage.cages.machined.cage import BallCage
from flexcage.cages.machined.defects import (
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

if TYPE_CHECKING:
    from flexcage.geometry.inside import CageProposal
    from flexcage.mesh.build import MeshBuilder
    from flexcage.modes.reduction import Interfaces
    from flexcage.stress.places import Places


def _mesh() -> MeshBuilder[BallCage]:
    from flexcage.cages.machined.build import build_ball_cage_mesh

    return build_ball_cage_mesh


def _interfaces() -> Interfaces[BallCage]:
    from flexcage.cages.machined.interface import ROUND_INTERFACES

    return ROUND_INTERFACES


def _places() -> Places:
    from flexcage.cages.machined.places import ROUND_PLACES

    return ROUND_PLACES


def _proposal() -> CageProposal:
    from flexcage.cages.machined.proposal import propose_machined_cage

    return propose_machined_cage


CAGE_TYPE = CageType(
    name="machined", spec=BallCage, holds=("ball",), mesh=_mesh, interfaces=_interfaces,
    places=_places, proposal=_proposal, defect_spec=BallCageDefect,
    defects=(EnlargedPocket, ElongatedPocket, DisplacedPocket, WebCrack),
)  # fmt: skip
