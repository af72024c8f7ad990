"""Tapered roller bearings: the spec, the cones, mass and inertia of a roller.

Both races and all rollers are cones with one apex on the bearing's axis, so that everything rolls
along whole lines (T. A. Harris, Rolling Bearing Analysis, chapters on geometry and on speeds). The
apex is at +x: an axial load > 0 pushes the inner ring (cone) towards it, into the outer ring (cup).
The origin is on the axis, in the plane of the rollers' middles. Their large ends, at -x, are
spheres that bear on the inner ring's large rib.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from math import asin, atan, cos, pi, sin, sqrt
from typing import TYPE_CHECKING, ClassVar

from flexcage.bearings.cylindrical_roller.spot import RollerSpot
from flexcage.bearings.tapered_roller.frustum import Frustum
from flexcage.cages.conical.cage import ConicalCage
from flexcage.core.spec import GIVEN, option, quantity
from flexcage.core.units import typeset
from flexcage.geometry.bearing import Bearing, Spec, type_name
from flexcage.geometry.hertz import PointContact
from flexcage.geometry.inclined_rollers import OfInclinedRollers
from flexcage.geometry.life.iso281 import ROLLERS, Endurance
from flexcage.geometry.materials import MATERIALS, Material
from flexcage.geometry.other_kinds import SURROUNDINGS
from flexcage.geometry.rollers import RollerProfile
from flexcage.geometry.spall import BY_RACE, Spall, spalls_in_words
from flexcage.geometry.waviness import waviness, waviness_azimuth, waviness_order

if TYPE_CHECKING:
    from flexcage.geometry.fits.changed import Changed

BY_ANGLE = "a tapered roller bearing's contact angle is that of the outer race (cup): contact_angle"
FIRST_CONTACT = (
    "displacements of a tapered roller bearing count from first contact: give its preload as "
    "load.axial"
)


@dataclass(frozen=True, kw_only=True)
class TaperedRollerBearing(OfInclinedRollers, Bearing):
    """A single-row tapered roller bearing; displacements count from first contact.

    The rollers' half angle follows from their mean diameter, the pitch diameter and the contact
    angle, as all cones share one apex.
    """

    kind: ClassVar[str] = "tapered roller bearing"
    cage_spec: ClassVar[Spec] = ConicalCage
    element: ClassVar[str] = "tapered roller"
    family: ClassVar[str] = "tapered_roller"
    places: ClassVar[tuple[str, ...]] = ("race", "rib")
    sliced: ClassVar[tuple[str, ...]] = ("race",)
    endurance: ClassVar[Endurance | None] = ROLLERS
    carries_axial_load: ClassVar[bool] = True
    elsewhere: ClassVar[Mapping[str, str]] = {
        "(cup|cone|half|outer|inner|taper).?angle": BY_ANGLE,
        "(radial|axial)_clearance|end_play": FIRST_CONTACT,
        **BY_RACE,
        **SURROUNDINGS,
    }

    type: str = type_name("tapered_roller")
    bore: float = quantity("mm", doc="bearing bore d", above=0.0)
    outside_diameter: float = quantity("mm", doc="bearing outside diameter D", above=0.0)
    width: float = quantity("mm", doc="width T of the bearing, over both rings", above=0.0)
    inner_width: float = quantity("mm", doc="width B of the inner ring (cone)", above=0.0)
    outer_width: float = quantity("mm", doc="width C of the outer ring (cup)", above=0.0)
    contact_angle: float = quantity(
        "deg", doc="half angle of the outer race, the contact angle of ISO 281", above=0.0,
        maximum=0.25 * pi,
    )  # fmt: skip
    pitch_diameter: float = quantity("mm", doc="diameter Dpw of the rollers' middles", above=0.0)
    roller_diameter: float = quantity("mm", doc="mean diameter Dwe of a roller", above=0.0)
    roller_length: float = quantity("mm", doc="length Lw of a roller, overall", above=0.0)
    effective_length: float = quantity(
        "mm", doc="length Lwe of a roller without end chamfers", above=0.0
    )
    roller_count: int = option(doc="number Z of rollers", minimum=3)
    rib_height: float = quantity("mm", doc="height of the large rib over the inner race", above=0.0)
    end_radius: float = quantity("mm", doc="radius of the rollers' spherical large ends", above=0.0)
    small_rib_height: float | None = quantity(
        "mm", None, doc="height of the small rib over the inner race (default: no small rib)",
        above=0.0,
    )  # fmt: skip
    small_rib_play: float = quantity(
        "mm", 0.3e-3, doc="play of a roller between both ribs, along its axis", above=0.0,
        when={"small_rib_height": GIVEN},
    )  # fmt: skip
    profile: RollerProfile = option(RollerProfile(), doc="roller profile")
    material: Material = option(MATERIALS["GCr15"], doc="material of the rings, and of the rollers")
    element_material: Material | None = option(
        None, doc="material of the rollers, as Si3N4 (default: bearing.material)"
    )
    inner_waviness: float = waviness("inner")
    inner_waviness_order: int = waviness_order("inner")
    inner_waviness_azimuth: float = waviness_azimuth("inner")
    outer_waviness: float = waviness("outer")
    outer_waviness_order: int = waviness_order("outer")
    outer_waviness_azimuth: float = waviness_azimuth("outer")
    inner_spall: Spall = option(Spall(), doc="a pit of the inner race, which turns with its ring")
    outer_spall: Spall = option(Spall(), doc="a pit of the outer race")
    roller_spot: RollerSpot = option(RollerSpot(), doc="a pit or a flat on a roller")

    @cached_property
    def half_angle(self) -> float:
        """Half angle eps [rad] of a roller: tan(eps) = Dwe/Dpw sin(alpha - eps)."""
        ratio, angle, before = self.roller_diameter / self.pitch_diameter, 0.0, -1.0
        for _ in range(200):  # a contraction, as long as the ratio is below 1
            if angle == before:
                break
            before, angle = angle, atan(ratio * sin(self.contact_angle - angle))
        return angle

    @property
    def axis_angle(self) -> float:
        """Angle [rad] between a roller's axis and the bearing's."""
        return self.contact_angle - self.half_angle

    @property
    def race_angles(self) -> tuple[float, float]:
        """Half angles [rad] of inner and outer race, at which they touch rollers."""
        return self.axis_angle - self.half_angle, self.contact_angle

    @property
    def apex_distance(self) -> float:
        """Distance [m] of the apex from a roller's middle."""
        return 0.5 * self.pitch_diameter / sin(self.axis_angle)

    @cached_property
    def roller(self) -> Frustum:
        return Frustum(0.5 * self.roller_diameter, self.roller_length, self.half_angle)

    @property
    def sphere_at_centre(self) -> float:
        """Radius [m] of the sphere about a roller's centre of mass that its cone touches."""
        return self.roller.radius(self.roller.centre) * cos(self.half_angle)

    @property
    def clearance(self) -> float:
        """None: another bearing is adjusted against it, and displacements begin at contact."""
        return 0.0

    def in_place(self, changed: Changed) -> TaperedRollerBearing:
        """Cones keep one apex, and touch where the inner ring then stands (``approach``)."""
        return replace(
            self,
            pitch_diameter=self.pitch_diameter + 0.5 * (changed.inner_race + changed.outer_race),
            roller_diameter=self.roller_diameter + changed.element,
        )

    def approach(self, mounted: Bearing, changed: Changed) -> float:
        """Rollers move with the inner ring and its rib; what a roller grows lifts its outer surface
        by that times cos(eps) towards the outer race, which an axial displacement of the inner ring
        meets by its sin(alpha)."""
        races = 0.5 * (changed.inner_race - changed.outer_race) * cos(self.contact_angle)
        return (races + changed.element * cos(self.half_angle)) / sin(self.contact_angle)

    @property
    def curvature_radii(self) -> tuple[float, float]:
        """Effective radii [m] of rollers on inner and outer race at mid-length, across the lines of
        contact: surfaces of cones are curved by cos(half angle)/r."""
        roller = cos(self.half_angle) / (0.5 * self.roller_diameter)
        races = [2.0 * cos(a) / d for a, d in zip(self.race_angles, self.race_diameters)]
        return 1.0 / (roller + races[0]), 1.0 / (roller - races[1])

    @cached_property
    def rib_place(self) -> tuple[float, float]:
        """Where a roller's end bears on the large rib, halfway up that: along its axis towards the
        apex and across it outwards [m], from its middle."""
        y = self.roller.ends[0] - 0.5 * self.rib_height
        return -0.5 * self.roller_length + self.end_radius - sqrt(self.end_radius**2 - y**2), -y

    @property
    def rib_angle(self) -> float:
        """Angle [rad] between the rib's force and the roller's axis: it acts through the centre of
        the end's sphere, on the axis."""
        return atan(-self.rib_place[1] / sqrt(self.end_radius**2 - self.rib_place[1] ** 2))

    @cached_property
    def rib_contact(self) -> PointContact:
        """Hertz contact of a roller's spherical end with the conical face of the rib, which the
        force at ``rib_angle`` meets at right angles."""
        inwards = sin(self.axis_angle - self.rib_angle)  # > 0: the face is hollow
        along, across = self.rib_place
        radius = self.pitch_radius - along * sin(self.axis_angle) + across * cos(self.axis_angle)
        return PointContact(
            rolling=1.0 / (1.0 / self.end_radius - inwards / radius),
            transverse=self.end_radius,
            modulus=self.race_modulus,
        )

    @property
    def small_rib_angle(self) -> float:
        """Angle [rad] between the small rib's force, halfway up that, and the roller's axis: small
        ends count as spheres as flat as the large ones."""
        assert self.small_rib_height is not None
        return asin((self.roller.ends[1] - 0.5 * self.small_rib_height) / self.end_radius)

    @cached_property
    def small_rib_contact(self) -> PointContact:
        """Hertz contact of a roller's small end with the face of the small rib, which is vaulted as
        that of the large one is hollow."""
        lean, end = self.axis_angle + self.small_rib_angle, 0.5 * self.roller_length
        radius = self.race_diameters[0] / 2.0 * (1.0 - end / self.apex_distance)
        return PointContact(
            rolling=1.0 / (1.0 / self.end_radius + sin(lean) / radius),
            transverse=self.end_radius,
            modulus=self.race_modulus,
        )

    @property
    def apex_to_end(self) -> float:
        """Distance [m] of the apex from the middle of a roller's large end: the greatest radius
        that an end may have."""
        return self.apex_distance + 0.5 * self.roller_length

    def race_diameter(self, ring: str, x: float) -> float:
        """Diameter [m] of the "inner" or "outer" race at a distance x [m] along a roller from its
        middle, towards the apex."""
        shrink = 1.0 - x / self.apex_distance
        return self.race_diameters[ring == "outer"] * shrink

    @property
    def ring_widths(self) -> tuple[float, float]:
        return self.inner_width, self.outer_width

    def axial_refusal(self, load: float) -> str:
        if load >= 0.0:
            return ""
        return (
            "a tapered roller bearing carries axial load on its inner ring towards +x alone, into "
            "the outer ring"
        )

    def in_words(self) -> str:
        angle = typeset(self.contact_angle, "deg", digits=4)
        large, small = (2.0 * radius for radius in self.roller.ends)
        return (
            f"{self.name_and_size} with {self.roller_count} rollers from {typeset(large, 'mm')} to "
            f"{typeset(small, 'mm')} in diameter and {typeset(self.roller_length, 'mm')} "
            f"long{self.of_what}, contact angle {angle}."
            f"{spalls_in_words(self)}"
            f"{self.roller_spot.in_words()}"
        )
