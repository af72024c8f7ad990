"""Single-row cylindrical roller bearings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from flexcage.bearings.family import Family
from flexcage.geometry.cylindrical_roller import OTHER_DESIGNS, RollerBearing

if TYPE_CHECKING:
    from flexcage.render.shapes import ShapesOf


def _shapes() -> ShapesOf:
    from flexcage.render.roller_shapes import roller_shapes

    return roller_shapes


FAMILY = Family(
    name="cylindrical_roller",
    types=(RollerBearing,),
    other_designs=OTHER_DESIGNS,
    shapes=_shapes,
)
