"""Thickness of the lubricant's film between rolling elements and races: isothermal, fully flooded.

With the numbers U = eta u/(E' R), G = alpha E' and W, of the viscosity eta at ambient pressure, the
pressure-viscosity coefficient alpha, the entrainment speed u (mean of both surfaces' speeds past
their contact), the effective radius R in the rolling direction and E' of ``geometry.hertz``:

- point contacts of axis ratio k, W = Q/(E' R^2) (B. J. Hamrock and D. Dowson, Isothermal
  elastohydrodynamic lubrication of point contacts, part III, J. Lubr. Technol. 99 (1977) 264):
  centre 2.69 U^0.67 G^0.53 W^-0.067 (1 - 0.61 exp(-0.73 k)),
  least 3.63 U^0.68 G^0.49 W^-0.073 (1 - exp(-0.68 k)), both over R;
- line contacts of length L, W = Q/(E' R L): centre 3.06 U^0.69 G^0.56 W^-0.10 (D. Dowson and
  A. Toyoda, Leeds-Lyon Symposium 1978), least 2.65 U^0.70 G^0.54 W^-0.13 (D. Dowson, Proc. Inst.
  Mech. Eng. 182 (1968) 151).

Starvation, heat from shear in the inlet, and roughness, all of which thin a film, are left out.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import exp

import numpy as np

from flexcage.geometry.hertz import PointContact


@dataclass(frozen=True)
class Oil:
    """What of a lubricant makes films."""

    viscosity: float  # Pa s, at ambient pressure
    pressure_coefficient: float  # 1/Pa


@dataclass(frozen=True)
class Film:
    """Film thickness [m] in the middle of contacts and where it is least; NaN without contact."""

    central: np.ndarray
    least: np.ndarray


def point_film(contact: PointContact, load: np.ndarray, speed: np.ndarray, oil: Oil) -> Film:
    """Film of point contacts under loads [N] at entrainment speeds [m/s], of one shape."""
    R, modulus, k = contact.rolling, contact.modulus, contact.ratio
    U, G, W = _numbers(R, modulus, load / R, speed, oil)
    central = 2.69 * U**0.67 * G**0.53 * W**-0.067 * (1.0 - 0.61 * np.exp(-0.73 * k))
    least = 3.63 * U**0.68 * G**0.49 * W**-0.073 * (1.0 - np.exp(-0.68 * k))
    return Film(R * central, R * least)


def line_film(
    radius: float, modulus: float, line_load: np.ndarray, speed: np.ndarray, oil: Oil
) -> Film:
    """Film of line contacts of effective radius [m] under loads per length [N/m], likewise."""
    U, G, W = _numbers(radius, modulus, line_load, speed, oil)
    central = 3.06 * U**0.69 * G**0.56 * W**-0.10
    least = 2.65 * U**0.70 * G**0.54 * W**-0.13
    return Film(radius * central, radius * least)


def _numbers(
    radius: float, modulus: float, line_load: np.ndarray, speed: np.ndarray, oil: Oil
) -> tuple[np.ndarray, float, np.ndarray]:
    """U, G and W; W is NaN where nothing bears."""
    line_load = np.asarray(line_load, float)
    U = oil.viscosity * np.abs(np.asarray(speed, float)) / (modulus * radius)
    W = np.where(line_load > 0.0, line_load, np.nan) / (modulus * radius)
    return U, oil.pressure_coefficient * modulus, W


def both_races(films: Sequence[Film]) -> Film:
    """Films (..., 2) of inner and outer race from those of either."""
    central, least = (
        np.stack([getattr(film, name) for film in films], axis=-1) for name in ("central", "least")
    )
    return Film(central, least)


def rolling_entrainment(
    angle: np.ndarray, orbit: np.ndarray, inner_speed: float, *, diameter: float, pitch: float
) -> np.ndarray:
    """Entrainment speeds (Z, 2) [m/s] of elements of a ``diameter`` [m] that roll without slip at
    contact angles (Z, 2) [rad] and orbit at speeds (Z,) [rad/s] on a ``pitch`` diameter [m]; the
    outer ring stands."""
    reach = 0.5 * diameter * np.cos(angle)
    middle = 0.5 * pitch
    inner = (inner_speed - orbit) * (middle - reach[:, 0])
    return np.abs(np.stack([inner, orbit * (middle + reach[:, 1])], axis=1))


def creep_speed(
    *, limit: float, pressure: float, film: float, half_length: float, speed: float, oil: Oil,
    shear_modulus: float,
) -> float:  # fmt: skip
    """Sliding speed [m/s] at which the slope of a film's traction at rest reaches ``limit`` times
    the mean pressure [Pa].

    A film of thickness ``film`` [m] shears by u/h: viscously, by Barus' viscosity at the mean
    pressure, and elastically by ``shear_modulus`` [Pa] during the time b/U that its oil has been in
    the contact on average. Both compliances add (K. L. Johnson and J. L. Tevaarwerk, Proc. R. Soc.
    A 356 (1977) 215).
    """
    viscous = 1.0 / (oil.viscosity * exp(oil.pressure_coefficient * pressure))
    elastic = speed / (shear_modulus * half_length)
    return limit * pressure * film * (viscous + elastic)
