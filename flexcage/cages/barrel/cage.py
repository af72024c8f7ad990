"""One-piece window cages of spherical roller bearings: frozen specs.

Two walls about cones, whose large rims meet in the bearing's middle and are one rim there. Numbers
are those of the half of the row at +x, as of a conical cage (``conical.shape``): s counts along a
barrel's axis away from the bearing's middle. The half of the row at -x is its mirror image.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import cos, pi, sin
from typing import Any, ClassVar

import numpy as np

from flexcage.cages.conical.cage import STEEPEST
from flexcage.cages.conical.shape import ConeShaped
from flexcage.core.spec import option, quantity
from flexcage.core.units import mm, typeset
from flexcage.geometry.cage import HeldElements, Objection, cages_of
from flexcage.geometry.materials import MATERIALS, Material

GUIDANCE = ("roller",)
BARREL_CAGES = cages_of("barrel roller")
ROWS = 2


@dataclass(frozen=True, kw_only=True)
class BarrelCage(ConeShaped):
    """A machined window cage for both rows of barrels, as of the makers' types CA and MA.

    Pocket walls are planes: the ends across the barrel's axis, and the bars' faces parallel to it,
    which approach each other outwards by the ``flank_angle``.
    """

    cage_type: ClassVar[str] = "barrel"
    altered: ClassVar[str] = "Deformed"
    mirrored: ClassVar[bool] = True
    widths: ClassVar[tuple[str, str]] = ("pocket_width", "pocket_width")

    type: str = option("barrel", doc="kind of cage", choices=BARREL_CAGES)
    material: Material = option(MATERIALS["brass"], doc="cage material (a name or its values)")
    cone_angle: float = quantity(
        "deg", doc="half angle of the cones, that of the barrels' axes", above=0.0,
        maximum=0.25 * pi,
    )  # fmt: skip
    pitch_diameter: float = quantity(
        "mm", doc="diameter on which the pockets' middles lie, the barrels' Dpw", above=0.0
    )
    row_distance: float = quantity(
        "mm", doc="axial distance of the pockets' middles of both rows, the barrels'", above=0.0
    )
    offset: float = quantity(
        "mm", doc="distance of the wall's middle from the barrels' axes; > 0 outwards"
    )
    thickness: float = quantity("mm", doc="thickness of the wall", above=0.0)
    rim: float = quantity("mm", doc="width of the rims at both ends, along the wall", above=0.0)
    pocket_length: float = quantity("mm", doc="pocket length along the barrel's axis", above=0.0)
    pocket_width: float = quantity("mm", doc="pocket width halfway up the bars' faces", above=0.0)
    flank_angle: float = quantity(
        "deg", 0.0, doc="slope of the bars' faces: pockets narrow outwards where it is > 0",
        minimum=-STEEPEST, maximum=STEEPEST,
    )  # fmt: skip
    fillet_radius: float = quantity(
        "mm",
        0.5e-3,
        doc="pocket corner fillet radius",
        above=0.0,
        assumption="not given; a corner as cutters leave it: without one, root stress is singular",
    )
    guidance: str = option("roller", doc="what guides the cage radially", choices=GUIDANCE)

    @property
    def small_rim(self) -> float:
        return self.rim

    @property
    def large_rim(self) -> float:
        """Width [m] of a half's part of the rim between the rows, where it is narrowest."""
        ends = (float(self.large_end(n)) for n in self.section[2:])
        return -0.5 * self.pocket_length - max(ends)

    @property
    def pocket_width_small(self) -> float:
        return self.pocket_width

    @property
    def pocket_width_large(self) -> float:
        return self.pocket_width

    def large_end(self, n: Any) -> Any:
        """In the bearing's middle plane."""
        middle = -0.5 * self.row_distance
        return (middle - np.asarray(n) * sin(self.cone_angle)) / cos(self.cone_angle)

    def from_large_end(self, points: np.ndarray) -> np.ndarray:
        distance: np.ndarray = points[:, 0] + 0.5 * self.row_distance
        return distance

    @property
    def half_width_along(self) -> float:
        """How far [m] it reaches from the bearing's middle to either side."""
        return self.ends[1] + 0.5 * self.row_distance

    @property
    def width(self) -> float:  # type: ignore[override]
        return 2.0 * self.half_width_along

    @property
    def axial_reach(self) -> float:
        return self.half_width_along

    @property
    def inner_reach(self) -> float:
        return 0.5 * self.row_distance

    @property
    def most_unbalance(self) -> float:
        return ROWS * super().most_unbalance

    def in_words(self) -> str:
        return (
            f"its two walls, {typeset(self.thickness, 'mm')} thick, are cones of "
            f"{typeset(self.cone_angle, 'deg', digits=4)}; pockets are "
            f"{typeset(self.pocket_width, 'mm')} wide and {typeset(self.pocket_length, 'mm')} long"
        )

    def impossible(self, pocket_count: int) -> Iterator[Objection]:
        if self.large_rim <= 0.0:
            least = self.pocket_length + 2.0 * self.large_rim
            yield (
                "pocket_length",
                "so the pockets of both rows run into each other in the middle of the cage; it "
                f"must be less than {mm(least)}",
            )
            return
        yield from super().impossible(pocket_count)

    def obstructions(self, bearing: HeldElements) -> Iterator[Objection]:
        from flexcage.cages.barrel.rollers import obstructions

        return obstructions(self, bearing)
