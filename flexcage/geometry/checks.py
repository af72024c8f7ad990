"""What the checks of bearings share: is this geometry possible?

Specs check each value alone (bounds); ``Bearing.check`` checks values against one another, and says
in one sentence what is wrong and what is right.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import inf, sqrt
from typing import Any

from flexcage.core.errors import InputError
from flexcage.core.units import describe, mm
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage
from flexcage.geometry.defect import check_in_rows, defect_spec, in_row, numbered_as

Finding = tuple[str, str]  # where, sentence

# of an element's diameter: elements differ by a hundred times what those of one bearing do
MOST_SCATTER = 0.01
OVERLOAD = 4.0  # static ratings C0: line contacts then bear 8 GPa, the hardness of bearing steel


def greatest_speed(bearing: Bearing) -> float:
    """Speed [rad/s] of the inner ring at which centrifugal force alone loads every element as
    ``OVERLOAD`` static ratings load the first one, 5 C0/Z; infinite where masses are not known."""
    mass = bearing.element_mass
    if mass == 0.0:
        return inf
    pitch, diameter = bearing.pitch_diameter, bearing.element_diameter
    most = 5.0 * OVERLOAD * bearing.static_rating / bearing.total_elements
    return 2.0 / (1.0 - diameter / pitch) * sqrt(most / (0.5 * mass * pitch))


def raise_first(findings: Iterator[Finding]) -> None:
    """Raise the first finding, if any, as an InputError."""
    for where, sentence in findings:
        raise InputError(sentence, where=where)


def check_fit(bearing: Bearing, cage: Cage, around: Iterator[Finding]) -> None:
    """Raise InputError for the first impossibility in a cage between elements and rings;
    ``around``: what leaves it no place."""
    raise_first(around)
    raise_first(
        (f"cage.{name}", f"cage.{name} is {cage.described(name)}, {what}.")
        for name, what in cage.obstructions(bearing)
    )
    raise_first(_find_in_unbalance(cage))


def check_cage_defects(bearing: Bearing, cage: Cage, defects: Sequence[Any]) -> None:
    """Raise InputError for the first defect that the cage cannot have in this bearing."""
    if not defects:
        return
    spec, count = defect_spec(cage), bearing.element_count
    check_in_rows(defects, count, bearing.row_count)
    for row in range(bearing.row_count):
        own = in_row(defects, row, count)
        with numbered_as(defects, row, count):
            spec.check_all(
                own, cage, pocket_count=count, pitch_diameter=bearing.pitch_diameter,
                element_diameter=bearing.element_diameter,
            )  # fmt: skip
            raise_first(spec.interference(own, cage, bearing))


def _find_in_unbalance(c: Cage) -> Iterator[Finding]:
    """An unbalance that no cage of this size can have."""
    if c.unbalance > c.most_unbalance:
        yield (
            "cage.unbalance",
            f"cage.unbalance is {describe(c.unbalance, 'g*mm')}, but half of the cage's body of "
            f"revolution makes no more than {describe(c.most_unbalance, 'g*mm')}.",
        )
    if abs(c.unbalance_offset) > 0.5 * c.axial_width:
        yield (
            "cage.unbalance_offset",
            f"cage.unbalance_offset is {mm(c.unbalance_offset)}, but the cage ends "
            f"{mm(0.5 * c.axial_width)} from its middle.",
        )


def find_off_pitch_circle(b: Bearing, c: Cage) -> Iterator[Finding]:
    """A cage that the elements' centres do not lie in."""
    if not c.bore < b.pitch_diameter < c.outside_diameter:
        yield (
            "cage",
            f"The cage from {mm(c.bore)} to {mm(c.outside_diameter)} in diameter does not hold "
            f"the {b.element}s' pitch circle of {mm(b.pitch_diameter)}; its pockets cannot guide "
            "them.",
        )
