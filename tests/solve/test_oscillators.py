"""Linear oscillators in the explicit method: exact motion, order, dense output, stability."""

from __future__ import annotations

from math import factorial

import numpy as np
import pytest
from dae_problems import plain
from scipy.integrate import quad, solve_ivp

from flexcage.solve import contract
from flexcage.solve.oscillators import (
    FIRST,
    HALF,
    INNER,
    LAST,
    MIDDLE,
    ROWS,
    WHOLE,
    Oscillators,
    step_weights,
)


@pytest.fixture(scope="module")
def method():
    return plain("runge_kutta")


def oscillators(*modes: tuple[int, int, float, float]) -> Oscillators:
    """Of (place of the displacement, place of the velocity, decay, frequency)."""
    places = np.array([mode[:2] for mode in modes], np.int64).T.reshape(2, -1)
    return Oscillators(places, *np.array([mode[2:] for mode in modes], float).T.copy())


class Problem:
    """y' = f(t, y); some of its unknowns are oscillators."""

    def __init__(self, f, modes, y0):
        self.f, self.modes, self.y0 = f, modes, np.array(y0, float)
        self.evaluations = 0

    def functions(self):
        def rates(t, y, yd, data, power):
            self.evaluations += 1
            yd[:] = self.f(t, y)
            power[:] = 0.0

        return rates, lambda t, y, data: None, lambda *_: None, lambda sample, data: True

    def run(self, method, *, end, h, tolerance=1e300, times=(), known=True):
        """The state, and y and y' at the times; ``known``: what swings is known to the method."""
        y0, times = self.y0, np.append(np.asarray(times, float), end)
        st = method.new_state(
            0.0, y0, 0.0 * y0, weight=np.full(len(y0), 1.0 / tolerance), h0=h, quad_weight=[0.0],
            modes=self.modes if known else None,
        )  # fmt: skip
        ys, yds = np.zeros((2, len(times), len(y0)))
        outcome, _, _ = method.advance(
            self.functions(), None, st, method.RungeKuttaOptions(h, 1e-12, 100_000), end,
            times, ys, yds, 0, np.zeros((100_000, 5)), np.zeros((len(times), 1)),
        )  # fmt: skip
        assert outcome == contract.DONE
        return st, ys, yds

    def exact(self, times, **options):
        return solve_ivp(
            self.f, (0.0, times[-1]), self.y0, "DOP853", times, rtol=1e-12, atol=1e-13
        ).y.T


def swing(g, w, drive):
    """q'' = -(g^2 + w^2) q - 2 g q' + drive(t), as (q, q')."""
    return lambda t, y: np.array([y[1], -(g * g + w * w) * y[0] - 2.0 * g * y[1] + drive(t)])


@pytest.mark.parametrize("Z", [1e-9, 0.02, 0.249, 0.251, 1.0, np.pi, 2.0 * np.pi, 30.0])
@pytest.mark.parametrize("ratio", [0.0, 0.01, 0.9])
def test_weights_are_their_integrals(Z, ratio):
    """exp, and int_0^1 exp((1 - s) z) s^k ds = k! phi_k+1(z), by quadrature."""
    h, g, w = 2e-6, ratio * Z / 2e-6, np.sqrt(1.0 - ratio**2) * Z / 2e-6
    z = h * complex(-g, w)
    out = np.zeros((ROWS, 1))
    step_weights(h, oscillators((0, 1, g, w)), out)
    value = {row: complex(*out[row : row + 2, 0]) for row in range(0, ROWS, 2)}

    def integral(power, z):
        def part(of):
            return quad(lambda s: of(np.exp((1.0 - s) * z)) * s**power, 0.0, 1.0, limit=400,
                        epsabs=1e-14)[0]  # fmt: skip

        return complex(part(np.real), part(np.imag))

    p1, p2, p3 = (integral(k, z) / factorial(k) for k in range(3))
    expected = {
        HALF: np.exp(0.5 * z),
        WHOLE: np.exp(z),
        MIDDLE: 0.5 * h * integral(0, 0.5 * z),
        FIRST: h * (p1 - 3.0 * p2 + 4.0 * p3),
        INNER: h * (2.0 * p2 - 4.0 * p3),
        LAST: h * (4.0 * p3 - p2),
    }
    for row, number in expected.items():
        scale = 1.0 if row in (HALF, WHOLE) else h
        assert abs(value[row] - number) < 1e-12 * scale, row


@pytest.mark.parametrize("g", [0.0, 3.0])
def test_free_motion_is_exact_at_any_step(method, g):
    """Steps of seven periods, at any tolerance: nothing of it is an error. Between points too."""
    w, q0, u0 = 40.0, 1.0, -3.0
    problem = Problem(swing(g, w, lambda t: 0.0), oscillators((0, 1, g, w)), (q0, u0))
    times = np.linspace(0.01, 4.9, 77)
    st, ys, yds = problem.run(method, end=5.0, h=1.1, tolerance=1e-9, times=times)
    t = np.append(times, 5.0)
    a, b = q0, (u0 + g * q0) / w
    q = np.exp(-g * t) * (a * np.cos(w * t) + b * np.sin(w * t))
    u = np.exp(-g * t) * ((b * w - g * a) * np.cos(w * t) - (a * w + g * b) * np.sin(w * t))
    np.testing.assert_allclose(ys, np.stack([q, u], axis=1), atol=1e-10)
    np.testing.assert_allclose(yds[:, 0], u, atol=1e-10)
    np.testing.assert_allclose(yds[:, 1], -(g * g + w * w) * q - 2.0 * g * u, atol=1e-8)
    assert st.count[contract.STEPS] <= 8 and st.count[contract.ERROR_FAILS] <= 2


def test_a_parabola_of_a_drive_is_exact(method):
    """Drives of time to the second power, at the points and between them."""
    g, w = 2.0, 30.0
    drive = np.polynomial.Polynomial([5.0, -40.0, 70.0])
    # the particular motion is a parabola too
    s = g * g + w * w
    c2 = 70.0 / s
    c1 = (-40.0 - 4.0 * g * c2) / s
    c0 = (5.0 - 2.0 * c2 - 2.0 * g * c1) / s
    slow = np.polynomial.Polynomial([c0, c1, c2])
    problem = Problem(swing(g, w, drive), oscillators((0, 1, g, w)), (slow(0), slow.deriv()(0.0)))
    times = np.linspace(0.02, 0.98, 49)
    _, ys, _ = problem.run(method, end=1.0, h=0.2, times=times)
    np.testing.assert_allclose(ys[:-1, 0], slow(times), atol=1e-13)
    np.testing.assert_allclose(ys[:-1, 1], slow.deriv()(times), atol=1e-12)


def coupled(w=60.0, g=0.5):
    """A fast oscillator, a slow pendulum, and a spring between them that hardens."""

    def f(t, y):
        q, u, x, v = y
        force = 30.0 * (x - q) + 200.0 * (x - q) ** 3
        return np.array([u, -(w * w + g * g) * q - 2.0 * g * u + 8.0 * force + 20.0 * np.cos(3 * t),
                         v, -4.0 * np.sin(x) - force])  # fmt: skip

    return Problem(f, oscillators((0, 1, g, w)), (0.05, 1.0, 0.4, 0.0))


def test_order_four(method):
    """What drives an oscillator depends on it and on others."""
    problem = coupled()
    exact = problem.exact(np.array([1.0]))[-1]
    errors = [
        np.abs(problem.run(method, end=1.0, h=1.0 / n)[0].y - exact).max() for n in (80, 160, 320)
    ]
    orders = np.log2(np.array(errors[:-1]) / errors[1:])
    assert orders == pytest.approx(4.0, abs=0.3)


def test_long_steps_pay(method):
    """A step turns the oscillator by 1.5: the classical method damps it by a twelfth a step."""
    problem = coupled()
    exact = problem.exact(np.array([1.0]))[-1]
    ours, classical = (
        np.abs(problem.run(method, end=1.0, h=1.0 / 40, known=known)[0].y - exact).max()
        for known in (True, False)
    )
    assert ours < classical / 8.0


def test_short_steps_are_those_of_the_classical_method(method):
    """Z = 0.006: what remains is of the order of errors."""
    problem = coupled()
    known, unknown = (
        problem.run(method, end=0.01, h=1e-4, known=known)[0].y for known in (True, False)
    )
    np.testing.assert_allclose(known, unknown, atol=1e-9)


def test_dense_output_follows_the_swing(method):
    """Between points that lie 1.2 radians apart, y and y' are as good as at the points."""
    problem = coupled()
    times = np.linspace(0.013, 0.97, 60)
    exact = problem.exact(times)
    _, ys, yds = problem.run(method, end=1.0, h=0.02, times=times)
    at_points = np.abs(problem.run(method, end=0.98, h=0.02)[0].y - problem.exact([0.98])[-1])
    missed = np.abs(ys[:-1] - exact).max(axis=0)
    assert missed[0] < 3.0 * at_points[0] + 1e-5 and missed[1] < 3.0 * at_points[1] + 1e-3
    rates = np.array([problem.f(t, y) for t, y in zip(times, exact, strict=True)])
    assert np.abs(yds[:-1] - rates).max(axis=0)[1] < 0.03 * np.abs(rates[:, 1]).max()


def test_error_follows_the_tolerance(method):
    problem = coupled()
    exact = problem.exact(np.array([1.0]))[-1]
    errors = [
        np.abs(problem.run(method, end=1.0, h=0.5, tolerance=t)[0].y - exact).max()
        for t in (1e-4, 1e-6, 1e-8)
    ]
    assert errors[0] > 10.0 * errors[1] > 100.0 * errors[2]


def damped_contact(w, ratio, stiffness, damping, mass=1.0):
    """An oscillator of unit modal mass against a mass, a spring and a damper between them."""
    g = ratio * w

    def f(t, y):
        q, u, x, v = y
        force = stiffness * (x - q) + damping * (v - u)
        return np.array([u, -(w * w + g * g) * q - 2.0 * g * u + force, v, -force / mass])

    return Problem(f, oscillators((0, 1, g, w)), (1.0, 0.0, 0.0, 0.0))


def spectrum(problem, own):
    """Radius of df/dy, without what makes the oscillator swing by itself unless ``own``."""
    J = np.stack([problem.f(0.0, e) for e in np.eye(4)], axis=1)
    if not own:
        g, w = problem.modes.decay[0], problem.modes.frequency[0]
        J[1, :2] += g * g + w * w, 2.0 * g
    return np.abs(np.linalg.eigvals(J)).max()


@pytest.mark.parametrize("turn", [0.5, 1.5, 2.5])
@pytest.mark.parametrize("damping", [0.0, 0.7, 3.0])
def test_three_quarters_of_the_bound_are_stable(method, turn, damping):
    """A step turns the oscillator by ``turn``, damped by 1 %, and is 0.75 of what the spectrum of
    all else, a contact between swinging and overdamped, would allow by itself."""
    h = 1e-3
    w, radius = turn / h, 0.75 * method.REACH / h
    scale = radius / spectrum(damped_contact(w, 0.01, 1.0, damping), own=False)
    problem = damped_contact(w, 0.01, scale**2, scale * damping)
    assert spectrum(problem, own=False) == pytest.approx(radius)
    st, _, _ = problem.run(method, end=400 * h, h=h)
    assert np.abs(st.y[[0, 2]]).max() < 2.0
    assert np.abs(st.y[[1, 3]]).max() < 2.0 * max(w, radius)


def test_the_radius_leaves_out_what_swings_by_itself(method):
    problem = damped_contact(3e6, 0.01, 4e9, 2e4)
    st = method.new_state(
        0.0, np.zeros(4), np.zeros(4), weight=[1e8, 1.0, 1e8, 1.0], h0=1.0, modes=problem.modes
    )
    found = method.spectral_radius(problem.functions(), None, st, 60, 1e-3)
    assert found == pytest.approx(spectrum(problem, own=False), rel=0.05)
    assert spectrum(problem, own=True) > 30.0 * found
