"""Machined cages of ball bearings: a hollow cylinder with round pockets."""

from flexcage.cages.cage_type import CageType
from flexcage.geometry.ball_cage_defects import (
    BallCageDefect,
    DisplacedPocket,
    ElongatedPocket,
    EnlargedPocket,
    WebCrack,
)
from flexcage.geometry.ball_cages import BallCage

MACHINED = CageType(
    name="machined",
    spec=BallCage,
    defects=(EnlargedPocket, ElongatedPocket, DisplacedPocket, WebCrack),
    defect_spec=BallCageDefect,
)
