"""Is a four-point contact bearing possible, and what is it rated for?

ISO 76 and ISO 281 do not name these bearings. Makers rate them as two rows of angular contact whose
balls are the same (i = 2), and give factors of the equivalent load for 35 degrees that are those of
ISO 281 for two rows (SKF, General Catalogue 6000 EN, four-point contact ball bearings: P = Fr +
0.66 Fa, and 0.6 Fr + 1.07 Fa beyond Fa/Fr = 0.95).
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import degrees, nan
from typing import Any

from flexcage.bearings.ball import checks, lands, ratings
from flexcage.bearings.four_point.bearing import FourPointContactBearing
from flexcage.bearings.two_rows import ROWS  # as which both pairs of arcs count
from flexcage.core.units import mm
from flexcage.geometry.bearing import EquivalentLoad, Rules
from flexcage.geometry.cage import Cage
from flexcage.geometry.checks import Finding, raise_first

_LEAST = 20.0  # degrees: makers' factors do not depend on the load


def check(bearing: FourPointContactBearing, cage: Cage | None, defects: Sequence[Any]) -> None:
    """Raise InputError for the first impossibility in the bearing, its cage or the defects."""
    raise_first(_find_in_arcs(bearing))
    raise_first(checks.find_in_angle(bearing, "arcs"))
    checks.check(bearing, cage, defects)
    raise_first(_find_in_edges(bearing))


def _find_in_arcs(b: FourPointContactBearing) -> Iterator[Finding]:
    if not any(b.shims):
        yield (
            "bearing.inner_shim",
            "bearing.inner_shim and bearing.outer_shim are both 0, so that each race is one arc; "
            'give a shim, or take type = "deep_groove_ball".',
        )
    for ring, shim, length in zip(("inner", "outer"), b.shims, b.lengths):
        if 0.0 < length <= 0.5 * shim:
            yield (
                f"bearing.{ring}_shim",
                f"bearing.{ring}_shim is {mm(shim)}, but no ball touches both arcs of this race "
                f"where it is {mm(2.0 * length)} or more, 2 r - D.",
            )


def _find_in_edges(b: FourPointContactBearing) -> Iterator[Finding]:
    for ring, edge, rest in zip(("inner", "outer"), b.groove_edges, b.shim_angles):
        if edge <= rest:
            yield (
                f"bearing.{ring}_shoulder",
                f"bearing.{ring}_shoulder ends the race at {degrees(edge):.4g} deg, but balls rest "
                f"in it at {degrees(rest):.4g} deg, by its shim; give a higher shoulder or a "
                "thinner shim.",
            )


def static_rating(bearing: FourPointContactBearing) -> float:
    """ISO 76 with i = 2; axial ratings, above 45 degrees, are those of one pair of arcs."""
    one = ratings.static_rating(bearing)
    return one if bearing.is_thrust else ROWS * one


def dynamic_rating(bearing: FourPointContactBearing) -> float:
    """ISO 281, b_m f_c (i cos(alpha))^0.7 Z^(2/3) D^1.8 with i = 2."""
    one = ratings.dynamic_rating(bearing)
    return one if bearing.is_thrust else ROWS**0.7 * one


def equivalent_load(
    bearing: FourPointContactBearing, radial: float, axial: float
) -> EquivalentLoad:
    """Of two rows by ISO 281, from 20 degrees on; below, the standard's factors depend on the load
    and are not given here."""
    angle = degrees(bearing.nominal_contact_angle)
    if bearing.is_thrust:
        return ratings.equivalent_load(bearing, radial, axial)
    if angle < _LEAST:
        return EquivalentLoad(nan, nan, nan, 3.0)
    limit, x, high, low = ratings.two_row_factors(bearing, axial)
    x, y = (x, high) if axial > limit * radial else (1.0, low)
    return EquivalentLoad(x * radial + y * axial, x, y, 3.0)


RULES = Rules[FourPointContactBearing](
    check=check, static_rating=static_rating, dynamic_rating=dynamic_rating,
    equivalent_load=equivalent_load, land=lands.land, cage_space=lands.cage_space,
    stops=lands.stops,
)  # fmt: skip
