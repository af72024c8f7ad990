"""What a bearing family is: one value, composed of what each floor asks for."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, cast

from flexcage.core.wings import FAMILIES
from flexcage.geometry.bearing import Bearing

if TYPE_CHECKING:
    from flexcage.render.shapes import ShapesOf


@dataclass(frozen=True, kw_only=True)
class Family:
    """Bearings whose rolling elements move by the same equations.

    ``types``: the specs of its types of bearing, which bring dimensions, checks, ratings and films
    with them; ``other_designs`` maps patterns of names that are no types here to what there is
    instead. All else is heavy: functions without arguments that import what they return.
    """

    name: str
    types: tuple[type[Bearing], ...]
    shapes: Callable[[], ShapesOf]  # profiles of rings and elements, for pictures
    other_designs: Mapping[str, str] = field(default_factory=dict)


def family_of(bearing: Bearing) -> Family:
    """The family of a bearing."""
    return cast(Family, FAMILIES[bearing.family])
