"""A spall of a race: its dimensions, its words, and where none can be."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.spec import GIVEN, option, quantity
from flexcage.core.units import mm, typeset

if TYPE_CHECKING:
    from flexcage.geometry.bearing import Bearing

_IS = {"length": GIVEN}

#: What asks for a spall in other words, and where it is given (``Bearing.elsewhere``).
BY_RACE: Mapping[str, str] = {
    "spalls?|defects?": "give a spall as [bearing.outer_spall] or [bearing.inner_spall]"
}


@dataclass(frozen=True, kw_only=True)
class Spall:
    """A spall of a race: a pit with sharp edges, of one depth; none while its length is zero.

    An element's centre goes down by (l - x)^2/(2 R) at a distance x from the middle of a spall of
    half length l, as it turns about the edge that it still touches (R: effective radius of element
    and race), and never deeper than the pit. Its edges do not yield more than the race does.
    """

    length: float = quantity("mm", 0.0, doc="length along the race; 0: no spall", minimum=0.0)
    depth: float = quantity("um", 100.0e-6, doc="depth", above=0.0, when=_IS)
    azimuth: float = quantity(
        "deg", 0.0, doc="azimuth of its middle on its ring, from y towards z", when=_IS
    )
    width: float | None = quantity(
        "mm", None, doc="axial width (default: all)", above=0.0, when=_IS
    )
    offset: float = quantity(
        "mm", 0.0, doc="axial distance of its middle from the race's",
        when={**_IS, "width": GIVEN},
    )  # fmt: skip
    row: int = option(
        0, doc="row that it is of: 0, at -x, or 1 in bearings of two rows", minimum=0, when=_IS
    )

    def covered(self, centres: np.ndarray, slice_width: float) -> np.ndarray:
        """Share (n,) of slices of a roller that stands in the middle of the race, by the axial
        places of their centres (n,) [m]."""
        return covered(centres, slice_width, self.width, self.offset)

    def sides(self, groove_radius: float) -> tuple[float, float]:
        """Angles [rad] from a groove's bottom, towards +x, to its sides; infinite if it is as wide
        as the groove."""
        if self.width is None:
            return -np.inf, np.inf
        places = self.offset + 0.5 * self.width * np.array([-1.0, 1.0])
        low, high = np.arcsin(np.clip(places / groove_radius, -1.0, 1.0))
        return float(low), float(high)

    def in_words(self, race: str) -> str:
        """A sentence on a spall of the "inner" or "outer" race; empty if there is none."""
        if not self.length:
            return ""
        of_row = f" in row {self.row}" if self.row else ""
        return (
            f" The {race} race has a spall{of_row} of {typeset(self.length, 'mm')}, "
            f"{typeset(self.depth, 'um')} deep, at {typeset(self.azimuth, 'deg')}."
        )


def spalls_in_words(b: Any) -> str:
    """Sentences on the spalls of both races of a bearing; empty if there are none."""
    return "".join(getattr(b, f"{ring}_spall").in_words(ring) for ring in ("inner", "outer"))


def covered(
    centres: np.ndarray, slice_width: float, width: float | None, offset: float
) -> np.ndarray:
    """Share (n,) of slices, by the places of their centres (n,) [m], that lie on a strip of a
    ``width`` [m] about ``offset``; None: on one as wide as all of them."""
    if width is None:
        return np.ones_like(centres)
    low, high = offset - 0.5 * width, offset + 0.5 * width
    half = 0.5 * slice_width
    over = np.minimum(centres + half, high) - np.maximum(centres - half, low)
    return np.clip(over / slice_width, 0.0, 1.0)


def find_row(b: Bearing, ring: str) -> Iterator[tuple[str, str]]:
    """A row of a ring's spall that the bearing has not; where, and in a sentence."""
    spall, where = getattr(b, f"{ring}_spall"), f"bearing.{ring}_spall.row"
    if not spall.length or spall.row < b.row_count:
        return
    one = "this bearing has one row of elements; leave it out"
    more = "rows are 0, at -x, and 1, at +x"
    yield where, f"{where} is {spall.row}, but {one if b.row_count == 1 else more}."


def find_in_spall(b: Bearing, ring: str, radius: float, reach: float) -> Iterator[tuple[str, str]]:
    """What is impossible in the spall of the "inner" or "outer" ring's race, of a radius [m] about
    the bearing's axis, to which elements reach from its middle [m]; where, and in a sentence."""
    spall, where = getattr(b, f"{ring}_spall"), f"bearing.{ring}_spall"
    pitch, most = 2.0 * pi * radius / b.element_count, 0.1 * b.element_diameter
    yield from find_row(b, ring)
    if spall.length >= pitch:
        yield (
            f"{where}.length",
            f"{where}.length is {mm(spall.length)}, but must be less than the distance of two "
            f"{b.element}s there, {mm(pitch)}: a longer one is no spall but another race.",
        )
    if spall.length and spall.depth > most:
        yield (
            f"{where}.depth",
            f"{where}.depth is {mm(spall.depth)}; give a tenth of the {b.element}'s diameter, "
            f"{mm(most)}, or less.",
        )
    if spall.length and spall.width is not None:
        if abs(spall.offset) - 0.5 * spall.width >= reach:
            yield (
                f"{where}.offset",
                f"{where}.offset is {mm(spall.offset)}, where no {b.element} runs: {b.element}s "
                f"touch the race to {mm(reach)} from its middle.",
            )
