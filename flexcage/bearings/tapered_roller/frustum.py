"""A truncated cone: radii, volume, centre of mass and inertia."""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, pi, tan
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

    from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing


@dataclass(frozen=True)
class Frustum:
    """A roller as a truncated cone: ``mean`` radius at mid-length, ``length``, half angle."""

    mean: float
    length: float
    half_angle: float

    def radius(self, x: float) -> float:
        """Radius [m] at a distance x [m] from mid-length, towards the apex."""
        return self.mean - x * tan(self.half_angle)

    @property
    def ends(self) -> tuple[float, float]:
        """Radii [m] of the large and the small end."""
        return self.radius(-0.5 * self.length), self.radius(0.5 * self.length)

    @property
    def volume(self) -> float:
        large, small = self.ends
        return pi / 3.0 * self.length * (large**2 + large * small + small**2)

    @property
    def centre(self) -> float:
        """Centre of mass [m] from mid-length, towards the apex: negative."""
        slope = tan(self.half_angle)
        return -2.0 * pi * self.mean * slope * self.length**3 / 12.0 / self.volume

    def inertia(self, density: float) -> tuple[float, float]:
        """Axial and transverse moments of inertia [kg m^2] about its centre of mass, the integrals
        of pi r^4/2 and of pi (r^4/4 + r^2 x^2) along it."""
        m, k, h = self.mean, tan(self.half_angle), 0.5 * self.length
        # r = m - k x: moments of even powers of x over -h to h
        fourth = 2.0 * (m**4 * h + 2.0 * m**2 * k**2 * h**3 + k**4 * h**5 / 5.0)
        second = 2.0 * (m**2 * h**3 / 3.0 + k**2 * h**5 / 5.0)
        axial = density * 0.5 * pi * fourth
        about_middle = density * pi * (0.25 * fourth + second)
        return axial, about_middle - density * self.volume * self.centre**2


def spheres(b: TaperedRollerBearing, slices: int) -> tuple[np.ndarray, np.ndarray]:
    """Spheres of which the surface of a bearing's roller is the envelope: places (n,) of their
    centres on its axis from its centre of mass, and radii (n,) less the profile's drop [m]. They
    touch the surface in the middles of slices of the static solution."""
    x, drop = b.profile.slices(slices, diameter=b.roller_diameter, length=b.effective_length)
    radius = 0.5 * b.roller_diameter - x * tan(b.half_angle)
    place = x - radius * tan(b.half_angle) - b.roller.centre
    return place, radius / cos(b.half_angle) - drop
