"""Cages of ball bearings."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sin

from flexcage.core.spec import option, quantity
from flexcage.geometry.cage import Cage
from flexcage.geometry.materials import MATERIALS, Material

POCKET_SHAPES = ("cylindrical", "spherical")
GUIDANCE = ("ball", "inner", "outer")


@dataclass(frozen=True, kw_only=True)
class BallCage(Cage):
    """A cage with one round pocket per ball: a hollow cylinder with radial holes, or spheres.

    ``pocket_diameter`` is that of cylinder or sphere. A cage that a ring guides has its land there,
    with the clearance of [contacts.land].
    """

    material: Material = option(MATERIALS["PA66"], doc="cage material (a name or its values)")
    pocket_diameter: float = quantity("mm", doc="diameter of a pocket", above=0.0)
    pocket_shape: str = option("cylindrical", doc="shape of pockets", choices=POCKET_SHAPES)
    pocket_scatter: float = quantity(
        "um", 0.0, doc="standard deviation of pockets' places around the cage", minimum=0.0
    )
    guidance: str = option("ball", doc="what guides the cage radially", choices=GUIDANCE)

    def thinnest(self, pitch_diameter: float, pocket_count: int) -> float:
        web = pitch_diameter * sin(pi / pocket_count) - self.pocket_diameter
        wall, rim = self.outside_diameter - self.bore, self.width - self.pocket_diameter
        return min(0.5 * wall, 0.5 * rim, web)
