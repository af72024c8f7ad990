"""Spherical roller bearings: the spec, the sphere, grooves and barrels.

Two rows of barrels roll on one sphere of the outer ring, whose centre is the bearing's middle, and
in a groove each of the inner ring, so that the inner ring tilts freely (T. A. Harris, Rolling
Bearing Analysis, chapters on geometry). Lines of contact go through the middle: at a contact angle
to the radial direction, at which the barrels' axes lean towards the bearing's.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from math import asin, cos, pi, sin, tan
from typing import TYPE_CHECKING, Any, ClassVar

from flexcage.bearings.spherical_roller.barrel import Barrel
from flexcage.bearings.two_rows import RowFields, RowPlace
from flexcage.cages.barrel.cage import BarrelCage
from flexcage.core.spec import option, quantity
from flexcage.core.units import typeset
from flexcage.geometry.bearing import Bearing, Spec, type_name
from flexcage.geometry.inclined_rollers import OfInclinedRollers
from flexcage.geometry.life.iso281 import ROLLERS, Endurance
from flexcage.geometry.materials import MATERIALS, Material
from flexcage.geometry.other_kinds import SURROUNDINGS
from flexcage.geometry.rollers import STATIC_PRESSURE

if TYPE_CHECKING:
    from flexcage.geometry.fits.changed import Changed

_SPHERE = (
    "the outer race is a sphere about the bearing's middle: its radius follows from "
    "pitch_diameter, contact_angle, roller_diameter and radial_clearance"
)
_PLACES = "rows stand where lines of contact go through the bearing's middle: give contact_angle"


@dataclass(frozen=True, kw_only=True)
class SphericalRollerBearing(RowFields, OfInclinedRollers, Bearing):
    """Two rows of barrels on one sphere of the outer ring; ``roller_count`` is that of one row.

    The sphere's radius and where rows are follow from where the rollers are, and the clearance.
    """

    kind: ClassVar[str] = "spherical roller bearing"
    cage_spec: ClassVar[Spec] = BarrelCage
    element: ClassVar[str] = "barrel roller"
    family: ClassVar[str] = "spherical_roller"
    places: ClassVar[tuple[str, ...]] = ("race",)
    sliced: ClassVar[tuple[str, ...]] = ("race",)
    endurance: ClassVar[Endurance | None] = ROLLERS
    carries_axial_load: ClassVar[bool] = True
    self_aligning: ClassVar[bool] = True
    one_sided: ClassVar[bool] = False
    row_power: ClassVar[float] = 7.0 / 9.0  # ISO 281, roller bearings
    weibull: ClassVar[float] = 9.0 / 8.0
    carries: ClassVar[tuple[bool, ...]] = (True, True, True, False, False)
    pressure_limit: ClassVar[float] = STATIC_PRESSURE
    elsewhere: ClassVar[Mapping[str, str]] = {
        "(outer|sphere).*(radius|diameter)": _SPHERE,
        "row_(distance|spacing)": _PLACES,
        "profile|crown(_radius)?": "the barrels' profile is an arc: barrel_radius",
        **SURROUNDINGS,
    }

    type: str = type_name("spherical_roller")
    row_distance: ClassVar[Any]  # type: ignore[misc]
    bore: float = quantity("mm", doc="bearing bore d", above=0.0)
    outside_diameter: float = quantity("mm", doc="bearing outside diameter D", above=0.0)
    width: float = quantity("mm", doc="width B of both rings", above=0.0)
    contact_angle: float = quantity(
        "deg", doc="angle of the lines of contact to the radial direction", above=0.0,
        maximum=0.25 * pi,
    )  # fmt: skip
    pitch_diameter: float = quantity("mm", doc="diameter Dpw of the rollers' middles", above=0.0)
    roller_diameter: float = quantity("mm", doc="largest diameter Dwe of a barrel", above=0.0)
    roller_length: float = quantity("mm", doc="length Lw of a barrel, overall", above=0.0)
    effective_length: float = quantity(
        "mm", doc="length Lwe of a barrel without end chamfers", above=0.0
    )
    roller_count: int = option(doc="number Z of barrels of a row", minimum=3)
    barrel_radius: float = quantity("mm", doc="radius of the barrels' profile", above=0.0)
    inner_groove_radius: float = quantity(
        "mm", doc="radius of the inner grooves' profile", above=0.0
    )
    radial_clearance: float = quantity("um", 0.0, doc="radial internal clearance Pd")
    material: Material = option(MATERIALS["GCr15"], doc="material of the rings, and of the rollers")
    element_material: Material | None = option(
        None, doc="material of the rollers, as Si3N4 (default: bearing.material)"
    )

    @property
    def one_row(self) -> SphericalRollerBearing:
        """Itself: both rows have one cage, whose keys are those of a half."""
        return self

    @property
    def axis_angle(self) -> float:
        return self.contact_angle

    @property
    def race_angles(self) -> tuple[float, float]:
        return self.contact_angle, self.contact_angle

    @property  # type: ignore[no-redef]
    def row_distance(self) -> float:
        """Axial distance [m] of the rollers' middles of both rows."""
        return self.pitch_diameter * tan(self.contact_angle)

    @property
    def reach(self) -> float:
        """Distance [m] of the rollers' middles from the bearing's."""
        return self.pitch_radius / cos(self.contact_angle)

    @property
    def gap(self) -> float:
        """Clearance [m] of a roller at either race, along its line of contact."""
        return 0.25 * self.radial_clearance * cos(self.contact_angle)

    @property
    def sphere_radius(self) -> float:
        """Radius [m] of the outer race."""
        return self.reach + 0.5 * self.roller_diameter + self.gap

    @property
    def osculations(self) -> tuple[float, float]:
        """Radius of the barrels' profile over those of inner groove and sphere, below 1."""
        return (
            self.barrel_radius / self.inner_groove_radius,
            self.barrel_radius / self.sphere_radius,
        )

    @property
    def profile_radii(self) -> tuple[float, float]:
        """Effective radii [m] of rollers on inner and outer race along the lines of contact."""
        races = self.inner_groove_radius, self.sphere_radius
        own, (inner, outer) = self.barrel_radius, races
        return own * inner / (inner - own), own * outer / (outer - own)

    @property
    def curvature_radii(self) -> tuple[float, float]:
        """Effective radii [m] of rollers on inner and outer race across the lines of contact."""
        roller = 2.0 / self.roller_diameter
        inner = 2.0 * cos(self.contact_angle) / self.race_diameters[0]
        return 1.0 / (roller + inner), 1.0 / (roller - 1.0 / self.sphere_radius)

    @cached_property
    def roller(self) -> Barrel:
        return Barrel(self.roller_diameter, self.roller_length, self.barrel_radius)

    @property
    def ring_widths(self) -> tuple[float, float]:
        return self.width, self.width

    @property
    def clearance(self) -> float:
        return self.radial_clearance

    @property
    def greatest_tilt(self) -> float:
        """Beyond it, barrels run over the edge of the sphere."""
        barrel = asin(0.5 * self.effective_length / self.sphere_radius)
        return asin(0.5 * self.width / self.sphere_radius) - self.contact_angle - barrel

    @property
    def late(self) -> float:
        return 0.0

    @property
    def row_places(self) -> tuple[RowPlace, RowPlace]:
        return self._places(self.roller_count, sense=-1.0)

    def race_diameter(self, ring: str, x: float) -> float:
        """Diameter [m] of the "inner" or "outer" race at a distance x [m] along a roller's axis
        from its middle, away from the bearing's middle."""
        across = self.contact_angle
        if ring == "outer":
            height = (self.sphere_radius**2 - x**2) ** 0.5
            return 2.0 * (height * cos(across) - x * sin(across))
        sagitta = self.inner_groove_radius - (self.inner_groove_radius**2 - x**2) ** 0.5
        height = sagitta - 0.5 * self.roller_diameter - self.gap
        return self.pitch_diameter + 2.0 * (height * cos(across) - x * sin(across))

    def in_place(self, changed: Changed) -> SphericalRollerBearing:
        """The sphere is where the clearance leaves it."""
        races = 0.5 * (changed.inner_race + changed.outer_race)
        return replace(
            self, pitch_diameter=self.pitch_diameter + races,
            roller_diameter=self.roller_diameter + changed.element,
            inner_groove_radius=self.inner_groove_radius * (1.0 + changed.inner_strain),
            radial_clearance=changed.clearance,
        )  # fmt: skip

    def in_words(self) -> str:
        return (
            f"{self.name_and_size} with two rows of {self.roller_count} barrels of "
            f"{typeset(self.roller_diameter, 'mm')} by {typeset(self.roller_length, 'mm')}"
            f"{self.of_what} on a sphere, contact angle "
            f"{typeset(self.contact_angle, 'deg', digits=4)}, radial clearance "
            f"{typeset(self.radial_clearance, 'um')}."
        )
