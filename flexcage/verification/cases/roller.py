"""A roller of the N1013: profile, mass, and the scales of force and speed that follow."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from flexcage import epicyclic
from flexcage.spec import RollerProfile
from flexcage.verification.bearings import RPM, preset
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

PROFILE = (7.630, 4.650, 3.320, 2.481)  # um, from the end inwards
# a roller of 8 by 30 mm, longer than 2.5 diameters: distance from its middle [mm]: profile [um]
LONG = {4.9: 0.0, 10.0: 1.150728, 12.5: 3.306714, 14.5: 9.311612}
DIGITS = Tolerance(5.1e-4, "printed to 1e-3 um", absolute=True)
CENTRE = Tolerance(5.1e-5, "printed to 1e-4 um", absolute=True)
PRINTED = Tolerance(3e-5, "printed to five digits, inertias from a mass of five digits")
FORMULA = Tolerance(6e-7, "worked out by hand to 1e-6 um", absolute=True)
ROUNDED = Tolerance(5e-5, "printed to 1e-3 N and m/s")


def rows() -> Iterator[Row]:
    b = preset("N1013")
    slices = ((np.arange(30) + 0.5) / 30 - 0.5) * b.effective_length
    drop = 1e6 * b.profile.drop(slices, diameter=b.roller_diameter, length=b.effective_length)
    for k, expected in enumerate(PROFILE):
        yield Row(f"profile, slice {k + 1} of 30", "um", expected, drop[k], DIGITS)
    yield Row("profile, slice 15 of 30", "um", 0.0031, drop[14], CENTRE)
    long = np.array(list(LONG)) * 1e-3
    drop = 1e6 * RollerProfile().drop(long, diameter=8e-3, length=30e-3)
    for (at, expected), found in zip(LONG.items(), drop):
        yield Row(f"long roller, profile {at} mm from its middle", "um", expected, found, FORMULA)
    yield Row("mass", "g", 3.1567, 1e3 * b.roller_mass, PRINTED)
    axial, transverse = b.roller_inertia
    yield Row("axial moment of inertia", "kg mm^2", 2.5253e-2, 1e6 * axial, PRINTED)
    yield Row("transverse moment of inertia", "kg mm^2", 2.9463e-2, 1e6 * transverse, PRINTED)
    speed = 6000.0 * RPM
    cage = epicyclic(
        element_diameter=b.roller_diameter,
        pitch_diameter=b.pitch_diameter,
        element_count=b.roller_count,
        inner_speed=speed,
    ).cage_speed
    centrifugal = b.roller_mass * cage**2 * b.pitch_radius
    yield Row("centrifugal force at 6000 rpm", "N", 10.480, centrifugal, ROUNDED)
    rolling = 0.5 * b.inner_race_diameter * (speed - cage)
    yield Row("rolling speed at the inner race", "m/s", 12.837, rolling, ROUNDED)


CASE: KnownAnswer = KnownAnswer(
    name="roller",
    title="Profile, mass and scales of a roller",
    source="ISO/TS 16281:2008, reference profile of rollers, and of those longer than 2.5 "
    "diameters, P = 0.0005 Dwe ln{1/[1 - ((2 |x| - (Lwe - 2.5 Dwe))/(2.5 Dwe))^2]}; mass and "
    "scales from an independent program",
    checks="The logarithmic profile at the centres of 30 slices, that of a long roller, mass and "
    "inertia of a steel roller of 8 by 8 mm, and two scales that decide about slip: centrifugal "
    "force and rolling speed.",
    rows=rows,
)
