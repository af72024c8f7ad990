"""What bearings share whose rollers lean: their axes are at an angle to the bearing's, towards it
at +x (tapered rollers), or at the side where their row is (barrels)."""

from __future__ import annotations

from functools import cached_property
from math import cos, pi
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from flexcage.geometry.bearing import Bearing, hollow_cylinder_inertia
from flexcage.geometry.film import Film, Oil, both_races, line_film, rolling_entrainment
from flexcage.geometry.rollers import OfRollers


class Roller(Protocol):
    """A roller as a body of revolution."""

    @property
    def volume(self) -> float: ...
    @property
    def centre(self) -> float:
        """Centre of mass [m] from mid-length, along the axis that leans towards the bearing's."""

    def inertia(self, density: float) -> tuple[float, float]:
        """Axial and transverse moments of inertia [kg m^2] about its centre of mass."""


if TYPE_CHECKING:  # a part of specs, not one itself

    class _OfRollers(OfRollers, Bearing): ...
else:
    _OfRollers = OfRollers


class OfInclinedRollers(_OfRollers):
    """What follows from the keys of such a bearing, and from its rollers' angle and shape."""

    if TYPE_CHECKING:
        contact_angle: float

        @property
        def axis_angle(self) -> float:
            """Angle [rad] between a roller's axis and the bearing's."""

        @property
        def roller(self) -> Roller: ...
        @property
        def curvature_radii(self) -> tuple[float, float]:
            """Effective radii [m] of rollers on both races, across the lines of contact."""

        @property
        def ring_widths(self) -> tuple[float, float]:
            """Of inner and outer ring [m]."""

    @property
    def pitch_radius(self) -> float:
        return 0.5 * self.pitch_diameter

    @property
    def nominal_contact_angle(self) -> float:
        """Of kinematics: Dwe is measured across the roller's axis."""
        return self.axis_angle

    def rolling_angles(self, angles: tuple[float, float]) -> tuple[float, float]:
        return self.axis_angle, self.axis_angle

    @property
    def gamma(self) -> float:
        """Dwe cos(alpha)/Dpw of the ratings."""
        return self.roller_diameter * cos(self.contact_angle) / self.pitch_diameter

    @property
    def race_diameters(self) -> tuple[float, float]:
        """Of the races [m] where the middles of rollers touch them."""
        reach = self.roller_diameter * cos(self.axis_angle)
        return self.pitch_diameter - reach, self.pitch_diameter + reach

    @property
    def element_mass(self) -> float:
        """Of a roller with flat ends [kg]."""
        return self.rolling_material.density * self.roller.volume

    @cached_property
    def roller_inertia(self) -> tuple[float, float]:
        """Axial and transverse moments of inertia [kg m^2] about its centre of mass."""
        return self.roller.inertia(self.rolling_material.density)

    @cached_property
    def inner_ring_mass(self) -> float:
        """Inner ring as a hollow cylinder from bore to mean race diameter, without ribs [kg]."""
        area = 0.25 * pi * (self.race_diameters[0] ** 2 - self.bore**2)
        return self.material.density * area * self.ring_widths[0]

    @cached_property
    def inner_ring_inertia(self) -> tuple[float, float]:
        """Axial and transverse moments of inertia of that hollow cylinder [kg m^2]."""
        return hollow_cylinder_inertia(
            self.inner_ring_mass, self.bore, self.race_diameters[0], self.ring_widths[0]
        )

    @cached_property
    def outer_ring_mass(self) -> float:
        area = 0.25 * pi * (self.outside_diameter**2 - self.race_diameters[1] ** 2)
        return self.material.density * area * self.ring_widths[1]

    @cached_property
    def outer_ring_inertia(self) -> tuple[float, float]:
        """Axial and transverse moments of inertia of a hollow cylinder of that mass [kg m^2]."""
        return hollow_cylinder_inertia(
            self.outer_ring_mass, self.race_diameters[1], self.outside_diameter, self.ring_widths[1]
        )

    def race_film(self, force: np.ndarray, speed: np.ndarray, oil: Oil) -> Film:
        """The load spread evenly over the effective length: a profile's ends are not resolved."""
        line = force / self.effective_length
        return both_races([
            line_film(radius, self.race_modulus, line[..., k], speed[..., k], oil)
            for k, radius in enumerate(self.curvature_radii)
        ])  # fmt: skip

    def rolling_entrainment(
        self, angle: np.ndarray, orbit: np.ndarray, inner_speed: float
    ) -> np.ndarray:
        rolling: Any = np.where(np.isnan(angle), np.nan, self.axis_angle)
        return rolling_entrainment(
            rolling, orbit, inner_speed, diameter=self.roller_diameter, pitch=self.pitch_diameter
        )
