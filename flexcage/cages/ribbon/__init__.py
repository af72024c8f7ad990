"""Riveted ribbon cages of deep groove ball bearings."""

from flexcage.cages.cage_type import CageType
from flexcage.geometry.ribbon_cage import RibbonCage

RIBBON = CageType(name="ribbon", spec=RibbonCage)
