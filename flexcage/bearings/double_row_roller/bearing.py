"""Double row cylindrical roller bearings."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.bearings.two_rows import RowFields, single
from flexcage.core.units import typeset
from flexcage.geometry.bearing import RowPlace, type_name
from flexcage.geometry.rollers import STATIC_PRESSURE
from flexcage.geometry.spall import spalls_in_words


@dataclass(frozen=True, kw_only=True)
class DoubleRowRollerBearing(RowFields, RollerBearing):
    """Two rows of cylindrical rollers, of the designs NN (``design`` N) and NNU (NU);
    ``roller_count`` is that of one row."""

    kind: ClassVar[str] = "double row cylindrical roller bearing"
    family: ClassVar[str] = "double_row_roller"
    row_power: ClassVar[float] = 7.0 / 9.0  # ISO 281, roller bearings
    weibull: ClassVar[float] = 9.0 / 8.0
    carries: ClassVar[tuple[bool, ...]] = (False, True, True, True, True)
    pressure_limit: ClassVar[float] = STATIC_PRESSURE

    type: str = type_name("double_row_cylindrical_roller")

    @cached_property
    def row(self) -> RollerBearing:
        row: RollerBearing = single(self, RollerBearing)
        return row

    @property
    def row_places(self) -> tuple[RowPlace, RowPlace]:
        return self._places(self.roller_count, sense=1.0)

    @property
    def greatest_shift(self) -> float:
        return 0.5 * (self.width - self.row_distance - self.roller_length)

    @property
    def late(self) -> float:
        return 0.0

    def in_words(self) -> str:
        return (
            f"{self.name_and_size} with two rows of {self.roller_count} rollers of "
            f"{typeset(self.roller_diameter, 'mm')}{self.of_what}, radial clearance "
            f"{typeset(self.radial_clearance, 'um')}."
            f"{spalls_in_words(self)}{self.roller_spot.in_words()}"
        )
