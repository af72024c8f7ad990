"""Machined window cages of cylindrical roller bearings."""

from flexcage.cages.cage_type import CageType
from flexcage.geometry.cages import WindowCage
from flexcage.geometry.window_defects import CrossbeamDefect, SideBeamDefect, WindowDefect

WINDOW = CageType(
    name="window",
    spec=WindowCage,
    defects=(CrossbeamDefect, SideBeamDefect),
    defect_spec=WindowDefect,
)
