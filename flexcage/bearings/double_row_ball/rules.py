"""Ratings and equivalent loads of double row ball bearings, ISO 76:2006 and ISO 281:2007.

Self-aligning bearings have factors of their own.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, degrees, pi, tan
from typing import Any

from flexcage.bearings import two_rows
from flexcage.bearings.ball.bearing import BallBearing
from flexcage.bearings.ball.ratings import (
    LUNDBERG_PALMGREN,
    STRIBECK,
    shape_factor,
    size_of,
    static_factor,
    two_row_factors,
)
from flexcage.bearings.double_row_ball.angular_contact import (
    POWER,
    DoubleRowAngularContactBallBearing,
)
from flexcage.bearings.double_row_ball.self_aligning import SelfAligningBallBearing
from flexcage.bearings.two_rows import ROWS
from flexcage.core.errors import InputError
from flexcage.geometry.bearing import EquivalentLoad, Rules
from flexcage.geometry.cage import Cage

# ISO 281, table 3, self-aligning: e = 1.5 tan(alpha), X, and Y = 0.42 or 0.65 cot(alpha)
_LIMIT, _RADIAL, _BELOW, _BEYOND = 1.5, 0.65, 0.42, 0.65
_STEEPEST = 0.25 * pi  # the table has no double row bearings of a greater contact angle
# ISO 281's f_c is of a sphere and inner grooves of 0.53 at the closest, without the reduction of
# other bearings: all 21 entries of its column, 0.05 to 0.4, come out to their last digit
_GROOVE, _SPREAD = 0.53, 1.04


def self_aligning_factor(gamma: float, inner: float = _GROOVE) -> float:
    """f_c of self-aligning ball bearings [N and mm] at D cos(alpha)/Dpw."""
    sphere = 0.5 * (1.0 + 1.0 / gamma)
    return LUNDBERG_PALMGREN * shape_factor(gamma, max(inner, _GROOVE), sphere, _SPREAD)


def _static_rating(bearing: BallBearing) -> float:
    """C0r = i Z D^2 cos(alpha) q/5; q is the load of a ball at 4600 MPa of self-aligning ones."""
    if not isinstance(bearing, SelfAligningBallBearing):
        return two_rows.static_rating(bearing)
    per_ball = static_factor(
        bearing.gamma, max(bearing.inner_conformity, _GROOVE), bearing.outer_conformity,
        pressure=bearing.pressure_limit,
    )  # fmt: skip
    size = ROWS * bearing.ball_count * (bearing.ball_diameter * 1e3) ** 2
    return size * per_ball * cos(bearing.nominal_contact_angle) / STRIBECK


def _dynamic_rating(bearing: BallBearing) -> float:
    """b_m f_c (i cos alpha)^0.7 Z^(2/3) D^1.8."""
    if not isinstance(bearing, SelfAligningBallBearing):
        return two_rows.dynamic_rating(bearing)
    size = size_of(bearing.ball_diameter * 1e3) * bearing.ball_count ** (2.0 / 3.0)
    rows = (ROWS * cos(bearing.nominal_contact_angle)) ** POWER
    return self_aligning_factor(bearing.gamma, bearing.inner_conformity) * rows * size


def _equivalent_load(bearing: BallBearing, radial: float, axial: float) -> EquivalentLoad:
    """P = Fr + Y1 Fa up to Fa/Fr = e, then X Fr + Y2 Fa."""
    if isinstance(bearing, SelfAligningBallBearing):
        slope = tan(bearing.nominal_contact_angle)
        limit, x, beyond, below = _LIMIT * slope, _RADIAL, _BEYOND / slope, _BELOW / slope
    else:
        limit, x, beyond, below = two_row_factors(bearing, axial)
    x, y = (x, beyond) if axial > limit * radial else (1.0, below)
    return EquivalentLoad(x * radial + y * axial, x, y, 3.0)


def _check(bearing: BallBearing, cage: Cage | None, defects: Sequence[Any]) -> None:
    """Raise InputError for the first impossibility found."""
    if isinstance(bearing, DoubleRowAngularContactBallBearing) and bearing.is_thrust:
        angle = degrees(bearing.nominal_contact_angle)
        raise InputError(
            f"bearing.contact_angle is {angle:.4g} deg, but ISO 281 has double row bearings up to "
            f"{degrees(_STEEPEST):g} deg alone; give that or less.",
            where="bearing.contact_angle",
        )
    if isinstance(bearing, SelfAligningBallBearing):
        bearing.grooved.check(cage)
        two_rows.check_rows(bearing)
        two_rows.check_cage(bearing, cage, defects)
    else:
        two_rows.check(bearing, cage, defects)


RULES = Rules[BallBearing](
    check=_check, static_rating=_static_rating, dynamic_rating=_dynamic_rating,
    equivalent_load=_equivalent_load,
)  # fmt: skip
