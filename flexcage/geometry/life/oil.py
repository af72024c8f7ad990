"""Viscosity of an oil over temperature, and what a starved inlet leaves of its film."""

from __future__ import annotations

from math import log10

from flexcage.core.errors import InputError

_WARM = (313.15, 373.15)  # K, at which oils are specified
_EXPONENTS = (3.06, 0.58, 0.29)


def viscosity_at(temperature: float, at_40: float, at_100: float) -> float:
    """Kinematic viscosity [m^2/s] at a temperature [K] from those at 40 and 100 degC: ASTM D341,
    log10 log10(nu + 0.7) is linear in log10 T, nu in mm^2/s.

    Raises InputError where the oil does not thin with warmth.
    """
    if not at_40 > at_100:
        raise InputError(
            f"life.viscosity_100 is {1e6 * at_100:g} mm^2/s, but oils thin with warmth: give less "
            f"than life.viscosity_40, {1e6 * at_40:g} mm^2/s.",
            where="life.viscosity_100",
        )
    first, last = (log10(log10(1e6 * nu + 0.7)) for nu in (at_40, at_100))
    cold, warm = map(log10, _WARM)
    slope = (first - last) / (warm - cold)
    return 1e-6 * float(10.0**10.0 ** (first - slope * (log10(temperature) - cold)) - 0.7)


def starved_share(inlet: float, half_length: float, radius: float, film: float) -> float:
    """What is left of a central film [m] whose oil begins ``inlet`` [m] before the middle of a
    contact of half ``half_length`` [m] in the rolling direction and effective ``radius`` [m] there:
    B. J. Hamrock and D. Dowson, Isothermal elastohydrodynamic lubrication of point contacts, part
    IV, J. Lubr. Technol. 99 (1977) 15: [(m - 1)/(m* - 1)]^0.29 with m = inlet/b and
    m* = 1 + 3.06 [(R/b)^2 h/R]^0.58. 0 for an edge within the contact.
    """
    factor, inner, outer = _EXPONENTS
    flooded = factor * ((radius / half_length) ** 2 * film / radius) ** inner  # m* - 1
    beyond = max(inlet / half_length - 1.0, 0.0)
    return float(min(beyond / flooded, 1.0) ** outer)
