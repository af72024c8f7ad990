"""What is said of cylindrical roller bearings beside their dimensions."""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller import checks, lands, ratings
from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.geometry.bearing import Rules

RULES = Rules[RollerBearing](
    check=checks.check, static_rating=ratings.static_rating,
    dynamic_rating=ratings.dynamic_rating, equivalent_load=ratings.equivalent_load,
    land=lands.land, cage_space=lands.limits,
)  # fmt: skip
