"""What a bearing family is: one value, composed of what each floor asks for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, cast

from flexcage.core.wings import FAMILIES
from flexcage.geometry.bearing import Bearing

if TYPE_CHECKING:
    from flexcage.render.shapes import Shapes
    from flexcage.results.figures import OwnFigures
    from flexcage.results.metrics import ElementSpeed
    from flexcage.results.registry import OwnVariables
    from flexcage.stress.rubbing import Rub


@dataclass(frozen=True, kw_only=True)
class Family:
    """Bearings whose rolling elements move by the same equations.

    ``types``: the specs of its types of bearing, which bring dimensions, checks, ratings and films
    with them. All else is heavy: functions without arguments that import what they return.
    """

    name: str
    types: tuple[type[Bearing], ...]
    variables: Callable[[], OwnVariables]
    speed: Callable[[], ElementSpeed]
    figures: Callable[[], OwnFigures]
    shapes: Callable[[], Shapes]
    rubbing: Callable[[], Rub]

    @property
    def element(self) -> str:
        """Its rolling elements, in words."""
        return self.types[0].element


def family_of(bearing: Bearing) -> Family:
    """The family of a bearing."""
    return cast(Family, FAMILIES[bearing.family])
