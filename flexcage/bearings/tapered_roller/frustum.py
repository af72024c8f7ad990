"""A truncated cone: radii, volume, centre of mass and inertia."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, tan


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
