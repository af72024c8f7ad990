"""What roller bearings of all kinds share: profiles, slices, and formulas of ISO 281 and ISO/TS
16281.

In N and mm where the standards are. The standards themselves are not public: formulas and
constants are those that public implementations of them agree on (Dessia's mechanical_components
among them); ISO/TR 1281-1 explains ISO 281.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, inf, pi
from typing import TYPE_CHECKING

import numpy as np

from flexcage.core.spec import option, quantity

LINE_EXPONENT = 10.0 / 9.0
_MOST_PRESSED = 0.01  # of a roller's diameter, a hundred times what C0 leaves for good (ISO 76)
STATIC_PRESSURE = 4.0e9  # Pa, ISO 76, rollers
B_M = 1.1  # ISO 281: today's steel and manufacture, cylindrical and tapered roller bearings
LIFE_EXPONENT = 10.0 / 3.0
# The formula's constant is printed as 0.377 * 551.13373 = 207.78, factors of three digits. All
# 20 entries of ISO 281's table of f_c come out to their last digit for 207.891 to 207.915 alone.
_B_RADIAL = 207.9
LAMBDA_NU = 0.83  # stress concentration at edges and spread of quality, radial roller bearings
# ISO/TS 16281:2008: ratings of one roller
_INNER, _OUTER, _SPREAD = 0.378, 0.364, 1.038


@dataclass(frozen=True, kw_only=True)
class RollerProfile:
    """Profile of the roller's generatrix: the radial drop P(x) at axial distance x from its centre.

    ``logarithmic``: ISO/TS 16281, P = 0.00035 Dw ln(1/(1-(2x/Lwe)^2)) for Lwe <= 2.5 Dw and its
    long-roller form otherwise; ``crowned``: a circular arc of ``crown_radius``; ``straight``: 0.
    """

    kind: str = option("logarithmic", choices=("logarithmic", "crowned", "straight"))
    crown_radius: float = quantity(
        "m", 10.0, doc="radius of a crowned profile", above=0.0, when={"kind": ("crowned",)}
    )

    def drop(self, x: np.ndarray, *, diameter: float, length: float) -> np.ndarray:
        """Radial drop [m] at |x| < length/2; infinite at the very end of a logarithmic profile."""
        x = np.abs(np.asarray(x, float))
        if self.kind == "straight":
            return np.zeros_like(x)
        if self.kind == "crowned":
            return x**2 / (2.0 * self.crown_radius)
        if length <= 2.5 * diameter:
            return -0.00035 * diameter * np.log(1.0 - (2.0 * x / length) ** 2)
        over = np.maximum(2.0 * x - (length - 2.5 * diameter), 0.0) / (2.5 * diameter)
        return -0.0005 * diameter * np.log(1.0 - over**2)

    def slices(
        self, count: int, *, diameter: float, length: float
    ) -> tuple[np.ndarray, np.ndarray]:
        """Slices' centres (n,) along the roller, and the drop there (n,) [m]."""
        width = length / count
        places = (np.arange(count) + 0.5) * width - 0.5 * length
        return places, self.drop(places, diameter=diameter, length=length)


class OfRollers:
    """What follows of a ``Bearing`` from its keys of rollers alone, whatever their shape."""

    if TYPE_CHECKING:

        @property
        def roller_count(self) -> int: ...
        @property
        def roller_diameter(self) -> float: ...
        @property
        def roller_length(self) -> float: ...
        @property
        def effective_length(self) -> float: ...

    @property
    def element_count(self) -> int:
        return self.roller_count

    @property
    def element_diameter(self) -> float:
        return self.roller_diameter

    @property
    def element_length(self) -> float:
        return self.roller_length

    @property
    def element_edge(self) -> float:
        return 0.5 * (self.roller_length - self.effective_length)

    @property
    def greatest_tilt(self) -> float:
        return 2.0 * _MOST_PRESSED * self.roller_diameter / self.effective_length

    def contact_patch(self, force: float, pressure: float, race: int) -> tuple[float, float]:
        return 0.25 * pi * pressure, 2.0 * force / (pi * pressure * self.effective_length)


def geometry_factor(gamma: float) -> float:
    """f_c of radial roller bearings [N and mm] at gamma = Dwe cos(alpha)/Dpw.

    f_c = 207.9 lambda nu gamma^(2/9) (1-gamma)^(29/27)/(1+gamma)^(1/4)
    {1 + [1.04 ((1-gamma)/(1+gamma))^(143/108)]^(9/2)}^(-2/9), which is the formula behind ISO
    281's table and agrees with it to its last digit for gamma from 0.01 to 0.3.
    """
    share = 1.04 * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)
    rings = (1.0 + share**4.5) ** (-2.0 / 9.0)
    shape = gamma ** (2.0 / 9.0) * (1.0 - gamma) ** (29.0 / 27.0) / (1.0 + gamma) ** 0.25
    return _B_RADIAL * LAMBDA_NU * shape * rings


def edge_stress(slices: int) -> np.ndarray:
    """Stress riser (n,) of ISO/TS 16281 on the slices of a line contact, largest at its ends."""
    k = np.arange(1, slices + 1)
    place = np.abs(2.0 * k - slices - 1.0) / (2.0 * slices - 2.0)
    middle = place == 0.0
    return 1.0 - np.where(middle, 0.0, 0.01 / np.log(1.985 * np.where(middle, 0.25, place)))


def roller_ratings(
    rating: float, count: int, gamma: float, angle: float = 0.0
) -> tuple[float, float]:
    """Loads [N] of one roller that inner and outer race bear for 10^6 revolutions (ISO/TS 16281),
    of a radial bearing with a dynamic ``rating`` [N] and a contact angle [rad]."""
    share = (_SPREAD * ((1.0 - gamma) / (1.0 + gamma)) ** (143.0 / 108.0)) ** 4.5
    one = rating / (LAMBDA_NU * count * cos(angle))
    return (
        one / _INNER * (1.0 + share) ** (2.0 / 9.0),
        one / _OUTER * (1.0 + 1.0 / share) ** (2.0 / 9.0),
    )


def reference_life(inner: np.ndarray, outer: np.ndarray, ratings: tuple[float, float]) -> float:
    """Basic reference rating life L10r of ISO/TS 16281 [10^6 revolutions] under forces (Z, n) of
    slices on both races [N]; ``ratings`` of one roller (``roller_ratings``)."""
    if not max(inner.max(), outer.max()) > 0.0:
        return inf
    n = inner.shape[1]
    edges = edge_stress(n)
    of_slice = [q * n ** (-7.0 / 9.0) for q in ratings]
    on_inner = np.mean((edges * inner) ** 4.0, axis=0) ** 0.25  # it turns under the load
    on_outer = np.mean((edges * outer) ** 4.5, axis=0) ** (1.0 / 4.5)  # it stands
    worn = (on_inner / of_slice[0]) ** 4.5 + (on_outer / of_slice[1]) ** 4.5
    return float(worn.sum() ** (-8.0 / 9.0))


def line_pressure(
    line: np.ndarray, radius: np.ndarray, modulus: float
) -> tuple[np.ndarray, np.ndarray]:
    """Largest pressure [Pa] and half of the width [m] of line contacts under loads per length
    [N/m]; ``radius`` of curvature [m], ``modulus`` as ``Bearing.race_modulus`` (Johnson 4.43 and
    4.45)."""
    modulus = 0.5 * modulus
    width = np.sqrt(4.0 * line * radius / (pi * modulus))
    return np.sqrt(line * modulus / (pi * radius)), width
