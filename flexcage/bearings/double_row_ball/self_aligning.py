"""Self-aligning ball bearings."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import acos, atan2, cos, hypot, sin
from typing import TYPE_CHECKING, Any, ClassVar

from flexcage.bearings.ball.angular_contact import AngularContactBallBearing
from flexcage.bearings.ball.bearing import BallBearing
from flexcage.bearings.ball.deep_groove import DeepGrooveBallBearing
from flexcage.bearings.double_row_ball.angular_contact import POWER, WEIBULL
from flexcage.bearings.two_rows import RowFields, single
from flexcage.core.spec import quantity
from flexcage.core.units import typeset
from flexcage.geometry.bearing import RowPlace, type_name
from flexcage.geometry.spall import spalls_in_words

if TYPE_CHECKING:
    from flexcage.geometry.fits.changed import Changed

_LEAST_ANGLE = 1e-6  # rad, of a row's contact


@dataclass(frozen=True, kw_only=True)
class SelfAligningBallBearing(RowFields, BallBearing):
    """Two rows of balls that roll on one sphere of the outer ring, so that the inner one tilts
    freely; ``ball_count`` is that of one row.

    The sphere has its centre in the bearing's middle: its radius and the contact angle follow from
    where the balls are, and from the clearance.
    """

    kind: ClassVar[str] = "self-aligning ball bearing"
    family: ClassVar[str] = "double_row_ball"
    self_aligning: ClassVar[bool] = True
    row_power: ClassVar[float] = POWER
    weibull: ClassVar[float] = WEIBULL
    carries: ClassVar[tuple[bool, ...]] = (True, True, True, False, False)
    pressure_limit: ClassVar[float] = 4.6e9

    type: str = type_name("self_aligning_ball")
    # no keys: the outer race is one sphere, without shoulders
    outer_groove_radius: ClassVar[Any]  # type: ignore[misc]
    outer_shoulder: ClassVar[None] = None  # type: ignore[misc, assignment]
    radial_clearance: float = quantity("um", 0.0, doc="radial internal clearance Pd")

    @property
    def nominal_contact_angle(self) -> float:
        return atan2(self.row_distance, self.pitch_diameter)

    @property
    def _reach(self) -> float:
        """Distance [m] of a ball's centre from the bearing's middle."""
        return 0.5 * hypot(self.row_distance, self.pitch_diameter)

    @property  # type: ignore[no-redef]
    def outer_groove_radius(self) -> float:
        """Radius [m] of the sphere: where balls touch it, and the clearance along the contact."""
        gap = 0.5 * self.radial_clearance * cos(self.nominal_contact_angle)
        return self._reach + 0.5 * self.ball_diameter + gap

    @property
    def free_contact_angle(self) -> float:
        return self.nominal_contact_angle

    @property
    def clearance(self) -> float:
        return self.radial_clearance

    @property
    def groove_offset(self) -> tuple[float, float]:
        """Of grooves that hold the balls in the middle of their clearance."""
        lost = self.outer_groove_radius - self._reach - 0.5 * self.ball_diameter
        distance, angle = self.groove_distance - lost, self.nominal_contact_angle
        return distance * sin(angle), distance * cos(angle)

    @cached_property
    def row(self) -> AngularContactBallBearing:
        """As the ring, moved along the axis, presses its balls; the sphere's centre stays."""
        angle = max(acos(min(self.groove_offset[1] / self.groove_distance, 1.0)), _LEAST_ANGLE)
        row: AngularContactBallBearing = single(
            self, AngularContactBallBearing, contact_angle=angle, radial_clearance=None,
            pitch_diameter=2.0 * self._pressed * cos(angle),
        )  # fmt: skip
        return row

    @property
    def grooved(self) -> DeepGrooveBallBearing:
        """A bearing of one row with the same inner groove on both rings: what is impossible in it
        is so here."""
        found: DeepGrooveBallBearing = single(
            self, DeepGrooveBallBearing, outer_groove_radius=self.inner_groove_radius
        )
        return found

    @property
    def _pressed(self) -> float:
        """Distance [m] from the middle of balls that touch the sphere."""
        return self.outer_groove_radius - 0.5 * self.ball_diameter

    @property
    def row_places(self) -> tuple[RowPlace, RowPlace]:
        distance = 2.0 * self._pressed * sin(self.row.free_contact_angle)
        return self._places(self.ball_count, sense=-1.0, distance=distance)

    @property
    def late(self) -> float:
        return self.row.groove_offset[0] - self.groove_offset[0]

    def in_place(self, changed: Changed) -> BallBearing:
        """The sphere is where the clearance leaves it."""
        return replace(
            self, pitch_diameter=self.pitch_diameter + changed.inner_race + 0.5 * changed.element,
            ball_diameter=self.ball_diameter + changed.element,
            inner_groove_radius=self.inner_groove_radius * (1.0 + changed.inner_strain),
            radial_clearance=changed.clearance,
        )  # fmt: skip

    def in_words(self) -> str:
        return (
            f"{self.name_and_size} with two rows of {self.ball_count} balls of "
            f"{typeset(self.ball_diameter, 'mm')}{self.of_what} on a sphere, contact angle "
            f"{typeset(self.nominal_contact_angle, 'deg', digits=4)}, radial clearance "
            f"{typeset(self.radial_clearance, 'um', digits=4)}."
            f"{spalls_in_words(self)}{self.ball_spot.in_words()}"
        )
