"""Catalogue ratings and equivalent loads of single-row ball bearings, ISO 76:2006 and ISO 281:2007.

The factors f_0 and f_c are computed from what stands behind the standards' tables (ISO/TR 10657,
ISO/TR 1281-1): Hertz contact at 4200 MPa, and Lundberg and Palmgren's formula; the tests compare
both with the tables. Above 45 degrees of contact angle a bearing is a thrust bearing, with axial
ratings. The standards' grooves are the closest that count: closer ones do not raise a rating, wider
ones lower it.
"""

from __future__ import annotations

from math import cos, degrees, nan, sin, tan

import numpy as np

from flexcage.bearings.ball.bearing import BallBearing
from flexcage.bearings.two_rows import ROWS
from flexcage.geometry.bearing import EquivalentLoad
from flexcage.geometry.hertz import PointContact, load_at_pressure

STATIC_PRESSURE = 4.2e9  # Pa, ISO 76, balls
STRIBECK = 5.0  # ISO 76: C0r = Z Q cos(alpha)/5
_STEEL = 207e9 / (1.0 - 0.3**2)  # Pa, of the standard's table
_B_M = 1.3  # ISO 281: today's steel and manufacture, ball bearings
# Lundberg and Palmgren's constants in kgf and mm, g of ISO 80000, and the standard's reduction
# factors lambda: 0.95 for one row of radial contact, 0.9 for thrust bearings
LUNDBERG_PALMGREN = 98.0665 * 0.41
_RADIAL, _THRUST = LUNDBERG_PALMGREN * 0.95, 98.0665 * 0.9
_SIZE_LIMIT = 25.4  # mm: beyond, the standard has 3.647 Dw^1.4 for Dw^1.8

# ISO 281, table 3: X and e; Y = (1 - X)/e is the table's to its rounding, without its jumps. Deep
# grooves (0) and angular contact of 10 and 15 degrees over f0 Fa/C0r
_RELATIVE_LOADS = {
    0.0: (0.172, 0.345, 0.689, 1.03, 1.38, 2.07, 3.45, 5.17, 6.89),
    10.0: (0.175, 0.35, 0.7, 1.05, 1.4, 2.1, 3.5, 5.25, 7.0),
    15.0: (0.178, 0.357, 0.714, 1.07, 1.43, 2.14, 3.57, 5.35, 7.14),
}
_LIMITS = {
    0.0: (0.19, 0.22, 0.26, 0.28, 0.30, 0.34, 0.38, 0.42, 0.44),
    10.0: (0.29, 0.32, 0.36, 0.38, 0.40, 0.44, 0.49, 0.54, 0.54),
    15.0: (0.38, 0.40, 0.43, 0.46, 0.47, 0.50, 0.55, 0.56, 0.56),
}
_RADIAL_FACTORS = {0.0: 0.56, 10.0: 0.46, 15.0: 0.44}
# from 20 degrees on: contact angle, e, X; and of thrust bearings, with Y = 1
_STEEP = np.array([
    (20.0, 0.57, 0.43), (25.0, 0.68, 0.41), (30.0, 0.80, 0.39), (35.0, 0.95, 0.37),
    (40.0, 1.14, 0.35), (45.0, 1.34, 0.33),
])  # fmt: skip
_THRUST_TABLE = np.array([
    (45.0, 1.25, 0.66), (50.0, 1.49, 0.73), (55.0, 1.79, 0.81), (60.0, 2.17, 0.92),
    (65.0, 2.68, 1.06), (70.0, 3.43, 1.28), (75.0, 4.67, 1.66), (80.0, 7.09, 2.43),
    (85.0, 14.29, 4.80),
])  # fmt: skip


def static_factor(
    gamma: float,
    inner: float,
    outer: float,
    *,
    modulus: float = _STEEL,
    pressure: float = STATIC_PRESSURE,
) -> float:
    """Load of a ball at ``pressure`` over its diameter squared [N/mm^2], at D cos(alpha)/Dpw.

    ``inner`` and ``outer`` are the grooves' conformities. A fifth of it is f_0 of radial bearings.
    """
    loads = []
    for side, conformity in ((-1.0, inner), (1.0, outer)):
        unit = PointContact(
            rolling=0.5 * (1.0 + side * gamma),
            transverse=conformity / (2.0 * conformity - 1.0),
            modulus=modulus,
        )  # of a ball 1 m in diameter
        loads.append(load_at_pressure(unit, pressure))
    return 1e-6 * min(loads)


def shape_factor(gamma: float, inner: float, outer: float, spread: float) -> float:
    """What f_c of radial and of thrust ball bearings have in common."""
    share = ring_share(gamma, inner, outer, spread)
    rings = (1.0 + share ** (10.0 / 3.0)) ** -0.3
    ends = gamma**0.3 * (1.0 - gamma) ** 1.39 / (1.0 + gamma) ** (1.0 / 3.0)
    return rings * ends * (2.0 * inner / (2.0 * inner - 1.0)) ** 0.41


def ring_share(gamma: float, inner: float, outer: float, spread: float) -> float:
    """Rating of the inner race over the outer's, ``spread`` times what one ball's are.

    ISO 281 and ISO/TS 16281: spread [(1-g)/(1+g)]^1.72 [f_i (2 f_e - 1)/(f_e (2 f_i - 1))]^0.41.
    """
    grooves = inner * (2.0 * outer - 1.0) / (outer * (2.0 * inner - 1.0))
    return spread * ((1.0 - gamma) / (1.0 + gamma)) ** 1.72 * grooves**0.41


def radial_factor(gamma: float, inner: float = 0.52, outer: float = 0.53) -> float:
    """f_c of single-row radial contact and angular contact ball bearings [N and mm].

    The standard allows outer grooves up to 0.53 and computes its table with 0.52; wider ones are
    taken 0.01 closer as well (an assumption, so that the factor has no jump).
    """
    return _RADIAL * shape_factor(gamma, max(inner, 0.52), max(outer - 0.01, 0.52), 1.04)


def thrust_factor(gamma: float, angle: float, inner: float = 0.535, outer: float = 0.535) -> float:
    """f_c of single-direction thrust ball bearings [N and mm] at a contact angle [rad].

    ISO 281's table comes out, to its last digit, for grooves of 0.535.
    """
    reduction = _THRUST * (1.0 - sin(angle) / 3.0)
    return reduction * shape_factor(gamma, max(inner, 0.535), max(outer, 0.535), 1.0)


def static_rating(bearing: BallBearing) -> float:
    """C0r = Z D^2 cos(alpha) q/5, or C0a = Z D^2 sin(alpha) q."""
    angle, diameter = bearing.nominal_contact_angle, bearing.ball_diameter * 1e3
    thrust = bearing.is_thrust
    inner, outer = (0.54, 0.54) if thrust else (0.52, 0.53)
    per_ball = static_factor(
        bearing.gamma, max(bearing.inner_conformity, inner), max(bearing.outer_conformity, outer)
    )
    size = bearing.ball_count * diameter**2 * per_ball
    return size * (sin(angle) if thrust else cos(angle) / STRIBECK)


def dynamic_rating(bearing: BallBearing) -> float:
    """b_m f_c (cos alpha)^0.7 Z^(2/3) D^1.8, times tan(alpha) for thrust bearings."""
    angle, diameter = bearing.nominal_contact_angle, bearing.ball_diameter * 1e3
    grooves = bearing.inner_conformity, bearing.outer_conformity
    size = size_of(diameter) * bearing.ball_count ** (2.0 / 3.0) * cos(angle) ** 0.7
    if bearing.is_thrust:
        return size * tan(angle) * thrust_factor(bearing.gamma, angle, *grooves)
    return size * radial_factor(bearing.gamma, *grooves)


def size_of(diameter: float) -> float:
    """b_m times the power of a ball's diameter [mm] in C."""
    return _B_M * (diameter**1.8 if diameter <= _SIZE_LIMIT else 3.647 * diameter**1.4)


def factors(bearing: BallBearing, axial: float) -> tuple[float, float]:
    """Limit e and factor X of ISO 281 under an axial load [N], interpolated over the table's
    contact angles, as the standard allows, and over its loads. 0 stands for deep grooves."""
    angle = degrees(bearing.nominal_contact_angle)
    if bearing.is_thrust:
        return _at(angle, _THRUST_TABLE)
    per_ball = static_factor(bearing.gamma, 0.52, 0.53) / STRIBECK
    relative = per_ball * axial / bearing.static_rating
    flat = [
        (column, float(np.interp(relative, _RELATIVE_LOADS[column], _LIMITS[column])), x)
        for column, x in _RADIAL_FACTORS.items()
    ]
    return _at(angle, np.concatenate([np.array(flat), _STEEP]))


def two_row_factors(bearing: BallBearing, axial: float) -> tuple[float, float, float, float]:
    """Limit e, X and Y beyond it, and Y up to it, of two rows (ISO 281, table 3): X and Y are 2^0.7
    times those of one row, within 0.7 %. The relative load is f0 i Fa/C0r."""
    limit, one = factors(bearing, ROWS * axial)
    rows: float = ROWS**0.7
    return limit, rows * one, rows * (1.0 - one) / limit, (rows - 1.0) / limit


def _at(angle: float, rows: np.ndarray) -> tuple[float, float]:
    limit, x = (float(np.interp(angle, rows[:, 0], rows[:, k])) for k in (1, 2))
    return limit, x


def equivalent_load(bearing: BallBearing, radial: float, axial: float) -> EquivalentLoad:
    """P = Fr up to Fa/Fr = e, then X Fr + Y Fa."""
    limit, x = factors(bearing, axial)
    beyond = axial > limit * radial
    if bearing.is_thrust:
        # the standard has no factors for less axial load in one direction
        return EquivalentLoad(x * radial + axial if beyond else nan, x, 1.0, 3.0)
    x, y = (x, (1.0 - x) / limit) if beyond else (1.0, 0.0)
    return EquivalentLoad(x * radial + y * axial, x, y, 3.0)
