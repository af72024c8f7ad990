"""Catalogue ratings of bearings, to check that a preset's inside fits its outside, and their life.

Every bearing type registers its own functions here; those of radial roller bearings stand below:
ISO 281:2007 (dynamic, with its explanatory notes ISO/TR 1281-1) and ISO 76:2006 (static), in N and
mm; contact angle 0, one row. The standards themselves are not public: formulas and constants are
those that public implementations of them agree on (Dessia's mechanical_components among them).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import singledispatch
from typing import Any

from flexcage.core.errors import InputError
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cylindrical_roller import RollerBearing

# The formula's constant is printed as 0.377 * 551.13373 = 207.78, factors of three digits. All
# 20 entries of ISO 281's table of f_c come out to their last digit for 207.891 to 207.915 alone.
_B_RADIAL = 207.9
_LAMBDA_NU = 0.83  # stress concentration at edges and spread of quality, radial roller bearings
_B_M = 1.1  # ISO 281: today's steel and manufacture, cylindrical roller bearings


@dataclass(frozen=True)
class EquivalentLoad:
    """Dynamic equivalent load P [N] of ISO 281, its factors, and the exponent of life.

    The load is not a number where the standard gives no factors.
    """

    load: float
    radial_factor: float  # X
    axial_factor: float  # Y
    exponent: float


def _unknown(bearing: Any) -> NotImplementedError:
    return NotImplementedError(f"no ratings are registered for {type(bearing).__name__}")


@singledispatch
def static_rating(bearing: Bearing) -> float:
    """Basic static load rating C0 [N] of ISO 76: radial, or axial for thrust bearings."""
    raise _unknown(bearing)


@singledispatch
def dynamic_rating(bearing: Bearing) -> float:
    """Basic dynamic load rating C [N] of ISO 281: radial, or axial for thrust bearings."""
    raise _unknown(bearing)


@singledispatch
def equivalent_load(bearing: Bearing, radial: float, axial: float) -> EquivalentLoad:
    """Dynamic equivalent load of ISO 281 under a radial and an axial load [N], both >= 0."""
    raise _unknown(bearing)


def rating_names(bearing: Bearing) -> tuple[str, str]:
    """Symbols of the static and the dynamic rating."""
    return ("C0a", "Ca") if bearing.is_thrust else ("C0r", "Cr")


@static_rating.register
def _(bearing: RollerBearing) -> float:
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


@dynamic_rating.register
def _(bearing: RollerBearing) -> float:
    """ISO 281, b_m f_c Lwe^7/9 Z^3/4 Dw^29/27."""
    length, diameter = bearing.effective_length * 1e3, bearing.roller_diameter * 1e3
    size = length ** (7.0 / 9.0) * bearing.roller_count**0.75 * diameter ** (29.0 / 27.0)
    return _B_M * geometry_factor(bearing.gamma) * size


@equivalent_load.register
def _(bearing: RollerBearing, radial: float, axial: float) -> EquivalentLoad:
    """P = Fr: with a contact angle of 0 no axial load is allowed for."""
    if axial != 0.0:
        raise InputError(
            f"load.axial is {axial:g} N, but ISO 281 rates cylindrical roller bearings for radial "
            "load alone; leave it out.",
            where="load.axial",
        )
    return EquivalentLoad(radial, 1.0, 0.0, 10.0 / 3.0)
