"""Balls at speed: centrifugal force and gyroscopic moment part the contact angles."""

from __future__ import annotations

from collections.abc import Iterator

from flexcage import StaticSolution
from flexcage.spec import StaticOptions
from flexcage.verification.bearings import RPM, angles, preset, solved
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance

# 7010C-PI under 100 N without friction: speed [rpm], prescribed cage speed [rpm]; angles [deg] and
# forces [N] at inner and outer race, axial displacement [um]
FRICTIONLESS = (
    (4000, 1720.845, (17.0677, 14.2845, 18.9286, 22.5161, 5.8347)),
    (10000, 4369.292, (20.9261, 8.2012, 15.5547, 38.9454, -3.8115)),
)
# under outer race control: preset, load [N], speed; and the cage speed [rpm] as well
CONTROLLED = (
    ("7010C-PI", 100, 4000, (16.5698, 14.8838, 19.4807, 23.0665, 6.2747, 1719.466)),
    ("7010C-PI", 100, 7000, (18.0985, 13.0993, 17.8835, 28.9770, 5.1565, 3018.232)),
    ("7010C-PI", 100, 10000, (19.8114, 10.6191, 16.3917, 39.4558, 1.8091, 4338.532)),
    ("7010C-PI", 100, 11000, (20.3147, 9.7624, 16.0021, 44.1153, 0.2694, 4784.627)),
    ("7010C-PA66", 1500, 8000, (19.0380, 18.5334, 255.4708, 266.6458, 33.2416, 3491.753)),
    ("7010C-PA66", 5000, 10000, (22.0207, 21.7026, 740.8577, 758.0679, 61.6395, 4376.910)),
)
# 7010C-PI, 100 N: speed: centrifugal force [N], gyroscopic moment [N mm], friction at outer race
INERTIA = {
    4000: (3.7190, 1.8197, 0.0166), 7000: (11.4597, 4.9472, 0.0358),
    10000: (23.6802, 8.3116, 0.0442), 11000: (28.8009, 9.3015, 0.0443),
}  # fmt: skip
PRINTED = Tolerance(2e-4, "printed to four digits or more; 0.5 % is demanded")
FRICTION = Tolerance(5.1e-5, "printed to four decimals", absolute=True)
NAMES = (
    ("inner angle", "deg"), ("outer angle", "deg"), ("inner force", "N"), ("outer force", "N"),
    ("axial displacement", "um"), ("cage speed", "rpm"),
)  # fmt: skip


def found(solution: StaticSolution) -> tuple[float, ...]:
    """What ``NAMES`` lists, of the first ball: all are alike under axial load."""
    e = solution.elements
    return (
        *angles(solution)[0], *e.force[0], 1e6 * solution.displacement[0],
        e.orbital_speed[0] / RPM,
    )  # fmt: skip


def rows() -> Iterator[Row]:
    for rpm, cage, without in FRICTIONLESS:
        options = StaticOptions(gyroscopic="none", cage_speed=cage * RPM)
        solution = solved(preset("7010C-PI"), rpm=rpm, options=options, axial=100.0)
        for (name, unit), reference, value in zip(NAMES, without, found(solution)):
            yield Row(f"without friction, {rpm} rpm: {name}", unit, reference, value, PRINTED)
    for preset_name, force, rpm, expected in CONTROLLED:
        solution = solved(preset(preset_name), rpm=rpm, axial=force)
        where = f"{preset_name}, {force} N, {rpm} rpm"
        for (name, unit), reference, value in zip(NAMES, expected, found(solution)):
            yield Row(f"{where}: {name}", unit, reference, value, PRINTED)
        if preset_name == "7010C-PI":
            yield from _inertia(where, solution, INERTIA[rpm])


def _inertia(
    where: str, solution: StaticSolution, expected: tuple[float, float, float]
) -> Iterator[Row]:
    e, (push, moment, friction) = solution.elements, expected
    yield Row(f"{where}: centrifugal force", "N", push, e.centrifugal[0], PRINTED)
    yield Row(f"{where}: gyroscopic moment", "N mm", moment, 1e3 * e.gyroscopic[0], PRINTED)
    asked = e.friction[0, 1]
    yield Row(f"{where}: friction asked of the outer race", "", friction, asked, FRICTION)


CASE: KnownAnswer = KnownAnswer(
    name="ball_speed",
    title="Angular contact ball bearings at speed",
    source="independent program after A. B. Jones (1960) and T. A. Harris, Rolling Bearing "
    "Analysis: outer race control, and a form without friction on the races whose cage speed is "
    "prescribed",
    checks="Contact angles and forces at both races, axial displacement, which turns negative as "
    "balls press outwards, cage speed, centrifugal force, gyroscopic moment, and the friction that "
    "it asks of the outer race: more than many lubricants give, so that balls would skid.",
    rows=rows,
)
