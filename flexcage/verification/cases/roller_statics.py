"""The static solution of an N1013, against the same answers as the start of a run."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import radians

import numpy as np

from flexcage.bearings import statics_of
from flexcage.contacts.spec import Contacts, NormalLaw, PairSpec
from flexcage.spec import RollerBearing, RollerProfile
from flexcage.system.spec import Load
from flexcage.system.statics.solution import StaticSolution
from flexcage.system.statics.solve import solve_bearing
from flexcage.verification.ball_bearings import RPM
from flexcage.verification.cases.static_load import (
    BETWEEN,
    BY_PALMGREN,
    COUNT,
    PALMGREN,
    PROFILED,
    TURNING,
    UNPROFILED,
)
from flexcage.verification.inside import roller_bearing
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

# radial clearance [um]: displacement [um], load zone eps and largest force [N] of Sjoevall's
# integral, in which rollers are spread evenly
SPREAD = {
    0: (1.7829, 0.50000, 185.681), 10: (7.5920, 0.17071, 281.409), 20: (13.0327, 0.11635, 335.053),
    40: (23.6200, 0.07663, 407.870), 55: (31.4459, 0.06274, 448.878),
}  # fmt: skip
MANY = 4400  # rollers, 200 in the place of one
INTEGRAL = Tolerance(1.5e-5, "printed to five digits or six; 4400 rollers stand for the integral")
ZONE = Tolerance(
    4e-4, "the zone's ends are known to one roller of 4400, eps is (1 - cos psi)/2", absolute=True
)
HERTZ = Tolerance(3e-4, "printed to four digits; the clearance moves radii by 1e-7")
SAME = Tolerance(1e-4, "printed to four digits or more; small angles on both sides")


def bearing(clearance: float, *, profile: str = "straight") -> RollerBearing:
    """The preset at a radial clearance [um]."""
    found = roller_bearing("N1013")
    return replace(found, radial_clearance=clearance * 1e-6, profile=RollerProfile(kind=profile))


def solution(
    of: RollerBearing, *, azimuth: float = 0.0, rpm: float = 0.0, slices: int = 16,
    factor: float = 1.0,
) -> StaticSolution:  # fmt: skip
    """Under 1000 N."""
    race = PairSpec(normal=NormalLaw(stiffness_factor=factor), slices=slices)
    load = Load(radial=1000.0, direction=radians(azimuth))
    contacts = Contacts(race=race)
    return solve_bearing(of, statics_of(of), load=load, speed=rpm * RPM, contacts=contacts)


def displacement(of: StaticSolution) -> float:
    """Radial [um]."""
    return 1e6 * float(np.hypot(*of.displacement[1:3]))


def spread_rows() -> Iterator[Row]:
    """Many soft rollers: Sjoevall's integrals."""
    share = roller_bearing("N1013").roller_count / MANY
    for clearance, (moved, zone, largest) in SPREAD.items():
        found = solution(replace(bearing(clearance), roller_count=MANY), factor=share)
        force = found.elements.force[:, 0]
        name = f"Pd {clearance} um, rollers spread"
        yield Row(f"{name}: displacement", "um", moved, displacement(found), INTEGRAL)
        value = float(force.max() / share)
        yield Row(f"{name}: largest force", "N", largest, value, INTEGRAL)
        loaded = np.pi * np.count_nonzero(force > 0.0) / MANY
        yield Row(f"{name}: load zone", "", zone, 0.5 * (1.0 - np.cos(loaded)), ZONE)
        if clearance == 0:
            value *= 22 / 1000.0
            yield Row(f"{name}: integral J_r", "", 0.244799, 1.0 / value, INTEGRAL)
            yield Row(f"{name}: 1/J_r", "", 4.08499, value, INTEGRAL)


def rows() -> Iterator[Row]:
    yield from spread_rows()
    for clearance, both in UNPROFILED.items():
        for azimuth, (moved, largest, loaded) in zip((0.0, float(BETWEEN.split()[0])), both):
            found = solution(bearing(clearance), azimuth=azimuth)
            name = f"Pd {clearance} um, load {'between' if azimuth else 'on a roller'}"
            yield Row(f"{name}: displacement", "um", moved, displacement(found), SAME)
            yield Row(f"{name}: largest force", "N", largest, found.largest_force, SAME)
            count = int(np.count_nonzero(found.elements.force[:, 0] > 1e-3))
            yield Row(f"{name}: loaded rollers", "", loaded, count, COUNT)
    found = solution(bearing(0.0))
    share = (185.3 / found.elements.force[0, 0]) ** 0.5
    for side, width, pressure in ((0, 32.12, 503.2), (1, 35.40, 456.5)):
        name = f"185.3 N, {('inner', 'outer')[side]} race"
        value = 1e6 * share * found.elements.along[0, side]
        yield Row(f"{name}: half-width", "um", width, value, HERTZ)
        value = 1e-6 * share * found.elements.pressure[0, side]
        yield Row(f"{name}: pressure", "MPa", pressure, value, HERTZ)
    for clearance, (moved, largest) in PROFILED.items():
        found = solution(bearing(clearance, profile="logarithmic"), slices=30)
        name = f"Pd {clearance} um, profiled"
        yield Row(f"{name}: displacement", "um", moved, displacement(found), SAME)
        yield Row(f"{name}: largest force", "N", largest, found.largest_force, SAME)
    for clearance, (moved, force) in BY_PALMGREN.items():
        found = solution(bearing(clearance), factor=PALMGREN)
        name = f"Pd {clearance} um, Palmgren"
        yield Row(f"{name}: displacement", "um", moved, displacement(found), SAME)
        if force is not None:
            yield Row(f"{name}: largest force", "N", force, found.largest_force, SAME)
    for clearance, (moved, inner, outer) in TURNING.items():
        found = solution(bearing(clearance), rpm=6000.0)
        name = f"Pd {clearance} um, 6000 rpm"
        most = found.elements.force.max(axis=0)
        yield Row(f"{name}: displacement", "um", moved, displacement(found), SAME)
        yield Row(f"{name}: largest inner force", "N", inner, most[0], SAME)
        yield Row(f"{name}: largest outer force", "N", outer, most[1], SAME)


CASE = KnownAnswer(
    name="roller_statics",
    title="Static solution of an N1013 under 1000 N",
    source="independent program after H. Sjoevall with the stiffness of ISO/TS 16281:2008, or A. "
    "Palmgren's: the same numbers as for 'static_load', and H. Sjoevall's integral J_r of the load "
    "zone for Q in proportion to d^(10/9)",
    checks="Displacement, largest force, number of loaded rollers and Hertz pressure by the static "
    "solution, which shares nothing but spec and stiffness with the start of a run that "
    "'static_load' checks. 4400 rollers, each a two-hundredth as stiff, come to the integral.",
    rows=rows,
)
