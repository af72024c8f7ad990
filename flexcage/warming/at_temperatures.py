"""A bearing at given temperatures: its case, its losses, and the network of its heat."""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from dataclasses import dataclass
from math import pi

import numpy as np

from flexcage.bearings import losses_of
from flexcage.case import Case, StaticCase
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.heat.correlations import Contacts, OilState, network_of
from flexcage.geometry.heat.network import (
    CAGE,
    ELEMENTS,
    INNER,
    OIL,
    OUTER,
    TITLES,
    Network,
    by_body,
)
from flexcage.geometry.heat.spec import Heat
from flexcage.geometry.life.oil import viscosity_at
from flexcage.geometry.life.spec import Life
from flexcage.geometry.temperature import MODULUS_CURVES, beyond_service
from flexcage.results.losses import losses_of_run
from flexcage.simulate import simulate
from flexcage.static import solve_static
from flexcage.system.statics.losses import Losses
from flexcage.system.statics.solution import StaticSolution
from flexcage.warming.warmth import ZERO, Iteration

_FIT = {"inner": INNER, "outer": OUTER, "element": ELEMENTS, "shaft": "shaft", "housing": "housing"}
_NO_POCKETS = (
    "losses are of the static solution, which has no cage: pockets and lands are left out; "
    'heat.losses = "run" has them.'
)


@dataclass(frozen=True)
class Evaluated:
    """An iteration, and the network that it goes by."""

    iteration: Iteration
    network: Network


def film_of(temperatures: Mapping[str, float]) -> float:
    """Temperature [K] of the oil in contacts: that of their surfaces, the mean of both races' and
    the elements' (assumption)."""
    rings = temperatures[INNER] + temperatures[OUTER]
    return 0.25 * (rings + 2.0 * temperatures[ELEMENTS])


def kinematic(case: StaticCase, temperature: float) -> float:
    """Kinematic viscosity [m^2/s] of a case's oil at a temperature [K]."""
    life = case.life
    assert life.viscosity_40 is not None and life.viscosity_100 is not None
    return viscosity_at(temperature, life.viscosity_40, life.viscosity_100)


def warmed(
    case: StaticCase, temperatures: Mapping[str, float]
) -> tuple[StaticCase, tuple[str, ...]]:
    """The case at temperatures [K]: viscosity, fits and the cage's modulus follow; and sentences on
    what does not. Raises InputError where the clearance cannot be."""
    film = round(film_of(temperatures), 2)
    changes: dict[str, float] = {
        f"fit.{name}_temperature": temperatures[body] for name, body in _FIT.items()
    }
    changes |= {
        "lubricant.viscosity": float(f"{kinematic(case, film) * case.lubricant.density:.6g}"),
        "life.temperature": film,
    }
    notes = [_NO_POCKETS] if case.heat.losses == "static" else []
    cage = case.cage if isinstance(case, Case) else None
    if cage is not None:
        material, warmth = cage.material.name, temperatures.get(CAGE, film)
        curve = MODULUS_CURVES.get(material)
        if curve is not None and curve.temperatures[0] <= warmth <= curve.temperatures[-1]:
            changes["cage.temperature"] = warmth
        else:
            notes.append(
                f"the cage keeps its modulus: that of {material} at {warmth - ZERO:.0f} degC is "
                "not known."
            )
        if hot := beyond_service(cage.material, warmth):
            notes.append(f"{hot}.")
    return case.replace(changes), tuple(notes)


def evaluate(case: StaticCase, temperatures: Mapping[str, float]) -> Evaluated:
    """Losses of a case at temperatures [K] by body, and where the network goes under them.

    Bodies without a temperature yet, as the cage, have that of the oil in contacts.
    """
    now, _ = warmed(case, temperatures)
    plain = _without_lives(now)
    solution = solve_static(plain)
    bearing = plain.mounted.bearing
    losses = losses_of(bearing)(
        bearing, solution, contacts=plain.contacts, lubricant=plain.lubricant
    )
    places, power = _places(case.heat, plain, losses)
    film = film_of(temperatures)
    oil = OilState(kinematic(case, temperatures[OIL]), case.lubricant.density)
    network = network_of(
        case.heat, bearing, _contacts(bearing, solution), oil,
        speeds=_speeds(bearing, losses), cage_area=_cage_area(case),
    )  # fmt: skip
    towards = network.temperatures(by_body(_in_network(places, network)))
    at = {body: temperatures.get(body, film) for body in towards}
    clearance = plain.mounting.operating if plain.mounting else bearing.clearance
    flows = {f"{TITLES[a]} to {TITLES[b]}": w for (a, b), w in network.out(at).items()}
    return Evaluated(
        Iteration(at, towards, film, plain.lubricant.viscosity, clearance, places, flows, power),
        network,
    )


def _without_lives(case: StaticCase) -> StaticCase:
    """The case without what every turn would compute again and nothing here reads."""
    bare = case.replace({"life": Life(), "heat": Heat()})
    given = [p for p in bare.given or () if p.partition(".")[0] not in ("life", "heat")]
    return dataclasses.replace(bare, given=tuple(given))


def _places(heat: Heat, case: StaticCase, losses: Losses) -> tuple[dict[str, float], float]:
    """Losses [W] by place, and what drive, seals and further sources put in."""
    if heat.losses == "run":
        assert isinstance(case, Case)
        run = simulate(case, stress=False)
        places, power = losses_of_run(run.dataset, case.output.settle)
        cage = case.cage
        guided = getattr(cage, "guidance", "") if cage is not None else ""
        if "lands" in places and guided in (INNER, OUTER):
            places[f"{guided} lands"] = places.pop("lands")
    else:
        places, power = dict(losses.places), losses.torque * case.speed
    turning = abs(case.speed)
    more = {
        "seals": heat.seal_torque * turning, "churning": heat.churning_torque * turning,
        "shaft heat": heat.shaft_heat, "housing heat": heat.housing_heat,
    }  # fmt: skip
    places |= {place: loss for place, loss in more.items() if loss}
    return places, power + sum(more[place] for place in ("seals", "churning"))


def _in_network(places: Mapping[str, float], network: Network) -> dict[str, float]:
    """Places of a bearing without a cage in the network heat none."""
    if CAGE in network.bodies:
        return dict(places)
    return {p: loss for p, loss in places.items() if CAGE not in by_body({p: loss})}


def _contacts(bearing: Bearing, solution: StaticSolution) -> Contacts:
    e = solution.elements
    speed = bearing.rolling_entrainment(e.angle, e.orbital_speed, solution.speed)
    return Contacts(
        np.where(e.force > 0.0, e.across, 0.0), np.where(e.force > 0.0, e.along, 0.0),
        solution.film.central, np.nan_to_num(speed), bearing.element == "ball",
    )  # fmt: skip


def _speeds(bearing: Bearing, losses: Losses) -> tuple[float, float]:
    """Speeds [m/s] of the cage at the pitch circle, and of elements' surfaces."""
    orbit = 0.5 * abs(losses.orbit) * bearing.pitch_diameter
    return orbit, 0.5 * losses.spin * bearing.element_diameter


def _cage_area(case: StaticCase) -> float:
    """Surface [m^2] of a case's cage, as of a plain ring for each row."""
    cage = case.cage if isinstance(case, Case) else None
    if cage is None:
        return 0.0
    each = pi * (cage.bore + cage.outside_diameter) * cage.axial_width
    return float(each * case.bearing.row_count)
