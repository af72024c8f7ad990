"""Machined window cages of cylindrical roller bearings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from flexcage.cages.cage_type import CageType
from flexcage.cages.window.cage import WindowCage
from flexcage.cages.window.defects import CrossbeamDefect, SideBeamDefect, WindowDefect

# specs that ``flexcage.spec`` shows
__all__ = [
    "CrossbeamDefect",
    "SideBeamDefect",
    "WindowCage",
    "WindowDefect",
]

if TYPE_CHECKING:
    from flexcage.geometry.inside import CageProposal
    from flexcage.mesh.build import MeshBuilder
    from flexcage.modes.reduction import Interfaces
    from flexcage.stress.places import Places


def _mesh() -> MeshBuilder[WindowCage]:
    from flexcage.cages.window.build import build_window_mesh

    return build_window_mesh


def _interfaces() -> Interfaces[WindowCage]:
    from flexcage.cages.window.interface import WINDOW_INTERFACES

    return WINDOW_INTERFACES


def _places() -> Places:
    from flexcage.cages.window.places import WINDOW_PLACES

    return WINDOW_PLACES


def _proposal() -> CageProposal:
    from flexcage.cages.window.proposal import propose_window_cage

    return propose_window_cage


CAGE_TYPE = CageType(
    name="window", spec=WindowCage, holds=("roller",), mesh=_mesh, interfaces=_interfaces,
    places=_places, proposal=_proposal, defects=(CrossbeamDefect, SideBeamDefect),
    defect_spec=WindowDefect,
)  # fmt: skip
