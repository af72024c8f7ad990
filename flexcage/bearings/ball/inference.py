"""Number and size of the balls inside a catalogue's bearing, from its outline and ratings."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from fractions import Fraction
from math import asin, ceil, degrees, pi, radians, sin
from typing import Any

from flexcage.bearings.ball.angular_contact import AngularContactBallBearing
from flexcage.bearings.ball.deep_groove import DeepGrooveBallBearing
from flexcage.geometry.bearing import name_of
from flexcage.geometry.inference import Candidate, Inference, Outline

# a ball over the rings' height (D - d): walls remain below and above
_SMALLEST, _USUAL, _LARGEST = 0.2, 0.3, 0.36
_MOST_FILLED = radians(195.0)  # arc that balls of a deep groove bearing take while it is filled
_FILLED = radians(188.0)  # makers fill in as many as go
_SHIFTED = 1.015  # pitch circle over the mean of bore and outside, at most
_CLOSEST = 0.92  # ball over the distance of two balls: webs of a cage remain
_INNER_GROOVE, _OUTER_GROOVE = 0.515, 0.525  # radii over the ball's diameter
_DEEP_GROOVE = name_of(DeepGrooveBallBearing)
_SHOULDERS, _STEEP = {_DEEP_GROOVE: 0.17}, 0.2  # heights, likewise: those of steep contact angles
_CLEARANCE = 10e-6  # m

_INCH = 25.4e-3
_LARGEST_BALL = 0.15  # m


@dataclass(frozen=True)
class Balls:
    diameter: float  # m
    count: int
    pitch: float  # m, diameter of the circle of their centres
    name: str  # of their size


def _sizes(smallest: float, largest: float) -> Iterator[tuple[float, str, float]]:
    """Standard balls (ISO 3290) within two diameters [m]: diameter, what it is, how unusual.

    Steps of 1/32 inch are the most common ones.
    """
    largest = min(largest, _LARGEST_BALL)
    for sixty_fourths in range(ceil(64.0 * smallest / _INCH), int(64.0 * largest / _INCH) + 1):
        diameter, name = round(sixty_fourths * _INCH / 64.0, 6), Fraction(sixty_fourths, 64)
        yield diameter, f"{name} inch", 0.0 if sixty_fourths % 2 == 0 else 0.5
    for half in range(ceil(2e3 * smallest), int(2e3 * largest) + 1):
        yield round(half * 0.5e-3, 6), f"{half / 2:g} mm", 0.5 if half % 2 == 0 else 1.5


def candidates(outline: Outline) -> list[Candidate]:
    """Every number of every standard ball that has room."""
    if outline.type == _DEEP_GROOVE:
        return every(outline, _filled, _deep_groove, filling_angle)
    return every(outline, between, _angular_contact)


def every(
    outline: Outline,
    pitch_of: Callable[[Outline, float, int], float | None],
    make: Callable[[Outline, Balls, float], Candidate],
    filling: Callable[[int, float, float], float] = lambda *balls: _FILLED,
) -> list[Candidate]:
    """What ``make`` makes of every number of every standard ball for which there is a pitch circle;
    ``filling``: the arc that the balls take while they are filled in."""
    if outline.type != _DEEP_GROOVE:
        outline.required("contact_angle", "the contact angle (--contact-angle)")
    height = outline.outside_diameter - outline.bore
    found = []
    for diameter, name, unusual in _sizes(_SMALLEST * height, _LARGEST * height):
        walls = ((diameter / height - _USUAL) / 0.025) ** 2
        for count in range(5, 60):
            pitch = pitch_of(outline, diameter, count)
            if pitch is None:
                break
            angle = filling(count, diameter, pitch)
            unlikely = unusual + walls + ((angle - _FILLED) / radians(10.0)) ** 2
            found.append(make(outline, Balls(diameter, count, pitch, name), unlikely))
    return found


def _mean(outline: Outline) -> float:
    return 0.5 * (outline.bore + outline.outside_diameter)


def _filled(outline: Outline, diameter: float, count: int) -> float | None:
    """Pitch circle [m] on which so many balls can be filled in; None if there is none."""
    mean = _mean(outline)
    pitch = max(mean, diameter / sin(0.5 * _MOST_FILLED / (count - 1)))
    fits = pitch <= _SHIFTED * mean and diameter < _CLOSEST * pitch * sin(pi / count)
    return pitch if fits else None


def between(outline: Outline, diameter: float, count: int) -> float | None:
    """Pitch circle [m] where webs remain between the balls."""
    mean = _mean(outline)
    return mean if diameter <= _CLOSEST * mean * sin(pi / count) else None


def filling_angle(count: int, diameter: float, pitch: float) -> float:
    """Arc [rad] of the pitch circle that balls side by side take, between the first and the last
    one's middle: so far must eccentric rings be open to be filled."""
    return 2.0 * (count - 1) * asin(diameter / pitch)


def dimensions_of(outline: Outline, balls: Balls) -> tuple[dict[str, Any], dict[str, str]]:
    """Dimensions [m] that all types have, and how each was found."""
    diameter, shoulder = balls.diameter, _SHOULDERS.get(outline.type, _STEEP)
    more = balls.pitch / _mean(outline) - 1.0
    shares = {
        "inner_groove_radius": _INNER_GROOVE,
        "outer_groove_radius": _OUTER_GROOVE,
        "inner_shoulder": shoulder,
        "outer_shoulder": shoulder,
    }
    dimensions = {
        **outline.boundary,
        "designation": outline.designation,
        "pitch_diameter": round(balls.pitch, 6),
        "ball_diameter": diameter,
        "ball_count": balls.count,
        **{key: round(share * diameter, 7) for key, share in shares.items()},
    }
    reasons = {
        "pitch_diameter": "inferred: the mean of bore and outside diameter"
        + (f", and {more:.1%} more to fill the balls in" if more > 0.0 else ""),
        "ball_diameter": f"inferred from C0 and C: a standard ball, {balls.name}",
        "ball_count": "inferred from C0 and C",
        **{k: f"assumption: {share:g} times the ball's diameter" for k, share in shares.items()},
    }
    return dimensions, reasons


def _deep_groove(outline: Outline, balls: Balls, unlikely: float) -> Candidate:
    dimensions, reasons = dimensions_of(outline, balls)
    angle = degrees(filling_angle(balls.count, balls.diameter, balls.pitch))
    reasons["ball_count"] += f"; the filling angle is {angle:.0f} degrees"
    clearance, reasons["radial_clearance"] = outline.clearance_in_operation(_CLEARANCE)
    bearing = DeepGrooveBallBearing(radial_clearance=clearance, **dimensions)
    return Candidate(outline=outline, bearing=bearing, reasons=reasons, unlikely=unlikely)


def _angular_contact(outline: Outline, balls: Balls, unlikely: float) -> Candidate:
    dimensions, reasons = dimensions_of(outline, balls)
    bearing = AngularContactBallBearing(contact_angle=outline.contact_angle, **dimensions)
    return Candidate(outline=outline, bearing=bearing, reasons=reasons, unlikely=unlikely)


INFERENCE = Inference(
    candidates=candidates,
    cages={_DEEP_GROOVE: "ribbon", name_of(AngularContactBallBearing): "machined"},
    count="ball_count",
)
