"""Catalogue ratings and equivalent loads of radial roller bearings, ISO 76:2006 and ISO 281:2007.

In N and mm; contact angle 0, one row. ``geometry.rollers`` says where the formulas are from.
"""

from __future__ import annotations

from math import nan

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.core.errors import InputError
from flexcage.geometry.bearing import EquivalentLoad
from flexcage.geometry.rollers import LIFE_EXPONENT, geometry_factor


def static_rating(bearing: RollerBearing) -> float:
    """ISO 76, 44 (1 - gamma) Z Lwe Dw in N and mm."""
    length, diameter = bearing.effective_length * 1e3, bearing.roller_diameter * 1e3
    return 44.0 * (1.0 - bearing.gamma) * bearing.roller_count * length * diameter


def dynamic_rating(bearing: RollerBearing) -> float:
    """ISO 281, b_m f_c Lwe^7/9 Z^3/4 Dw^29/27."""
    length, diameter = bearing.effective_length * 1e3, bearing.roller_diameter * 1e3
    size = length ** (7.0 / 9.0) * bearing.roller_count**0.75 * diameter ** (29.0 / 27.0)
    return bearing.rating_factor * geometry_factor(bearing.gamma) * size


def equivalent_load(bearing: RollerBearing, radial: float, axial: float) -> EquivalentLoad:
    """P = Fr: with a contact angle of 0 no axial load is allowed for. What ribs carry is
    limited by their friction; ISO 281 gives no factors for it."""
    if axial != 0.0 and any(bearing.carried):
        return EquivalentLoad(nan, 1.0, nan, LIFE_EXPONENT)
    if axial != 0.0:
        raise InputError(
            f"load.axial is {axial:g} N, but ISO 281 rates {bearing.kind}s for radial load "
            "alone; leave it out.",
            where="load.axial",
        )
    return EquivalentLoad(radial, 1.0, 0.0, LIFE_EXPONENT)
