"""The IMPACT function of ADAMS: its STEP, and the restitution that its damping gives.

The cubic STEP, and what restitution a c_max really gives: 0.1 % of K, as papers propose, leaves
next to none, and it falls with speed, for 1 % of K in proportion: an overdamped ball creeps out of
the race, whatever speed it came in with.

Source: STEP and IMPACT as documented by ADAMS; restitution by direct integration in an independent
program, for a ball of the 7010C of 'Measurement and Dynamic Analysis of the Centroid Trajectories
of Angular-Contact Ball Bearing Cages'.
"""

from __future__ import annotations

from collections.abc import Iterator

from known_rows import check
from law_values import normal, strike

from flexcage.contacts import laws
from flexcage.contacts.spec import NormalLaw
from flexcage.verification import Row, Tolerance

STEP = {0.1: 0.028, 0.25: 0.15625, 0.5: 0.5, 0.75: 0.84375, 0.9: 0.972, 1.0: 1.0, 3.0: 1.0}
STIFFNESS, MASS = 8.286e5 * 1e3**1.5, 3.529e-3  # N/m^1.5, kg: a ball of a 7010C
# c_max [N s/mm], depth of full damping [mm], speed [m/s], restitution
TABLE = (
    (828.6, 0.01, 0.05, 0.0717), (828.6, 0.01, 0.2, 0.0179), (828.6, 0.01, 0.5, 0.0072),
    (828.6, 0.01, 1.0, 0.0036), (8286.0, 0.01, 0.05, 0.0138),
    (0.708, 0.01, 0.2, 0.9), (2.818, 0.01, 0.2, 0.7), (6.772, 0.01, 0.2, 0.5),
    (64.8, 0.1, 0.2, 0.9), (260.0, 0.1, 0.2, 0.7), (633.0, 0.1, 0.2, 0.5),
)  # fmt: skip
USUAL = {10.0: 0.41, 50.0: 0.14}  # the same over 0.01 mm at 0.2 m/s
# at 1 % of K a ball comes back as fast from any blow: restitution falls as 1/speed [m/s]
OVERDAMPED = {speed: 0.0138 * 0.05 / speed for speed in (0.2, 0.5, 1.0)}
POLYNOMIAL = Tolerance(1e-12, "a cubic polynomial, to rounding")
PRINTED = Tolerance(6e-4, "damping and restitution are printed to three digits", absolute=True)
SMALL = Tolerance(6e-5, "printed to 1e-4", absolute=True)
SHORT = Tolerance(5.1e-3, "printed to two digits", absolute=True)
THREE_DIGITS = Tolerance(4e-3, "0.0138 is printed to three digits")


def restitution(damping: float, full: float, speed: float) -> float:
    """Restitution under c_max [N s/mm] that is full at a depth [mm], at a speed [m/s]."""
    spec = NormalLaw(law="impact_step", damping=1e3 * damping, full_damping_depth=1e-3 * full)
    p = laws.normal_parameters(spec, STIFFNESS, 1.5)
    return strike(laws.impact_step, p, MASS, speed).restitution


def rows() -> Iterator[Row]:
    depth = 2e-6
    dashpot = NormalLaw(law="impact_step", damping=100.0, full_damping_depth=depth)
    p = laws.normal_parameters(dashpot, 0.0, 1.5)  # no stiffness
    for x, expected in STEP.items():
        found = normal(laws.impact_step, p, [depth * x], [0.25])[0][0] / 25.0
        yield Row(f"STEP at {x:g} of its depth", "", expected, found, POLYNOMIAL)
    for damping, full, speed, expected in TABLE:
        found = restitution(damping, full, speed)
        name = f"e, c_max {damping:g} N s/mm over {full:g} mm, {speed:g} m/s"
        yield Row(name, "", expected, found, SMALL if expected < 0.1 else PRINTED)
    for damping, expected in USUAL.items():
        name = f"e, c_max {damping:g} N s/mm over 0.01 mm, 0.2 m/s"
        yield Row(name, "", expected, restitution(damping, 0.01, 0.2), SHORT)
    for speed, expected in OVERDAMPED.items():
        name = f"e, c_max 8286 N s/mm over 0.01 mm, {speed:g} m/s"
        yield Row(name, "", expected, restitution(8286.0, 0.01, speed), THREE_DIGITS)


def test_impact_with_step_damping():
    check(rows())
