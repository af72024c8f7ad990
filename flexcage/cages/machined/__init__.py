"""Machined cages of ball bearings: a hollow cylinder with round pockets."""

from __future__ import annotations

from typing import TYPE_CHECKING

from flexcage.cages.cage_type import CageType
from flexcage.geometry.ball_cage_defects import (
    BallCageDefect,
    DisplacedPocket,
    ElongatedPocket,
    EnlargedPocket,
    WebCrack,
)
from flexcage.geometry.ball_cages import BallCage

if TYPE_CHECKING:
    from flexcage.mesh.build import MeshBuilder
    from flexcage.modes.reduction import Interfaces
    from flexcage.stress.places import Places


def _mesh() -> MeshBuilder[BallCage]:
    from flexcage.mesh.ball_build import build_ball_cage_mesh

    return build_ball_cage_mesh


def _interfaces() -> Interfaces[BallCage]:
    from flexcage.modes.ball_interface import ROUND_INTERFACES

    return ROUND_INTERFACES


def _places() -> Places:
    from flexcage.stress.round_places import ROUND_PLACES

    return ROUND_PLACES


MACHINED = CageType(
    name="machined", spec=BallCage, holds=("ball",), mesh=_mesh, interfaces=_interfaces,
    places=_places, defects=(EnlargedPocket, ElongatedPocket, DisplacedPocket, WebCrack),
    defect_spec=BallCageDefect,
)  # fmt: skip
