"""Ball bearings whose races grip: cage and balls take the speeds of pure rolling."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from math import radians
from typing import Any

import numpy as np

from flexcage.case import Case
from flexcage.compiling import build_bearing
from flexcage.stages import assembled_start, cage_mesh, cage_reduction
from flexcage.verification.ball_bearings import deep_groove
from flexcage.verification.c7010 import NO_OIL, RPM, c7010, march
from flexcage.verification.cases.kinematics import TABLE
from flexcage.verification.deep_groove import case_of
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

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
LATE = (0.98, 0.97)  # orbit and spin at the start, over those of rolling
SHARE = 0.025  # of the table's speed at 15 degrees: centrifugal force leaves the contact angles
ROLLS = Tolerance(5e-4, "demanded; loads change the radii of rolling by 1e-4, and traction creeps")


def without_angle(rpm: float, model: str) -> Case:
    """Seven balls without contact angle, preloaded by some newtons, with 5 um of play in their
    pockets: the cage soon goes as they do."""
    ball, pitch, count = TABLE["6203"][:3]
    bearing = replace(
        deep_groove(-1e-6, ball=ball * 1e-3, count=int(count)), pitch_diameter=pitch * 1e-3,
        bore=15e-3, outside_diameter=37e-3, width=10e-3,
    )  # fmt: skip
    return case_of(bearing, NO_OIL, GRIP, {
        "drive.speed": f"{rpm:g} rpm", "load.radial": "1 N", "cage.model": model,
        "solver.duration": "60 ms", "cage.pocket_diameter": "6.48 mm",
    })  # fmt: skip


def at_an_angle(rpm: float, model: str) -> Case:
    """A 7010C under 3 N."""
    return c7010(NO_OIL, GRIP, {
        "drive.speed": f"{rpm:g} rpm", "load.axial": "3 N", "cage.model": model,
        "solver.duration": "40 ms",
    })  # fmt: skip


def started_late(case: Case) -> Any:
    """Run of a case whose cage and balls start too slow; its last quarter."""
    mesh = cage_mesh(case)
    bearing = build_bearing(case, mesh, cage_reduction(case, mesh))
    start = assembled_start(case, bearing)
    layout, y, yd = bearing.layout, start.y.copy(), start.yd.copy()
    orbit, spin = LATE
    for part, names in ((layout.u(y), ("elements", "omega")),
                        (layout.q(yd), ("elements", "quaternion"))):  # fmt: skip
        for name in names:
            part[name][..., :3] *= orbit
        part["elements"][:, 3:] *= spin
    ds = march(case, bearing, y, yd)
    return ds.isel(time=slice(3 * ds.sizes["time"] // 4, None))


def speed_rows(name: str, case: Case, of_table: str, factor: float) -> Iterator[Row]:
    """Speeds over the table's times ``factor``; a ball's spin is its roll, without the turning
    about the contact's normal that the table's balls do not have."""
    angle = radians(TABLE[of_table][3])
    cage, spin = (abs(factor) * speed for speed in TABLE[of_table][5:7])
    ds, sense = started_late(case), np.sign(factor)
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


CASE = KnownAnswer(
    name="ball_epicyclic_run",
    title="Epicyclic run of ball bearings",
    source="speeds of pure rolling as in `kinematics`",
    checks="Traction of 0.3, light load, no resistance and no friction on the cage: a deep groove "
    "bearing at 9000 rpm and a 7010C at 100 rpm, whose balls start 2 % slow in orbit and 3 % in "
    "spin, come to the epicyclic speeds, and so does the cage that the first one's balls strike. "
    "At higher speeds the contact angles of the 7010C part, and the table no longer holds: it is "
    "0.04 % at 400 rpm under this load.",
    rows=rows,
    quick=False,
)
