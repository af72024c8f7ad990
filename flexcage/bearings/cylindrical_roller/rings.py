"""Sections of rings with plain raceways and ribs, for rings that bend.

Undercuts between race and ribs, and chamfers, are left out.
"""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.geometry.ring import Raceway, RingSection


def roller_rings(
    b: RollerBearing,
    *,
    angle: tuple[float, float],
    across: tuple[float, float],
    seat: tuple[float, float],
) -> tuple[RingSection, RingSection]:
    """Sections of inner ring, with its two ribs, and outer ring of a bearing; rollers press along
    their effective length."""
    half, gap, end = 0.5 * b.width, 0.5 * b.rib_gap, 0.5 * b.effective_length
    bore, outside = (0.5 * d for d in seat)
    race, outer = 0.5 * b.inner_race_diameter, 0.5 * b.outer_race_diameter
    rib = 0.5 * b.rib_diameter
    inner_outline = (
        (-half, bore), (half, bore), (half, rib), (gap, rib), (gap, race), (end, race),
        (-end, race), (-gap, race), (-gap, rib), (-half, rib),
    )  # fmt: skip
    inner_names = ("seat", "", "", "", "", "race", "", "", "", "")
    outer_outline = (
        (half, outside), (-half, outside), (-half, outer), (-end, outer), (end, outer),
        (half, outer),
    )  # fmt: skip
    outer_names = ("seat", "", "", "race", "", "")
    return (
        RingSection(inner_outline, inner_names, _line(race, -1.0, end), race - bore),
        RingSection(outer_outline, outer_names, _line(outer, 1.0, end), outside - outer),
    )


def _line(race: float, side: float, half_length: float) -> Raceway:
    return Raceway(place=(0.0, race), normal=(0.0, side), extent=half_length, line=True)
