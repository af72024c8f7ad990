"""Barrels in the pockets of their cage: what leaves no room for them, or for it in the bearing."""

from __future__ import annotations

from collections.abc import Iterator
from math import hypot
from typing import Any, Protocol

from flexcage.cages.conical.rollers import (
    PITCH_OFF,
    InclinedRollers,
    edges_in_fillets,
    off_axes,
    tight,
)
from flexcage.core.units import mm
from flexcage.geometry.cage import HeldElements, Objection


class Barrels(InclinedRollers, Protocol):
    """What a cage of barrels asks of its bearing."""

    @property
    def row_distance(self) -> float: ...
    @property
    def reach(self) -> float: ...
    @property
    def sphere_radius(self) -> float: ...
    def race_diameter(self, ring: str, x: float) -> float: ...


def obstructions(cage: Any, bearing: HeldElements) -> Iterator[Objection]:
    """What leaves no room in the cage for the barrels, or for itself between the rings."""
    barrels: Barrels = bearing  # type: ignore[assignment]
    yield from off_axes(cage, barrels)
    yield from _off_rows(cage, barrels)
    yield from tight(cage, barrels, {"pocket_width": 0.0})
    yield from edges_in_fillets(cage, barrels)
    yield from _between_rings(cage, barrels)


def _off_rows(cage: Any, b: Barrels) -> Iterator[Objection]:
    if abs(cage.row_distance - b.row_distance) > PITCH_OFF:
        yield "row_distance", f"but the rows of barrels are {mm(b.row_distance)} apart; give that"


def _between_rings(cage: Any, b: Barrels) -> Iterator[Objection]:
    """A wall that cuts into the sphere, or into the inner ring beside the grooves."""
    at = cage.section
    ends = at.small, float(cage.large_end(at.outside))
    far = max(hypot(b.reach + at.outside, s) for s in ends)
    if far >= b.sphere_radius:
        yield (
            "offset",
            f"so the wall cuts {mm(far - b.sphere_radius)} into the sphere of the outer ring; make "
            "it, the thickness or the rims smaller",
        )
    half = 0.5 * b.element_length
    for what, s, edge in (
        ("outer", at.small, half),
        ("inner", float(cage.large_end(at.inside)), -half),
    ):
        ring = 0.5 * b.race_diameter("inner", edge)
        inside = float(cage.radius(s, at.inside))
        if inside <= ring:
            yield (
                "offset",
                f"so the wall cuts {mm(ring - inside)} into the inner ring beside the barrels' "
                f"{what} ends; make it greater, or the wall thinner",
            )
