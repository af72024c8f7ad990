"""Explicit Runge-Kutta method of order 4 with error control, for y' = f(t, y).

Linear oscillators among the unknowns, the modes of a cage, swing by their own equation and exactly;
the method integrates what drives them (``oscillators``), and steps may be a third of their period.
Everything else goes by Kutta's classical four stages (Hairer, Norsett and Wanner, Solving Ordinary
Differential Equations I, section II.1).

A fifth evaluation, at the new point, is the first one of the next step if that point is accepted;
both it and the fourth stage lie at t + h with arguments of second order, so that any part of the
last weight may move from one to the other without loss of order 3. A ``SHARE`` of it does, and the
difference of the two formulas is the error estimate. Both look at the step's end, and not at a
contact that closes on the way there; so the bend of y' over the step (start less middle plus end)
adds ``CURVE`` of itself. The step is carried on with order 4. The powers' integrals take the
weights of the stages, and so have the order and points of the solution, and its estimate.

``advance`` is plain Python that numba also compiles: it receives the problem as functions and their
data,

    rates(t, y, yd, data, power)         y' -> yd, what follows from y -> the rest of y, quadrature
                                         integrands -> power
    note(t, y, data)                     the point evaluated last, of this y, was accepted
    sample(sample, t, y, yd, data)       y at sampling time t, by dense output; may complete both
    wanted(sample, data)                 whether the oscillators are of interest at a sampling time

Stability: where the spectrum of df/dy, without what makes the oscillators swing by themselves, lies
in the left half-plane within radius rho, steps up to ``REACH``/rho are stable: the classical
method's region contains that half-disk. (What acts back on oscillators that turn by up to 2.5 in a
step, damped by 1 %, is stable to three quarters of that.) The error test keeps steps near the
bound by itself. ``spectral_radius`` computes rho.
"""

from __future__ import annotations

from math import sin
from typing import Any, NamedTuple

import numpy as np

from flexcage.solve.contract import (
    DONE,
    ERROR_FAILS,
    EXPLICIT,
    LOG_FULL,
    NOT_FINITE,
    RESIDUALS,
    STEPS,
    TOO_MANY,
    TOO_SMALL,
    H,
    Integrator,
    T,
)
from flexcage.solve.oscillators import (
    ROWS,
    Oscillators,
    drive_half,
    drive_missed,
    drive_whole,
    drive_within,
    find_drives,
    find_turns,
    leave_own,
    no_oscillators,
    step_weights,
)

STAGES = 5  # with the evaluation at the new point
SHARE = 1.0 / 75.0  # of the last weight that moves to the new point in the estimate
CURVE = 1.0 / 500.0  # of the bend of y' in the estimate
REACH = 2.6  # radius of a half-disk inside the stability region, from abs(R(z)) <= 1
SAFETY, SLOW, FAST = 0.9, 0.3, 4.0  # of the step's control
AIM, STEADY, SWIFT = 0.1, 0.075, 0.1  # steps aim at this share of the tolerance
ERROR = 2  # further entry of RKState.real: of the last step; 0 before the first


class RKState(NamedTuple):
    """The integrator between steps: all of it but ``Y`` is in a checkpoint."""

    y: np.ndarray  # (n,) at the last accepted point
    K: np.ndarray  # (STAGES, n) y' at the stages; the first is that of y
    Y: np.ndarray  # (2, n) work
    real: np.ndarray  # (3,) t, next h, error of the last step
    count: np.ndarray  # type: ignore[assignment]  # (7,) counters of ``contract``
    weight: np.ndarray  # (n,) 1/allowed local error; 0: not in the error test
    quad: np.ndarray  # (n_quad,) integrals
    quad_weight: np.ndarray  # (n_quad,) 1/allowed local error of each; 0: not in the error test
    power: np.ndarray  # (STAGES, n_quad) integrands
    modes: Oscillators  # m of the unknowns' pairs
    drive: np.ndarray  # (STAGES, m) what drives them at the stages
    turn: np.ndarray  # (3, 2, m) their z: at the last point, at the second stage, elsewhere
    exact: np.ndarray  # (2, ROWS, m) weights: of the step, of a part of it


class RungeKuttaOptions(NamedTuple):
    h_max: float
    h_min: float
    max_steps: int


def new_state(
    t0: float, y0, yd0, *, weight, h0: float, quad_weight=(), modes: Oscillators | None = None
) -> RKState:
    """State at the start; y' is computed from y."""
    n, n_quad, modes = len(y0), len(quad_weight), modes or no_oscillators()
    m = len(modes.decay)
    return RKState(
        np.array(y0, float), np.zeros((STAGES, n)), np.zeros((2, n)), np.array([t0, h0, 0.0]),
        np.zeros(7, np.int64), np.array(weight, float), np.zeros(n_quad),
        np.array(quad_weight, float), np.zeros((STAGES, n_quad)), modes, np.zeros((STAGES, m)),
        np.zeros((3, 2, m)), np.zeros((2, ROWS, m)),
    )  # fmt: skip


def largest(a, weight):
    """Largest weighted entry; infinite if any is not finite."""
    s = total = 0.0
    for k in range(a.shape[0]):
        x = abs(a[k]) * weight[k]
        total += x  # carries whatever is not a number
        s = max(s, x)
    return s if total <= 1e300 else np.inf


def missed(h, power, weight):
    """Largest weighted estimate of what a step's integrals miss, as that of y."""
    most = total = 0.0
    for k in range(weight.shape[0]):
        late = power[4, k] - power[3, k]
        bend = power[0, k] - power[1, k] - power[2, k] + power[4, k]
        x = abs(h * (SHARE * late + CURVE * bend)) * weight[k]
        total += x  # carries whatever is not a number
        most = max(most, x)
    return most if total <= 1e300 else np.inf


def hermite(x, h, y0, f0, y1, f1, y, yd):
    """Cubic through two points with their slopes, at share x of the step h: y and y'."""
    a, b = x * x * (3.0 - 2.0 * x), x * (1.0 - x)
    c, d = h * b * (1.0 - x), -h * b * x
    da, dc, dd = 6.0 * b / h, (1.0 - x) * (1.0 - 3.0 * x), x * (3.0 * x - 2.0)
    for k in range(y.shape[0]):
        rise = y1[k] - y0[k]
        y[k] = y0[k] + a * rise + c * f0[k] + d * f1[k]
        yd[k] = da * rise + dc * f0[k] + dd * f1[k]


def advance(fns, data, st, opt, t_end, times, ys, yds, first, log, quads):
    """Integrate until t_end; see ``contract``."""
    rates, note, sample_at, wanted = fns[0], fns[1], fns[2], fns[3]
    y, K, power, real, count = st.y, st.K, st.power, st.real, st.count
    stage, estimate = st.Y[0], st.Y[1]
    modes, N, C, D = st.modes, st.drive, st.exact[0], st.exact[1]
    begin, turn, spare = st.turn[0], st.turn[1], st.turn[2]
    n = y.shape[0]
    sample, row = first, 0
    finite = True
    if real[ERROR] == 0.0:  # the start counts as accepted
        real[ERROR] = 1.0
        rates(real[T], y, K[0], data, power[0])
        note(real[T], y, data)
    while real[T] < t_end:
        if row >= log.shape[0]:
            return LOG_FULL, sample, row
        if count[STEPS] >= opt.max_steps:
            return TOO_MANY, sample, row
        t, rest = real[T], t_end - real[T]
        h = min(real[H], opt.h_max)
        if h < opt.h_min:
            return (TOO_SMALL if finite else NOT_FINITE), sample, row
        t_new = t + h
        if h > 0.5 * rest:  # land on the end exactly, by one step or by two equal ones
            steps = 1 if h > 0.999 * rest else 2
            h = rest / steps
            t_new = t_end if steps == 1 else t + h
        half, third, sixth = 0.5 * h, h / 3.0, h / 6.0
        step_weights(h, modes, C)
        find_turns(y, modes, begin)
        find_drives(y, K[0], modes, N[0])
        for k in range(n):
            stage[k] = y[k] + half * K[0, k]
        drive_half(modes, C, begin, N[0], N[0], turn, stage)
        rates(t + half, stage, K[1], data, power[1])
        find_drives(stage, K[1], modes, N[1])
        for k in range(n):
            stage[k] = y[k] + half * K[1, k]
        drive_half(modes, C, begin, N[1], N[1], spare, stage)
        rates(t + half, stage, K[2], data, power[2])
        find_drives(stage, K[2], modes, N[2])
        for k in range(n):
            stage[k] = y[k] + h * K[2, k]
        drive_half(modes, C, turn, N[2], N[0], spare, stage)
        rates(t_new, stage, K[3], data, power[3])
        find_drives(stage, K[3], modes, N[3])
        for k in range(n):
            stage[k] = y[k] + sixth * (K[0, k] + K[3, k]) + third * (K[1, k] + K[2, k])
        drive_whole(modes, C, begin, N, stage)
        rates(t_new, stage, K[4], data, power[4])
        find_drives(stage, K[4], modes, N[4])
        count[RESIDUALS] += 4
        for k in range(n):
            late, bend = K[4, k] - K[3, k], K[0, k] - K[1, k] - K[2, k] + K[4, k]
            estimate[k] = h * (SHARE * late + CURVE * bend)
        drive_missed(modes, C, N, SHARE, CURVE, estimate)
        error = max(largest(estimate, st.weight), missed(h, power, st.quad_weight))
        if not error <= 1.0:
            count[ERROR_FAILS] += 1
            finite = error < np.inf
            real[H] = h * max(SLOW, SAFETY * error**-0.25)
            continue
        real[T] = t_new
        count[STEPS] += 1
        count[EXPLICIT] += 1
        note(t_new, stage, data)
        while sample < times.shape[0] and times[sample] <= t_new + 1e-12 * h:
            x = 1.0 - (t_new - times[sample]) / h
            hermite(x, h, y, K[0], stage, K[4], ys[sample], yds[sample])
            if wanted(sample, data):
                step_weights(x * h, modes, D)
                drive_within(x, modes, C, D, begin, N, ys[sample], yds[sample])
            sample_at(sample, times[sample], ys[sample], yds[sample], data)
            for k in range(st.quad.shape[0]):  # the quadratic through both ends with its integral
                p = (power[0, k] + power[3, k]) / 6.0 + (power[1, k] + power[2, k]) / 3.0
                rise = power[4, k] - power[0, k]
                bend = 3.0 * (power[0, k] + power[4, k]) - 6.0 * p
                slope = rise - bend
                quads[sample, k] = st.quad[k] + h * x * (
                    power[0, k] + x * (0.5 * slope + x * bend / 3.0)
                )
            sample += 1
        for k in range(st.quad.shape[0]):
            st.quad[k] += sixth * (power[0, k] + power[3, k]) + third * (power[1, k] + power[2, k])
            power[0, k] = power[4, k]
        for k in range(n):
            y[k] = stage[k]
            K[0, k] = K[4, k]
        log[row, 0], log[row, 1], log[row, 2] = t_new, h, 4
        log[row, 3], log[row, 4] = 0.0, error
        row += 1
        error = max(error, 1e-4)
        factor = (AIM / error) ** STEADY * (real[ERROR] / error) ** SWIFT
        real[ERROR] = error
        if t_new < t_end or factor < 1.0:  # a last step cut short says little about the next
            real[H] = h * min(FAST, max(SLOW, factor))
    return DONE, sample, row


def spectral_radius(fns, data, st, iterations, nudge):
    """Radius [1/s] of the spectrum of df/dy at the last accepted point, by power iteration.

    Without what makes the oscillators swing by themselves, as steps are not limited by that.
    Differences over ``nudge`` times the allowed local error; of the growth per iteration, the mean
    over the second half, because complex eigenvalues make it vary. Sommeijer, Shampine and Verwer,
    J. Comput. Appl. Math. 88 (1998) 315, bound the steps of their stabilised method so.
    """
    rates, y, f, shifted, direction = fns[0], st.K[1], st.K[2], st.Y[0], st.Y[1]
    power, t, n = st.power[1], st.real[T], st.y.shape[0]
    for k in range(n):
        y[k] = st.y[k]
        direction[k] = sin(12.9898 * (k + 1)) / st.weight[k] if st.weight[k] > 0.0 else 0.0
    rates(t, y, f, data, power)
    base, growth, used = st.K[3], 0.0, 0
    for k in range(n):
        base[k] = f[k]
    for i in range(iterations):
        size = 0.0
        for k in range(n):
            size += (direction[k] * st.weight[k]) ** 2
        size = np.sqrt(size)
        if not size > 0.0:
            return 0.0
        for k in range(n):
            direction[k] /= size
            shifted[k] = st.y[k] + nudge * direction[k]
        rates(t, shifted, f, data, power)
        for k in range(n):
            f[k] = (f[k] - base[k]) / nudge
        leave_own(direction, f, st.modes)
        grown = 0.0
        for k in range(n):
            direction[k] = f[k] if st.weight[k] > 0.0 else 0.0
            grown += (direction[k] * st.weight[k]) ** 2
        if i >= iterations // 2 and grown > 0.0:
            growth += 0.5 * np.log(grown)
            used += 1
    return np.exp(growth / used) if used > 0 else 0.0


def _options(solver: Any) -> RungeKuttaOptions:
    return RungeKuttaOptions(solver.max_step, solver.min_step, solver.max_steps)


def _refresh(state: RKState) -> None:
    """Nothing is left over: a step depends on y, y' and the next step's length alone."""


EXPLICIT_METHOD = Integrator(
    name="explicit",
    advance=advance,
    functions=("rates", "note", "sample", "wanted"),
    helpers=(
        "largest",
        "missed",
        "hermite",
        "step_weights",
        "find_turns",
        "find_drives",
        "drive_half",
        "drive_whole",
        "drive_missed",
        "drive_within",
        "leave_own",
        "spectral_radius",
    ),  # fmt: skip
    options=_options,
    bounded=True,
    new_state=new_state,
    kept=("y", "K", "real", "count", "quad", "power"),
    refresh=_refresh,
    last=lambda state: (state.y.copy(), state.K[0].copy()),
)
