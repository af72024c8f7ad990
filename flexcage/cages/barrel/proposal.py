"""A machined cage of usual proportions for a spherical roller bearing."""

from __future__ import annotations

from math import asin, cos, degrees, hypot, radians, sin, tan
from typing import Any

from flexcage.cages.barrel.cage import BarrelCage
from flexcage.geometry.inference import ProposedCage, rounded

# over the barrel's diameter: clearance between the bars, height of the bars' middles over the
# barrels' axes, wall, narrowest and widest rims, fillets; clearance along over the barrel's length
_AROUND, _HEIGHT, _WALL, _FILLET, _ALONG = 0.025, 0.22, 0.22, 0.05, 0.025
_NARROWEST, _WIDEST = 0.06, 0.18
_TO_SPHERE = 0.03  # least clearance to the outer ring, over the barrel's diameter
_STEP = 10e-6  # m


def propose_barrel_cage(bearing: Any) -> ProposedCage:
    """One piece of brass for both rows: bars outside the barrels' axes, where there is room between
    barrels, and a rim between the rows; no thicker than the sphere of the outer ring leaves room.
    """
    diameter = bearing.element_diameter
    flank = radians(round(degrees(asin(2.0 * _HEIGHT))))
    pocket = rounded((1.0 + _ALONG) * bearing.element_length, _STEP)
    rim = _rim(bearing, 0.5 * pocket)
    reach = (0.5 + 0.5 * _AROUND) * diameter
    width = rounded(2.0 * (reach / cos(flank) - _HEIGHT * diameter * tan(flank)), _STEP)
    cage = BarrelCage(
        cone_angle=bearing.axis_angle, pitch_diameter=bearing.pitch_diameter,
        row_distance=rounded(bearing.row_distance, _STEP), rim=rim,
        offset=_offset(bearing, 0.5 * width),
        thickness=_thickness(bearing, 0.5 * pocket + rim), pocket_length=pocket,
        pocket_width=width, flank_angle=flank, fillet_radius=rounded(_FILLET * diameter, _STEP),
    )  # fmt: skip
    return ProposedCage(cage=cage, reasons=_REASONS)


def _offset(bearing: Any, aside: float) -> float:
    """Offset [m] of a wall that is lower at the bars' faces, ``aside`` [m] of the middle plane."""
    height, cosine = _HEIGHT * bearing.element_diameter, cos(bearing.axis_angle)
    y = 0.5 * bearing.pitch_diameter + height * cosine
    return rounded(height + (hypot(y, aside) - y) * cosine, _STEP)


def _rim(bearing: Any, end: float) -> float:
    """Width [m] of rims from the ``end`` s [m] of pockets to the bearing's sides."""
    diameter, angle = bearing.element_diameter, bearing.axis_angle
    aside = (_HEIGHT + 0.5 * _WALL) * diameter * sin(angle)
    room = (0.5 * (bearing.width - bearing.row_distance) - aside) / cos(angle) - end
    return rounded(min(max(room, _NARROWEST * diameter), _WIDEST * diameter), _STEP)


def _thickness(bearing: Any, end: float) -> float:
    """Thickness [m] that leaves its clearance to the sphere at an ``end`` s [m] of the wall."""
    diameter = bearing.element_diameter
    sphere = bearing.sphere_radius - _TO_SPHERE * diameter
    room = (sphere**2 - end**2) ** 0.5 - bearing.reach - 1.1 * _HEIGHT * diameter
    return rounded(min(_WALL * diameter, 2.0 * room), _STEP)


_REASONS = {
    "material": "assumption: machined cages are of brass",
    "cone_angle": "from the barrels' axes",
    "pitch_diameter": "from the barrels",
    "row_distance": "from the barrels",
    "offset": f"assumption: the bars' middles are {_HEIGHT:g} times the barrel's diameter over the "
    "barrels' axes, where they have the width that they need",
    "thickness": f"assumption: {_WALL:g} times the barrel's diameter, or what the outer ring has "
    "room for",
    "rim": f"assumption: as far as the bearing's sides, {_NARROWEST:g} to {_WIDEST:g} times the "
    "barrel's diameter",
    "pocket_length": f"assumption: a clearance of {_ALONG:g} times the barrel's length",
    "pocket_width": f"assumption: a clearance of {_AROUND:g} times the barrel's diameter",
    "flank_angle": "assumption: barrels touch the middle of the bars' faces",
    "fillet_radius": f"assumption: {_FILLET:g} times the barrel's diameter",
}
