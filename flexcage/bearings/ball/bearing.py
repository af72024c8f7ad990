"""What deep groove and angular contact ball bearings have in common.

Grooves are circular arcs. Their centres lie A = r_i + r_e - D apart when a ball just fills the
space between them; the line through both is the contact angle. Curvatures: T. A. Harris, Rolling
Bearing Analysis, 2 and 6; ISO/TS 16281:2008, 4.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from math import acos, cos, inf, pi, sin, sqrt
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from flexcage.bearings.ball.spot import BallSpot
from flexcage.cages.round_pocket.cage import BallCage
from flexcage.core.spec import option, quantity
from flexcage.core.units import typeset
from flexcage.geometry.bearing import (
    Bearing,
    Spec,
    hollow_cylinder_inertia,
)
from flexcage.geometry.film import Film, Oil, both_races, point_film, rolling_entrainment
from flexcage.geometry.hertz import PointContact
from flexcage.geometry.life.iso281 import BALLS, Endurance
from flexcage.geometry.materials import MATERIALS, Material
from flexcage.geometry.other_kinds import SURROUNDINGS
from flexcage.geometry.spall import BY_RACE, Spall, spalls_in_words
from flexcage.geometry.waviness import waviness, waviness_azimuth, waviness_order

if TYPE_CHECKING:
    from flexcage.geometry.fits.changed import Changed

SHOULDER = 0.2  # of the ball's diameter: a shoulder's height where none is given


@dataclass(frozen=True, kw_only=True)
class BallBearing(Bearing):
    """A single-row ball bearing; the types differ in where their grooves stand without load.

    The inner ring is pushed towards +x by an axial load > 0. Shoulder heights are those of the
    loaded shoulders above the grooves' bottoms; without them nothing is said of ellipses at edges.
    """

    cage_spec: ClassVar[Spec] = BallCage
    element: ClassVar[str] = "ball"
    family: ClassVar[str] = "ball"
    places: ClassVar[tuple[str, ...]] = ("race", "pocket")
    sliced: ClassVar[tuple[str, ...]] = ("race",)
    elsewhere: ClassVar[Mapping[str, str]] = {**BY_RACE, **SURROUNDINGS}
    endurance: ClassVar[Endurance | None] = BALLS
    carries_axial_load: ClassVar[bool] = True
    one_sided: ClassVar[bool] = False  # are there shoulders for one direction of load alone?

    bore: float = quantity("mm", doc="bearing bore d", above=0.0)
    outside_diameter: float = quantity("mm", doc="bearing outside diameter D", above=0.0)
    width: float = quantity("mm", doc="bearing width B", above=0.0)
    pitch_diameter: float = quantity(
        "mm", doc="diameter Dpw of the circle of ball centres", above=0.0
    )
    ball_diameter: float = quantity("mm", doc="diameter Dw of a ball", above=0.0)
    ball_count: int = option(doc="number Z of balls", minimum=3)
    inner_groove_radius: float = quantity("mm", doc="radius r_i of the inner groove", above=0.0)
    outer_groove_radius: float = quantity("mm", doc="radius r_e of the outer groove", above=0.0)
    inner_shoulder: float | None = quantity("mm", None, doc="inner shoulder's height", above=0.0)
    outer_shoulder: float | None = quantity("mm", None, doc="outer shoulder's height", above=0.0)
    ball_scatter: float = quantity(
        "um", 0.0, doc="standard deviation of ball diameters", minimum=0.0
    )
    inner_waviness: float = waviness("inner")
    inner_waviness_order: int = waviness_order("inner")
    inner_waviness_azimuth: float = waviness_azimuth("inner")
    outer_waviness: float = waviness("outer")
    outer_waviness_order: int = waviness_order("outer")
    outer_waviness_azimuth: float = waviness_azimuth("outer")
    inner_spall: Spall = option(Spall(), doc="a pit of the inner race, which turns with its ring")
    outer_spall: Spall = option(Spall(), doc="a pit of the outer race")
    ball_spot: BallSpot = option(BallSpot(), doc="a pit or a flat on a ball")
    material: Material = option(MATERIALS["GCr15"], doc="material of the rings, and of the balls")
    element_material: Material | None = option(
        None, doc="material of the balls, as Si3N4 (default: bearing.material)"
    )

    @property
    def free_contact_angle(self) -> float:
        """Contact angle [rad] when the rings are pushed together without load."""
        raise self._lacks("free_contact_angle")

    @property
    def nominal_contact_angle(self) -> float:
        """Contact angle [rad] to which curvatures and ratings refer."""
        raise self._lacks("nominal_contact_angle")

    @property
    def element_count(self) -> int:
        return self.ball_count

    @property
    def element_diameter(self) -> float:
        return self.ball_diameter

    @property
    def element_mass(self) -> float:
        return self.ball_mass

    @property
    def groove_offset(self) -> tuple[float, float]:
        """Inner groove's centre from the outer one's, axially and radially [m], undisplaced."""
        raise self._lacks("groove_offset")

    @property
    def is_thrust(self) -> bool:
        """ISO 281 rates ball bearings above 45 degrees for axial load."""
        return self.nominal_contact_angle > 0.25 * pi + 1e-9

    @property
    def groove_distance(self) -> float:
        """A = r_i + r_e - D [m]."""
        return self.inner_groove_radius + self.outer_groove_radius - self.ball_diameter

    @property
    def inner_conformity(self) -> float:
        """f_i = r_i/D."""
        return self.inner_groove_radius / self.ball_diameter

    @property
    def outer_conformity(self) -> float:
        """f_e = r_e/D."""
        return self.outer_groove_radius / self.ball_diameter

    @property
    def gamma(self) -> float:
        """D cos(alpha)/Dpw at the nominal contact angle."""
        return self.ball_diameter * cos(self.nominal_contact_angle) / self.pitch_diameter

    @cached_property
    def ball_mass(self) -> float:
        return self.rolling_material.density * pi / 6.0 * self.ball_diameter**3

    @cached_property
    def ball_inertia(self) -> float:
        """Moment of inertia of a ball about its centre [kg m^2]."""
        return 0.1 * self.ball_mass * self.ball_diameter**2

    def race_radius(self, ring: str) -> float:
        """Radius [m] about the bearing's axis at which balls roll on the "inner" or "outer" race at
        the nominal contact angle."""
        return 0.5 * self.pitch_diameter * (1.0 + (self.gamma if ring == "outer" else -self.gamma))

    @property
    def race_diameters(self) -> tuple[float, float]:
        return 2.0 * self.race_radius("inner"), 2.0 * self.race_radius("outer")

    def in_place(self, changed: Changed) -> BallBearing:
        """Grooves move with their races, and grow as warm rings do; so do balls."""
        return replace(
            self,
            pitch_diameter=self.pitch_diameter + 0.5 * (changed.inner_race + changed.outer_race),
            ball_diameter=self.ball_diameter + changed.element,
            inner_groove_radius=self.inner_groove_radius * (1.0 + changed.inner_strain),
            outer_groove_radius=self.outer_groove_radius * (1.0 + changed.outer_strain),
            **self._as_clearance(changed.clearance),
        )

    def _as_clearance(self, clearance: float) -> dict[str, Any]:
        """Fields that say a radial clearance [m]."""
        return {"radial_clearance": clearance}

    def race_reach(self, ring: str) -> float:
        """Half of the width [m] of the "inner" or "outer" ring's groove between its shoulders, a
        fifth of the ball's diameter high where no height is given."""
        given, radius = getattr(self, f"{ring}_shoulder"), getattr(self, f"{ring}_groove_radius")
        height = SHOULDER * self.ball_diameter if given is None else given
        return sqrt(max(height * (2.0 * radius - height), 0.0))

    @cached_property
    def shoulder_diameters(self) -> tuple[float, float]:
        """Diameters [m] of inner and outer ring at their shoulders; a fifth of the ball's diameter
        above the grooves' bottoms where heights are not given."""
        share = SHOULDER * self.ball_diameter
        inner, outer = (h or share for h in (self.inner_shoulder, self.outer_shoulder))
        return (
            self.pitch_diameter - self.ball_diameter + 2.0 * inner,
            self.pitch_diameter + self.ball_diameter - 2.0 * outer,
        )

    @cached_property
    def groove_edges(self) -> tuple[float, float]:
        """Angles [rad] from the bottoms of inner and outer groove to the edges of their loaded
        shoulders; infinite where a height is not given."""
        heights = (self.inner_shoulder, self.outer_shoulder)
        radii = (self.inner_groove_radius, self.outer_groove_radius)
        inner, outer = (inf if h is None else acos(1.0 - h / r) for h, r in zip(heights, radii))
        return inner, outer

    @cached_property
    def inner_ring_mass(self) -> float:
        """Inner ring as a hollow cylinder from bore to shoulder, without its groove [kg]."""
        area = 0.25 * pi * (self.shoulder_diameters[0] ** 2 - self.bore**2)
        return self.material.density * area * self.width

    @cached_property
    def inner_ring_inertia(self) -> tuple[float, float]:
        """Axial and transverse moments of inertia of that hollow cylinder [kg m^2]."""
        return hollow_cylinder_inertia(
            self.inner_ring_mass, self.bore, self.shoulder_diameters[0], self.width
        )

    @cached_property
    def outer_ring_mass(self) -> float:
        area = 0.25 * pi * (self.outside_diameter**2 - self.shoulder_diameters[1] ** 2)
        return self.material.density * area * self.width

    @cached_property
    def outer_ring_inertia(self) -> tuple[float, float]:
        """Axial and transverse moments of inertia of a hollow cylinder of that mass [kg m^2]."""
        return hollow_cylinder_inertia(
            self.outer_ring_mass, self.shoulder_diameters[1], self.outside_diameter, self.width
        )

    @cached_property
    def inner_groove_centre(self) -> tuple[float, float]:
        """Place (x, r) [m] of the inner groove's centre in its ring, from where ball centres lie.

        The radius is ISO/TS 16281's R_i.
        """
        axial, radial = self.groove_offset
        share = (self.inner_groove_radius - 0.5 * self.ball_diameter) / self.groove_distance
        return share * axial, 0.5 * self.pitch_diameter + share * radial

    @cached_property
    def outer_groove_centre(self) -> tuple[float, float]:
        """Place (x, r) [m] of the outer groove's centre, likewise."""
        axial, radial = self.groove_offset
        inner = self.inner_groove_centre
        return inner[0] - axial, inner[1] - radial

    @cached_property
    def contacts(self) -> tuple[PointContact, PointContact]:
        """Hertz contact of a ball with inner and outer race."""
        return (
            race_contact(self, self.inner_conformity, -1.0),
            race_contact(self, self.outer_conformity, 1.0),
        )

    @cached_property
    def contact_curvatures(self) -> tuple[float, float]:
        """Curvature [1/m] of the surface of contact across the rolling direction, inner and outer
        race: the mean of the ball's and the groove's (Harris), of two materials nearer to that of
        the stiffer one, as either yields by its share of (1 - nu^2)/E."""
        inner, outer = (
            self._stays * 2.0 / self.ball_diameter + (1.0 - self._stays) * 1.0 / radius
            if self.is_hybrid
            else 0.5 * (2.0 / self.ball_diameter + 1.0 / radius)
            for radius in (self.inner_groove_radius, self.outer_groove_radius)
        )
        return inner, outer

    @property
    def _stays(self) -> float:
        """Share of the ball's own shape that is left in a contact: of what yields, the groove's."""
        ring, ball = self.material.compliance, self.rolling_material.compliance
        return ring / (ring + ball)

    @cached_property
    def rolling_heights(self) -> tuple[float, float]:
        bends, contacts = self.contact_curvatures, self.contacts
        inner, outer = (
            0.1 * bend * float(c.semi_axes(1.0)[0]) ** 2 / (0.5 * self.ball_diameter)
            for bend, c in zip(bends, contacts)
        )
        return inner, outer

    def race_film(self, force: np.ndarray, speed: np.ndarray, oil: Oil) -> Film:
        return both_races([
            point_film(contact, force[..., k], speed[..., k], oil)
            for k, contact in enumerate(self.contacts)
        ])  # fmt: skip

    def rolling_entrainment(
        self, angle: np.ndarray, orbit: np.ndarray, inner_speed: float
    ) -> np.ndarray:
        return rolling_entrainment(
            angle, orbit, inner_speed, diameter=self.ball_diameter, pitch=self.pitch_diameter
        )

    def contact_patch(self, force: float, pressure: float, race: int) -> tuple[float, float]:
        return 2.0 / 3.0 * pressure, float(self.contacts[race].semi_axes(force)[1])

    def beyond_edges(self, force: np.ndarray, angle: np.ndarray) -> np.ndarray:
        across = np.stack(
            [c.semi_axes(force[..., k])[0] for k, c in enumerate(self.contacts)], axis=-1
        )
        radii = np.array([self.inner_groove_radius, self.outer_groove_radius])
        return np.abs(angle) + across / radii - np.array(self.groove_edges)

    def in_words(self) -> str:
        return (
            f"{self.name_and_size} with {self.ball_count} balls of "
            f"{typeset(self.ball_diameter, 'mm')}{self.of_what}, free contact angle "
            f"{typeset(self.free_contact_angle, 'deg', digits=4)}, radial clearance "
            f"{typeset(self.clearance, 'um', digits=4)}; "
            f"the grooves' radii are {self.inner_conformity:.4g} (inner) and "
            f"{self.outer_conformity:.4g} (outer) times the ball's diameter."
            f"{spalls_in_words(self)}"
            f"{self.ball_spot.in_words()}"
        )


def race_contact(bearing: BallBearing, conformity: float, side: float) -> PointContact:
    """Contact of a ball with a race: the inner at ``side`` -1, the outer at +1."""
    radius = 0.5 * bearing.ball_diameter
    return PointContact(
        rolling=radius * (1.0 + side * bearing.gamma),
        transverse=2.0 * radius * conformity / (2.0 * conformity - 1.0),
        modulus=bearing.race_modulus,
    )


def clearance_at(angle: float, distance: float) -> float:
    """Radial clearance [m] that goes with a free contact angle [rad]: 2 A (1 - cos(alpha))."""
    return 4.0 * distance * sin(0.5 * angle) ** 2
