"""Steps whose stored energy grows by other than their powers are repeated, shorter."""

from __future__ import annotations

import numpy as np
import pytest
from dae_problems import Oscillator, functions, plain

from flexcage.solve import contract

ALLOWED = 1e-4  # J


@pytest.fixture(scope="module")
def method():
    return plain("runge_kutta")


class Ramp:
    """A mass in a valley with straight sides, whose force jumps at the bottom, and in a damper that
    takes ``drag`` per speed; ``false``: of its energy that the report makes up."""

    def __init__(self, jump=20.0, drag=0.05, false=0.0):
        self.jump, self.drag, self.false, self.evaluations = jump, drag, false, 0

    def energy(self, y):
        return 0.5 * y[1] ** 2 + self.jump * abs(y[0]) + self.false * y[0] * np.sin(30.0 * y[0])

    def functions(self):
        def rates(t, y, yd, data, power):
            self.evaluations += 1
            yd[:] = y[1], -self.jump * np.sign(y[0]) - self.drag * y[1]
            power[0] = -self.drag * y[1] ** 2
            if len(power) > 1:
                power[1] = self.energy(y)

        return rates, lambda t, y, data: None, lambda *_: None, lambda sample, data: True


class Smooth(Ramp):
    """The same in a round valley."""

    def energy(self, y):
        return 0.5 * y[1] ** 2 + 2.0 * y[0] ** 2

    def functions(self):
        _, *others = super().functions()

        def rates(t, y, yd, data, power):
            yd[:] = y[1], -4.0 * y[0] - self.drag * y[1]
            power[0] = -self.drag * y[1] ** 2
            if len(power) > 1:
                power[1] = self.energy(y)

        return rates, *others


def run(method, problem, *, leak, tolerance=1e-3, end=2.0):
    """Allowed errors of y so large that they ask for no short steps at the jump."""
    y0 = np.array([0.3, 0.0])
    st = method.new_state(
        0.0, y0, 0.0 * y0, weight=np.full(2, 1.0 / tolerance), h0=1e-3, quad_weight=[0.0],
        leak_weight=1.0 / leak if leak else 0.0,
    )  # fmt: skip
    log, quads, nothing = np.zeros((200_000, 5)), np.zeros((1, 1)), np.zeros((1, 2))
    outcome, _, rows = method.advance(
        problem.functions(), None, st, method.Options(0.01, 1e-14, 10**6), end,
        np.array([end]), nothing, nothing.copy(), 0, log, quads,
    )  # fmt: skip
    assert outcome == contract.DONE
    gained = problem.energy(st.y) - problem.energy(y0) - st.quad[0]
    return st, abs(gained), log[:rows]


def test_a_force_that_jumps_within_a_step_takes_no_energy(method):
    crossings = 6
    loose = run(method, Ramp(), leak=0.0, tolerance=0.1)
    tight = run(method, Ramp(), leak=ALLOWED, tolerance=0.1)
    assert loose[1] > 1e-2
    assert tight[1] < 2 * crossings * ALLOWED
    fails = tight[0].count[contract.ERROR_FAILS] - loose[0].count[contract.ERROR_FAILS]
    assert 0 < fails < 20 * crossings  # each is found within a few repetitions
    assert len(tight[2]) < len(loose[2]) + 20 * crossings


def test_steps_that_miss_no_energy_stay_as_they_were_to_the_bit(method):
    loose, tight = (run(method, Smooth(), leak=leak, tolerance=1e-7) for leak in (0.0, ALLOWED))
    np.testing.assert_array_equal(loose[0].y, tight[0].y)
    np.testing.assert_array_equal(loose[2], tight[2])


def test_a_force_without_an_energy_does_not_stop_the_run(method):
    """What no step removes shortens steps to a share of the longest, and the balance says so."""
    honest, wrong = (run(method, Ramp(false=false), leak=ALLOWED) for false in (0.0, 5.0))
    assert wrong[1] > 100.0 * honest[1]
    tried = wrong[0].count[contract.STEPS] + wrong[0].count[contract.ERROR_FAILS]
    before = honest[0].count[contract.STEPS] + honest[0].count[contract.ERROR_FAILS]
    assert tried < 40 * before


class Jump(Ramp):
    """A valley whose stored energy jumps with the sense of motion: no step of any length misses
    less."""

    def energy(self, y):
        return super().energy(y) + (0.5 if y[1] > 0.0 else 0.0)


def test_an_energy_that_jumps_ends_no_run(method):
    st, missed, _ = run(method, Jump(), leak=ALLOWED)
    assert missed > 0.1 or st.y[1] < 0.0
    assert st.count[contract.STEPS] + st.count[contract.ERROR_FAILS] < 2000


class Swing(Oscillator):
    """A lightly damped oscillator beside a slow one; integrals: losses, behind them the energy."""

    losses = True

    def power(self, t, y, yd):
        stored = 0.5 * y[1] ** 2 + 0.5 * self.w**2 * y[0] ** 2
        return np.array([-2.0 * self.z * self.w * y[1] ** 2, stored])


@pytest.mark.parametrize("leak", [0.0, 1e-5])
def test_the_implicit_method_keeps_what_swings_faster_than_its_steps(leak):
    """Steps that an error allowed in y makes a fifth of a swing long lose most of its energy; by
    the energy's test no step loses more than it may."""
    bdf, problem = plain("bdf"), Swing(w=100.0, z=1e-3)
    y0, yd0 = problem.exact(0.0), problem.rate(0.0)
    st = bdf.new_state(
        0.0, y0, yd0, weight=np.array([10.0, 0.1]), h0=1e-6, quad_weight=[0.0],
        leak_weight=1.0 / (leak * 5e3) if leak else 0.0,
    )  # fmt: skip
    log, quads, nothing = np.zeros((200_000, 5)), np.zeros((1, 1)), np.zeros((1, 2))
    outcome, _, rows = bdf.advance(
        functions(problem), None, st, bdf.Options(2, 0.02, 1e-14, 0.3, 10**6), 0.5,
        np.array([0.5]), nothing, nothing.copy(), 0, log, quads,
    )  # fmt: skip
    assert outcome == contract.DONE
    begun, left = problem.power(0.0, y0, yd0)[1], problem.power(0.5, st.D[0], yd0)[1]
    lost = abs(left - begun - st.quad[0]) / begun
    assert lost > 0.2 if not leak else lost < rows * leak
