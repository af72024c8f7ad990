"""The static solution of an N1013, against the same answers as the start of a run."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import radians
from typing import Any

import numpy as np

import flexcage
from flexcage import spec
from flexcage.verification.bearings import RPM, preset
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


def bearing(clearance: float, *, profile: str = "straight") -> Any:
    """The preset at a radial clearance [um]."""
    found = replace(preset("N1013"), radial_clearance=clearance * 1e-6)
    return replace(found, profile=replace(found.profile, kind=profile))


def solution(
    of: spec.Bearing, *, azimuth: float = 0.0, rpm: float = 0.0, slices: int = 16,
    factor: float = 1.0,
) -> flexcage.StaticSolution:  # fmt: skip
    """Under 1000 N."""
    race = spec.PairSpec(normal=spec.NormalLaw(stiffness_factor=factor), slices=slices)
    case = flexcage.StaticCase(
        bearing=of, load=spec.Load(radial=1000.0, direction=radians(azimuth)),
        drive=spec.Drive(speed=rpm * RPM), contacts=spec.Contacts(race=race),
    )  # fmt: skip
    return flexcage.solve_static(case)


def displacement(of: flexcage.StaticSolution) -> float:
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


CASE: KnownAnswer = KnownAnswer(
    name="roller_statics",
    title="Static solution of an N1013 under 1000 N",
    source="independent program after H. Sjoevall with the stiffness of ISO/TS 16281:2008, or A. "
    "Palmgren's: the same numbers as for 'static_load'",
    checks="Displacement, largest force, number of loaded rollers and Hertz pressure by the static "
    "solution, which shares nothing but spec and stiffness with the start of a run that "
    "'static_load' checks.",
    rows=rows,
)
