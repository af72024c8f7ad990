"""A ball bearing at speed finds its contact angles by itself."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from flexcage.bearings import motion_of
from flexcage.case import Case
from flexcage.system.problem import Bearing
from flexcage.system.statics.solution import StaticSolution
from flexcage.verification.ball_bearings import DEGREES, solved
from flexcage.verification.c7010 import NO_OIL, RPM, SMOOTH, bearing_of, c7010, march
from flexcage.verification.cases.ball_speed import FRICTIONLESS
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

DAMPED = {  # inelastic races, so that the start's oscillations die out; a cage out of the way
    "cage.pocket_diameter": "10.4 mm",
    "contacts.race.normal.restitution": 0.1,
    "contacts.race.normal.speed_floor": "0.05 m/s",
    "solver.duration": "0.12 s",
    "output.rate": "10 kHz",
    "output.vibration_rate": "10 kHz",
}
SETTLED = Tolerance(5e-3, "what is left of the start's oscillations; the reference demands 0.5 %")


def rows() -> Iterator[Row]:
    for rpm, cage, expected in FRICTIONLESS:
        case = c7010(SMOOTH, NO_OIL, DAMPED, {"drive.speed": f"{rpm} rpm"})
        bearing = bearing_of(case)
        standing = solved(case.bearing, axial=100.0)
        y, yd = _standing(case, bearing, standing)
        orbit = _orbit(bearing, y, expected, cage * RPM)
        u, rate = bearing.layout.u(y), bearing.layout.q(yd)
        u["elements"][:, 2] = bearing.layout.q(y)["elements"][:, 1] * orbit
        rate["elements"][:, 2] = orbit
        u["omega"][0], rate["quaternion"][1] = cage * RPM, 0.5 * cage * RPM
        ds = march(case, bearing, y, yd).isel(time=slice(-400, None))
        angle, force = (ds[v].mean(("time", "element")) for v in ("contact_angle", "race_force"))
        found = [*(DEGREES * angle.values), *force.values]
        names = ("inner angle", "outer angle", "inner force", "outer force")
        for name, unit, value, reference in zip(
            names, ("deg", "deg", "N", "N"), found, expected, strict=False
        ):
            yield Row(f"{rpm} rpm: {name}", unit, reference, float(value), SETTLED)
        place = 1e6 * float(ds["inner_position"].sel(axis="x").mean())
        yield Row(f"{rpm} rpm: axial displacement", "um", expected[4], place, SETTLED)


def _standing(case: Case, bearing: Bearing, found: StaticSolution) -> tuple[np.ndarray, np.ndarray]:
    """y and y' of balls that roll where a static solution has them."""
    start = motion_of(case.bearing).start(
        bearing, limit_force=0.0, statics=lambda: found, advance=lambda *_: None
    )
    return start.y, start.yd


def _orbit(bearing, y: np.ndarray, expected: tuple[float, ...], wanted: float) -> float:
    """Orbital speed at the start with which balls, pushed out, arrive at the one ``wanted``."""
    model = bearing.data.model
    angle, force = np.radians(expected[1]), expected[3]
    depth = (force / model.outer.normal[0]) ** (2.0 / 3.0)
    reach = model.outer.radius - model.bodies.radius[0] + depth
    there = model.outer.centre + reach * np.cos(angle)
    return float(wanted * (there / bearing.layout.q(y)["elements"][0, 1]) ** 2)


CASE = KnownAnswer(
    name="ball_speed_run",
    title="An angular contact ball bearing in motion at speed",
    source="independent program after A. B. Jones (1960), without friction on the races and with "
    "prescribed cage speed (the same numbers as in `ball_speed`)",
    checks="A 7010C under 100 N, in pockets that are not touched, begins where it would stand "
    "still, its balls orbiting; nothing but centrifugal force and the elastic races move them, and "
    "damping brings them to rest. Mean angles and forces of the last 40 ms, and where the inner "
    "ring is then.",
    rows=rows,
    quick=False,
)
