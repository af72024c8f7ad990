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

from dataclasses import dataclass
from functools import singledispatch
from math import exp, pi

import numpy as np

from flexcage.geometry.ball_bearing import BallBearing
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cylindrical_roller import RollerBearing
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


@singledispatch
def race_film(bearing: Bearing, force: np.ndarray, speed: np.ndarray, oil: Oil) -> Film:
    """Film at inner and outer race under forces (..., 2) [N] of elements at entrainment speeds
    (..., 2) [m/s]; NaN for types not registered."""
    unknown = np.full(np.shape(force), np.nan)
    return Film(unknown, unknown)


@race_film.register
def _(bearing: BallBearing, force: np.ndarray, speed: np.ndarray, oil: Oil) -> Film:
    films = [
        point_film(contact, force[..., k], speed[..., k], oil)
        for k, contact in enumerate(bearing.contacts)
    ]
    return _both(films)


@race_film.register
def _(bearing: RollerBearing, force: np.ndarray, speed: np.ndarray, oil: Oil) -> Film:
    """The load spread evenly over the effective length: a profile's ends are not resolved."""
    roller, modulus = 0.5 * bearing.roller_diameter, bearing.material.plane_strain_modulus
    films = []
    for k, (race, side) in enumerate(
        ((bearing.inner_race_radius, 1.0), (bearing.outer_race_radius, -1.0))
    ):
        radius = roller * race / (race + side * roller)
        load = force[..., k] / bearing.effective_length
        films.append(line_film(radius, modulus, load, speed[..., k], oil))
    return _both(films)


def _both(films: list[Film]) -> Film:
    central, least = (
        np.stack([getattr(film, name) for film in films], axis=-1) for name in ("central", "least")
    )
    return Film(central, least)


@singledispatch
def rolling_entrainment(
    bearing: Bearing, angle: np.ndarray, orbit: np.ndarray, inner_speed: float
) -> np.ndarray:
    """Entrainment speeds (Z, 2) [m/s] of elements that roll without slip at contact angles (Z, 2)
    [rad] and orbit at speeds (Z,) [rad/s]; the outer ring stands. NaN for types not registered."""
    return np.full(angle.shape, np.nan)


@rolling_entrainment.register(BallBearing)
@rolling_entrainment.register(RollerBearing)
def _(bearing: Bearing, angle: np.ndarray, orbit: np.ndarray, inner_speed: float) -> np.ndarray:
    reach = 0.5 * bearing.element_diameter * np.cos(angle)
    middle = 0.5 * bearing.pitch_diameter
    inner = (inner_speed - orbit) * (middle - reach[:, 0])
    return np.abs(np.stack([inner, orbit * (middle + reach[:, 1])], axis=1))


@singledispatch
def patch(bearing: Bearing, force: float, pressure: float, race: int) -> tuple[float, float]:
    """Mean pressure [Pa] of a contact under a force [N] and a largest pressure [Pa], and the half
    of its length [m] in the rolling direction; ``race`` 0 is the inner."""
    raise NotImplementedError(f"{type(bearing).__name__} has no contact patches")


@patch.register
def _(bearing: BallBearing, force: float, pressure: float, race: int) -> tuple[float, float]:
    return 2.0 / 3.0 * pressure, float(bearing.contacts[race].semi_axes(force)[1])


@patch.register
def _(bearing: RollerBearing, force: float, pressure: float, race: int) -> tuple[float, float]:
    return 0.25 * pi * pressure, 2.0 * force / (pi * pressure * bearing.effective_length)


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
