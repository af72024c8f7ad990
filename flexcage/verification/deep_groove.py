"""Deep groove ball bearings of the chapter in motion: a case with a rigid cage for any of them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from flexcage.case import Case
from flexcage.mesh.options import MeshOptions
from flexcage.system.spec import Load

if TYPE_CHECKING:
    from flexcage.bearings.ball.bearing import BallBearing


def case_of(bearing: BallBearing, *tables: Mapping[str, object]) -> Case:
    """A bearing without weight in a rigid cage with 4 % of play; ``tables`` map dotted paths to
    text, later ones win."""
    ball, pitch = bearing.ball_diameter, bearing.pitch_diameter
    cage = bearing.cage_spec(
        bore=pitch - 0.4 * ball, outside_diameter=pitch + 0.4 * ball, width=1.5 * ball,
        pocket_diameter=1.04 * ball,
    )  # fmt: skip
    case = Case(
        bearing=bearing, cage=cage, cage_model="rigid", mesh=MeshOptions(fineness="coarse"),
        load=Load(gravity=0.0),
    )  # fmt: skip
    return case.replace(si=False, **{k: v for t in tables for k, v in t.items()})
