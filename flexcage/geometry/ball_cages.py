"""Cages of ball bearings: as much as their static solution and its checks need."""

from __future__ import annotations

from dataclasses import dataclass

from flexcage.core.spec import option, quantity
from flexcage.geometry.materials import MATERIALS, Material


@dataclass(frozen=True, kw_only=True)
class BallCage:
    """A cage with one round pocket per ball; ``pocket_diameter`` is that of cylinder or sphere."""

    material: Material = option(MATERIALS["PA66"], doc="cage material (a name or its values)")
    bore: float = quantity("mm", doc="inside diameter", above=0.0)
    outside_diameter: float = quantity("mm", doc="outside diameter", above=0.0)
    width: float = quantity("mm", doc="axial width", above=0.0)
    pocket_diameter: float = quantity("mm", doc="diameter of a pocket", above=0.0)
