"""Needle roller bearings: long rollers between two ribs of the outer ring, on the shaft itself or
on an inner ring, caged or a full complement.

Without an inner ring the bore is the race diameter F: shaft and race are one. The cage lies between
the ribs, which in a drawn cup are its lips, and passes on what needles press on them.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, ClassVar

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.core.spec import option
from flexcage.core.units import mm
from flexcage.geometry.bearing import type_name

if TYPE_CHECKING:
    from flexcage.geometry.fits.changed import Changed
    from flexcage.geometry.fits.spec import Fit

SLENDER = (2.5, 10.0)  # length over diameter of needles: ISO 3096
_MOST_PLAY = 0.1  # of a needle's length, between its ribs, without a cage
_THINNEST = 0.15  # of a needle's diameter: a machined ring at its race


@dataclass(frozen=True, kw_only=True)
class NeedleRollerBearing(RollerBearing):
    """A needle roller bearing with a machined outer ring (NK, RNA; with an inner ring NKI, NA).

    A bore as large as ``inner_race_diameter`` means that there is no inner ring. ``rib_gap`` is the
    distance of the ribs; needles in a cage stop a side beam's width before them.
    """

    kind: ClassVar[str] = "needle roller bearing"
    cage_between_ribs: ClassVar[bool] = True
    walls: ClassVar[tuple[float, float]] = (0.0, 1.0)  # m, of the outer ring at its race

    type: str = type_name("needle_roller")
    design: str = option("NU", choices=("NU",), doc="ribs: two on the outer ring")

    @property
    def has_inner_ring(self) -> bool:
        return self.bore != self.inner_race_diameter

    def in_place(self, changed: Changed) -> RollerBearing:
        made = super().in_place(changed)
        return made if self.has_inner_ring else replace(made, bore=made.inner_race_diameter)

    def axial_refusal(self, load: float) -> str:
        if load == 0.0:
            return ""
        return (
            f"a {self.kind} has ribs on the outer ring alone, which hold needles and cage, and "
            "carries no axial load: take it up by a thrust bearing beside it"
        )

    def impossible(self) -> Iterator[tuple[str, str]]:
        """Needles that are none, lie loose or have no race, and walls of the outer ring."""
        slender, (least, most) = self.roller_length / self.roller_diameter, SLENDER
        if not least <= slender <= most:
            yield (
                "bearing.roller_length",
                f"bearing.roller_length is {mm(self.roller_length)}, {slender:.3g} times the "
                f"diameter, but needles are {least:g} to {most:g} times as long (ISO 3096); "
                "shorter rollers are those of type 'cylindrical_roller'.",
            )
        if self.bore > self.inner_race_diameter:
            yield (
                "bearing.bore",
                f"bearing.bore is {mm(self.bore)}, but the inner race has "
                f"{mm(self.inner_race_diameter)}; give less, or the same without an inner ring.",
            )
        wall = 0.5 * (self.outside_diameter - self.outer_race_diameter)
        thin, thick = max(self.walls[0], _THINNEST * self.roller_diameter), self.walls[1]
        if wall > 0.0 and not thin <= wall <= thick:
            yield (
                "bearing.outside_diameter",
                f"bearing.outside_diameter is {mm(self.outside_diameter)}, which leaves a wall of "
                f"{mm(wall)} at the outer race; that of a {self.kind} is {mm(thin)} to "
                f"{mm(thick)} thick.",
            )


@dataclass(frozen=True, kw_only=True)
class DrawnCupNeedleRollerBearing(NeedleRollerBearing):
    """A needle roller bearing whose outer ring is a cup drawn from sheet steel (HK; full
    complement HN), pressed into its housing, which gives it its shape.

    The closed end of a BK counts as a lip: the stiffness and mass of its bottom are left out.
    """

    kind: ClassVar[str] = "drawn cup needle roller bearing"
    rating_factor: ClassVar[float] = 1.0  # b_m of ISO 281 for drawn cups
    walls: ClassVar[tuple[float, float]] = (0.3e-3, 2.5e-3)  # sheet steel: an assumption

    type: str = type_name("drawn_cup_needle_roller")

    def fit_refusal(self, fit: Fit) -> str:
        if not fit.housing:
            return ""
        return (
            f"fit.housing is '{fit.housing}', but a drawn cup takes its shape from the housing and "
            "has no outside diameter of a tolerance before (ISO 3245): give what it is pressed by "
            "as fit.housing_interference, or the clearance in its housing as "
            "bearing.radial_clearance without it."
        )
