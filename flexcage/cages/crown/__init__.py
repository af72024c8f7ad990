"""Crown (snap) cages of deep groove ball bearings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from flexcage.cages.cage_type import CageType
from flexcage.cages.crown.cage import CrownCage
from flexcage.cages.crown.defects import (
    BentClaw,
    ClawDefect,
    CrackedClaw,
    CrownDefect,
    MissingClaw,
    WornPocket,
)

# specs that ``flexcage.spec`` shows
__all__ = [
    "BentClaw",
    "ClawDefect",
    "CrackedClaw",
    "CrownCage",
    "CrownDefect",
    "MissingClaw",
    "WornPocket",
]

if TYPE_CHECKING:
    from flexcage.geometry.inside import CageProposal
    from flexcage.mesh.build import MeshBuilder
    from flexcage.modes.reduction import Interfaces
    from flexcage.stress.places import Places


def _mesh() -> MeshBuilder[CrownCage]:
    from flexcage.cages.crown.build import build_crown_mesh

    return build_crown_mesh


def _interfaces() -> Interfaces[CrownCage]:
    from flexcage.cages.crown.interface import CROWN_INTERFACES

    return CROWN_INTERFACES


def _places() -> Places:
    from flexcage.cages.crown.places import CROWN_PLACES

    return CROWN_PLACES


def _proposal() -> CageProposal:
    from flexcage.cages.crown.proposal import propose_crown_cage

    return propose_crown_cage


CAGE_TYPE = CageType(
    name="crown", spec=CrownCage, holds=("ball",), mesh=_mesh, interfaces=_interfaces,
    places=_places, proposal=_proposal, defect_spec=CrownDefect,
    defects=(BentClaw, CrackedClaw, MissingClaw, WornPocket),
)  # fmt: skip
