"""Long cylinders under pressure and in rotation, in plane stress: what their diameters grow.

S. P. Timoshenko and J. N. Goodier, Theory of Elasticity, "Stress distribution symmetrical about an
axis" (Lame) and "Rotating disks"; DIN 7190-1 and T. A. Harris, Rolling Bearing Analysis, chapter 3,
have the same equations.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import inf

from flexcage.geometry.materials import Material


@dataclass(frozen=True)
class Cylinder:
    """A cylinder between two diameters [m]: ``inner`` 0 is solid, ``outer`` may be infinite."""

    inner: float
    outer: float
    material: Material

    def pressed(self, at: float, *, inside: float = 0.0, outside: float = 0.0) -> float:
        """Growth [m] of the diameter ``at`` under pressures [Pa] inside and outside."""
        nu, modulus = self.material.poisson_ratio, self.material.youngs_modulus
        share = 0.0 if self.outer == inf else (self.inner / self.outer) ** 2
        even = (1.0 - nu) * (inside * share - outside) * at
        bore = (1.0 + nu) * (inside - outside) * self.inner**2 / at
        return (even + bore) / (modulus * (1.0 - share))

    def spun(self, at: float, speed: float) -> float:
        """Growth [m] of the diameter ``at`` at a speed [rad/s], of a cylinder without pressure."""
        nu, a2, b2, r2 = self.material.poisson_ratio, self.inner**2, self.outer**2, at**2
        shape = (3.0 + nu) * ((1.0 - nu) * (a2 + b2) + (1.0 + nu) * a2 * b2 / r2)
        shape -= (1.0 - nu**2) * r2
        return self.material.density * speed**2 * at * shape / (32.0 * self.material.youngs_modulus)


@dataclass(frozen=True)
class Press:
    """A cylinder inside another, at their common diameter [m]."""

    inside: Cylinder
    outside: Cylinder
    diameter: float

    def pressure(self, interference: float) -> float:
        """Pressure [Pa] between both for an interference [m] of their diameters, before they are
        joined; 0 where there is a gap."""
        d = self.diameter
        yields = self.outside.pressed(d, inside=1.0) - self.inside.pressed(d, outside=1.0)
        return max(interference, 0.0) / yields
