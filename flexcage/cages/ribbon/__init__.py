"""Riveted ribbon cages of deep groove ball bearings."""

from flexcage.cages.cage_type import CageType
from flexcage.geometry.ball_cage_defects import BallCageDefect
from flexcage.geometry.ribbon_cage import RibbonCage
from flexcage.geometry.ribbon_defects import MissingRivet

RIBBON = CageType(
    name="ribbon", spec=RibbonCage, defects=(MissingRivet,), defect_spec=BallCageDefect
)
