"""Machined window cages of cylindrical roller bearings."""

from flexcage.cages.cage_type import CageType
from flexcage.geometry.cages import WindowCage

WINDOW = CageType(name="window", spec=WindowCage)
