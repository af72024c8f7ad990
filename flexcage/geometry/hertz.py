"""Elliptical Hertz contact from complete elliptic integrals, without fitted approximations.

H. Hertz (1881); notation of K. L. Johnson, Contact Mechanics (1985), 4.2, and B. J. Hamrock,
Fundamentals of Fluid Film Lubrication, for kappa, E and F. ``m`` is scipy's parameter, the square
of the modulus.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import degrees, exp, expm1, log, pi, sqrt

import numpy as np

_LONGEST = 40.0  # log of the axis ratio up to which an ellipse is sought


@dataclass(frozen=True)
class PointContact:
    """Two bodies that touch in a point: effective radii across two directions, and modulus.

    ``rolling`` and ``transverse`` [m] are 1/(1/r_1 + 1/r_2) in either plane, ``modulus`` [Pa] is
    2/((1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2).
    """

    rolling: float
    transverse: float
    modulus: float

    @cached_property
    def radius(self) -> float:
        """1/(sum of curvatures) [m]."""
        return 1.0 / (1.0 / self.rolling + 1.0 / self.transverse)

    @cached_property
    def ratio(self) -> float:
        """Axis ratio kappa >= 1 of the ellipse."""
        return axis_ratio(max(self.rolling, self.transverse) / min(self.rolling, self.transverse))

    @cached_property
    def integrals(self) -> tuple[float, float]:
        """Complete elliptic integrals E and F of the second and the first kind."""
        from scipy.special import ellipe, ellipk  # late: every case loads this module

        m = -expm1(-2.0 * log(self.ratio))
        return float(ellipe(m)), float(ellipk(m))

    @cached_property
    def stiffness(self) -> float:
        """K of Q = K delta^(3/2) [N/m^(3/2)]: pi kappa E' sqrt(2 E R/(9 F^3))."""
        second, first = self.integrals
        return pi * self.ratio * self.modulus * sqrt(2.0 * second * self.radius / (9.0 * first**3))

    def semi_axes(self, load: np.ndarray | float) -> tuple[np.ndarray, np.ndarray]:
        """Semi-axes [m] of the ellipse under loads [N]: transverse, and in rolling direction."""
        second, _ = self.integrals
        cube = 6.0 * self.ratio**2 * second * self.radius * np.asarray(load, float)
        long = np.cbrt(cube / (pi * self.modulus))
        short = long / self.ratio
        return (long, short) if self.transverse >= self.rolling else (short, long)

    def pressure(self, load: np.ndarray | float) -> np.ndarray:
        """Largest pressure [Pa] under loads [N]: 3 Q/(2 pi a b)."""
        a, b = self.semi_axes(load)
        loaded = a * b > 0.0
        return np.where(loaded, 1.5 * np.asarray(load) / (pi * np.where(loaded, a * b, 1.0)), 0.0)


def axis_ratio(radii: float) -> float:
    """Axis ratio of the contact ellipse of two bodies whose effective radii have a ratio >= 1.

    radii = B(m)/((1 - m) D(m)) with m = 1 - kappa^-2, D = (F - E)/m and B = F - D, by Carlson's
    integrals so that nothing cancels near the circle (Johnson 4.28 in other words).
    """
    from scipy.optimize import brentq
    from scipy.special import ellipk, elliprd

    wanted = log(radii)
    if wanted < 1e-12:
        return 1.0

    def excess(t: float) -> float:
        rest = exp(-2.0 * t)  # 1 - m
        d = float(elliprd(0.0, rest, 1.0)) / 3.0
        b = float(ellipk(-expm1(-2.0 * t))) - d
        return log(b / (rest * d)) - wanted

    return exp(brentq(excess, 0.0, _LONGEST, xtol=1e-15, rtol=1e-14))


def series_stiffness(one: float, other: float) -> float:
    """Stiffness K of two contacts with exponent 3/2 that bear one load in turn [N/m^(3/2)]."""
    return float((one ** (-2.0 / 3.0) + other ** (-2.0 / 3.0)) ** -1.5)


def load_at_pressure(contact: PointContact, pressure: float) -> float:
    """Load [N] whose largest pressure [Pa] is the given one; the load grows with its cube."""
    return float((pressure / contact.pressure(1.0)) ** 3)


def over_edge(
    element: str, race: str, beyond: float, *, force: float, angle: float, when: str = ""
) -> str:
    """What to say of an ellipse that runs ``beyond`` [rad] over a groove's edge, under ``force``
    [N] at a contact ``angle`` [rad]."""
    return (
        f"the contact ellipse of {element} runs over the {race} groove's edge by "
        f"{degrees(beyond):.2g} deg{when}, under {force:.4g} N at a contact angle of "
        f"{degrees(angle):.4g} deg; its edge pressure is not computed."
    )
