"""What is said of tapered roller bearings beside their dimensions."""

from __future__ import annotations

from flexcage.bearings.tapered_roller import checks, ratings
from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing
from flexcage.geometry.bearing import Rules

RULES = Rules[TaperedRollerBearing](
    check=checks.check, static_rating=ratings.static_rating,
    dynamic_rating=ratings.dynamic_rating, equivalent_load=ratings.equivalent_load,
)  # fmt: skip
