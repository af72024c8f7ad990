"""Catalogue ratings of radial roller bearings, to check that a preset's inside fits its outside."""

from __future__ import annotations

from flexcage.geometry.cylindrical_roller import RollerBearing

_B_RADIAL = 207.9332  # N and mm; ISO/TR 1281-1, line contact
_LAMBDA_NU = 0.83  # ISO/TR 1281-1: stress concentration at edges and spread of quality
_B_M = 1.1  # ISO 281: today's steel and manufacture, cylindrical roller bearings


def static_rating(bearing: RollerBearing) -> float:
    """Basic static radial load rating C0r [N]: ISO 76, 44 (1 - gamma) Z Lwe Dw in N and mm."""
    length, diameter = bearing.effective_length * 1e3, bearing.roller_diameter * 1e3
    return 44.0 * (1.0 - bearing.gamma) * bearing.roller_count * length * diameter


def geometry_factor(gamma: float) -> float:
    """f_c of radial roller bearings from the formula behind ISO 281's table (ISO/TR 1281-1).

    Agrees with that table to 0.1 for gamma from 0.01 to 0.3; 83.8 at the N1013's 0.097.
    """
    share = 1.04 * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)
    rings = (1.0 + share**4.5) ** (-2.0 / 9.0)
    shape = gamma ** (2.0 / 9.0) * (1.0 - gamma) ** (29.0 / 27.0) / (1.0 + gamma) ** 0.25
    return _B_RADIAL * _LAMBDA_NU * shape * rings


def dynamic_rating(bearing: RollerBearing) -> float:
    """Basic dynamic radial load rating Cr [N]: ISO 281, b_m f_c Lwe^7/9 Z^3/4 Dw^29/27."""
    length, diameter = bearing.effective_length * 1e3, bearing.roller_diameter * 1e3
    size = length ** (7.0 / 9.0) * bearing.roller_count**0.75 * diameter ** (29.0 / 27.0)
    return _B_M * geometry_factor(bearing.gamma) * size
