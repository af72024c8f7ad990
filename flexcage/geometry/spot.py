"""A spot of a rolling element, a pit or a flat: what those of all families have in common."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Protocol

import numpy as np

from flexcage.core.units import mm, typeset

if TYPE_CHECKING:
    from flexcage.geometry.bearing import Bearing

_WIDEST, _DEEPEST = 0.25, 0.1  # of the element's diameter, to which a spot is small against it


class Spot(Protocol):
    """A pit or a flat; none while its size is zero."""

    @property
    def size(self) -> float: ...
    @property
    def kind(self) -> str: ...
    @property
    def depth(self) -> float: ...


def marked(count: int, elements: Sequence[int]) -> np.ndarray:
    """1 for each of ``count`` elements that has a spot, else 0 (records hold no booleans)."""
    has = np.zeros(count, np.int64)
    has[list(elements)] = 1
    return has


def spotted_in_words(element: str, elements: Sequence[int], spot: Spot) -> str:
    """A sentence on the elements that have a spot; empty if there is none."""
    if not elements:
        return ""
    *most, last = map(str, elements)
    numbers = f"{', '.join(most)} and {last}" if most else last
    deep = "" if spot.kind == "flat" else f", {typeset(spot.depth, 'um')} deep"
    what = f"{spot.kind} of {typeset(spot.size, 'mm')}{deep}"
    return f" {element}{'s' if most else ''} {numbers} {'have' if most else 'has'} a {what}."


def find_in_spots(
    b: Bearing, where: str, spot: Spot, named: Mapping[str, Sequence[int]], diameter: float
) -> Iterator[tuple[str, str]]:
    """What is impossible in a spot of elements of a ``diameter`` [m]: a number, by its key in
    ``named``, that no element of the bearing has, and a spot that is not small against them; where,
    and in a sentence."""
    most, deepest, element = _WIDEST * diameter, _DEEPEST * diameter, b.element
    for key, numbers in named.items():
        for number in numbers:
            if not 0 <= number < b.total_elements:
                yield (
                    f"{where}.{key}",
                    f"{where}.{key} is {number}, but the {element}s are numbered 0 to "
                    f"{b.total_elements - 1}.",
                )
    if spot.size > most:
        yield (
            f"{where}.size",
            f"{where}.size is {mm(spot.size)}; give a quarter of the {element}'s diameter, "
            f"{mm(most)}, or less.",
        )
    if spot.kind == "pit" and spot.depth > deepest:
        yield (
            f"{where}.depth",
            f"{where}.depth is {mm(spot.depth)}; give a tenth of the {element}'s diameter, "
            f"{mm(deepest)}, or less.",
        )
