"""The explicit integrator: order, error control, dense output, quadratures, stability, outcomes."""

from __future__ import annotations

import numpy as np
import pytest
from dae_problems import plain

from flexcage.solve import contract


@pytest.fixture(scope="module")
def method():
    return plain("runge_kutta")


class Pendulum:
    """y'' = -sin y + 0.3 cos 2t, with the work of its forcing; a third entry is held at cos t."""

    n = 3
    tested = np.array([1.0, 1.0, 0.0])

    def __init__(self):
        self.evaluations, self.accepted, self.samples = 0, [], []

    def functions(self):
        def rates(t, y, yd, data, power):
            self.evaluations += 1
            y[2] = np.cos(t)
            yd[:] = y[1], -np.sin(y[0]) + 0.3 * np.cos(2.0 * t), 0.0
            power[:] = (0.3 * np.cos(2.0 * t) * y[1])[..., None][: len(power)]

        def note(t, y, data):
            self.accepted.append(t)

        def sample(sample, t, y, yd, data):
            self.samples.append(t)

        return rates, note, sample, lambda sample, data: True

    def energy(self, y):
        return 0.5 * y[1] ** 2 - np.cos(y[0])


def run(method, problem, *, tolerance, end=5.0, h0=1e-3, h_max=1.0, h_min=1e-12, times=(),
        y0=(0.5, 0.0, 1.0), max_steps=100_000, log_rows=100_000, quad_weight=0.0):  # fmt: skip
    y0 = np.array(y0, float)
    st = method.new_state(
        0.0, y0, 0.0 * y0, weight=problem.tested / tolerance, h0=h0, quad_weight=[quad_weight]
    )
    times = np.append(np.asarray(times, float), end)
    ys, yds, quads = np.zeros((len(times), len(y0))), np.zeros((len(times), len(y0))), None
    quads = np.zeros((len(times), 1))
    log, first, rows = np.zeros((log_rows, 5)), 0, []
    options = method.RungeKuttaOptions(h_max, h_min, max_steps)
    while True:
        outcome, first, filled = method.advance(
            problem.functions(), None, st, options, end, times, ys, yds, first, log, quads
        )
        rows.append(log[:filled].copy())
        if outcome != contract.LOG_FULL:
            return outcome, st, np.concatenate(rows), ys, yds, quads


@pytest.fixture(scope="module")
def exact(method):
    return run(method, Pendulum(), tolerance=1e-13)[1].y


def fixed(method, steps, times=()):
    """With steps of one length: no error is ever too large."""
    h = 5.0 / steps
    return run(method, Pendulum(), tolerance=1e9, h0=h, h_max=h, times=times)


def test_order_four(method, exact):
    errors = [np.abs(fixed(method, n)[1].y - exact)[:2].max() for n in (50, 100, 200)]
    assert np.log2(np.array(errors[:-1]) / errors[1:]) == pytest.approx(4.0, abs=0.2)


def test_quadratures_have_the_order_of_the_solution(method):
    """Work of the forcing, which is the energy gained."""
    fine = run(method, Pendulum(), tolerance=1e-13)[1]
    start = Pendulum().energy(np.array([0.5, 0.0]))
    assert fine.quad[0] == pytest.approx(Pendulum().energy(fine.y) - start, abs=1e-10)
    misses = [abs(fixed(method, n)[1].quad[0] - fine.quad[0]) for n in (100, 200, 400)]
    assert np.log2(np.array(misses[:-1]) / misses[1:]) == pytest.approx(4.0, abs=0.5)


def test_the_error_of_integrals_is_controlled(method):
    """Where y alone would allow steps of any length, the integral asks for those that it needs."""
    exact = run(method, Pendulum(), tolerance=1e-13)[1].quad[0]
    misses, steps = [], []
    for allowed in (1e-6, 1e-8):
        found = run(method, Pendulum(), tolerance=1e9, quad_weight=1.0 / allowed)[1]
        misses.append(abs(found.quad[0] - exact))
        steps.append(found.count[contract.STEPS])
    assert misses[0] < 1e-6 * steps[0] and misses[1] < 1e-8 * steps[1]
    assert 10 < 2 * steps[0] < steps[1]


def test_dense_output_is_of_order_three_or_more(method):
    """y, y' and the integral between the points, against a run that has points there."""
    times = np.linspace(0.313, 4.7, 40)
    near = run(method, Pendulum(), tolerance=1e-13, times=times)
    found = []
    for n in (50, 100):
        out = fixed(method, n, times)
        found.append([np.abs(a - b)[:-1, :2].max() for a, b in zip(out[3:], near[3:], strict=True)])
    orders = np.log2(np.array(found[0]) / found[1])
    assert orders[0] > 3.5 and orders[1] > 2.5 and orders[2] > 3.0


def test_error_follows_the_tolerance(method, exact):
    errors, work = [], []
    for tolerance in (1e-5, 1e-7, 1e-9):
        problem = Pendulum()
        out = run(method, problem, tolerance=tolerance)
        errors.append(np.abs(out[1].y - exact)[:2].max())
        work.append(problem.evaluations)
        assert out[0] == contract.DONE and out[2][:, 4].max() <= 1.0
        assert problem.accepted[0] == 0.0  # the start, and every step of the log
        np.testing.assert_array_equal(problem.accepted[1:], out[2][:, 0])
    assert errors[0] > 20.0 * errors[1] > 400.0 * errors[2]
    assert work[2] < 25.0 * work[0]  # the bend in the estimate is of order 3


def test_four_evaluations_a_step(method):
    problem = Pendulum()
    st = run(method, problem, tolerance=1e-6)[1]
    tried = st.count[contract.STEPS] + st.count[contract.ERROR_FAILS]
    assert problem.evaluations == 4 * tried + 1
    assert st.count[contract.RESIDUALS] == 4 * tried


def test_held_entries_are_set_at_every_point(method):
    out = run(method, Pendulum(), tolerance=1e-6)
    assert out[1].y[2] == np.cos(5.0)


class Linear:
    """y' = A y: eigenvalues are known."""

    def __init__(self, A):
        self.A, self.tested = np.asarray(A, float), np.ones(len(A))

    def functions(self):
        def rates(t, y, yd, data, power):
            yd[:] = self.A @ y
            power[:] = 0.0

        return rates, lambda t, y, data: None, lambda *_: None, lambda sample, data: True


def rotation(radius, angle):
    """A 2 by 2 matrix with eigenvalues radius exp(+-i angle)."""
    c, s = radius * np.cos(angle), radius * np.sin(angle)
    return np.array([[c, s], [-s, c]])


@pytest.mark.parametrize("angle", np.radians([90.0, 122.5, 150.0, 180.0]))
def test_stability_region_holds_the_half_disk(method, angle):
    """Steps of the bound neither grow nor does a hundredth less than twice it stay bounded."""
    problem = Linear(rotation(100.0, angle))
    h = method.REACH / 100.0
    for factor, grows in ((1.0, False), (1.2, True)):
        h_max, y0 = factor * h, (1.0, 0.0)
        st = run(method, problem, tolerance=1e300, h0=h_max, h_max=h_max, end=400 * h, y0=y0)[1]
        assert (np.abs(st.y).max() > 1.0) == grows


def test_spectral_radius(method):
    """Of a matrix with complex and real eigenvalues, far from normal, and of entries not tested."""
    A = np.zeros((6, 6))
    A[:2, :2], A[2:4, 2:4], A[4, 4] = rotation(3e5, np.radians(100.0)), -7e4 * np.eye(2), -10.0
    A[0, 2], A[1, 4] = 2e5, 1e5
    A[5, 5] = -9e6  # not tested: its growth does not count
    problem = Linear(A)
    st = method.new_state(0.0, np.ones(6), np.zeros(6), weight=[1e8] * 5 + [0.0], h0=1.0)
    found = method.spectral_radius(problem.functions(), None, st, 40, 1e-3)
    assert found == pytest.approx(3e5, rel=0.05)


def test_steps_stay_near_the_stability_bound(method):
    """A stiff component that is at rest: no accuracy limits the step."""
    problem = Linear([[-1000.0, 0.0], [0.0, -1.0]])
    out = run(method, problem, tolerance=1e-2, end=5.0, y0=(1e-3, 1.0))
    late = out[2][len(out[2]) // 2 :, 1]
    assert np.mean(late) == pytest.approx(2.785e-3, rel=0.2)


class Wall:
    """A mass that flies to a stiff spring, meets it half a period long, and flies back."""

    tested = np.ones(2)
    stiffness = 1e4

    def functions(self):
        def rates(t, y, yd, data, power):
            yd[:] = y[1], -self.stiffness * max(y[0], 0.0)
            power[:] = 0.0

        return rates, lambda t, y, data: None, lambda *_: None, lambda sample, data: True


def test_a_contact_that_closes_within_a_step_is_seen(method):
    """In free flight steps grow to 10 ms; the contact lasts 31 ms. Its errors stay near the
    tolerance, wherever in a step it begins."""
    misses = []
    for start in np.linspace(-0.3, -0.2, 21):
        st = run(method, Wall(), tolerance=1e-6, h_max=1e-2, end=0.6, y0=(start, 1.0))[1]
        back = -start - 0.6 + np.pi / 100.0
        misses.append(np.abs(st.y - (back, -1.0)) / (1.0, 100.0))
    assert np.max(misses) < 20e-6


def test_outcomes(method):
    assert run(method, Pendulum(), tolerance=1e-6, max_steps=5)[0] == contract.TOO_MANY
    assert run(method, Pendulum(), tolerance=1e-16, h_min=1e-3)[0] == contract.TOO_SMALL
    wild = Linear([[np.nan, 0.0], [0.0, -1.0]])
    assert run(method, wild, tolerance=1e-6, y0=(1.0, 1.0))[0] == contract.NOT_FINITE


def test_a_full_log_loses_nothing(method):
    whole = run(method, Pendulum(), tolerance=1e-8)
    parts = run(method, Pendulum(), tolerance=1e-8, log_rows=7)
    np.testing.assert_array_equal(whole[2], parts[2])
    np.testing.assert_array_equal(whole[1].y, parts[1].y)
