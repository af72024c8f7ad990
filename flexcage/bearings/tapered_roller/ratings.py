"""Catalogue ratings and equivalent loads of single-row tapered roller bearings, ISO 76:2006 and ISO
281:2007. ``geometry.rollers`` says where the formulas are from."""

from __future__ import annotations

from math import cos, tan

from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing
from flexcage.geometry.bearing import EquivalentLoad
from flexcage.geometry.rollers import B_M, LIFE_EXPONENT, geometry_factor


def static_rating(bearing: TaperedRollerBearing) -> float:
    """ISO 76, 44 (1 - gamma) Z Lwe Dwe cos(alpha) in N and mm."""
    size = bearing.effective_length * bearing.roller_diameter * 1e6
    along = cos(bearing.contact_angle)
    return 44.0 * (1.0 - bearing.gamma) * bearing.roller_count * size * along


def dynamic_rating(bearing: TaperedRollerBearing) -> float:
    """ISO 281, b_m f_c (Lwe cos(alpha))^7/9 Z^3/4 Dwe^29/27."""
    length = bearing.effective_length * 1e3 * cos(bearing.contact_angle)
    diameter = bearing.roller_diameter * 1e3
    size = length ** (7.0 / 9.0) * bearing.roller_count**0.75 * diameter ** (29.0 / 27.0)
    return B_M * geometry_factor(bearing.gamma) * size


def axial_limit(bearing: TaperedRollerBearing) -> float:
    """e of ISO 281, 1.5 tan(alpha)."""
    return 1.5 * tan(bearing.contact_angle)


def equivalent_load(bearing: TaperedRollerBearing, radial: float, axial: float) -> EquivalentLoad:
    """P = Fr up to Fa/Fr = e, then 0.4 Fr + 0.4 cot(alpha) Fa."""
    beyond = axial > axial_limit(bearing) * radial
    x, y = (0.4, 0.4 / tan(bearing.contact_angle)) if beyond else (1.0, 0.0)
    return EquivalentLoad(x * radial + y * axial, x, y, LIFE_EXPONENT)


def static_equivalent_load(bearing: TaperedRollerBearing, radial: float, axial: float) -> float:
    """P0 of ISO 76 [N]: 0.5 Fr + 0.22 cot(alpha) Fa, and no less than Fr."""
    return max(radial, 0.5 * radial + 0.22 / tan(bearing.contact_angle) * axial)
