"""Conical window cages of tapered roller bearings."""

from __future__ import annotations

from flexcage.cages.cage_type import CageType
from flexcage.cages.conical import slots
from flexcage.cages.conical.cage import ConicalCage
from flexcage.cages.window.broken import BrokenCrossbeam
from flexcage.cages.window.defects import CrossbeamDefect, SideBeamDefect, WindowDefect

# specs that ``flexcage.spec`` shows
__all__ = ["ConicalCage"]

CAGE_TYPE = CageType(
    name="conical",
    spec=ConicalCage,
    holds=("tapered roller",),
    mesh=lambda: slots.mesh,
    interfaces=lambda: slots.interfaces,
    places=lambda: slots.places,
    proposal=lambda: slots.proposal,
    defects=(CrossbeamDefect, SideBeamDefect, BrokenCrossbeam),
    defect_spec=WindowDefect,
)
