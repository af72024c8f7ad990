"""A pressed conical cage of usual proportions for a tapered roller bearing."""

from __future__ import annotations

from math import asin, cos, degrees, hypot, radians, tan
from typing import Any

from flexcage.cages.conical.cage import ConicalCage
from flexcage.geometry.inference import ProposedCage, rounded

# over the roller's mean diameter: clearance between the bars, wall, height of the bars' middles
# over the rollers' axes, rims, fillets; clearance along over the roller's length
_AROUND, _WALL, _HEIGHT, _RIM, _FILLET, _ALONG = 0.03, 0.13, 0.25, 0.3, 0.05, 0.025
_STEP, _SHEET = 10e-6, 0.05e-3  # m


def propose_conical_cage(bearing: Any) -> ProposedCage:
    """Bars lie outside the rollers' axes, where there is room between rollers, and bear on them
    with flanks that touch in the middle of the wall."""
    diameter = bearing.element_diameter
    flank = radians(round(degrees(asin(2.0 * _HEIGHT))))
    pocket = rounded((1.0 + _ALONG) * bearing.element_length, _STEP)
    small, middle, large = (_width(bearing, flank, s * pocket) for s in (0.5, 0.0, -0.5))
    rim = rounded(_RIM * diameter, _STEP)
    cage = ConicalCage(
        cone_angle=_readable(bearing.axis_angle), pitch_diameter=bearing.pitch_diameter,
        offset=_offset(bearing, 0.5 * middle), thickness=rounded(_WALL * diameter, _SHEET),
        small_rim=rim, large_rim=rim, pocket_length=pocket, pocket_width_small=small,
        pocket_width_large=large, flank_angle=flank,
        fillet_radius=rounded(_FILLET * diameter, _STEP),
    )  # fmt: skip
    return ProposedCage(cage=cage, reasons=_REASONS)


def _readable(angle: float) -> float:
    """The angle [rad] to 1e-4 degrees, as ``contact_angle`` is given."""
    return radians(round(degrees(angle), 4))


def _width(bearing: Any, flank: float, s: float) -> float:
    """Width [m] of a pocket, halfway up the bars' faces, whose flanks are at the clearance from the
    roller, at a place s along it."""
    diameter = bearing.element_diameter
    reach = bearing.roller.radius(s) + 0.5 * _AROUND * diameter
    return rounded(2.0 * (reach / cos(flank) - _HEIGHT * diameter * tan(flank)), _STEP)


def _offset(bearing: Any, aside: float) -> float:
    """Offset [m] of a wall that is lower at the bars' faces, ``aside`` [m] of the middle plane."""
    height, cosine = _HEIGHT * bearing.element_diameter, cos(bearing.axis_angle)
    y = 0.5 * bearing.pitch_diameter + height * cosine
    return rounded(height + (hypot(y, aside) - y) * cosine, _STEP)


_REASONS = {
    "material": "assumption: pressed cages are of steel strip",
    "cone_angle": "from the rollers' axes",
    "pitch_diameter": "from the rollers",
    "offset": f"assumption: the bars' middles are {_HEIGHT:g} times the roller's diameter over the "
    "rollers' axes, where they have the width that they need",
    "thickness": f"assumption: {_WALL:g} times the roller's diameter",
    "small_rim": f"assumption: {_RIM:g} times the roller's diameter",
    "large_rim": f"assumption: {_RIM:g} times the roller's diameter",
    "pocket_length": f"assumption: a clearance of {_ALONG:g} times the roller's length",
    "pocket_width_small": f"assumption: a clearance of {_AROUND:g} times the roller's diameter",
    "pocket_width_large": f"assumption: a clearance of {_AROUND:g} times the roller's diameter",
    "flank_angle": "assumption: coined so that rollers touch the middle of the bars' faces",
    "fillet_radius": f"assumption: {_FILLET:g} times the roller's diameter",
}
