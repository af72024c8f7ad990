"""A barrel: a roller whose profile is an arc of a circle, widest in its middle."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi

import numpy as np

_POINTS = 16  # of Gauss and Legendre: integrals of a barrel are then exact to rounding


@dataclass(frozen=True)
class Barrel:
    """A roller of a largest ``diameter``, ``length`` and ``profile`` radius [m]."""

    diameter: float
    length: float
    profile: float
    centre = 0.0  # of mass, from mid-length

    def radius(self, x: np.ndarray) -> np.ndarray:
        """Radius [m] at distances x [m] along the axis from mid-length."""
        sagitta = self.profile - np.sqrt(self.profile**2 - np.asarray(x, float) ** 2)
        found: np.ndarray = 0.5 * self.diameter - sagitta
        return found

    def spheres(self, x: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Spheres about the axis that touch the surface at distances x (n,) [m] from mid-length:
        places (n,) of their centres on it, and radii (n,) [m]. The surface's normal goes through
        the centre of the profile's arc, beyond the axis."""
        beyond = self.profile - 0.5 * self.diameter
        share = beyond / np.sqrt(self.profile**2 - np.asarray(x, float) ** 2)
        return x * share, self.profile * (1.0 - share)

    @property
    def end_radius(self) -> float:
        """Radius [m] of the ends."""
        return float(self.radius(np.array(0.5 * self.length)))

    @property
    def volume(self) -> float:
        x, weight = self._points()
        return float(weight @ (pi * self.radius(x) ** 2))

    def inertia(self, density: float) -> tuple[float, float]:
        """Axial and transverse moments of inertia [kg m^2], the integrals of pi r^4/2 and of
        pi (r^4/4 + r^2 x^2) along it."""
        x, weight = self._points()
        square = self.radius(x) ** 2
        axial = density * weight @ (0.5 * pi * square**2)
        return float(axial), float(0.5 * axial + density * weight @ (pi * square * x**2))

    def _points(self) -> tuple[np.ndarray, np.ndarray]:
        x, weight = np.polynomial.legendre.leggauss(_POINTS)
        return 0.5 * self.length * x, 0.5 * self.length * weight
