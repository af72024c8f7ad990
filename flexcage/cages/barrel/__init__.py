"""One-piece window cages of spherical roller bearings, for both rows of barrels."""

from __future__ import annotations

from flexcage.cages.barrel import slots
from flexcage.cages.barrel.cage import BarrelCage
from flexcage.cages.cage_type import CageType
from flexcage.cages.window.broken import BrokenCrossbeam
from flexcage.cages.window.defects import CrossbeamDefect, SideBeamDefect, WindowDefect

# specs that ``flexcage.spec`` shows
__all__ = ["BarrelCage"]

CAGE_TYPE = CageType(
    name="barrel",
    spec=BarrelCage,
    holds=("barrel roller",),
    mesh=lambda: slots.mesh,
    interfaces=lambda: slots.interfaces,
    places=lambda: slots.places,
    proposal=lambda: slots.proposal,
    defects=(CrossbeamDefect, SideBeamDefect, BrokenCrossbeam),
    defect_spec=WindowDefect,
    joins=True,
)
