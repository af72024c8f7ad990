"""Rings and rolling elements as solids: what pictures ask of a bearing family."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from flexcage.core.wings import FAMILIES
from flexcage.geometry.bearing import Bearing

if TYPE_CHECKING:
    import pyvista

Profile = list[tuple[float, float]]


@dataclass(frozen=True)
class Shapes:
    """Solids of a family, each by the spec of a bearing.

    ``rings``: profiles (x, r) [m] of inner and outer ring, of the half with x < 0,
    counter-clockwise: rings are cut at mid-width. ``element``: a rolling element about its centre,
    its axis along x. ``end``: distance [m] along x from its centre to the side that faces the
    viewer.
    """

    rings: Callable[[Any], tuple[Profile, Profile]]
    element: Callable[[Any], pyvista.PolyData]
    end: Callable[[Any], float]


def shapes_of(bearing: Bearing) -> Shapes:
    """Solids of a bearing's family."""
    found: Shapes = FAMILIES[bearing.family].shapes()
    return found
