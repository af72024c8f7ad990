"""Machined window cages of cylindrical roller bearings."""

from __future__ import annotations

from flexcage.cages.cage_type import CageType
from flexcage.cages.window import slots
from flexcage.cages.window.broken import BrokenCrossbeam
from flexcage.cages.window.cage import WindowCage
from flexcage.cages.window.defects import CrossbeamDefect, SideBeamDefect, WindowDefect

# specs that ``flexcage.spec`` shows
__all__ = [
    "BrokenCrossbeam",
    "CrossbeamDefect",
    "SideBeamDefect",
    "WindowCage",
    "WindowDefect",
]

CAGE_TYPE = CageType(
    name="window",
    spec=WindowCage,
    holds=("roller",),
    mesh=lambda: slots.mesh,
    interfaces=lambda: slots.interfaces,
    places=lambda: slots.places,
    proposal=lambda: slots.proposal,
    defects=(CrossbeamDefect, SideBeamDefect, BrokenCrossbeam),
    defect_spec=WindowDefect,
    joins=True,
)
