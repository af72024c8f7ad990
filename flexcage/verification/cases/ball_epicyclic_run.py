"""Ball bearings whose races grip: cage and balls take the speeds of pure rolling."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import radians
from typing import Any

import numpy as np

import flexcage
from flexcage.verification.bearings import RPM, deep_groove
from flexcage.verification.cases.kinematics import TABLE
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance
from flexcage.verification.runs import NO_OIL, c7010, faster, in_a_cage, run_of

GRIP: Mapping[str, Any] = {
    "contacts.race.friction.law": "traction",
    "contacts.race.friction.peak": 0.3,
    "contacts.race.friction.high_speed": 0.29,
    "contacts.race.friction.peak_speed": "0.01 m/s",
    "contacts.pocket.friction.law": "none",
    "contacts.pocket.normal.restitution": 0.1,  # the cage comes to rest among the balls
    "output.rate": "5 kHz",
    "output.vibration_rate": "20 kHz",
}
LATE = 0.97  # of the ring's speed, at the start
SHARE = 0.025  # of the table's speed at 15 degrees: centrifugal force leaves the contact angles
ROLLS = Tolerance(5e-4, "demanded; loads change the radii of rolling by 1e-4, and traction creeps")


def without_angle(rpm: float, model: str) -> flexcage.Case:
    """Seven balls without contact angle, preloaded by some newtons, with 5 um of play in their
    pockets: the cage soon goes as they do."""
    ball, pitch, count = TABLE["6203"][:3]
    bearing = replace(
        deep_groove(-1e-6, ball=ball * 1e-3, count=int(count)), pitch_diameter=pitch * 1e-3,
        bore=15e-3, outside_diameter=37e-3, width=10e-3,
    )  # fmt: skip
    return in_a_cage(bearing, NO_OIL, GRIP, faster(LATE, rpm), {
        "load.radial": "1 N", "cage.model": model,
        "solver.duration": "60 ms", "cage.pocket_diameter": "6.48 mm",
    })  # fmt: skip


def at_an_angle(rpm: float, model: str) -> flexcage.Case:
    """A 7010C under 3 N."""
    return c7010(NO_OIL, GRIP, faster(LATE, rpm), {
        "load.axial": "3 N", "cage.model": model, "solver.duration": "40 ms",
    })  # fmt: skip


def speed_rows(name: str, case: flexcage.Case, of_table: str, factor: float) -> Iterator[Row]:
    """Speeds over the table's times ``factor``; a ball's spin is its roll, without the turning
    about the contact's normal that the table's balls do not have."""
    angle = radians(TABLE[of_table][3])
    cage, spin = (abs(factor) * speed for speed in TABLE[of_table][5:7])
    ds, sense = run_of(case).dataset, np.sign(factor)
    ds = ds.isel(time=slice(3 * ds.sizes["time"] // 4, None))
    orbit = sense * (ds["element_velocity"].sel(cyl="psi") / ds["element_position"].sel(cyl="r"))
    along, across = (sense * ds["element_omega"].sel(spin_axis=c) for c in ("axial", "radial"))
    roll = (orbit - along) * np.cos(angle) + across * np.sin(angle)
    yield Row(f"{name}: balls' orbit", "rpm", cage, float(orbit.mean()) / RPM, ROLLS)
    yield Row(f"{name}: balls' roll in the cage", "rpm", spin, float(roll.mean()) / RPM, ROLLS)
    if not angle:
        found = sense * float(ds["cage_omega"].sel(axis="x").mean())
        yield Row(f"{name}: cage", "rpm", cage, found / RPM, ROLLS)


def rows() -> Iterator[Row]:
    for sense, model, way in (
        (1.0, "rigid", "forwards"),
        (-1.0, "rigid", "backwards"),
        (1.0, "flexible", "flexible cage"),
    ):
        case = without_angle(sense * TABLE["6203"][4], model)
        yield from speed_rows(f"no contact angle, {way}", case, "6203", sense)
        factor = SHARE * sense
        case = at_an_angle(factor * TABLE["7010C at 4000"][4], model)
        yield from speed_rows(f"15 degrees, {way}", case, "7010C at 4000", factor)


CASE: KnownAnswer = KnownAnswer(
    name="ball_epicyclic_run",
    title="Epicyclic run of ball bearings",
    source="speeds of pure rolling as in `kinematics`",
    checks="Traction of 0.3, light load, no resistance and no friction on the cage: a deep groove "
    "bearing at 9000 rpm and a 7010C at 100 rpm, whose rings begin 3 % slower and speed up within "
    "2 ms: their balls come to the epicyclic speeds in orbit and spin, and so does the cage that "
    "the first one's balls strike. "
    "At higher speeds the contact angles of the 7010C part, and the table no longer holds: it is "
    "0.04 % at 400 rpm under this load.",
    rows=rows,
    quick=False,
)
