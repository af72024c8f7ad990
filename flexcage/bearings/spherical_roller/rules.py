"""What is said of spherical roller bearings beside their dimensions."""

from __future__ import annotations

from flexcage.bearings.spherical_roller import checks, ratings
from flexcage.bearings.spherical_roller.bearing import SphericalRollerBearing
from flexcage.geometry.bearing import Rules

RULES = Rules[SphericalRollerBearing](
    check=checks.check, static_rating=ratings.static_rating,
    dynamic_rating=ratings.dynamic_rating, equivalent_load=ratings.equivalent_load,
)  # fmt: skip
