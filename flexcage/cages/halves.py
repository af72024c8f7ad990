"""Halves of a common cage of two rows: are they one body, and which way do they face?"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from typing import Any

from flexcage.cages.cage_type import cage_type_of
from flexcage.core.units import mm
from flexcage.core.wings import CAGE_TYPES
from flexcage.geometry.bearing import RowPlace
from flexcage.geometry.cage import Cage

_MEETS = 20e-6  # m: ends of halves that are this near to the middle plane are meant to lie in it


def is_one_piece(cage: Cage, places: Sequence[RowPlace]) -> bool:
    """Do the halves of a common cage of two rows at these places meet, so that it is one body?"""
    reach = cage.inner_reach
    if len(places) != 2 or reach is None or not cage_type_of(cage).joins:
        return False
    return abs(2.0 * reach - (places[1].place - places[0].place)) < 2.0 * _MEETS


def meeting(cage: Cage, places: Sequence[RowPlace]) -> Cage | None:
    """The cage with such a ``width`` that both halves meet; None where its type has no such."""
    if cage.inner_reach is None or not cage_type_of(cage).joins or len(places) != 2:
        return None
    width: dict[str, Any] = {"width": round(_meeting_width(cage, places), 6)}
    return replace(cage, **width)


def _meeting_width(cage: Cage, places: Sequence[RowPlace]) -> float:
    """Width [m] at which both halves meet; that of mirror images grows at one end."""
    gap = 0.5 * (places[1].place - places[0].place) - (cage.inner_reach or 0.0)
    return cage.width + (1.0 if cage.mirrored else 2.0) * gap


def find_apart(cage: Cage, places: Sequence[RowPlace]) -> Iterator[tuple[str, str]]:
    """Where and why, in a sentence, the halves of a common cage that is to bend are no one body."""
    reach, otherwise = cage.inner_reach, 'or model = "rigid" in [cage]'
    if reach is None or not cage_type_of(cage).joins:
        joining = ", ".join(f"'{name}'" for name, made in CAGE_TYPES.items() if made.joins)
        yield (
            "cage.model",
            f"cage.model is 'flexible', but the halves of a {cage.cage_type} cage for two rows are "
            f"not one body; give a cage of a type that is ({joining}), {otherwise}.",
        )
    elif not is_one_piece(cage, places):
        gap = 0.5 * (places[1].place - places[0].place) - reach
        what = "apart" if gap > 0.0 else "over each other"
        yield (
            "cage.width",
            f"cage.width is {mm(cage.width)}, so that both halves of the cage are "
            f"{mm(2.0 * abs(gap))} {what} in the middle, but a common cage that bends is one body; "
            f"give {mm(_meeting_width(cage, places))}, {otherwise}.",
        )


def signs_of(cage: Cage, places: Sequence[RowPlace]) -> tuple[float, ...]:
    """Sign of the x of each row's half of a common cage, as it is described, in the cage's frame.
    Halves that are mirror images turn their end at -x to the middle if they hold together there,
    and else to the outside."""
    if not cage.mirrored:
        return (1.0,) * len(places)
    inward = -1.0 if is_one_piece(cage, places) else 1.0
    return (inward, -inward)[: len(places)]
