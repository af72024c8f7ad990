"""A ball bearing at speed finds its contact angles by itself."""

from __future__ import annotations

from collections.abc import Iterator

from flexcage.verification.bearings import DEGREES, RPM
from flexcage.verification.cases.ball_speed import FRICTIONLESS
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance
from flexcage.verification.runs import NO_OIL, SMOOTH, c7010, run_of

DAMPED = {  # inelastic races, so that oscillations die out; a cage out of the way
    "cage.pocket_diameter": "10.4 mm",
    "contacts.race.normal.restitution": 0.1,
    "contacts.race.normal.speed_floor": "0.05 m/s",
    "solver.duration": "0.12 s",
    "output.rate": "10 kHz",
    "output.vibration_rate": "10 kHz",
}
MORE_LOAD = {  # the start is in equilibrium under the first load, with other angles
    "load.varies": "axial",
    "load.axial": "60 N",
    "load.ramp_to": "100 N",
    "load.ramp_time": "1 ms",
}
# by the reference's speed [rpm]: the ring's, with which balls begin an orbit that ends as the
# reference prescribes; without friction the ring does nothing else
RING = {4000: 3994.16, 10000: 9930.33}
SETTLED = Tolerance(5e-3, "what is left of oscillations; the reference demands 0.5 %")
ORBIT = Tolerance(1e-4, "set by the ring's speed at the start")


def rows() -> Iterator[Row]:
    names = (("inner angle", "deg"), ("outer angle", "deg"),
             ("inner force", "N"), ("outer force", "N"))  # fmt: skip
    for rpm, cage, expected in FRICTIONLESS:
        speed = {"drive.speed": f"{RING[rpm]} rpm"}
        end = run_of(c7010(SMOOTH, NO_OIL, DAMPED, MORE_LOAD, speed)).dataset
        end = end.isel(time=slice(-400, None))
        angle, force = (end[v].mean(("time", "element")) for v in ("contact_angle", "race_force"))
        found = (*(DEGREES * angle.values), *force.values)
        for (name, unit), reference, value in zip(names, expected, found):
            yield Row(f"{rpm} rpm: {name}", unit, reference, float(value), SETTLED)
        place = 1e6 * float(end["inner_position"].sel(axis="x").mean())
        yield Row(f"{rpm} rpm: axial displacement", "um", expected[4], place, SETTLED)
        orbit = end["element_velocity"].sel(cyl="psi") / end["element_position"].sel(cyl="r")
        yield Row(f"{rpm} rpm: balls' orbit", "rpm", cage, float(orbit.mean()) / RPM, ORBIT)


CASE: KnownAnswer = KnownAnswer(
    name="ball_speed_run",
    title="An angular contact ball bearing in motion at speed",
    source="independent program after A. B. Jones (1960), without friction on the races and with "
    "prescribed cage speed (the same numbers as in `ball_speed`)",
    checks="A 7010C in pockets that are not touched begins in equilibrium under 60 N; in a "
    "millisecond the load grows to 100 N. Nothing but centrifugal force, the load and the elastic "
    "races move the balls, and damping brings them to rest. The ring turns 0.1 and 0.7 % slower "
    "than named, so that balls end in the orbit prescribed. Mean angles and forces of the last 40 "
    "ms, and where the inner ring is then.",
    rows=rows,
    quick=False,
)
