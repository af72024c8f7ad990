"""Catalogue ratings and equivalent loads of spherical roller bearings, ISO 76:2006 and ISO
281:2007. ``geometry.rollers`` says where the formulas are from; X and Y are those of ISO 281's
table of radial roller bearings of two rows, as makers print them beside every bearing."""

from __future__ import annotations

from math import cos, tan

from flexcage.bearings.spherical_roller.bearing import SphericalRollerBearing
from flexcage.bearings.two_rows import ROWS
from flexcage.geometry.bearing import EquivalentLoad
from flexcage.geometry.rollers import LIFE_EXPONENT, geometry_factor

_B_M = 1.15  # ISO 281: today's steel and manufacture, spherical roller bearings
_LIMIT, _RADIAL, _BELOW, _BEYOND = 1.5, 0.67, 0.45, 0.67  # e = 1.5 tan(alpha), X, Y tan(alpha)
_STATIC = 0.44  # ISO 76, Y0 tan(alpha)


def static_rating(bearing: SphericalRollerBearing) -> float:
    """ISO 76, 44 (1 - gamma) i Z Lwe Dwe cos(alpha) in N and mm."""
    size = bearing.effective_length * bearing.roller_diameter * 1e6
    count = ROWS * bearing.roller_count
    return 44.0 * (1.0 - bearing.gamma) * count * size * cos(bearing.contact_angle)


def dynamic_rating(bearing: SphericalRollerBearing) -> float:
    """ISO 281, b_m f_c (i Lwe cos(alpha))^7/9 Z^3/4 Dwe^29/27."""
    length = ROWS * bearing.effective_length * 1e3 * cos(bearing.contact_angle)
    diameter = bearing.roller_diameter * 1e3
    size = length**bearing.row_power * bearing.roller_count**0.75 * diameter ** (29.0 / 27.0)
    return _B_M * geometry_factor(bearing.gamma) * size


def axial_limit(bearing: SphericalRollerBearing) -> float:
    """e of ISO 281."""
    return _LIMIT * tan(bearing.contact_angle)


def equivalent_load(bearing: SphericalRollerBearing, radial: float, axial: float) -> EquivalentLoad:
    """P = Fr + 0.45 cot(alpha) Fa up to Fa/Fr = e, then 0.67 Fr + 0.67 cot(alpha) Fa."""
    slope = tan(bearing.contact_angle)
    beyond = axial > axial_limit(bearing) * radial
    x, y = (_RADIAL, _BEYOND / slope) if beyond else (1.0, _BELOW / slope)
    return EquivalentLoad(x * radial + y * axial, x, y, LIFE_EXPONENT)


def static_equivalent_load(bearing: SphericalRollerBearing, radial: float, axial: float) -> float:
    """P0 of ISO 76 [N]: Fr + 0.44 cot(alpha) Fa."""
    return radial + _STATIC / tan(bearing.contact_angle) * axial
