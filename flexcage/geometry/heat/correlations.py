"""Conductances that follow from size, speed and oil.

- Shaft and housing to what is around: the reference heat flow of a radial bearing's seats, q =
  0.016 W/mm^2 up to A = pi B (d + D) = 50,000 mm^2, then 0.016 (A/50,000)^-0.34, over 50 K (ISO
  15312, thermal speed rating; quoted from memory), shared by the seats' areas.
- Seats: their areas times ``heat.seat_joint``. The rings' own resistance is left out.
- Rolling contacts: two half-spaces that touch for the time t in which a surface passes the contact
  exchange e sqrt(t/pi) per area and kelvin, with e = 2 e_1 e_2/(e_1 + e_2) of the effusivities
  sqrt(k rho c) (H. S. Carslaw and J. C. Jaeger, Conduction of Heat in Solids, 2.15: semi-infinite
  composite solid), on both sides of the film, whose conductance per area is the oil's conductivity
  over its central thickness, in series (assumption).
- Surfaces to oil: laminar flow along a plate, Nu = 0.332 Re^(1/2) Pr^(1/3) (E. Pohlhausen), at the
  speed of the cage over the length of the pitch diameter, as T. A. Harris takes it (Rolling Bearing
  Analysis, chapter on temperatures); elements at their surface's speed over their diameter. Oil
  wets surfaces as far as they face the bearing's inside (assumption).
- Oil that flows through: rho c times its flow.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import gamma, pi, sqrt
from typing import Any

import numpy as np

from flexcage.geometry.bearing import Bearing
from flexcage.geometry.heat import network as n
from flexcage.geometry.heat.spec import Heat

_FLOW_DENSITY, _AREA, _FALL, _EXCESS = 0.016e6, 0.05, -0.34, 50.0  # W/m^2, m^2, power, K
_PLATE = 0.332
# integral of (1 - s^2)^(1/4) ds over -1..1: over an ellipse's width, the root of times of contact
_OVER_WIDTH = sqrt(pi) * gamma(1.25) / gamma(1.75)


@dataclass(frozen=True)
class Contacts:
    """Contacts of all elements with both races: what they exchange heat through; (Z, 2) arrays."""

    across: np.ndarray  # half of the extent across the rolling direction, m
    along: np.ndarray  # half of that in rolling direction, m
    film: np.ndarray  # central thickness, m; NaN without contact
    speed: np.ndarray  # at which surfaces pass, m/s
    elliptical: bool


@dataclass(frozen=True)
class OilState:
    """The oil at its temperature."""

    viscosity: float  # kinematic, m^2/s
    density: float

    def prandtl(self, heat: Heat) -> float:
        """nu rho c/k."""
        return self.viscosity * self.density * heat.oil_capacity / heat.oil_conductivity


def seat_flow(bearing: Bearing) -> float:
    """Heat [W/K] that ISO 15312's reference conditions let the seats of a bearing give off."""
    area = pi * bearing.width * (bearing.bore + bearing.outside_diameter)
    density = _FLOW_DENSITY * min(1.0, (area / _AREA) ** _FALL)
    return density * area / _EXCESS


def rolling_conductances(contacts: Contacts, heat: Heat, bearing: Bearing) -> np.ndarray:
    """Conductances (2,) [W/K] of all contacts with the inner and with the outer race."""
    ring = sqrt(heat.ring_conductivity * bearing.material.density * heat.ring_capacity)
    element = sqrt(
        (heat.element_conductivity or heat.ring_conductivity)
        * bearing.rolling_material.density
        * (heat.element_capacity or heat.ring_capacity)
    )
    both = 2.0 * ring * element / (ring + element)
    speed = np.abs(contacts.speed)
    bears = (contacts.along > 0.0) & (contacts.across > 0.0) & (speed > 0.0)
    long, half = np.where(bears, contacts.across, 1.0), np.where(bears, contacts.along, 1.0)
    time = 2.0 * half / np.where(bears, speed, 1.0)
    width = long * (_OVER_WIDTH if contacts.elliptical else 2.0)
    solid = both * width * np.sqrt(time / pi) * speed
    area = 4.0 * long * half * (0.25 * pi if contacts.elliptical else 1.0)
    film = np.where(np.isfinite(contacts.film) & bears, contacts.film, 0.0)
    resistance = 1.0 / np.where(bears, solid, 1.0) + film / (heat.oil_conductivity * area)
    found: np.ndarray = np.where(bears, 1.0 / resistance, 0.0).sum(axis=0)
    return found


def plate(speed: float, length: float, oil: OilState, heat: Heat) -> float:
    """Heat transfer [W/(m^2 K)] of laminar flow along a plate."""
    reynolds = abs(speed) * length / oil.viscosity
    nusselt = _PLATE * sqrt(reynolds) * oil.prandtl(heat) ** (1.0 / 3.0)
    return nusselt * heat.oil_conductivity / length


def _to_oil(
    bearing: Bearing, cage_area: float, heat: Heat, oil: OilState, speeds: tuple[float, float]
) -> dict[str, float]:
    """From rings, elements and cage to the oil; ``speeds`` [m/s] of the cage at the pitch circle
    and of an element's surface."""
    on_rings = plate(speeds[0], bearing.pitch_diameter, oil, heat)
    size = bearing.element_diameter
    inner, outer = (pi * d * bearing.width for d in bearing.race_diameters)
    one = pi * size**2 if bearing.element == "ball" else pi * size * (
        bearing.element_length + 0.5 * size)  # fmt: skip
    return {
        n.INNER: on_rings * inner,
        n.OUTER: on_rings * outer,
        n.ELEMENTS: plate(speeds[1], size, oil, heat) * one * bearing.element_count,
        n.CAGE: on_rings * cage_area,
    }


def network_of(
    heat: Heat, bearing: Bearing, contacts: Contacts, oil: OilState, *,
    speeds: tuple[float, float], cage_area: float,
) -> n.Network:  # fmt: skip
    """The network of a bearing: conductances that ``heat`` gives, others as above. ``speeds``: as
    ``_to_oil`` has them; ``cage_area`` [m^2] of the cage's surface, 0 without one."""
    flow, seats = seat_flow(bearing), (bearing.bore, bearing.outside_diameter)
    shares = [d / sum(seats) for d in seats]
    joints = [heat.seat_joint * pi * d * bearing.width for d in seats]
    inner, outer = rolling_conductances(contacts, heat, bearing)
    wet = _to_oil(bearing, cage_area, heat, oil, speeds)

    def own(name: str, otherwise: float) -> float:
        given: float | None = getattr(heat, name)
        return float(otherwise) if given is None else given

    found: dict[tuple[str, str], float] = {
        (n.SHAFT, n.AMBIENT): own("shaft_ambient", flow * shares[0]),
        (n.HOUSING, n.AMBIENT): own("housing_ambient", flow * shares[1]),
        (n.INNER, n.SHAFT): own("inner_shaft", joints[0]),
        (n.OUTER, n.HOUSING): own("outer_housing", joints[1]),
        (n.INNER, n.ELEMENTS): own("inner_elements", inner),
        (n.OUTER, n.ELEMENTS): own("outer_elements", outer),
        (n.INNER, n.OIL): own("inner_oil", wet[n.INNER]),
        (n.OUTER, n.OIL): own("outer_oil", wet[n.OUTER]),
        (n.ELEMENTS, n.OIL): own("elements_oil", wet[n.ELEMENTS]),
        (n.OIL, n.HOUSING): heat.oil_housing,
    }
    if cage_area > 0.0:
        found[n.CAGE, n.OIL] = own("cage_oil", wet[n.CAGE])
    given: Mapping[str, Any] = {n.AMBIENT: heat.ambient}
    if heat.oil_flow > 0.0:
        found[n.OIL, n.INLET] = oil.density * heat.oil_capacity * heat.oil_flow
        inlet = heat.ambient if heat.oil_inlet is None else heat.oil_inlet
        given = {**given, n.INLET: inlet}
    return n.Network(found, given)
