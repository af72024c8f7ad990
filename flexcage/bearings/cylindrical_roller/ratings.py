"""Catalogue ratings and equivalent loads of radial roller bearings, ISO 76:2006 and ISO 281:2007.

In N and mm; contact angle 0, one row. ISO/TR 1281-1 explains ISO 281. The standards themselves are
not public: formulas and constants are those that public implementations of them agree on
(Dessia's mechanical_components among them).
"""

from __future__ import annotations

from math import nan

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.core.errors import InputError
from flexcage.geometry.bearing import EquivalentLoad

# The formula's constant is printed as 0.377 * 551.13373 = 207.78, factors of three digits. All
# 20 entries of ISO 281's table of f_c come out to their last digit for 207.891 to 207.915 alone.
_B_RADIAL = 207.9
_LAMBDA_NU = 0.83  # stress concentration at edges and spread of quality, radial roller bearings


def static_rating(bearing: RollerBearing) -> float:
    """ISO 76, 44 (1 - gamma) Z Lwe Dw in N and mm."""
    length, diameter = bearing.effective_length * 1e3, bearing.roller_diameter * 1e3
    return 44.0 * (1.0 - bearing.gamma) * bearing.roller_count * length * diameter


def geometry_factor(gamma: float) -> float:
    """f_c of radial roller bearings [N and mm] at gamma = Dw/Dpw.

    f_c = 207.9 lambda nu gamma^(2/9) (1-gamma)^(29/27)/(1+gamma)^(1/4)
    {1 + [1.04 ((1-gamma)/(1+gamma))^(143/108)]^(9/2)}^(-2/9), which is the formula behind ISO
    281's table and agrees with it to its last digit for gamma from 0.01 to 0.3.
    """
    share = 1.04 * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)
    rings = (1.0 + share**4.5) ** (-2.0 / 9.0)
    shape = gamma ** (2.0 / 9.0) * (1.0 - gamma) ** (29.0 / 27.0) / (1.0 + gamma) ** 0.25
    return _B_RADIAL * _LAMBDA_NU * shape * rings


def dynamic_rating(bearing: RollerBearing) -> float:
    """ISO 281, b_m f_c Lwe^7/9 Z^3/4 Dw^29/27."""
    length, diameter = bearing.effective_length * 1e3, bearing.roller_diameter * 1e3
    size = length ** (7.0 / 9.0) * bearing.roller_count**0.75 * diameter ** (29.0 / 27.0)
    return bearing.rating_factor * geometry_factor(bearing.gamma) * size


def equivalent_load(bearing: RollerBearing, radial: float, axial: float) -> EquivalentLoad:
    """P = Fr: with a contact angle of 0 no axial load is allowed for. What ribs carry is
    limited by their friction; ISO 281 gives no factors for it."""
    if axial != 0.0 and any(bearing.carried):
        return EquivalentLoad(nan, 1.0, nan, 10.0 / 3.0)
    if axial != 0.0:
        raise InputError(
            f"load.axial is {axial:g} N, but ISO 281 rates {bearing.kind}s for radial load "
            "alone; leave it out.",
            where="load.axial",
        )
    return EquivalentLoad(radial, 1.0, 0.0, 10.0 / 3.0)
