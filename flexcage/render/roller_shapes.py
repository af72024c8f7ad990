"""Rings and rollers of cylindrical roller bearings as solids."""

from __future__ import annotations

from typing import TYPE_CHECKING

from flexcage.geometry.cylindrical_roller import RollerBearing
from flexcage.render.shapes import Profile, Shapes
from flexcage.render.solids import revolved

if TYPE_CHECKING:
    import pyvista


def _rings(b: RollerBearing) -> tuple[Profile, Profile]:
    half, gap = 0.5 * b.width, 0.5 * b.rib_gap
    bore, race, rib = 0.5 * b.bore, 0.5 * b.inner_race_diameter, 0.5 * b.rib_diameter
    outer, outside = 0.5 * b.outer_race_diameter, 0.5 * b.outside_diameter
    return (
        [(-half, bore), (0.0, bore), (0.0, race), (-gap, race), (-gap, rib), (-half, rib)],
        [(-half, outer), (0.0, outer), (0.0, outside), (-half, outside)],
    )


def _element(b: RollerBearing) -> pyvista.PolyData:
    r, half = 0.5 * b.roller_diameter, 0.5 * b.roller_length
    c = 0.05 * b.roller_diameter
    shape = [(-half, 0.0), (half, 0.0), (half, r - c), (half - c, r), (c - half, r), (-half, r - c)]
    return revolved(shape, segments=48)


def _end(b: RollerBearing) -> float:
    return 0.5 * b.roller_length


SHAPES = Shapes(rings=_rings, element=_element, end=_end)
