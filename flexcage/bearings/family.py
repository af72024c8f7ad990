"""What a bearing family is: one value, composed of what each floor asks for."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, cast

from flexcage.core.wings import FAMILIES
from flexcage.geometry.bearing import Bearing

if TYPE_CHECKING:
    from flexcage.render.shapes import ShapesOf
    from flexcage.results.figures import OwnFigures
    from flexcage.results.metrics import ElementSpeed
    from flexcage.results.registry import OwnVariables
    from flexcage.stress.rubbing import Rub


@dataclass(frozen=True, kw_only=True)
class Family:
    """Bearings whose rolling elements move by the same equations.

    ``types``: the specs of its types of bearing, which bring dimensions, checks, ratings and films
    with them; ``other_designs`` maps patterns of names that are no types here to what there is
    instead. All else is heavy: functions without arguments that import what they return.
    """

    name: str
    types: tuple[type[Bearing], ...]
    variables: Callable[[], OwnVariables]  # that its runs record beside the common ones
    speed: Callable[[], ElementSpeed]  # how its elements turn about their own axes, and slip
    figures: Callable[[], OwnFigures]  # of its runs' summaries beside the common ones
    rubbing: Callable[[], Rub]  # of its elements in their pockets, for wear
    shapes: Callable[[], ShapesOf]  # profiles of rings and elements, for pictures
    other_designs: Mapping[str, str] = field(default_factory=dict)

    @property
    def element(self) -> str:
        """Its rolling elements, in words."""
        return self.types[0].element


def family_of(bearing: Bearing) -> Family:
    """The family of a bearing."""
    return cast(Family, FAMILIES[bearing.family])
