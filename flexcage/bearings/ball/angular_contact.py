"""Angular contact ball bearings, of one row."""

from __future__ import annotations

from dataclasses import dataclass
from math import asin, cos, pi, sin, sqrt
from typing import TYPE_CHECKING, Any, ClassVar

from flexcage.bearings.ball.bearing import BallBearing, clearance_at
from flexcage.core.spec import quantity
from flexcage.geometry.bearing import Bearing, type_name

if TYPE_CHECKING:
    from flexcage.geometry.fits.changed import Changed


@dataclass(frozen=True, kw_only=True)
class AngularContactBallBearing(BallBearing):
    """A ball bearing that bears axial load towards +x; displacements count from first contact.

    The free contact angle and the radial clearance say the same thing, Pd = 2 A (1 - cos alpha):
    one of them is enough, and both must agree.
    """

    kind: ClassVar[str] = "angular contact ball bearing"
    one_sided: ClassVar[bool] = True

    type: str = type_name("angular_contact_ball")
    contact_angle: float | None = quantity(
        "deg", None, doc="free contact angle", above=0.0, maximum=0.499 * pi
    )
    radial_clearance: float | None = quantity(
        "um", None, doc="radial internal clearance Pd, in place of the contact angle"
    )

    @property
    def free_contact_angle(self) -> float:
        if self.contact_angle is not None:
            return self.contact_angle
        share = (self.radial_clearance or 0.0) / (4.0 * self.groove_distance)
        return 2.0 * asin(sqrt(min(max(share, 0.0), 0.5)))

    @property
    def nominal_contact_angle(self) -> float:
        return self.free_contact_angle

    @property
    def clearance(self) -> float:
        return clearance_at(self.free_contact_angle, self.groove_distance)

    def approach(self, mounted: Bearing, changed: Changed) -> float | None:
        """None where no clearance, and so no contact angle, is left."""
        assert isinstance(mounted, AngularContactBallBearing)
        if (mounted.radial_clearance or 0.0) <= 0.0:
            return None
        return self.groove_offset[0] - mounted.groove_offset[0]

    def _as_clearance(self, clearance: float) -> dict[str, Any]:
        return {"contact_angle": None, "radial_clearance": clearance}

    @property
    def groove_offset(self) -> tuple[float, float]:
        angle = self.free_contact_angle
        return self.groove_distance * sin(angle), self.groove_distance * cos(angle)
