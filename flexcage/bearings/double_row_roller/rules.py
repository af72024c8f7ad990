"""What is said of double row cylindrical roller bearings beside their dimensions."""

from __future__ import annotations

from dataclasses import replace

from flexcage.bearings import two_rows
from flexcage.bearings.cylindrical_roller import lands
from flexcage.bearings.cylindrical_roller.ratings import equivalent_load
from flexcage.bearings.double_row_roller.bearing import DoubleRowRollerBearing
from flexcage.geometry.bearing import RingLand, Rules
from flexcage.geometry.cage import Cage


def land(bearing: DoubleRowRollerBearing, cage: Cage) -> RingLand:
    """Where the ends of a row's cage face the ring that guides it, or the outward ones of a common
    cage."""
    own = lands.land(bearing.row, cage)
    if cage.count_in(bearing) > 1:
        return own
    return replace(own, end=min(own.end + 0.5 * bearing.row_distance, 0.5 * bearing.width))


RULES = Rules[DoubleRowRollerBearing](
    check=two_rows.check, static_rating=two_rows.static_rating,
    dynamic_rating=two_rows.dynamic_rating, equivalent_load=equivalent_load, land=land,
    cage_space=lands.limits,
)  # fmt: skip
