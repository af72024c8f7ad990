"""Dimensions of conical cages that leave no body: one sentence each."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from flexcage.core.units import mm
from flexcage.geometry.cage import Objection


def impossible(cage: Any, pocket_count: int) -> Iterator[Objection]:
    """Dimensions that leave no body: small end, bars, pockets, fillets."""
    half = 0.5 * cage.pocket_length
    if cage.bore <= 0.0:
        yield "pitch_diameter", "so the wall runs into the bearing's axis at its small end"
        return
    if cage.pocket_width_small > cage.pocket_width_large:
        yield (
            "pocket_width_small",
            f"wider than at the large end; it must be at most {mm(cage.pocket_width_large)}",
        )
    narrow = 2.0 * min(cage.half_width(half, n) for n in cage.face_heights(half))
    if narrow <= 0.0:
        yield "flank_angle", "so the bars' faces meet within the wall; make it smaller"
    if (bar := cage.thinnest_bar(pocket_count)) <= 0.0:
        yield (
            cage.widths[0],
            f"makes the {pocket_count} crossbeams thinner than zero, {mm(bar)}, at an end; "
            "make pockets narrower or the offset greater",
        )
    yield from cage.unfit_fillets(0.5 * min(narrow, cage.pocket_length))
