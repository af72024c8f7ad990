"""Riveted ribbon cages of deep groove ball bearings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from flexcage.cages.cage_type import CageType
from flexcage.cages.machined.defects import BallCageDefect
from flexcage.cages.ribbon.cage import RibbonCage
from flexcage.cages.ribbon.defects import MissingRivet

# specs that ``flexcage.spec`` shows
__all__ = ["MissingRivet", "RibbonCage"]

if TYPE_CHECKING:
    from flexcage.geometry.inside import CageProposal
    from flexcage.mesh.build import MeshBuilder
    from flexcage.modes.reduction import Interfaces
    from flexcage.stress.places import Places


def _mesh() -> MeshBuilder[RibbonCage]:
    from flexcage.cages.ribbon.build import build_ribbon_mesh

    return build_ribbon_mesh


def _interfaces() -> Interfaces[RibbonCage]:
    from flexcage.cages.machined.interface import ROUND_INTERFACES

    return ROUND_INTERFACES


def _places() -> Places:
    from flexcage.cages.machined.places import ROUND_PLACES

    return ROUND_PLACES


def _proposal() -> CageProposal:
    from flexcage.cages.ribbon.proposal import propose_ribbon_cage

    return propose_ribbon_cage


CAGE_TYPE = CageType(
    name="ribbon", spec=RibbonCage, holds=("ball",), mesh=_mesh, interfaces=_interfaces,
    places=_places, proposal=_proposal, defects=(MissingRivet,),
    defect_spec=BallCageDefect,
)  # fmt: skip
