"""The integrator: order, drift, dense output, quadratures, work, outcomes, on known solutions."""

from __future__ import annotations

import numpy as np
import pytest
from dae_problems import Oscillator, Pendulum, functions, plain, run

from flexcage.solve.contract import OUTCOMES


@pytest.fixture(scope="module")
def bdf():
    return plain("bdf")


@pytest.fixture(scope="module")
def pendulum():
    return Pendulum()


def fixed_steps(problem, order, steps, end, integral=None):
    """Errors at the end of y (n,) and of an integral (1,) that is known over time: with one order
    and one step size, started from exact values."""
    bdf = plain("bdf")
    bdf._choose = lambda *_: None
    bdf.NEWTON_MAX = 12
    h, integrals = end / steps, [integral] if integral else []
    st = bdf.new_state(
        0.0, problem.exact(0.0), problem.rate(0.0), weight=problem.tested, h0=h,
        quad_weight=[0.0] * len(integrals),
    )  # fmt: skip
    for table, exact in (
        (st.D, problem.exact),
        (st.Q, lambda t: np.array([f(t) for f in integrals])),
    ):
        values = np.array([exact(-h * j) for j in range(order + 1)])
        for j in range(order + 1):
            table[j] = values[0]
            values = values[:-1] - values[1:]
    st.count[bdf.ORDER], st.count[bdf.BEGUN] = order, 1
    options = bdf.BDFOptions(order, 10.0, 0.0, 1e-12, 10**6)
    one, quads = np.zeros((1, problem.n)), np.zeros((1, len(integrals)))
    log = np.zeros((steps + 2, 5))
    outcome, _, rows = bdf.advance(
        functions(problem), None, st, options, end, np.array([end]), one, one.copy(), 0, log, quads
    )
    assert outcome == bdf.DONE and rows == steps and st.count[bdf.ERROR_FAILS] == 0
    wrong = np.array([st.quad[0] - integral(end)]) if integral else np.zeros(0)
    return (st.D[0] - problem.exact(end))[problem.tested > 0], wrong


@pytest.mark.parametrize("order", [1, 2, 3, 4, 5])
def test_order_on_an_oscillator(order):
    steps = [100, 200, 400]
    errors = [np.abs(fixed_steps(Oscillator(), order, n, 2.0)[0]).max() for n in steps]
    slopes = np.log2(np.array(errors[:-1]) / errors[1:])
    assert slopes[-1] == pytest.approx(order, abs=0.1)


@pytest.mark.parametrize("order", [1, 2, 3, 4, 5])
def test_order_on_a_constrained_pendulum(pendulum, order):
    """Stabilised index 2: the differential variables keep the formula's order."""
    steps = [100, 200] if order > 3 else [200, 400]
    errors = [np.abs(fixed_steps(pendulum, order, n, 0.5)[0]).max() for n in steps]
    assert np.log2(errors[0] / errors[1]) == pytest.approx(order, abs=0.25)


@pytest.mark.parametrize("max_order", [1, 2, 3, 5])
def test_error_follows_the_tolerance(bdf, pendulum, max_order):
    errors, steps = [], []
    for tolerance in (1e-4, 1e-6) if max_order == 1 else (1e-5, 1e-7):
        outcome, st, _, ys, _, _ = run(bdf, pendulum, tolerance=tolerance, max_order=max_order)
        assert outcome == bdf.DONE
        errors.append(np.abs(ys[-1, :4] - pendulum.exact(2.0)[:4]).max())
        steps.append(st.count[bdf.STEPS])
    # error ~ steps^-order; above order 2 the guard against oscillation holds it back at times
    slope = np.log(errors[0] / errors[1]) / np.log(steps[1] / steps[0])
    assert slope > 0.7 * min(max_order, 3)
    assert errors[1] < 2e-2 if max_order == 1 else errors[1] < 3e-3


@pytest.mark.parametrize("max_order", [1, 2, 5])
def test_constraints_hold_at_the_tolerance(bdf, pendulum, max_order):
    """On position and velocity level alike, over some swings: no drift."""
    times = np.linspace(0.01, 6.0, 200)
    for tolerance in (1e-4, 1e-5):
        outcome, _, _, ys, _, _ = run(
            bdf, pendulum, tolerance=tolerance, max_order=max_order, times=times, end=6.0
        )
        assert outcome == bdf.DONE
        assert max(pendulum.violation(y) for y in ys) < 15 * tolerance


@pytest.mark.parametrize("max_order", [1, 2, 4])
def test_dense_output_is_as_good_as_the_steps(bdf, max_order):
    problem = Oscillator(w=3.0, z=0.05)
    times = np.linspace(0.003, 1.99, 211)
    _, st, log, ys, yds, _ = run(
        bdf, problem, tolerance=1e-6 if max_order > 1 else 1e-5, max_order=max_order, times=times
    )
    at_steps = np.interp(times, log[:, 0], log[:, 0])  # all inside
    assert at_steps[0] >= log[0, 0] or log[0, 1] < 1e-3
    exact = np.array([problem.exact(t) for t in times])
    error = np.abs(ys[:-1] - exact).max()
    end = np.abs(ys[-1] - problem.exact(2.0)).max()
    assert error < 4 * end + 2e-4
    rates = np.array([problem.rate(t) for t in times])
    assert np.abs(yds[:-1] - rates).max() < (0.4 if max_order == 1 else 0.05)


@pytest.mark.parametrize("order", [1, 2, 3, 4, 5])
def test_change_of_step_is_exact_on_polynomials(bdf, order):
    """Differences of a polynomial at the new step, computed afresh."""
    rng = np.random.default_rng(order)
    c = rng.normal(size=(order + 1, 3))

    def value(t):
        return sum(c[j] * t**j for j in range(order + 1))

    def differences(h):
        v = [value(0.7 - h * j) for j in range(order + 1)]
        out = []
        for _ in range(order + 1):
            out.append(v[0])
            v = [a - b for a, b in zip(v[:-1], v[1:])]
        return np.array(out)

    for ratio in (0.25, 0.9, 1.5, 8.0):
        D, Q = np.zeros((8, 3)), np.zeros((8, 1))
        D[: order + 1] = differences(0.1)
        Q[:] = D[:, 1:2]
        bdf.change_step(D, Q, order, ratio)
        np.testing.assert_array_equal(Q, D[:, 1:2])
        np.testing.assert_allclose(
            D[: order + 1], differences(0.1 * ratio), atol=1e-10 * ratio**order
        )
        y, yd = np.empty(3), np.empty(3)
        time = 0.7 - 0.37 * 0.1 * ratio
        bdf.interpolate(D, order, 0.7, 0.1 * ratio, time, y, yd)
        np.testing.assert_allclose(y, value(time), atol=1e-10)
        rate = sum(j * c[j] * time ** (j - 1) for j in range(1, order + 1))
        np.testing.assert_allclose(yd, rate, atol=1e-8)


@pytest.mark.parametrize("order", [1, 2, 3, 4, 5])
def test_integrals_have_the_order_of_the_formula(order):
    """Energy lost in the damper of an oscillator against the energy that is left."""
    problem, end = Oscillator(w=3.0, z=0.3), 1.0

    def lost(t):
        return -energy(problem, problem.exact(t))

    coarse, fine = (fixed_steps(problem, order, n, end, lost)[1] for n in (100, 200))
    misses = np.abs(np.concatenate([coarse, fine]))
    assert np.log2(misses[0] / misses[1]) == pytest.approx(order, abs=0.2)


def energy(problem, y):
    return 0.5 * y[1] ** 2 + 0.5 * problem.w**2 * y[0] ** 2


@pytest.mark.parametrize("order", [1, 2, 5])
def test_a_constant_force_does_its_work_along_the_motion(order):
    """Whatever y misses by long steps beside a fast swing, the work of a force is the force times
    the displacement: an integral of the velocity is wrong by as much as the position."""
    problem = Oscillator(w=30.0, z=0.2)
    problem.power = lambda t, y, yd: np.array([1e3 * y[1]])
    problem.powers = lambda t, y, power: power.__setitem__(0, 1e3 * y[1])
    of_y, of_work = fixed_steps(problem, order, 240, 1.0, lambda t: 1e3 * problem.exact(t)[0])
    assert abs(of_y[0]) > 1e-8
    np.testing.assert_allclose(of_work, 1e3 * of_y[:1], rtol=1e-4)


def test_losses_are_second_order_and_never_shrink(bdf):
    """At steps and between them, also where what is lost stops at once, as a contact's does."""
    problem, misses = Oscillator(w=5.0, z=0.1), []
    problem.losses, times = True, np.linspace(0.11, 1.9, 371)
    for h_max in (4e-3, 2e-3):
        qs = run(bdf, problem, tolerance=1e-9, h_max=h_max, max_order=5, times=times, quads=1)[5]
        lost = [energy(problem, problem.exact(t)) for t in (0.0, *times, 2.0)]
        misses.append(np.abs(qs[:, 0] - (lost[0] - np.array(lost[1:]))).max())
    assert misses[1] < 1e-4 * lost[0]
    assert misses[0] / misses[1] == pytest.approx(4.0, rel=0.3)
    problem.power = lambda t, y, yd: np.array([max(y[0], 0.0) ** 1.5])
    qs = run(bdf, problem, tolerance=1e-3, times=times, quads=1)[5]
    assert np.diff(qs[:, 0]).min() >= 0.0


@pytest.mark.parametrize(
    ("losses", "tolerance", "bounds"),
    [(True, 1e-8, (np.inf, 1e-6, 1e-8)), (False, 1e-4, (np.inf, 1e-5, 1e-6))],
)
def test_the_error_of_integrals_is_controlled(bdf, losses, tolerance, bounds):
    """A step is held to what each may miss, where y alone would allow longer ones."""
    problem, misses, steps = Oscillator(w=5.0, z=0.1), [], []
    problem.losses = losses
    for allowed in bounds:
        out = run(
            bdf, problem, tolerance=tolerance, h_max=0.1, max_order=5, quads=1,
            quad_weight=1.0 / allowed,
        )  # fmt: skip
        lost = energy(problem, problem.exact(0.0)) - energy(problem, problem.exact(2.0))
        misses.append(abs(out[5][-1, 0] - lost))
        steps.append(out[1].count[bdf.STEPS])
    assert misses[1] < 0.3 * misses[0] and misses[2] < misses[1]
    assert misses[2] < 0.3 * misses[1] or not losses  # y's own error is in it as well
    assert misses[1] < bounds[1] * steps[1] and steps[0] < steps[1] < steps[2]


def test_every_accepted_step_is_settled_once(bdf):
    """With the accepted y, and no other: the last of them is the end."""
    problem = Oscillator(w=5.0, z=0.1)
    problem.power = lambda t, y, yd: np.array([1.0 if y[0] > 0.0 else 0.0])  # steps fail at jumps
    out = run(bdf, problem, tolerance=1e-6, max_order=5, quads=1, quad_weight=1e5)
    times = [t for t, _ in problem.settled]
    assert times[0] == 0.0 and out[1].count[bdf.ERROR_FAILS] > 0
    np.testing.assert_array_equal(times[1:], out[2][:, 0])
    np.testing.assert_allclose(problem.settled[-1][1], out[1].D[0], rtol=1e-14)


def test_a_jump_of_a_power_says_nothing_of_y(bdf):
    """It shortens steps, and neither lowers the order nor moves y."""
    problem, jumping = Oscillator(w=5.0, z=0.1), Oscillator(w=5.0, z=0.1)
    jumping.power = lambda t, y, yd: np.array([1.0 if y[0] > 0.0 else 0.0])
    free = run(bdf, problem, tolerance=1e-8, max_order=5, quads=1)
    held = run(bdf, jumping, tolerance=1e-8, max_order=5, quads=1, quad_weight=1e5)
    assert held[1].count[bdf.ERROR_FAILS] > free[1].count[bdf.ERROR_FAILS]
    assert held[1].count[bdf.STEPS] < 3 * free[1].count[bdf.STEPS]
    exact = problem.exact(2.0)
    assert np.abs(held[3][-1] - exact).max() < 5 * np.abs(free[3][-1] - exact).max() + 1e-6
    assert held[2][:, 2].max() > 2


def test_work_is_modest(bdf, pendulum):
    """Few Jacobians, hardly more than one residual a step: what modified Newton is for."""
    _, st, log, _, _, _ = run(bdf, pendulum, tolerance=1e-6, max_order=5)
    steps = st.count[bdf.STEPS]
    assert steps < 1600 and len(log) == steps
    assert st.count[bdf.RESIDUALS] < 1.5 * steps
    assert st.count[bdf.JACOBIANS] < 0.1 * steps
    np.testing.assert_allclose(np.diff(log[:, 0]), log[1:, 1], atol=1e-14)
    assert log[-1, 0] == 2.0 and log[:, 1].max() <= 0.1 and set(log[:, 2]) <= {1, 2, 3, 4, 5}


def test_largest_step_is_kept_to(bdf):
    log = run(bdf, Oscillator(), tolerance=1e-2, h_max=7e-3)[2]
    assert log[:, 1].max() <= 7e-3 * (1 + 1e-12)


def test_full_log_loses_nothing(bdf, pendulum):
    """Interrupted when the log is full and taken up again: the same to the last bit."""
    whole = run(bdf, pendulum, tolerance=1e-5, times=[0.5, 1.1])
    parts = run(bdf, pendulum, tolerance=1e-5, times=[0.5, 1.1], log_rows=7)
    for a, b in zip(whole[2:], parts[2:]):
        assert np.array_equal(a, b)


def test_outcomes_name_what_to_change(bdf, pendulum):
    assert run(bdf, pendulum, tolerance=1e-6, max_steps=20)[0] == bdf.TOO_MANY
    assert run(bdf, pendulum, tolerance=1e-12, h_min=1e-4, h0=1e-3)[0] == bdf.TOO_SMALL

    class Breaks(Oscillator):
        def F(self, t, y, yd):
            return super().F(t, y, yd) * (np.nan if t > 0.3 else 1.0)

    outcome, st, *_ = run(bdf, Breaks(), tolerance=1e-4)
    assert outcome == bdf.NOT_FINITE and st.real[bdf.T] <= 0.3
    for code in (bdf.TOO_SMALL, bdf.TOO_MANY, bdf.NOT_FINITE):
        assert "solver." in OUTCOMES[code] or "inputs" in OUTCOMES[code]


def test_lightly_damped_fast_oscillation_stays_bounded(bdf):
    """High orders are unstable near the imaginary axis; the guard and the error test bound them."""

    class Forced(Oscillator):
        """A slow force on a fast, lightly damped oscillator, which a first jolt has set off."""

        def F(self, t, y, yd):
            f = super().F(t, y, yd)
            f[1] -= self.w**2 * np.sin(t)
            return f

    problem = Forced(w=300.0, z=1e-3)
    for max_order in (2, 5):
        _, st, _, ys, _, _ = run(
            bdf, problem, tolerance=1e-2, max_order=max_order, end=1.0, h_max=0.05,
            times=np.linspace(0.05, 0.95, 40),
        )  # fmt: skip
        assert np.abs(ys[:, 0]).max() < 2.5
