"""Modified rating lives of a static solution, and of a load spectrum."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from math import hypot, inf, isfinite, nan, pi

import numpy as np

from flexcage.contacts.spec import Lubricant
from flexcage.core.units import describe
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.film import Oil
from flexcage.geometry.life.iso281 import (
    KAPPAS,
    Endurance,
    fatigue_limit,
    modification,
    reference_viscosity,
    reliability_factor,
    with_additives,
)
from flexcage.geometry.life.oil import starved_share, viscosity_at
from flexcage.geometry.life.spec import Life
from flexcage.system.statics.rated import Lives, RatedLife
from flexcage.system.statics.state import StaticState

_FILM_TO_KAPPA = 1.3  # ISO 281, 9.3.3: kappa is about Lambda^1.3
_HEAVY = 0.5  # of C: up to there ISO 281 holds


def rated(
    bearing: Bearing, solution: StaticState, life: Life, lubricant: Lubricant,
    temperature: float | None = None,
) -> RatedLife:  # fmt: skip
    """Life of a static solution; ``temperature`` [K] of the oil, if not life.temperature."""
    kind, ratings, speed = bearing.endurance, solution.ratings, solution.speed
    assert kind is not None  # see ``case.life_checks``
    at = life.temperature if temperature is None else temperature
    viscosity = _viscosity(life, lubricant, at)
    reference = reference_viscosity(speed, bearing.pitch_diameter) if speed else nan
    oil = Oil(viscosity * lubricant.density, lubricant.pressure_coefficient)
    starved = _starved(bearing, solution, life, oil)
    kappa = viscosity / reference * starved**_FILM_TO_KAPPA if speed else nan
    load = ratings.equivalent_load
    equal = ratings.dynamic * ratings.reference_life ** (-1.0 / kind.life)  # that L10r is of
    limit = limit_of(bearing, life)
    factors = [_modified(kind, kappa, limit, p, life, thrust=bearing.is_thrust)
               for p in (load, equal)]  # fmt: skip
    a1 = reliability_factor(life.reliability)
    lives = [a1 * (1.0 if life.contamination is None else factor) * plain for factor, plain in
             zip(factors, (ratings.life, ratings.reference_life))]  # fmt: skip
    radial = hypot(float(solution.load[1]), float(solution.load[2]))
    turns = abs(speed) / (2.0 * pi) * 3600.0
    return RatedLife(
        speed=speed, radial=radial, axial=float(solution.load[0]), temperature=at,
        equivalent_load=load, viscosity=viscosity, reference_viscosity=reference, starved=starved,
        kappa=kappa, modification=factors[0], reference_modification=factors[1], life=lives[0],
        reference_life=lives[1], hours=1e6 * lives[1] / turns if turns else inf,
    )  # fmt: skip


def limit_of(bearing: Bearing, life: Life) -> float:
    """Fatigue load limit C_u [N]; of hybrid bearings the one that makes as much stress."""
    assert bearing.endurance is not None
    return life.fatigue_load_limit or bearing.stress_share * fatigue_limit(
        bearing.endurance, bearing.static_rating, bearing.pitch_diameter
    )


def combined_hours(shares: Sequence[float], points: Sequence[RatedLife | None]) -> float:
    """Life [h] of points with shares of the time, by Palmgren and Miner: 1/sum(share/life)."""
    worn = sum(q / point.hours for q, point in zip(shares, points) if point is not None)
    return 1.0 / worn if worn > 0.0 else inf


def _modified(
    kind: Endurance, kappa: float, limit: float, load: float, life: Life, *, thrust: bool
) -> float:
    clean = life.contamination
    if clean is None or not isfinite(kappa) or not load > 0.0:
        return nan
    if life.additives:
        return with_additives(kind, kappa, clean * limit / load, clean, thrust=thrust)
    return modification(kind, kappa, clean * limit / load, thrust=thrust)


def _viscosity(life: Life, lubricant: Lubricant, temperature: float | None) -> float:
    """Kinematic viscosity [m^2/s]."""
    if life.viscosity_40 is None or life.viscosity_100 is None or temperature is None:
        return lubricant.viscosity / lubricant.density
    return viscosity_at(temperature, life.viscosity_40, life.viscosity_100)


def _starved(bearing: Bearing, solution: StaticState, life: Life, oil: Oil) -> float:
    """The least share of the flooded film that is left, of the most loaded contacts of both races;
    1 where the inlet is flooded."""
    if life.inlet is None or not solution.speed:
        return 1.0
    diameter, races, e = bearing.element_diameter, bearing.race_diameters, solution.elements
    entrained = bearing.rolling_entrainment(e.angle, e.orbital_speed, solution.speed)
    central, found = bearing.race_film(e.force, entrained, oil).central, []
    for race, side in enumerate((1.0, -1.0)):
        k = int(np.argmax(e.force[:, race]))
        radius = 0.5 * diameter * races[race] / (races[race] + side * diameter)
        along, film = e.along[k, race], central[k, race]
        if along > 0.0 and isfinite(film):
            found.append(starved_share(life.inlet, float(along), radius, float(film)))
    return min(found, default=1.0)


def questioned_lives(lives: Lives, dynamic_rating: float) -> Iterator[str]:
    """Sentences on lives outside of what the standards cover."""
    rows = [("", lives.here), *((f"life.spectrum.{k}: ", p) for k, p in enumerate(lives.points))]
    for where, point in rows:
        if point is None:
            continue
        if lives.contamination is not None and point.kappa < KAPPAS[0]:
            yield (
                f"{where}the viscosity ratio kappa is {point.kappa:.2g}, and ISO 281 has a_ISO "
                f"from {KAPPAS[0]:g} on, which is taken: such a film does not part the surfaces."
            )
        if point.starved == 0.0:
            yield (
                f"{where}life.inlet lies within the heaviest contacts: no film is left, and kappa "
                "is 0."
            )
        if point.equivalent_load > _HEAVY * dynamic_rating:
            yield (
                f"{where}the equivalent load, {describe(point.equivalent_load, 'kN')}, is above "
                "half of the dynamic rating, up to which ISO 281 holds."
            )
