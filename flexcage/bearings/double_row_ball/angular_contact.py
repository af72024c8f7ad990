"""Double row angular contact ball bearings."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, ClassVar

from flexcage.bearings.ball.angular_contact import AngularContactBallBearing
from flexcage.bearings.ball.bearing import BallBearing
from flexcage.bearings.ball.ratings import STATIC_PRESSURE
from flexcage.bearings.two_rows import (
    ARRANGEMENTS,
    RowFields,
    single,
)
from flexcage.core.spec import option, quantity
from flexcage.core.units import typeset
from flexcage.geometry.bearing import Bearing, RowPlace, type_name
from flexcage.geometry.spall import spalls_in_words

if TYPE_CHECKING:
    from flexcage.geometry.fits.changed import Changed

POWER, WEIBULL = 0.7, 10.0 / 9.0  # ISO 281, ball bearings


@dataclass(frozen=True, kw_only=True)
class DoubleRowAngularContactBallBearing(RowFields, AngularContactBallBearing):
    """Two rows of balls that bear axial load one way each; ``ball_count`` is that of one row.

    Displacements count from the middle of the axial clearance, which is free play of the inner
    ring from where one row touches to where the other does.
    """

    kind: ClassVar[str] = "double row angular contact ball bearing"
    family: ClassVar[str] = "double_row_ball"
    one_sided: ClassVar[bool] = False
    row_power: ClassVar[float] = POWER
    weibull: ClassVar[float] = WEIBULL
    carries: ClassVar[tuple[bool, ...]] = (True, True, True, True, True)
    pressure_limit: ClassVar[float] = STATIC_PRESSURE

    type: str = type_name("double_row_angular_contact_ball")
    arrangement: str = option(
        "back_to_back", choices=ARRANGEMENTS,
        doc="where the lines of contact meet the axis: beyond the rows, or between them",
    )  # fmt: skip
    axial_clearance: float = quantity("um", 0.0, doc="axial internal clearance; < 0 is preload")

    @cached_property
    def row(self) -> AngularContactBallBearing:
        row: AngularContactBallBearing = single(self, AngularContactBallBearing)
        return row

    @property
    def row_places(self) -> tuple[RowPlace, RowPlace]:
        return self._places(
            self.ball_count, sense=1.0 if self.arrangement == "back_to_back" else -1.0
        )

    @property
    def late(self) -> float:
        return 0.5 * self.axial_clearance

    def approach(self, mounted: Bearing, changed: Changed) -> float | None:
        return 0.0  # its middle stays

    def in_place(self, changed: Changed) -> BallBearing:
        """The rows meet by as much earlier as each of them does."""
        moved = super().in_place(changed)
        earlier = self.groove_offset[0] - moved.groove_offset[0]
        return replace(moved, axial_clearance=self.axial_clearance - 2.0 * earlier)  # type: ignore[call-arg]

    def in_words(self) -> str:
        return (
            f"{self.name_and_size} with two rows of {self.ball_count} balls of "
            f"{typeset(self.ball_diameter, 'mm')}{self.of_what}, "
            f"{self.arrangement.replace('_', ' ')}, free contact angle "
            f"{typeset(self.free_contact_angle, 'deg', digits=4)}, axial clearance "
            f"{typeset(self.axial_clearance, 'um', digits=4)}."
            f"{spalls_in_words(self)}{self.ball_spot.in_words()}"
        )
