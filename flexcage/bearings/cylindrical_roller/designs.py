"""Designs of cylindrical roller bearings: which ring has ribs, and on which sides.

Their names are those of makers' catalogues (NSK, Rolling Bearings, E1102e). The ring with two ribs
guides the rollers; a rib of the other ring, the counter rib, makes the bearing carry axial load.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING

from flexcage.core.units import describe, mm
from flexcage.geometry.checks import Finding

if TYPE_CHECKING:
    from flexcage.bearings.cylindrical_roller.bearing import RollerBearing

RINGS = ("inner", "outer")
SIDES = ("+x", "-x")  # order of a ring's ribs in all arrays
_TWO = (True, True)


@dataclass(frozen=True)
class Design:
    """``guide``: the ring with two ribs; ``counter``: how many ribs the other one has."""

    guide: str
    counter: int

    @property
    def other(self) -> str:
        """The ring that does not guide the rollers."""
        return RINGS[1 - RINGS.index(self.guide)]


#: Designs by their names in catalogues.
DESIGNS = {
    "N": Design("inner", 0),
    "NU": Design("outer", 0),
    "NJ": Design("outer", 1),
    "NUP": Design("outer", 2),
    "NF": Design("inner", 1),
}
ALL = "N, NU, NJ, NUP and NF"


@dataclass(frozen=True)
class Ribs:
    """Ribs of one ring: their diameter towards the rollers and their distance [m], and the sides,
    +x and -x, that have one. A single rib is half of the distance from the middle."""

    diameter: float
    gap: float
    sides: tuple[bool, bool]

    @property
    def name(self) -> str:
        return "ribs" if all(self.sides) else "rib"


def ribs_of(b: RollerBearing, ring: str) -> Ribs | None:
    """Ribs of the "inner" or "outer" ring; None if it has none."""
    design = DESIGNS[b.design]
    if ring == design.guide:
        return Ribs(b.rib_diameter, b.rib_gap, _TWO)
    if not design.counter:
        return None
    assert b.counter_rib_diameter is not None and b.counter_rib_gap is not None  # see ``check``
    return Ribs(b.counter_rib_diameter, b.counter_rib_gap, _counter_sides(b))


def _counter_sides(b: RollerBearing) -> tuple[bool, bool]:
    """Sides of the counter ribs. A single one of the inner ring pushes the rollers the way of the
    axial load; one of the outer ring stands in that way."""
    design = DESIGNS[b.design]
    if design.counter == 2:
        return _TWO
    plus = (b.thrust == "+x") == (design.other == "outer")
    return plus, not plus


def carried(b: RollerBearing) -> tuple[bool, bool]:
    """Does the bearing carry axial load on its inner ring towards +x, and towards -x?"""
    counter = DESIGNS[b.design].counter
    plus, minus = (counter == 2 or (counter == 1 and b.thrust == side) for side in SIDES)
    return plus, minus


def axial_refusal(b: RollerBearing, load: float) -> str:
    """Why the ribs cannot carry an axial load [N] on the inner ring; empty if they can."""
    if load == 0.0 or carried(b)[0 if load > 0.0 else 1]:
        return ""
    if not any(carried(b)):
        return (
            f"the design {b.design} has ribs on the {DESIGNS[b.design].guide} ring alone and "
            "carries no axial load: NJ carries one towards one side, NUP towards both"
        )
    towards = "+x" if load > 0.0 else "-x"
    return (
        f"this {b.design} carries axial load towards {b.thrust} alone: bearing.thrust = "
        f'"{towards}" turns it round, and the design NUP carries both'
    )


def axial_clearance(b: RollerBearing) -> float:
    """Axial distance [m] by which the inner ring of a bearing with counter ribs must move from the
    middle before rollers stand between ribs of both rings."""
    assert b.counter_rib_gap is not None
    return 0.5 * (b.rib_gap + b.counter_rib_gap) - b.roller_length


def rib_height(b: RollerBearing, ring: str) -> float:
    """Where a rib of the "inner" or "outer" ring bears on a roller's end: halfway up their overlap,
    radially from the roller's axis [m]. An end is flat to 0.9 of its radius."""
    ribs, radius = ribs_of(b, ring), 0.9 * 0.5 * b.roller_diameter
    assert ribs is not None
    sense = 1.0 if ring == "outer" else -1.0
    return 0.5 * sense * (sense * (0.5 * ribs.diameter - b.pitch_radius) + radius)


def diameters(b: RollerBearing) -> list[tuple[str, float]]:
    """Names and values of the fields that must rise from the bore to the outside diameter."""
    guide, counter = ("rib_diameter", b.rib_diameter), _counter(b)
    ribs = [guide, *counter] if DESIGNS[b.design].guide == "inner" else [*counter, guide]
    return [
        ("bore", b.bore),
        ("inner_race_diameter", b.inner_race_diameter),
        *ribs,
        ("outer_race_diameter", b.outer_race_diameter),
        ("outside_diameter", b.outside_diameter),
    ]


def _counter(b: RollerBearing) -> list[tuple[str, float]]:
    value = b.counter_rib_diameter
    return [] if value is None else [("counter_rib_diameter", value)]


def find_in_design(b: RollerBearing) -> Iterator[Finding]:
    """Counter ribs of a design that has none, or that are not described."""
    design = DESIGNS[b.design]
    for key in ("counter_rib_diameter", "counter_rib_gap"):
        value = getattr(b, key)
        if value is None and design.counter:
            yield (
                f"bearing.{key}",
                f"bearing.{key} is missing, but the design {b.design} has "
                f"{'a rib' if design.counter == 1 else 'ribs'} on the {design.other} ring too; "
                "give it.",
            )
        elif value is not None and not design.counter:
            yield (
                f"bearing.{key}",
                f"bearing.{key} is {describe(value, 'mm')}, but the design {b.design} has no ribs "
                f"on the {design.other} ring; leave it out, or take the design NJ, NUP or NF.",
            )


def find_in_gaps(b: RollerBearing) -> Iterator[Finding]:
    """Ribs that leave rollers no place between them, or for which the rings have none."""
    gaps = (("rib_gap", b.rib_gap), ("counter_rib_gap", b.counter_rib_gap))
    for key, gap in gaps:
        if gap is None:
            continue
        if gap <= b.roller_length:
            yield (
                f"bearing.{key}",
                f"bearing.{key} is {mm(gap)}, but must be greater than the roller's length, "
                f"{mm(b.roller_length)}.",
            )
        if gap >= b.width:
            yield (
                f"bearing.{key}",
                f"bearing.{key} is {mm(gap)}, which leaves no ribs on a ring {mm(b.width)} wide.",
            )
