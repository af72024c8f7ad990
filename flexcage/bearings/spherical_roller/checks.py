"""Is this spherical roller bearing possible? One sentence for each impossibility, and what would be
right."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import asin, cos, pi, sin, sqrt
from typing import Any

from flexcage.bearings.spherical_roller.bearing import SphericalRollerBearing
from flexcage.core.units import describe, mm
from flexcage.geometry.cage import Cage
from flexcage.geometry.checks import Finding, check_cage_defects, check_fit, raise_first


def check(b: SphericalRollerBearing, cage: Cage | None, defects: Sequence[Any]) -> None:
    """Raise InputError for the first impossibility in the bearing, its cage or the defects."""
    raise_first(_find_in_sizes(b))
    raise_first(_find_in_profiles(b))
    raise_first(_find_between_rollers(b))
    raise_first(_find_between_rows(b))
    raise_first(_find_in_rings(b))
    if cage is not None:
        cage.check(b.roller_count)
        check_fit(b, cage, iter(()))
        check_cage_defects(b, cage, defects)


def _find_in_sizes(b: SphericalRollerBearing) -> Iterator[Finding]:
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
    if b.effective_length > b.roller_length:
        yield (
            "bearing.effective_length",
            f"bearing.effective_length is {mm(b.effective_length)}, longer than the barrel "
            f"itself, {mm(b.roller_length)}.",
        )


def _find_in_profiles(b: SphericalRollerBearing) -> Iterator[Finding]:
    """Arcs: barrels have ends, and are more curved than both races."""
    half, radius = 0.5 * b.roller_length, 0.5 * b.roller_diameter
    least = max(half, 0.5 * (half**2 + radius**2) / radius)
    if b.barrel_radius <= least:
        yield (
            "bearing.barrel_radius",
            f"bearing.barrel_radius is {mm(b.barrel_radius)}, so small that barrels of "
            f"{mm(b.roller_length)} come to a point; give more than {mm(least)}.",
        )
    for key, race, name in (
        ("inner_groove_radius", b.inner_groove_radius, "the inner groove"),
        ("barrel_radius", b.sphere_radius, "the sphere of the outer ring"),
    ):
        if b.barrel_radius >= race:
            yield (
                f"bearing.{key}",
                f"bearing.barrel_radius is {mm(b.barrel_radius)}, but {name} has a radius of "
                f"{mm(race)}, so that barrels would bear with their ends; give a smaller one, "
                "usually 0.96 to 0.99 of the races'.",
            )


def _find_between_rollers(b: SphericalRollerBearing) -> Iterator[Finding]:
    """Barrels of a row lean towards one point of the axis: of that at x along a barrel's axis,
    (Dpw/2 - x sin(alpha)) sin(pi/Z) is half of the distance to the next one's."""

    def needed(share: float) -> float:
        lean = sin(b.contact_angle) * share
        return 0.5 * b.roller_diameter + b.barrel_radius * (sqrt(1.0 + lean**2) - 1.0)

    share = sin(pi / b.roller_count)
    if b.pitch_radius * share <= needed(share):
        most = int(pi / asin(min(needed(share) / b.pitch_radius, 1.0)))
        yield (
            "bearing.roller_count",
            f"{b.roller_count} barrels of {mm(b.roller_diameter)} a row overlap on a pitch "
            f"diameter of {mm(b.pitch_diameter)}; at most {most} fit.",
        )


def _find_between_rows(b: SphericalRollerBearing) -> Iterator[Finding]:
    """Corners of barrels next to the other row, and to the bearing's sides."""
    along, end = 0.5 * b.roller_length * cos(b.contact_angle), b.roller.end_radius
    middle, aside = 0.5 * b.row_distance, end * sin(b.contact_angle)
    if middle < along + aside:
        yield (
            "bearing.roller_length",
            f"barrels of {mm(b.roller_length)} meet those of the other row, whose middles are "
            f"{mm(b.row_distance)} off at a contact angle of "
            f"{describe(b.contact_angle, 'deg')}; give shorter ones or a larger angle.",
        )
    if middle + along + aside > 0.5 * b.width:
        yield (
            "bearing.width",
            f"barrels reach {mm(middle + along + aside)} from the bearing's middle, out of a "
            f"bearing {mm(b.width)} wide; give a width of {mm(2.0 * (middle + along + aside))} or "
            "more, or shorter barrels.",
        )


def _find_in_rings(b: SphericalRollerBearing) -> Iterator[Finding]:
    inner = b.race_diameter("inner", 0.5 * b.roller_length)
    if inner <= b.bore:
        yield (
            "bearing.bore",
            f"bearing.bore is {mm(b.bore)}, but the inner race is {mm(inner)} in diameter at the "
            "barrels' outer ends; give less.",
        )
    if 2.0 * b.sphere_radius >= b.outside_diameter:
        yield (
            "bearing.outside_diameter",
            f"bearing.outside_diameter is {mm(b.outside_diameter)}, but the outer race's sphere is "
            f"{mm(2.0 * b.sphere_radius)} in diameter; give more.",
        )
