"""Is this tapered roller bearing possible? One sentence for each impossibility, and what would be
right."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import asin, cos, pi, sin
from typing import Any

from flexcage.bearings.cylindrical_roller.checks import find_in_roller_spot
from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing
from flexcage.core.units import describe, mm
from flexcage.geometry.cage import Cage
from flexcage.geometry.checks import Finding, check_cage_defects, check_fit, raise_first
from flexcage.geometry.spall import find_in_spall


def check(b: TaperedRollerBearing, cage: Cage | None, defects: Sequence[Any]) -> None:
    """Raise InputError for the first impossibility in the bearing, its cage or the defects."""
    raise_first(_find_in_sizes(b))
    raise_first(_find_in_lengths(b))
    raise_first(_find_between_rollers(b))
    raise_first(_find_at_rib(b))
    raise_first(_find_at_small_rib(b))
    raise_first(_find_in_rings(b))
    for ring, diameter in zip(("inner", "outer"), b.race_diameters):
        raise_first(find_in_spall(b, ring, 0.5 * diameter, 0.5 * b.effective_length))
    raise_first(find_in_roller_spot(b))
    if cage is None:
        return
    cage.check(b.roller_count)
    check_fit(b, cage, iter(()))
    check_cage_defects(b, cage, defects)


def _find_in_sizes(b: TaperedRollerBearing) -> Iterator[Finding]:
    if not b.bore < b.pitch_diameter < b.outside_diameter:
        yield (
            "bearing.pitch_diameter",
            f"bearing.pitch_diameter is {mm(b.pitch_diameter)}, but must be between bore, "
            f"{mm(b.bore)}, and outside_diameter, {mm(b.outside_diameter)}.",
        )
    if b.roller_diameter >= b.pitch_diameter:
        yield (
            "bearing.roller_diameter",
            f"bearing.roller_diameter is {mm(b.roller_diameter)}, but must be smaller than "
            f"pitch_diameter, {mm(b.pitch_diameter)}.",
        )
    for key in ("inner_width", "outer_width"):
        if (value := getattr(b, key)) > b.width:
            yield (
                f"bearing.{key}",
                f"bearing.{key} is {mm(value)}, wider than the whole bearing, {mm(b.width)}.",
            )


def _find_in_lengths(b: TaperedRollerBearing) -> Iterator[Finding]:
    if b.race_angles[0] <= 0.0:
        yield (
            "bearing.contact_angle",
            f"bearing.contact_angle is {describe(b.contact_angle, 'deg')}, which leaves the inner "
            f"race no cone: rollers of {mm(b.roller_diameter)} have a half angle of "
            f"{describe(b.half_angle, 'deg')}; give thinner rollers or a larger angle.",
        )
    if b.effective_length > b.roller_length:
        yield (
            "bearing.effective_length",
            f"bearing.effective_length is {mm(b.effective_length)}, longer than the roller "
            f"itself, {mm(b.roller_length)}.",
        )
    along = b.roller_length * cos(b.axis_angle)
    if along > b.width:
        yield (
            "bearing.roller_length",
            f"bearing.roller_length is {mm(b.roller_length)}, {mm(along)} of it along the axis, "
            f"longer than the bearing is wide, {mm(b.width)}.",
        )
    radius, reach = b.profile.crown_radius, 0.5 * b.effective_length
    if b.profile.kind == "crowned" and reach**2 > radius * b.roller_diameter:
        yield (
            "bearing.profile.crown_radius",
            f"bearing.profile.crown_radius is {describe(radius, 'm')}, so small that the profile "
            "cuts through the roller's axis.",
        )


def _find_between_rollers(b: TaperedRollerBearing) -> Iterator[Finding]:
    share = sin(b.half_angle) / sin(b.axis_angle)
    if sin(pi / b.roller_count) <= share:
        yield (
            "bearing.roller_count",
            f"{b.roller_count} rollers of {mm(b.roller_diameter)} overlap on a pitch diameter of "
            f"{mm(b.pitch_diameter)}; at most {int(pi / asin(share))} fit.",
        )


def _find_at_rib(b: TaperedRollerBearing) -> Iterator[Finding]:
    large = b.roller.ends[0]
    if b.rib_height >= 2.0 * large:
        yield (
            "bearing.rib_height",
            f"bearing.rib_height is {mm(b.rib_height)}, but rollers are {mm(2.0 * large)} in "
            "diameter at their large ends; give less.",
        )
    if 0.5 * b.rib_height <= b.element_edge:
        yield (
            "bearing.rib_height",
            f"bearing.rib_height is {mm(b.rib_height)}, but rollers bear halfway up the rib, where "
            f"their ends have chamfers of {mm(b.element_edge)}; give more than twice that.",
        )
    if not large < b.end_radius < b.apex_to_end:
        yield (
            "bearing.end_radius",
            f"bearing.end_radius is {mm(b.end_radius)}, but must be between the radius of a "
            f"roller's large end, {mm(large)}, and its distance from the apex, "
            f"{mm(b.apex_to_end)}.",
        )


def _find_at_small_rib(b: TaperedRollerBearing) -> Iterator[Finding]:
    height, small = b.small_rib_height, b.roller.ends[1]
    if height is not None and not 2.0 * b.element_edge < height < 2.0 * small:
        yield (
            "bearing.small_rib_height",
            f"bearing.small_rib_height is {mm(height)}, but must be between twice the chamfer of "
            f"the rollers' ends, {mm(2.0 * b.element_edge)}, and their small diameter, "
            f"{mm(2.0 * small)}: rollers touch halfway up the rib.",
        )
    if height is not None and b.small_rib_play > 0.1 * b.roller_length:
        yield (
            "bearing.small_rib_play",
            f"bearing.small_rib_play is {mm(b.small_rib_play)}; give a tenth of the rollers' "
            f"length, {mm(0.1 * b.roller_length)}, or less.",
        )


def _find_in_rings(b: TaperedRollerBearing) -> Iterator[Finding]:
    """Walls that are left at the small end of the inner race and the large end of the outer."""
    half = 0.5 * b.effective_length
    inner, outer = b.race_diameter("inner", half), b.race_diameter("outer", -half)
    if inner <= b.bore:
        yield (
            "bearing.bore",
            f"bearing.bore is {mm(b.bore)}, but the inner race is {mm(inner)} in diameter at the "
            "rollers' small ends; give less.",
        )
    if outer >= b.outside_diameter:
        yield (
            "bearing.outside_diameter",
            f"bearing.outside_diameter is {mm(b.outside_diameter)}, but the outer race is "
            f"{mm(outer)} in diameter at the rollers' large ends; give more.",
        )
