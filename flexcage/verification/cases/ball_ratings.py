"""Ratings of ball bearings: the standards' tables, computed from what stands behind them."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import cos, radians, sin, tan
from typing import Any

from flexcage.verification.bearings import deep_groove, preset
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

# ISO 281:2007, f_c of single-row radial and angular contact ball bearings
RADIAL_FC = {
    0.05: 46.7, 0.06: 49.1, 0.07: 51.1, 0.08: 52.8, 0.09: 54.3, 0.10: 55.5, 0.12: 57.5,
    0.14: 58.8, 0.16: 59.6, 0.18: 59.9, 0.20: 59.9, 0.22: 59.6, 0.24: 59.0, 0.26: 58.2,
    0.28: 57.1, 0.30: 56.0, 0.32: 54.6, 0.34: 53.2, 0.36: 51.7, 0.38: 50.0, 0.40: 48.4,
}  # fmt: skip
# and of thrust ball bearings, at D cos(alpha)/Dpw of 0.01 to 0.1
THRUST_FC = {
    45: (42.1, 51.7, 58.2, 63.3, 67.3, 70.7, 73.5, 75.9, 78.0, 79.7),
    60: (39.2, 48.1, 54.2, 58.9, 62.6, 65.8, 68.4, 70.7, 72.6, 74.2),
    75: (37.3, 45.9, 51.7, 56.1, 59.7, 62.7, 65.2, 67.3, 69.2, 70.7),
}
# ISO 76:2006, f_0 of radial and of thrust ball bearings
RADIAL_F0 = {
    0.0: 14.7, 0.01: 14.9, 0.02: 15.1, 0.05: 15.7, 0.08: 16.3, 0.09: 16.5, 0.10: 16.4, 0.12: 15.9,
    0.15: 15.2, 0.20: 14.0, 0.25: 12.8, 0.30: 11.6, 0.35: 10.5, 0.40: 9.4,
}  # fmt: skip
THRUST_F0 = {0.0: 61.6, 0.01: 60.8, 0.02: 59.9}
FLAT = 1e-12  # in the place of a ratio of 0
THRUST = radians(45.0) + 2e-9  # the least contact angle of thrust bearings
LAST_DIGIT = Tolerance(
    0.06, "printed to one decimal, from constants of two and three digits", absolute=True
)
CATALOGUE = Tolerance(0.01, "makers round ratings to two or three digits")


def with_geometry(bearing: Any, *, gamma: float, inner: float, outer: float) -> Any:
    """A bearing of other conformities, and of another pitch diameter for D cos(alpha)/Dpw."""
    ball = bearing.ball_diameter
    return replace(
        bearing, pitch_diameter=ball * cos(bearing.nominal_contact_angle) / gamma,
        inner_groove_radius=inner * ball, outer_groove_radius=outer * ball,
    )  # fmt: skip


def thrust(angle: float, gamma: float, conformity: float) -> Any:
    """A thrust bearing with a contact angle [deg], not less than 45."""
    steep = replace(preset("7010C-PI"), contact_angle=max(radians(angle), THRUST))
    return with_geometry(steep, gamma=gamma, inner=conformity, outer=conformity)


def f_0(bearing: Any) -> float:
    """From the rating f_0 Z D^2 cos(alpha), or sin(alpha) of thrust bearings."""
    size = bearing.ball_count * (1e3 * bearing.ball_diameter) ** 2
    angle = bearing.nominal_contact_angle
    return float(bearing.static_rating / (size * (sin if bearing.is_thrust else cos)(angle)))


def f_c(bearing: Any) -> float:
    """From the rating b_m f_c (cos alpha)^0.7 Z^(2/3) D^1.8, times tan(alpha) of thrust ones."""
    angle, diameter = bearing.nominal_contact_angle, 1e3 * bearing.ball_diameter
    size = 1.3 * cos(angle) ** 0.7 * bearing.ball_count ** (2.0 / 3.0) * diameter**1.8
    return float(bearing.dynamic_rating / (size * tan(angle) if bearing.is_thrust else size))


def rows() -> Iterator[Row]:
    for gamma, expected in RADIAL_FC.items():
        found = f_c(with_geometry(deep_groove(0.0), gamma=gamma, inner=0.52, outer=0.53))
        yield Row(f"f_c at D cos(a)/Dpw = {gamma:.2f}", "", expected, found, LAST_DIGIT)
    for angle, column in THRUST_FC.items():
        for k, expected in enumerate(column):
            gamma = 0.01 * (k + 1)
            found = f_c(thrust(angle, gamma, 0.535))
            yield Row(f"f_c, thrust, {angle} deg, {gamma:.2f}", "", expected, found, LAST_DIGIT)
    for gamma, expected in RADIAL_F0.items():
        found = f_0(with_geometry(deep_groove(0.0), gamma=gamma or FLAT, inner=0.52, outer=0.53))
        yield Row(f"f_0 at D cos(a)/Dpw = {gamma:.2f}", "", expected, found, LAST_DIGIT)
    for gamma, expected in THRUST_F0.items():
        found = f_0(thrust(60.0, gamma or FLAT, 0.54))
        yield Row(f"f_0, thrust, {gamma:.2f}", "", expected, found, LAST_DIGIT)
    ball = 6.747e-3
    small = replace(
        deep_groove(0.0, ball=ball, count=8),
        bore=17e-3, outside_diameter=40e-3, pitch_diameter=28.5e-3,
    )  # fmt: skip
    yield Row("6203, dynamic rating Cr", "kN", 9.55, small.dynamic_rating / 1e3, CATALOGUE)
    yield Row("6203, static rating C0r", "kN", 4.80, small.static_rating / 1e3, CATALOGUE)
    spindle = preset("7010C-PA66")
    size = spindle.ball_diameter
    spindle = replace(
        spindle, inner_groove_radius=0.52 * size, outer_groove_radius=0.53 * size
    )  # the catalogue's, closer than those of the paper
    yield Row("7010C, f_0", "", 15.7, f_0(spindle), LAST_DIGIT)
    yield Row("7010C, static rating C0r", "kN", 20.7, spindle.static_rating / 1e3, CATALOGUE)


CASE: KnownAnswer = KnownAnswer(
    name="ball_ratings",
    title="Load ratings of ball bearings",
    source="ISO 281:2007, tables of f_c; ISO 76:2006, table of f_0; a 6203 in makers' catalogues "
    "(17 x 40 x 12 mm, eight balls of 17/64 inch: 9.55 and 4.8 kN) and a 7010C (18 balls of 11/32 "
    "inch: f_0 15.7, C0r from 20.7 kN on)",
    checks="f_0 from exact Hertz contact at 4200 MPa, f_c from Lundberg and Palmgren's formula "
    "with the standards' reduction factors; and both ratings of a common bearing from its inside.",
    rows=rows,
)
