"""Is this ball bearing possible? One sentence for each impossibility, and what would be right."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import asin, cos, degrees, pi, sin
from typing import Any, Protocol

from flexcage.bearings.ball.angular_contact import AngularContactBallBearing
from flexcage.bearings.ball.bearing import BallBearing
from flexcage.core.units import describe, mm
from flexcage.geometry.cage import Cage
from flexcage.geometry.checks import (
    MOST_SCATTER,
    Finding,
    check_cage_defects,
    check_fit,
    find_off_pitch_circle,
    raise_first,
)
from flexcage.geometry.spall import find_in_spall
from flexcage.geometry.spot import find_in_spots

_AGREE = 1e-6  # m, to which contact angle and clearance must agree: a tenth of a clearance class
_WIDEST_GROOVE = 1.0  # radius, of the ball's diameter
_WIDEST = 2.0  # of the bearing's width: one that reaches out of it on both sides
_MOST_PRELOAD = 0.01  # of the ball's diameter: a Hertz pressure far beyond any steel's


class Angled(Protocol):
    """A bearing that is given by its contact angle or its radial clearance."""

    @property
    def contact_angle(self) -> float | None: ...
    @property
    def radial_clearance(self) -> float | None: ...
    @property
    def clearance(self) -> float: ...


def check(bearing: BallBearing, cage: Cage | None, defects: Sequence[Any]) -> None:
    """Raise InputError for the first impossibility in the bearing, its cage or the defects."""
    raise_first(_find_in_grooves(bearing))
    raise_first(_find_in_balls(bearing))
    raise_first(_find_in_shoulders(bearing))
    raise_first(_find_in_spalls(bearing))
    raise_first(_find_in_spot(bearing))
    if isinstance(bearing, AngularContactBallBearing):
        raise_first(find_in_angle(bearing, "grooves"))
        raise_first(_find_without_angle(bearing))
    else:
        raise_first(_find_in_clearance(bearing, bearing.clearance))
    if cage is None:
        return
    check_fit(bearing, cage, find_around_cage(bearing, cage))
    cage.check(bearing.ball_count)
    check_cage_defects(bearing, cage, defects)


def _find_in_grooves(b: BallBearing) -> Iterator[Finding]:
    for key in ("inner_groove_radius", "outer_groove_radius"):
        radius = getattr(b, key)
        if radius <= 0.5 * b.ball_diameter:
            yield (
                f"bearing.{key}",
                f"bearing.{key} is {mm(radius)}, but must be greater than the ball's radius, "
                f"{mm(0.5 * b.ball_diameter)}; 0.515 to 0.54 times its diameter is usual.",
            )
        if radius > _WIDEST_GROOVE * b.ball_diameter:
            yield (
                f"bearing.{key}",
                f"bearing.{key} is {mm(radius)}, so wide that it is no groove; give "
                f"{mm(_WIDEST_GROOVE * b.ball_diameter)} or less, the ball's diameter; 0.515 to "
                "0.54 times it is usual.",
            )


def _find_in_balls(b: BallBearing) -> Iterator[Finding]:
    widest = MOST_SCATTER * b.ball_diameter
    if b.ball_scatter > widest:
        yield (
            "bearing.ball_scatter",
            f"bearing.ball_scatter is {mm(b.ball_scatter)}, but balls of one bearing differ by "
            f"micrometres; give {mm(widest)} or less, {100.0 * MOST_SCATTER:g} % of their "
            "diameter.",
        )
    chord = b.pitch_diameter * sin(pi / b.ball_count)
    if chord <= b.ball_diameter:
        most = int(pi / asin(min(b.ball_diameter / b.pitch_diameter, 1.0)))
        yield (
            "bearing.ball_count",
            f"{b.ball_count} balls of {mm(b.ball_diameter)} overlap on a pitch diameter of "
            f"{mm(b.pitch_diameter)}; at most {most} fit.",
        )
    reach = b.ball_diameter * cos(b.nominal_contact_angle)
    if not b.bore < b.pitch_diameter - reach:
        yield (
            "bearing.bore",
            f"bearing.bore is {mm(b.bore)}, but the balls reach in to "
            f"{mm(b.pitch_diameter - reach)} in diameter, which leaves no inner ring.",
        )
    if not b.outside_diameter > b.pitch_diameter + reach:
        yield (
            "bearing.outside_diameter",
            f"bearing.outside_diameter is {mm(b.outside_diameter)}, but the balls reach out to "
            f"{mm(b.pitch_diameter + reach)} in diameter, which leaves no outer ring.",
        )


def _find_in_shoulders(b: BallBearing) -> Iterator[Finding]:
    for side in ("inner", "outer"):
        height, radius = getattr(b, f"{side}_shoulder"), getattr(b, f"{side}_groove_radius")
        if height is not None and height >= radius:
            yield (
                f"bearing.{side}_shoulder",
                f"bearing.{side}_shoulder is {mm(height)}, but must be less than the groove's "
                f"radius, {mm(radius)}.",
            )


def _find_in_spalls(b: BallBearing) -> Iterator[Finding]:
    for ring in ("inner", "outer"):
        reach, spall = b.race_reach(ring), getattr(b, f"{ring}_spall")
        yield from find_in_spall(b, ring, b.race_radius(ring), reach)
        if spall.length and spall.width is not None and spall.width > 2.0 * reach:
            yield (
                f"bearing.{ring}_spall.width",
                f"bearing.{ring}_spall.width is {mm(spall.width)}, wider than the race, "
                f"{mm(2.0 * reach)} between its shoulders; leave it out for a spall of all of it.",
            )


def find_in_angle(b: Angled, races: str) -> Iterator[Finding]:
    """What is impossible in contact angle and clearance, one of which says the other in these
    ``races`` (in words)."""
    if b.contact_angle is None and b.radial_clearance is None:
        yield (
            "bearing.contact_angle",
            "[bearing] has neither contact_angle nor radial_clearance; give one of them.",
        )
    elif b.contact_angle is not None and b.radial_clearance is not None:
        if abs(b.clearance - b.radial_clearance) > _AGREE:
            yield (
                "bearing.radial_clearance",
                f"bearing.radial_clearance is {describe(b.radial_clearance, 'um')}, but a contact "
                f"angle of {degrees(b.contact_angle):.5g} deg makes it {b.clearance * 1e6:.4g} um "
                f'in these {races}; leave one of the two out, as by contact_angle = "none".',
            )


def _find_without_angle(b: AngularContactBallBearing) -> Iterator[Finding]:
    """What is impossible in the clearance that says the contact angle."""
    if b.contact_angle is None and b.radial_clearance is not None:
        if b.radial_clearance <= 0.0:
            yield (
                "bearing.radial_clearance",
                f"bearing.radial_clearance is {describe(b.radial_clearance, 'um')}, but an angular "
                "contact bearing has its contact angle from a clearance greater than 0 um.",
            )
        yield from _find_in_clearance(b, b.radial_clearance)


def _find_in_clearance(b: BallBearing, clearance: float) -> Iterator[Finding]:
    """A clearance [m] that its grooves do not allow."""
    most, least = 2.0 * b.groove_distance, -_MOST_PRELOAD * b.ball_diameter
    if not least <= clearance < most:
        yield (
            "bearing.radial_clearance",
            f"bearing.radial_clearance is {describe(clearance, 'um')}, but these grooves and balls "
            f"allow {describe(least, 'um')} (preload) to {most * 1e6:.6g} um.",
        )


def _rings(b: BallBearing) -> tuple[tuple[float, str], tuple[float, str]]:
    """Diameters between which a cage has its place, and what they are: of shoulders that are given
    on both sides, else of bore and outside."""
    inner, outer = (b.bore, "bearing.bore"), (b.outside_diameter, "bearing.outside_diameter")
    if not b.one_sided:
        over, under = b.shoulder_diameters
        if b.inner_shoulder is not None:
            inner = over, "the inner ring's shoulder"
        if b.outer_shoulder is not None:
            outer = under, "the outer ring's shoulder"
    return inner, outer


def find_around_cage(b: BallBearing, c: Cage) -> Iterator[Finding]:
    """What leaves a cage no place between the rings and around the pitch circle."""
    inner, outer = _rings(b)
    if not inner[0] < c.bore:
        yield (
            "cage.bore",
            f"cage.bore is {mm(c.bore)}, so the cage runs into the inner ring; it must be greater "
            f"than {inner[1]}, {mm(inner[0])}.",
        )
    if not c.outside_diameter < outer[0]:
        yield (
            "cage.outside_diameter",
            f"cage.outside_diameter is {mm(c.outside_diameter)}, so the cage runs into the outer "
            f"ring; it must be less than {outer[1]}, {mm(outer[0])}.",
        )
    if c.axial_width > _WIDEST * b.width:
        yield (
            "cage.width",
            f"cage.width is {mm(c.width)}, but the bearing's is {mm(b.width)}; a cage is at most "
            f"{_WIDEST:g} times as wide.",
        )
    yield from find_off_pitch_circle(b, c)


def _find_in_spot(b: BallBearing) -> Iterator[tuple[str, str]]:
    """What is impossible in the spot of a bearing's ball; where, and in a sentence."""
    spot = b.ball_spot
    if spot.size:
        named = {"ball": (spot.ball,), "others": spot.others}
        yield from find_in_spots(b, "bearing.ball_spot", spot, named, b.ball_diameter)
