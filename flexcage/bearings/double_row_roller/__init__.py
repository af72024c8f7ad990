"""Double row cylindrical roller bearings."""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.ratings import equivalent_load
from flexcage.bearings.double_row_roller.bearing import DoubleRowRollerBearing
from flexcage.bearings.family import Family
from flexcage.bearings.two_rows import check, dynamic_rating, rows_of, static_rating
from flexcage.geometry.bearing import Rules

__all__ = ["DoubleRowRollerBearing"]  # the spec that ``flexcage.spec`` shows

FAMILY = Family(
    name="double_row_roller",
    types=(DoubleRowRollerBearing,),
    rules=Rules[DoubleRowRollerBearing](
        check=check, static_rating=static_rating, dynamic_rating=dynamic_rating,
        equivalent_load=equivalent_load,
    ),
    statics=lambda: rows_of,
    motion=None,
    recording=None,
    variables=None,
    speed=None,
    figures=None,
    rubbing=None,
    shapes=None,
    inside=None,
    built_on="cylindrical_roller",
)  # fmt: skip
