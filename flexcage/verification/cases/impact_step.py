"""The IMPACT function of ADAMS: its STEP, and the restitution that its damping gives."""

from __future__ import annotations

from collections.abc import Iterator

from flexcage.contacts import laws
from flexcage.contacts.spec import NormalLaw
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance
from flexcage.verification.law_values import normal, strike

STEP = {0.1: 0.028, 0.25: 0.15625, 0.5: 0.5, 0.75: 0.84375, 0.9: 0.972, 1.0: 1.0, 3.0: 1.0}
STIFFNESS, MASS = 8.286e5 * 1e3**1.5, 3.529e-3  # N/m^1.5, kg: a ball of a 7010C
# c_max [N s/mm], depth of full damping [mm], speed [m/s], restitution
TABLE = (
    (828.6, 0.01, 0.05, 0.0717), (828.6, 0.01, 0.2, 0.0179), (828.6, 0.01, 0.5, 0.0072),
    (828.6, 0.01, 1.0, 0.0036), (8286.0, 0.01, 0.05, 0.0138),
    (0.708, 0.01, 0.2, 0.9), (2.818, 0.01, 0.2, 0.7), (6.772, 0.01, 0.2, 0.5),
    (64.8, 0.1, 0.2, 0.9), (260.0, 0.1, 0.2, 0.7), (633.0, 0.1, 0.2, 0.5),
    (10.0, 0.01, 0.2, 0.41), (50.0, 0.01, 0.2, 0.14),
)  # fmt: skip
POLYNOMIAL = Tolerance(1e-12, "a cubic polynomial, to rounding")
PRINTED = Tolerance(6e-4, "damping and restitution are printed to three digits", absolute=True)
SMALL = Tolerance(6e-5, "printed to 1e-4", absolute=True)
SHORT = Tolerance(5.1e-3, "printed to two digits", absolute=True)
FASTER = (0.2, 0.5, 1.0)  # m/s
OVERDAMPED = Tolerance(4e-3, "the first is printed to three digits")


def rows() -> Iterator[Row]:
    depth = 2e-6
    dashpot = NormalLaw(law="impact_step", damping=100.0, full_damping_depth=depth)
    p = laws.normal_parameters(dashpot, 0.0, 1.5)  # no stiffness
    for x, expected in STEP.items():
        found = normal(laws.impact_step, p, [depth * x], [0.25])[0][0] / 25.0
        yield Row(f"STEP at {x:g} of its depth", "", expected, found, POLYNOMIAL)
    for damping, full, speed, expected in TABLE:
        spec = NormalLaw(law="impact_step", damping=1e3 * damping, full_damping_depth=1e-3 * full)
        p = laws.normal_parameters(spec, STIFFNESS, 1.5)
        found = strike(laws.impact_step, p, MASS, speed).restitution
        name = f"e, c_max {damping:g} N s/mm over {full:g} mm, {speed:g} m/s"
        printed = SHORT if damping in (10.0, 50.0) else PRINTED
        yield Row(name, "", expected, found, SMALL if expected < 0.1 else printed)
    spec = NormalLaw(law="impact_step", damping=8.286e6, full_damping_depth=1e-5)
    p = laws.normal_parameters(spec, STIFFNESS, 1.5)
    for speed in FASTER:  # so damped, a ball comes back as fast from any blow
        found = strike(laws.impact_step, p, MASS, speed).restitution
        name = f"e, c_max 8286 N s/mm over 0.01 mm, {speed:g} m/s"
        yield Row(name, "", 0.0138 * 0.05 / speed, found, OVERDAMPED)


CASE = KnownAnswer(
    name="impact_step",
    title="IMPACT with STEP damping",
    source="STEP and IMPACT as documented by ADAMS; restitution by direct integration in an "
    "independent program, for a ball of the 7010C of 'Measurement and Dynamic Analysis of the "
    "Centroid Trajectories of Angular-Contact Ball Bearing Cages'",
    checks="The cubic STEP, and what restitution a c_max really gives: 0.1 % of K, as papers "
    "propose, leaves next to none, and it falls with speed, for 1 % of K in proportion: an "
    "overdamped ball creeps out of the race, whatever speed it came in with.",
    rows=rows,
)
