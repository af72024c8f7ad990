"""Rings and rolling elements as bodies of revolution: what pictures ask of a bearing's family."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from flexcage.core.errors import InputError
from flexcage.core.wings import FAMILIES
from flexcage.geometry.bearing import Bearing

Profile = list[tuple[float, float]]  # (x, r) [m], counter-clockwise


@dataclass(frozen=True)
class Shapes:
    """Profiles of a bearing's parts, each revolved about x.

    Rings are cut at mid-width: their profiles are of the half with x < 0. An element's is about its
    centre, its axis along x.
    """

    inner: Profile
    outer: Profile
    element: Profile

    @property
    def end(self) -> float:
        """Distance [m] along x from an element's centre to the side that faces the viewer."""
        return max(x for x, _ in self.element)


ShapesOf = Callable[[Any], Shapes]  # of a bearing of the family


def shapes_of(bearing: Bearing) -> Shapes:
    """Profiles of a bearing, by its family; InputError for a bearing of none."""
    family = FAMILIES.get(bearing.family)
    if family is None or family.shapes is None:
        raise InputError(f"There is no picture of a {type(bearing).__name__}.", where="bearing")
    found: Shapes = family.shapes()(bearing)
    return found
