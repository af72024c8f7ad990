"""What an elastic half-space yields under the patches of load by which rings are pressed.

A ring's finite elements yield under an element's contact as a half-space does, and as a ring does.
The contact law counts the former already, so it is taken away from them: what remains hardly
depends on the patch. All displacements are averages with the weights of the load, so that loads
and displacements do the work of the patch. K. L. Johnson, Contact Mechanics (1985), 3.2 and 3.6.
"""

from __future__ import annotations

from math import pi, sqrt

import numpy as np

from flexcage.geometry.materials import Material

_ANGLES = 4096  # of the plane of wave numbers: exact to rounding for ellipses of 100 to 1


def spot_compliance(across: float, along: float, material: Material) -> tuple[float, float]:
    """Compliance [m/N] of a half-space under Gaussian loads with standard deviations [m] across
    and along the rolling direction: pressure, and shear in the direction across.

    A load exp(i k x) yields (1 - nu)/(G k) along the normal and (1 - nu c^2)/(G k) along itself,
    where c is the cosine between both: the integrals of Johnson's 3.19 and 3.76 over the plane.
    """
    angle = 2.0 * pi * (np.arange(_ANGLES) + 0.5) / _ANGLES
    shear_modulus = material.youngs_modulus / (2.0 * (1.0 + material.poisson_ratio))
    # integral of exp(-k^2 s^2) over k from 0 on, s^2 = (across cos)^2 + (along sin)^2
    radial = 0.5 * sqrt(pi) / np.hypot(across * np.cos(angle), along * np.sin(angle))
    nu = material.poisson_ratio
    scale = 1.0 / (2.0 * pi * shear_modulus)
    normal = scale * float(np.mean((1.0 - nu) * radial))
    shear = scale * float(np.mean((1.0 - nu * np.cos(angle) ** 2) * radial))
    return normal, shear


def line_compliance(half_length: float, along: float, material: Material) -> tuple[float, float]:
    """Compliance of a half-space under a line of load, Gaussian with a standard deviation [m] along
    the rolling direction and, over its length, even [m/N] or linear [rad/(N m)].

    Boussinesq's (1 - nu^2)/(pi E d) over the distance d of two points of the patch (Johnson 3.22);
    its mean over the rolling direction is exp(z) K_0(z)/(2 sqrt(pi) s), z = x^2/(8 s^2).
    """
    from scipy.integrate import quad
    from scipy.special import k0e

    length = 2.0 * half_length

    def kernel(x: float) -> float:
        return float(k0e(x**2 / (8.0 * along**2))) / (2.0 * sqrt(pi) * along)

    def moments(x: float) -> float:  # of pairs of points at a distance x
        low, high = -half_length, half_length - x
        return (high**3 - low**3) / 3.0 + 0.5 * x * (high**2 - low**2)

    middle = min(along, half_length)
    even = quad(lambda x: (length - x) * kernel(x), 0.0, length, points=[middle])[0]
    linear = quad(lambda x: moments(x) * kernel(x), 0.0, length, points=[middle])[0]
    scale = 2.0 / (pi * material.plane_strain_modulus)
    return scale * even / length**2, scale * linear * 144.0 / length**6
