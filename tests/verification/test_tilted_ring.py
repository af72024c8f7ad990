"""A deep groove bearing's tilt, by energy: what finite rotations make of it, and small ones."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import root
from scipy.special import ellipe, ellipk

from flexcage.verification.bearings import deep_groove, solved
from flexcage.verification.cases.ball_tilt_run import CASES

Z, BALL, PITCH, INNER, OUTER = 7, 11.5, 43.5, 0.52 * 11.5, 0.53 * 11.5  # mm
MODULUS = 210e3 / (1.0 - 0.3**2)  # E' of Hamrock, N/mm^2
PSI = 2.0 * np.pi * np.arange(Z) / Z
LOADS = {0: ((0.0, 0.0), 1000.0), 10: ((1000.0, 1000.0), 0.0)}  # by clearance: N, N mm


def hertz(groove: float, side: float) -> float:
    """K [N/mm^1.5] of a ball in a groove, its axis ratio from the textbook's equation."""
    rx, ry = 0.5 * BALL * (1.0 + side * BALL / PITCH), 1.0 / (2.0 / BALL - 1.0 / groove)
    R = 1.0 / (1.0 / rx + 1.0 / ry)
    difference = R * (1.0 / rx - 1.0 / ry)

    def excess(k):
        E, F = ellipe(1.0 - k**-2), ellipk(1.0 - k**-2)
        return ((k * k + 1.0) * E - 2.0 * F) / ((k * k - 1.0) * E) - difference

    k = float(root(excess, 8.0, tol=1e-13).x[0])
    E, F = ellipe(1.0 - k**-2), ellipk(1.0 - k**-2)
    return np.pi * k * MODULUS * np.sqrt(R * E / (4.5 * F**3))


K_INNER, K_OUTER = hertz(INNER, -1.0), hertz(OUTER, 1.0)


def pressed(axial, radial, touching):
    """Depth (Z,) beyond a distance of centres; of complex numbers too."""
    depth = np.sqrt(axial * axial + radial * radial) - touching
    return np.where(depth.real > 0.0, depth, 0.0)


def energy(unknown, clearance, force, moment, finite):
    """Energy [N mm] of contacts and load; unknown are the ring's x, y, z and its turn about y, z
    [mrad], then x and r [um] of every ball, from the pitch circle."""
    x, y, z = 1e-3 * unknown[:3]
    turn = 1e-3 * unknown[3:5]
    balls = 1e-3 * unknown[5:].reshape(Z, 2)
    apart = INNER + OUTER - BALL - 0.5 * clearance  # of the grooves' centres
    inner = 0.5 * PITCH + apart * (INNER - 0.5 * BALL) / (INNER + OUTER - BALL)
    outer = inner - apart
    r = 0.5 * PITCH + balls[:, 1]
    cos, sin = np.cos(PSI), np.sin(PSI)
    if finite:  # distance of a ball from a circle about the turned axis
        angle = np.sqrt(turn @ turn + 1e-30)
        axis = np.array([np.cos(angle), *(np.sin(angle) / angle * np.array([turn[1], -turn[0]]))])
        away = np.stack([balls[:, 0] - x, r * cos - y, r * sin - z], axis=1)
        along = away @ axis
        across = np.sqrt((away * away).sum(axis=1) - along * along) - inner
    else:  # in each ball's own plane
        along = balls[:, 0] - x + inner * (turn[1] * cos - turn[0] * sin)
        across = r - inner - y * cos - z * sin
    deep = pressed(along, across, INNER - 0.5 * BALL)
    stored = 0.4 * K_INNER * (deep**2.5).sum()
    deep = pressed(balls[:, 0], r - outer, OUTER - 0.5 * BALL)
    stored = stored + 0.4 * K_OUTER * (deep**2.5).sum()
    return stored - force[0] * y - force[1] * x - moment * turn[1]


def equilibrium(clearance, force, moment, *, finite):
    """Radial and axial displacement [um], and tilt [mrad], where the energy is stationary."""

    def slopes(u):
        steps = u + 1e-30j * np.eye(len(u))
        each = [energy(s, clearance, force, moment, finite).imag for s in steps]
        return 1e30 * np.array(each)

    guess = np.zeros(5 + 2 * Z)
    guess[4] = 3.0
    guess[0], guess[1] = 0.146 * force[1], 0.02 * force[0]
    guess[5::2] = 0.5 * (guess[0] - 22.0 * guess[4] * np.cos(PSI))
    guess[6::2] = 0.5 * guess[1] * np.cos(PSI)
    found = root(slopes, guess, method="lm", options={"xtol": 1e-14, "ftol": 1e-14})
    assert np.abs(slopes(found.x)).max() < 1e-5  # of 1 N over 1 um, 1e-3; rounding leaves 1e-6
    return found.x[1], found.x[0], found.x[4]


@pytest.mark.parametrize("case", CASES, ids=["moment", "both loads"])
def test_finite_rotations_give_what_runs_must_give(case):
    clearance, _, expected, _ = case
    found = equilibrium(1e-3 * clearance, *LOADS[clearance], finite=True)
    for value, reference in zip(found, expected):
        if reference is not None:
            assert value == pytest.approx(reference, rel=5e-6)


@pytest.mark.parametrize("case", CASES, ids=["moment", "both loads"])
def test_small_rotations_give_the_static_solution(case):
    clearance, _, _, small = case
    (radial, axial), moment = LOADS[clearance]
    found = equilibrium(1e-3 * clearance, (radial, axial), moment, finite=False)
    solution = solved(
        deep_groove(clearance * 1e-6), radial=radial, axial=axial, moment_z=1e-3 * moment
    )
    assert found[2] == pytest.approx(small, rel=2e-5)
    moved = np.array([1e6, 1e6, 1e3]) * solution.displacement[[1, 0, 4]]
    np.testing.assert_allclose(moved, found, rtol=1e-6, atol=2e-5)  # axially soft
