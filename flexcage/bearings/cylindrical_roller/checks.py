"""Is this cylindrical roller bearing possible? One sentence for each impossibility, and what would
be right."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import asin, pi, sin
from typing import Any

from flexcage.bearings.cylindrical_roller import designs, lands
from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.core.units import describe, mm
from flexcage.geometry.cage import Cage
from flexcage.geometry.checks import (
    MOST_SCATTER,
    Finding,
    check_cage_defects,
    check_fit,
    find_off_pitch_circle,
    raise_first,
)
from flexcage.geometry.spall import find_in_spall
from flexcage.geometry.spot import find_in_spots

_MOST_CLEARANCE = 0.05  # of the roller's diameter: leaves one roller to bear a moderate load


def check(bearing: RollerBearing, cage: Cage | None, defects: Sequence[Any]) -> None:
    """Raise InputError for the first impossibility in the bearing, its cage or the defects."""
    raise_first(find_in_bearing(bearing))
    raise_first(find_in_roller_spot(bearing))
    if cage is None:
        return
    cage.check(bearing.roller_count)
    check_fit(bearing, cage, find_around_cage(bearing, cage))
    check_cage_defects(bearing, cage, defects)


def find_in_bearing(b: RollerBearing) -> Iterator[Finding]:
    """What is impossible in the bearing alone."""
    yield from _find_in_design(b)
    yield from b.impossible()
    rising = _diameters(b)
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
    yield from _find_in_gaps(b)
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
    if b.cage_between_ribs and c.width >= b.rib_gap:
        yield (
            "cage.width",
            f"cage.width is {mm(c.width)}, but the cage lies between the ribs, {mm(b.rib_gap)} "
            "apart (bearing.rib_gap); make it narrower.",
        )
    inner, outer = lands.limits(b, c)
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


def find_in_roller_spot(b: Any) -> Iterator[tuple[str, str]]:
    """What is impossible in the spot of a bearing's roller; where, and in a sentence."""
    spot, where, reach = b.roller_spot, "bearing.roller_spot", b.effective_length
    if not spot.size:
        return
    named = {"roller": (spot.roller,), "others": spot.others}
    yield from find_in_spots(b, where, spot, named, b.roller_diameter)
    if spot.width is not None and abs(spot.offset) - 0.5 * spot.width >= 0.5 * reach:
        yield (
            f"{where}.offset",
            f"{where}.offset is {mm(spot.offset)}, where the roller touches no race: it does to "
            f"{mm(0.5 * reach)} from its middle.",
        )


def _diameters(b: RollerBearing) -> list[tuple[str, float]]:
    """Names and values of the fields that must rise from the bore to the outside diameter."""
    guide, counter = ("rib_diameter", b.rib_diameter), _counter(b)
    ribs = [guide, *counter] if designs.DESIGNS[b.design].guide == "inner" else [*counter, guide]
    bore = [("bore", b.bore)] if b.has_inner_ring else []
    return [
        *bore,
        ("inner_race_diameter", b.inner_race_diameter),
        *ribs,
        ("outer_race_diameter", b.outer_race_diameter),
        ("outside_diameter", b.outside_diameter),
    ]


def _counter(b: RollerBearing) -> list[tuple[str, float]]:
    value = b.counter_rib_diameter
    return [] if value is None else [("counter_rib_diameter", value)]


def _find_in_design(b: RollerBearing) -> Iterator[Finding]:
    """Counter ribs of a design that has none, or that are not described."""
    design = designs.DESIGNS[b.design]
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


def _find_in_gaps(b: RollerBearing) -> Iterator[Finding]:
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
