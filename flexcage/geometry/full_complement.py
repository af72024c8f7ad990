"""Bearings without a cage: as many rolling elements as their pitch circle has space for."""

from __future__ import annotations

from dataclasses import replace
from math import asin, pi
from typing import TYPE_CHECKING, Any, TypeVar

from flexcage.core.units import describe

if TYPE_CHECKING:
    from flexcage.geometry.bearing import Bearing

# of an element's diameter, along the whole circle: without it elements would be clamped
_LEAST_PLAY = 0.01

#: What an outline's ratings are of: a bearing with a cage, one without (full complement), or one
#: with a cage where the elements shall fill the circle instead.
CAGED, FULL, FILLED = "caged", "full", "filled"

AnyBearing = TypeVar("AnyBearing", bound="Bearing")


def elements_around(diameter: float, pitch: float) -> float:
    """How many elements of a diameter fill a pitch circle [m], as a number with a fraction."""
    return pi / asin(diameter / pitch)


def filling_count(diameter: float, pitch: float) -> int:
    """The largest number of elements that still has circumferential play."""
    return int(elements_around(diameter, pitch) - _LEAST_PLAY)


def circumferential_play(diameter: float, pitch: float, count: int) -> float:
    """Arc [m] of the pitch circle that so many elements side by side leave free, in all."""
    return pitch * (pi - count * asin(diameter / pitch))


def filled(bearing: AnyBearing, field: str) -> AnyBearing:
    """The bearing with as many elements as fit; ``field`` is its key of their number."""
    most = filling_count(bearing.element_diameter, bearing.pitch_diameter)
    changes: dict[str, Any] = {field: most}
    return replace(bearing, **changes)


def reason_of_count(bearing: Bearing) -> str:
    """How the number of elements was found, and what play it leaves."""
    play = circumferential_play(
        bearing.element_diameter, bearing.pitch_diameter, bearing.element_count
    )
    return (
        "assumption: as many as fit, as makers do for high ratings; circumferential play "
        f"{describe(round(play, 6), 'mm')} in all"
    )
