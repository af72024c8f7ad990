"""Deep groove ball bearings, of one row."""

from __future__ import annotations

from dataclasses import dataclass
from math import asin, sqrt
from typing import ClassVar

from flexcage.bearings.ball.bearing import BallBearing
from flexcage.core.spec import quantity
from flexcage.geometry.bearing import type_name


@dataclass(frozen=True, kw_only=True)
class DeepGrooveBallBearing(BallBearing):
    """A ball bearing that bears axial load both ways; displacements count from its middle.

    The nominal contact angle is 0; a clearance < 0 is preload.
    """

    kind: ClassVar[str] = "deep groove ball bearing"

    type: str = type_name("deep_groove_ball")
    radial_clearance: float = quantity(
        "um", 0.0, doc="operating radial clearance Pd; with [fit] before mounting"
    )

    @property
    def free_contact_angle(self) -> float:
        share = self.radial_clearance / (4.0 * self.groove_distance)
        return 2.0 * asin(sqrt(min(max(share, 0.0), 0.5)))

    @property
    def nominal_contact_angle(self) -> float:
        return 0.0

    @property
    def clearance(self) -> float:
        return self.radial_clearance

    @property
    def groove_offset(self) -> tuple[float, float]:
        return 0.0, self.groove_distance - 0.5 * self.radial_clearance
