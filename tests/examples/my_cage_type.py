"""A user's own cage type: a machined cage of ball bearings whose ends are turned down outside."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any, ClassVar

import numpy as np

from flexcage import register
from flexcage.cages import CageType
from flexcage.cages.machined import CAGE_TYPE as MACHINED
from flexcage.cages.round_pocket.cage import BALL_CAGES, BallCage
from flexcage.mesh.build import MeshBuilder
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.options import MeshOptions
from flexcage.register import option, quantity


@dataclass(frozen=True, kw_only=True)
class TaperedCage(BallCage):
    """Its outside tapers from the pockets to both ends, where it has lost ``taper`` in radius."""

    cage_type: ClassVar[str] = "tapered"

    type: str = option("tapered", doc="kind of cage", choices=BALL_CAGES)
    taper: float = quantity("mm", doc="what each end has lost in radius", above=0.0)


def build_tapered_mesh(
    cage: TaperedCage,
    pocket_count: int,
    pitch_diameter: float,
    defects: Sequence[Any],
    options: MeshOptions,
) -> CageMesh:
    """The machined cage's mesh, drawn in towards its ends in proportion to the height over the
    bore."""
    mesh = MACHINED.mesh()(cage, pocket_count, pitch_diameter, defects, options)
    radius = np.hypot(mesh.points[:, 1], mesh.points[:, 2])
    inner, outer, rim = 0.5 * cage.bore, 0.5 * cage.outside_diameter, 0.5 * cage.pocket_diameter
    near_end = np.clip((np.abs(mesh.points[:, 0]) - rim) / (0.5 * cage.width - rim), 0.0, 1.0)
    lost = cage.taper * near_end * (radius - inner) / (outer - inner)
    points = mesh.points.copy()
    points[:, 1:] *= (1.0 - lost / radius)[:, None]
    return replace(mesh, points=points)


def _mesh() -> MeshBuilder[TaperedCage]:
    return build_tapered_mesh


register.cage_type(
    CageType(
        name="tapered",
        spec=TaperedCage,
        holds=("ball",),
        mesh=_mesh,
        interfaces=MACHINED.interfaces,
        places=MACHINED.places,
        proposal=None,
    )
)
