"""Riveted ribbon cages of deep groove ball bearings."""

from __future__ import annotations

from flexcage.cages.cage_type import CageType
from flexcage.cages.ribbon import slots
from flexcage.cages.ribbon.cage import RibbonCage
from flexcage.cages.ribbon.defects import MissingRivet
from flexcage.cages.round_pocket.defects import BallCageDefect

# specs that ``flexcage.spec`` shows
__all__ = ["MissingRivet", "RibbonCage"]

CAGE_TYPE = CageType(
    name="ribbon",
    spec=RibbonCage,
    holds=("ball",),
    mesh=lambda: slots.mesh,
    interfaces=lambda: slots.interfaces,
    places=lambda: slots.places,
    proposal=lambda: slots.proposal,
    defects=(MissingRivet,),
    defect_spec=BallCageDefect,
)
