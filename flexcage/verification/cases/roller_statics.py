"""The static solution of an N1013, against the same answers as the start of a run."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import radians

import numpy as np

from flexcage.contacts.spec import Contacts, NormalLaw, PairSpec
from flexcage.geometry.cylindrical_roller import RollerBearing, RollerProfile
from flexcage.geometry.presets import load_preset
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
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

HERTZ = Tolerance(3e-4, "printed to four digits; the clearance moves radii by 1e-7")
SAME = Tolerance(1e-4, "printed to four digits or more; small angles on both sides")


def bearing(clearance: float, *, profile: str = "straight") -> RollerBearing:
    """The preset at a radial clearance [um]."""
    found = load_preset("N1013").bearing
    return replace(found, radial_clearance=clearance * 1e-6, profile=RollerProfile(kind=profile))


def solution(
    of: RollerBearing, *, azimuth: float = 0.0, rpm: float = 0.0, slices: int = 16,
    factor: float = 1.0,
) -> StaticSolution:  # fmt: skip
    """Under 1000 N."""
    race = PairSpec(normal=NormalLaw(stiffness_factor=factor), slices=slices)
    load = Load(radial=1000.0, direction=radians(azimuth))
    return solve_bearing(of, load=load, speed=rpm * RPM, contacts=Contacts(race=race))


def displacement(of: StaticSolution) -> float:
    """Radial [um]."""
    return 1e6 * float(np.hypot(*of.displacement[1:3]))


def rows() -> Iterator[Row]:
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
    "Palmgren's: the same numbers as for 'static_load'",
    checks="Displacement, largest force, number of loaded rollers and Hertz pressure by the static "
    "solution, which shares nothing but spec and stiffness with the start of a run that "
    "'static_load' checks.",
    rows=rows,
)
