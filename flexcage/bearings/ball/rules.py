"""What is said of ball bearings beside their dimensions."""

from __future__ import annotations

from flexcage.bearings.ball import checks, lands, ratings
from flexcage.bearings.ball.bearing import BallBearing
from flexcage.geometry.bearing import Rules

RULES = Rules[BallBearing](
    check=checks.check, static_rating=ratings.static_rating,
    dynamic_rating=ratings.dynamic_rating, equivalent_load=ratings.equivalent_load,
    land=lands.land, cage_space=lands.cage_space, stops=lands.stops,
)  # fmt: skip
