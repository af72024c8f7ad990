"""Friction against sliding speed: creep below the static peak, dead band, traction curve.

A regularised law creeps: below the static peak a demand is met at the speeds of the table. The ramp
has a dead band: a body slides down any slope, at v0 + r (v1 - v0) where the slope is r times the
friction. The traction curve goes through its three points.

Source: ADAMS static and dynamic friction (cubic steps); Ambrosio's ramp (Lubricants 2025, 13(5),
216); P. K. Gupta, Advanced Dynamics of Rolling Elements (1984), traction curve fitted through rest,
maximum and high speed; numbers from an independent program.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from known_rows import check
from law_values import coefficient, friction
from scipy.integrate import solve_ivp
from scipy.optimize import minimize_scalar

from flexcage.contacts import laws
from flexcage.contacts.spec import DecayFriction, FrictionLaw
from flexcage.verification import Row, Tolerance
from flexcage.verification.cases import roller_statics

STATIC = FrictionLaw(law="step_coulomb", static=0.12, dynamic=0.08, v_static=0.1, v_dynamic=1.0)
RAMP = FrictionLaw(law="ramp_coulomb", dynamic=0.06, v_static=0.01, v_dynamic=0.05)
DECAY = DecayFriction(static=0.15, dynamic=0.02, v_static=1e-3, decay=2.0)
CREEP = {0.134138: 0.2, 0.347296: 0.5, 0.729299: 0.9}  # speed over v_static: mu over mu_static
BEYOND = {0.1: 0.12, 0.55: 0.10, 1.0: 0.08, 7.0: 0.08}  # speed [m/s]: mu
INCLINE = {0.25: 0.02, 0.5: 0.03, 0.9: 0.046}  # slope over mu: v0 + r (v1 - v0) [m/s]
DECAYED = {0.25: 0.098849, 0.5: 0.067824, 2.0: 0.022381}  # 0.02 + 0.13 exp(-2 u)
DEAD_BAND = {0.01: 0.0, 0.02: 0.015, 0.03: 0.03, 0.05: 0.06, 2.0: 0.06}
# peak mu, its speed [m/s], mu at large speed: A, B [s/m], C [s/m]
TRACTION = (
    (0.07, 0.5, 0.02, -0.02, 0.349350, 2.258607),
    (0.05, 0.3, 0.03, -0.03, 0.364488, 4.593632),
    (0.10, 1.0, 0.05, -0.05, 0.229556, 1.278465),
)
SIXTH = Tolerance(5.1e-7, "printed to 1e-6", absolute=True)
CUBIC = Tolerance(4e-6, "the speeds are printed to 1e-6")
EXACT = Tolerance(1e-12, "a polynomial, to rounding", absolute=True)
PRINTED = Tolerance(3e-6, "printed to 1e-6")
STEADY = Tolerance(1e-6, "closed form against an integration with 1e-10")
ROOT = Tolerance(1e-6, "closed form against a search for the maximum")


def rows() -> Iterator[Row]:
    p = laws.friction_parameters(STATIC)
    for x, share in CREEP.items():
        found = coefficient(laws.step_coulomb, p, [0.1 * x])[0] / 0.12
        yield Row(f"step: mu/mu_s at v/v_s = {x}", "", share, found, CUBIC)
    for u, mu in BEYOND.items():
        found = coefficient(laws.step_coulomb, p, [u])[0]
        yield Row(f"step: mu at {u} m/s", "", mu, found, EXACT)
    slope = friction(laws.step_coulomb, p, [0.0])[0][0]
    yield Row("step: slope at rest, 1.5 mu_s/v_s", "s/m", 1.8, slope, EXACT)
    p = laws.friction_parameters(DECAY)
    for u, mu in DECAYED.items():
        found = coefficient(laws.decay_coulomb, p, [u])[0]
        yield Row(f"decay: mu at {u} m/s", "", mu, found, SIXTH)
    p = laws.friction_parameters(RAMP)
    for u, mu in DEAD_BAND.items():
        found = coefficient(laws.ramp_coulomb, p, [u])[0]
        yield Row(f"ramp: mu at {u} m/s", "", mu, found, EXACT)
    for share, speed in INCLINE.items():
        found = speed_on_incline(p, 0.06 * share)
        yield Row(f"ramp: speed down a slope of {share} mu", "m/s", speed, found, STEADY)


def speed_on_incline(p: np.ndarray, slope: float) -> float:
    """Speed [m/s] at which a body from rest slides down a slope in the end; weight 10 m/s^2."""

    def rate(t: float, v: np.ndarray) -> list[float]:
        return [10.0 * (slope - coefficient(laws.ramp_coulomb, p, v)[0])]

    out = solve_ivp(rate, (0.0, 2.0), [0.0], rtol=1e-10, atol=1e-14, max_step=1e-3)
    return float(out.y[0, -1])


def traction_rows(peak: float, speed: float, high: float, abc: list[float]) -> Iterator[Row]:
    found = laws.gupta_coefficients(peak, speed, high)
    for letter, expected, value in zip("ABC", abc, found):
        yield Row(f"traction {peak}/{speed}/{high}: {letter}", "", expected, value, PRINTED)
    spec = FrictionLaw(law="traction", peak=peak, peak_speed=speed, high_speed=high)
    p = laws.friction_parameters(spec)
    top = minimize_scalar(
        lambda u: -coefficient(laws.traction, p, [u])[0], bounds=(0.2 * speed, 5.0 * speed),
        method="bounded", options={"xatol": 1e-9},
    )  # fmt: skip
    yield Row(f"traction {peak}/{speed}/{high}: maximum", "", peak, -top.fun, ROOT)
    far = float(coefficient(laws.traction, p, np.array([60.0 * speed]))[0])
    yield Row(f"traction {peak}/{speed}/{high}: far beyond", "", high, far, ROOT)


def test_coulomb_laws():
    check(rows())


@pytest.mark.parametrize("curve", TRACTION, ids=str)
def test_traction_curves(curve):
    peak, speed, high, *abc = curve
    check(traction_rows(peak, speed, high, abc))


def test_traction_on_the_most_loaded_roller():
    """Of an N1013 under 1000 N at 20 um of clearance, 332 N: 0.02 at 20 m/s."""
    law = FrictionLaw(law="traction", peak=0.05, high_speed=0.02)
    mu = coefficient(laws.traction, laws.friction_parameters(law), [20.0])[0]
    force = roller_statics.solution(roller_statics.bearing(20.0)).largest_force
    short = Tolerance(8e-3, "printed to two digits")
    check([Row("traction", "N", 6.6, float(mu) * force, short)])
