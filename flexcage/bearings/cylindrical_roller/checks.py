"""Is this cylindrical roller bearing possible? One sentence for each impossibility, and what would
be right."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import asin, pi, sin
from typing import TYPE_CHECKING, Any

from flexcage.bearings.cylindrical_roller import designs
from flexcage.bearings.cylindrical_roller.spot import find_in_spot
from flexcage.core.units import describe, mm
from flexcage.geometry.cage import Cage
from flexcage.geometry.checks import (
    MOST_SCATTER,
    Finding,
    check_cage_defects,
    check_room,
    find_off_pitch_circle,
    raise_first,
)
from flexcage.geometry.spall import find_in_spall

if TYPE_CHECKING:
    from flexcage.bearings.cylindrical_roller.bearing import RollerBearing

_MOST_CLEARANCE = 0.05  # of the roller's diameter: leaves one roller to bear a moderate load


def check(bearing: RollerBearing, cage: Cage | None, defects: Sequence[Any]) -> None:
    """Raise InputError for the first impossibility in the bearing, its cage or the defects."""
    raise_first(find_in_bearing(bearing))
    raise_first(find_in_spot(bearing))
    if cage is None:
        return
    cage.check(bearing.roller_count)
    check_room(bearing, cage)
    check_cage_defects(bearing, cage, defects)


def find_in_bearing(b: RollerBearing) -> Iterator[Finding]:
    """What is impossible in the bearing alone."""
    yield from designs.find_in_design(b)
    rising = designs.diameters(b)
    for (small, low), (large, high) in zip(rising, rising[1:]):
        if not low < high:
            yield (
                f"bearing.{large}",
                f"bearing.{large} is {mm(high)}, but must be greater than {small}, {mm(low)}.",
            )
    space = 0.5 * (b.outer_race_diameter - b.inner_race_diameter)
    if abs(b.roller_diameter - space) > 1e-6:
        yield (
            "bearing.roller_diameter",
            f"bearing.roller_diameter is {mm(b.roller_diameter)}, but the races leave "
            f"{mm(space)}, (E - F)/2; race diameters are those at zero clearance.",
        )
    chord = b.pitch_diameter * sin(pi / b.roller_count)
    if chord <= b.roller_diameter:
        most = int(pi / asin(b.roller_diameter / b.pitch_diameter))
        yield (
            "bearing.roller_count",
            f"{b.roller_count} rollers of {mm(b.roller_diameter)} overlap on a pitch diameter of "
            f"{mm(b.pitch_diameter)}; at most {most} fit.",
        )
    if b.radial_clearance < 0.0:
        yield (
            "bearing.radial_clearance",
            f"bearing.radial_clearance is {describe(b.radial_clearance, 'um')}, but a negative "
            "clearance (preload) is not modelled; give 0 um or more.",
        )
    widest = _MOST_CLEARANCE * b.roller_diameter
    if b.radial_clearance > widest:
        yield (
            "bearing.radial_clearance",
            f"bearing.radial_clearance is {mm(b.radial_clearance)}, so wide that one roller alone "
            f"would bear; give {mm(widest)} or less, {100.0 * _MOST_CLEARANCE:g} % of a roller's "
            "diameter.",
        )
    widest = MOST_SCATTER * b.roller_diameter
    if b.roller_scatter > widest:
        yield (
            "bearing.roller_scatter",
            f"bearing.roller_scatter is {mm(b.roller_scatter)}, but rollers of one bearing differ "
            f"by micrometres; give {mm(widest)} or less, {100.0 * MOST_SCATTER:g} % of their "
            "diameter.",
        )
    yield from _find_in_lengths(b)
    for ring, radius in (("inner", b.inner_race_radius), ("outer", b.outer_race_radius)):
        yield from find_in_spall(b, ring, radius, 0.5 * b.effective_length)


def _find_in_lengths(b: RollerBearing) -> Iterator[Finding]:
    if b.effective_length > b.roller_length:
        yield (
            "bearing.effective_length",
            f"bearing.effective_length is {mm(b.effective_length)}, longer than the roller "
            f"itself, {mm(b.roller_length)}.",
        )
    yield from designs.find_in_gaps(b)
    if b.profile.kind == "crowned" and (0.5 * b.effective_length) ** 2 > (
        b.profile.crown_radius * b.roller_diameter
    ):
        yield (
            "bearing.profile.crown_radius",
            f"bearing.profile.crown_radius is {describe(b.profile.crown_radius, 'm')}, so "
            "small that the profile cuts through the roller's axis.",
        )


def find_around_cage(b: RollerBearing, c: Cage) -> Iterator[Finding]:
    """What leaves a cage no place between the rings, and around the pitch circle."""
    if c.width > b.width:
        yield (
            "cage.width",
            f"cage.width is {mm(c.width)}, wider than the bearing, {mm(b.width)}.",
        )
    inner, outer = b.cage_space(c)
    if c.bore <= inner.diameter:
        yield (
            "cage.bore",
            f"cage.bore is {mm(c.bore)}, so the cage cuts through {inner.name}, "
            f"{mm(inner.diameter)} in diameter.",
        )
    if c.outside_diameter >= outer.diameter:
        yield (
            "cage.outside_diameter",
            f"cage.outside_diameter is {mm(c.outside_diameter)}, so the cage cuts through "
            f"{outer.name}, {mm(outer.diameter)} in diameter.",
        )
    if c.guidance in ("inner", "outer") and (ribs := b.ribs(c.guidance)) and not all(ribs.sides):
        yield (
            "cage.guidance",
            f"cage.guidance is '{c.guidance}', but the {c.guidance} ring of the design {b.design} "
            "has a rib on one side alone, which guides no cage; take 'roller' or "
            f"'{designs.DESIGNS[b.design].guide}'.",
        )
    yield from find_off_pitch_circle(b, c)
