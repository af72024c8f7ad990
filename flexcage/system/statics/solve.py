"""From bearing, load and speed to the static solution."""

from __future__ import annotations

from functools import partial
from typing import Any

import numpy as np

from flexcage.contacts.spec import Contacts, Lubricant
from flexcage.core.errors import InputError
from flexcage.core.threads import one_blas_thread
from flexcage.core.units import describe
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.film import Film
from flexcage.geometry.hertz import over_edge
from flexcage.geometry.kinematics import epicyclic, passing_frequencies
from flexcage.system.spec import Load
from flexcage.system.statics.elements import ElementLoads, Elements, ElementsOf
from flexcage.system.statics.equilibrium import Posture, Problem, balance, tangent
from flexcage.system.statics.options import StaticOptions
from flexcage.system.statics.rings import BentRing, Rings, balance_with_rings
from flexcage.system.statics.solution import StaticSolution
from flexcage.system.statics.state import Ratings
from flexcage.system.statics.yielding import balance_on_seat, on_seat

_PLACES = ("load.axial", "load.radial", "load.radial", "load.moment_y", "load.moment_z")
_BORNE = (("N", "load.axial_stiffness"), ("N*m", "load.tilt_stiffness"))  # forces, moments


@one_blas_thread
def solve_bearing(
    bearing: Bearing,
    elements_of: ElementsOf,
    *,
    load: Load,
    speed: float = 0.0,
    contacts: Contacts | None = None,
    lubricant: Lubricant | None = None,
    options: StaticOptions | None = None,
    rings: Rings | None = None,
    seat: np.ndarray | None = None,
) -> StaticSolution:
    """Equilibrium of the inner ring under the load at its start, turning at ``speed`` [rad/s], and
    the film that the lubricant then makes. ``elements_of``: of the bearing's family; ``rings``: how
    rings bend, if they do. ``seat``: the compliance (5, 5) of the outer ring's seat
    (``system.seat``), if it yields.

    Raises InputError for a load that the bearing cannot bear, RunFailed if no equilibrium is found.
    """
    options = options or StaticOptions()
    elements = elements_of(bearing, speed=speed, contacts=contacts or Contacts(), options=options)
    problem = posed(bearing, elements, load, options)
    find = balance if seat is None else partial(balance_on_seat, compliance=seat)
    bent: tuple[BentRing, ...] = ()
    if rings is not None and rings.bend:
        problem, posture, bent = balance_with_rings(problem, bearing, rings, find)
    else:
        posture = find(problem)
    borne = np.where(problem.spring > 0.0, posture.force, problem.load)  # by the elements
    ring = posture.ring + posture.outer
    springs = problem.pull(ring) - problem.load
    stiffness = tangent(problem, posture)
    return solution_at(
        bearing, elements, posture, options,
        load=problem.load, borne=borne, speed=speed, lubricant=lubricant,
        reaction=np.where(problem.free, springs, posture.force - problem.load),
        stiffness=stiffness if seat is None else on_seat(stiffness, seat),
        held=load.held_in_words(axially=bool(problem.free[0]), tilt=_tilt(load, options)[0]),
        rings=bent,
    )  # fmt: skip


def solution_at(
    bearing: Bearing, elements: Elements, posture: Posture, options: StaticOptions, *,
    load: np.ndarray, borne: np.ndarray, speed: float, lubricant: Lubricant | None,
    **known: Any,
) -> StaticSolution:  # fmt: skip
    """The solution of a posture in equilibrium: ``load`` (5,) is what was asked, ``borne`` (5,)
    what the elements bear; ``known`` are further values of the solution."""
    v = posture.v
    loads = elements.loads(v, posture.own)
    elements.check(loads)
    own, nominal = _frequencies(bearing, loads, speed)
    return StaticSolution(
        title=f"{bearing.designation or 'bearing'}, {bearing.kind} with {len(v)} rolling elements",
        speed=speed,
        load=load,
        displacement=posture.ring + posture.outer,
        outer=posture.outer,
        elements=loads,
        film=_film(bearing, loads, speed, lubricant or Lubricant()),
        ratings=_ratings(bearing, borne, options, elements.reference_life(v, posture.own)),
        warnings=tuple(_warnings(elements, loads)),
        unbalanced=posture.unbalanced,
        frequencies=own,
        nominal_frequencies=nominal,
        **known,
    )


def _frequencies(bearing: Bearing, loads: ElementLoads, speed: float) -> list[dict[str, float]]:
    """Passing frequencies of pure rolling: at the mean contact angles of elements that bear load on
    both races, and at the nominal one. None of a type that does not say how large its elements
    are."""
    try:
        nominal, size = bearing.nominal_contact_angle, bearing.element_diameter
    except NotImplementedError:
        return [{}, {}]
    both = (loads.force > 0.0).all(axis=1) & np.isfinite(loads.angle).all(axis=1)
    mean = np.abs(loads.angle[both]).mean(axis=0) if both.any() else np.full(2, nominal)
    borne = bearing.rolling_angles((float(mean[0]), float(mean[1])))
    found = []
    for inner, outer in (borne, (nominal, nominal)):
        rolling = epicyclic(
            element_diameter=size, pitch_diameter=bearing.pitch_diameter,
            element_count=bearing.element_count, inner_speed=speed,
            contact_angle=(inner, outer),
        )  # fmt: skip
        found.append(passing_frequencies(rolling, speed))
    return found


def _film(bearing: Bearing, loads: ElementLoads, speed: float, lubricant: Lubricant) -> Film:
    """Film of elements that roll without slip."""
    entrained = bearing.rolling_entrainment(loads.angle, loads.orbital_speed, speed)
    return bearing.race_film(loads.force, entrained, lubricant.oil)


def load_vector(load: Load) -> np.ndarray:
    """Forces and moments (5,) on the inner ring at the start of a load."""
    radial, axial = load.at_start
    return np.array([
        axial, radial * np.cos(load.direction), radial * np.sin(load.direction),
        load.moment_y, load.moment_z,
    ])  # fmt: skip


def _tilt(load: Load, options: StaticOptions) -> tuple[str, str]:
    """Is the inner ring free in tilt or held, and which key says so?"""
    return (load.tilt, "load.tilt") if options.tilt is None else (options.tilt, "static.tilt")


def posed(bearing: Bearing, elements: Elements, load: Load, options: StaticOptions) -> Problem:
    """What is free and what is held; InputError where the load does not fit that."""
    force = load_vector(load)
    held = np.array([0.0, 0.0, 0.0, 0.0, load.misalignment])
    axial, *tilts = load.stiffness
    spring = np.array([axial, 0.0, 0.0, *tilts])
    free = np.array(elements.carries) | (spring > 0.0)
    refused = "" if axial > 0.0 else bearing.axial_refusal(float(force[0]))
    if refused:
        raise InputError(
            f"load.axial is {describe(force[0], 'N')}, but {refused}; leave it out, or give the "
            "shaft's load.axial_stiffness.",
            where="load.axial",
        )
    for k in range(5):
        if force[k] != 0.0 and not free[k]:
            unit, shaft = _BORNE[k > 2]
            raise InputError(
                f"{_PLACES[k]} is {describe(force[k], unit)}, but a {bearing.kind} bears none of "
                f"it in the static solution; leave it out, or give the shaft's {shaft}.",
                where=_PLACES[k],
            )
    tilt, key = _tilt(load, options)
    if tilt == "held":
        if load.tilt_stiffness > 0.0:
            raise InputError(
                f"load.tilt_stiffness is {describe(load.tilt_stiffness, 'N*m/rad')}, but "
                f"{key} is 'held'; leave it out, or take {key} = \"free\".",
                where="load.tilt_stiffness",
            )
        free[3:] = False
        for k in (3, 4):
            if force[k] != 0.0:
                raise InputError(
                    f"{_PLACES[k]} is {describe(force[k], 'N*m')}, but {key} is 'held', so "
                    f'moments are reactions; leave it out, or take {key} = "free".',
                    where=_PLACES[k],
                )
    elif load.misalignment != 0.0 and load.tilt_stiffness == 0.0:
        raise InputError(
            f"load.misalignment is {describe(load.misalignment, 'mrad')}, but {key} is "
            f"'free'; take {key} = \"held\" for a tilt that is given, or give "
            "load.tilt_stiffness of a shaft that is so tilted.",
            where="load.misalignment",
        )
    if not np.abs(force).max() > 0.0:
        raise InputError(
            "The inner ring bears no load; give load.radial, load.axial or a moment.", where="load"
        )
    return Problem(elements, force, free, held, spring)


def _ratings(
    bearing: Bearing, force: np.ndarray, options: StaticOptions, reference_life: float
) -> Ratings:
    dynamic = options.dynamic_rating or bearing.dynamic_rating
    radial = float(np.hypot(force[1], force[2]))
    equivalent = bearing.equivalent_load(radial, abs(float(force[0])))
    load = equivalent.load if equivalent.load > 0.0 else float("nan")  # moments are not rated
    return Ratings(
        static=bearing.static_rating * bearing.stress_share,
        dynamic=dynamic,
        names=bearing.rating_names,
        equivalent_load=load,
        life=(dynamic / load) ** equivalent.exponent,
        reference_life=reference_life,
    )


def _warnings(elements: Elements, loads: ElementLoads) -> list[str]:
    found = []
    for side, name in enumerate(("inner", "outer")):
        worst = int(np.argmax(np.nan_to_num(loads.edge[:, side], nan=-np.inf)))
        beyond = loads.edge[worst, side]
        if beyond > 0.0:
            found.append(
                over_edge(
                    f"element {worst}",
                    name,
                    beyond,
                    force=loads.force[worst, side],
                    angle=loads.angle[worst, side],
                )
            )
    peak = float(loads.pressure.max())
    if peak > elements.pressure_limit:
        found.append(
            f"the largest pressure, {peak / 1e6:.0f} MPa, is above the "
            f"{elements.pressure_limit / 1e6:.0f} MPa at which ISO 76 sets the static rating; "
            "races would be dented."
        )
    return found
