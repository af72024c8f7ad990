"""Variable-order, variable-step BDF with a modified Newton-Raphson corrector for F(t, y, y') = 0.

The formula keeps backward differences D of a quasi-constant step (Byrne and Hindmarsh 1975) in
Klopfenstein's modification (NDF; Shampine and Reichelt, SIAM J. Sci. Comput. 18 (1997) 1, whose
notation this is): as stable at orders 1 and 2, with errors of half the size. With
c = h/((1 - kappa_k) gamma_k) the corrected value is y = y_p + d and its derivative
y' = (psi + d)/c. ``advance`` is plain Python that numba also compiles: it
receives the problem as six functions and their data,

    residual(t, y, yd, data, out, power)     F -> out, quadrature integrands -> power
    linearise(t, y, yd, data)                keep dF/dy, dF/dy' at this point
    factor(alpha, data) -> bool              factor dF/dy + alpha dF/dy'
    backsolve(alpha, y, r, data)             r <- -(that)^-1 r, the Newton step
    powers(t, y, data, power) -> int         integrands at y, a Newton step beyond that -> power;
                                             how many of them, the first ones, may change sign
    settle(t, y, data)                       that y was accepted
    observe(sample, t, y, yd, data)          y and y' at sampling time t, by dense output

Obligations of a problem: ``residual`` depends on nothing but its arguments and memory that only
``settle`` changes; it allocates nothing; functions share ``data`` and nothing else.
Integrands, and what ``settle`` keeps, may be those of the corrector's last residual, one Newton
step before the accepted point, but for what would miss that step.
Integrals of integrands that change sign are unknowns like others: the formula that moves y
integrates them, so that the work of a constant force is that force times the displacement, whatever
the steps. (By the trapezoidal rule it missed a share of every fast motion that long steps damp:
where a load of kN moves by nanometres, more than the drive did in 2 ms.) The others, losses, which
begin and end with contacts, take the trapezoidal rule: they must grow, and the formula swings on
after what stops at once.
Policies follow IDA's experience: few Jacobians, Newton fails early and cuts the step.
Stability guard: orders above 2 are left for ``GUARD_STEPS`` steps once the error test fails twice
within ten steps, the mark of lightly damped fast oscillation.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from flexcage.solve.contract import (
    DONE,
    ERROR_FAILS,
    FACTORS,
    JACOBIANS,
    LOG_FULL,
    NEWTON_FAILS,
    NOT_FINITE,
    RESIDUALS,
    STEPS,
    TOO_MANY,
    TOO_SMALL,
    H,
    Integrator,
    T,
)

MAX_ORDER = 5
KAPPA = (0.0, -0.1850, -1.0 / 9.0, -0.0823, -0.0415, 0.0)  # Shampine and Reichelt, table 1
NEWTON_MAX = 4
GUARD_STEPS = 200
JACOBIAN_AGE = 60
# entries of BDFState.real and .count beyond those of ``contract``
ALPHA, RATE, H_LAST = range(2, 5)
ORDER, EQUAL, AGE, HAVE_J, GUARD, RECENT, ITERATIONS, FAILS, BEGUN = range(7, 16)


class BDFState(NamedTuple):
    """The integrator between steps: all of it is in a checkpoint."""

    D: np.ndarray  # (MAX_ORDER + 3, n) backward differences
    Q: np.ndarray  # (MAX_ORDER + 3, n_quad) those of the integrals; losses have the first row only
    real: np.ndarray  # (5,) t, h, alpha of the factors, convergence rate, last accepted h
    count: np.ndarray  # type: ignore[assignment]  # (16,) counters of ``contract``, order and more
    weight: np.ndarray  # (n,) 1/allowed local error; 0: not in the error test
    quad: np.ndarray  # (n_quad,) integrals: the first row of ``Q``
    quad_weight: np.ndarray  # (n_quad,) 1/allowed local error of each; 0: not in the error test
    vec: np.ndarray  # (6, n) work
    power: np.ndarray  # (3, n_quad) integrands at the last, the present and the point before
    step: np.ndarray  # (2, n_quad) work: psi and d of the integrals
    coef: np.ndarray  # (3, MAX_ORDER + 1) gamma, (1 - kappa) gamma, error constants


class BDFOptions(NamedTuple):
    max_order: int
    h_max: float
    h_min: float
    newton_tol: float
    max_steps: int


def new_state(
    t0: float, y0, yd0, *, weight, h0: float, quad_weight=(), modes: Any = None
) -> BDFState:
    """State at the start: order 1, first difference h0 y'. ``modes`` are unknowns like others."""
    n, n_quad = len(y0), len(quad_weight)
    D = np.zeros((MAX_ORDER + 3, n))
    D[0] = y0
    D[1] = h0 * np.asarray(yd0)
    kappa = np.array(KAPPA)
    gamma = np.concatenate([[0.0], np.cumsum(1.0 / np.arange(1, MAX_ORDER + 1))])
    error = kappa * gamma + 1.0 / np.arange(1, MAX_ORDER + 2)
    count, Q = np.zeros(16, np.int64), np.zeros((MAX_ORDER + 3, n_quad))
    count[ORDER] = 1
    return BDFState(
        D, Q, np.array([t0, h0, 0.0, 1.0, h0]), count, np.array(weight, float), Q[0],
        np.array(quad_weight, float), np.zeros((6, n)), np.zeros((3, n_quad)),
        np.zeros((2, n_quad)),
        np.stack([gamma, (1.0 - kappa) * gamma, error]),
    )  # fmt: skip


def change_step(D, Q, order, ratio):
    """Backward differences for a step ``ratio`` times as long (in place)."""
    n = order + 1
    R = np.empty((n, n))
    U = np.empty((n, n))
    for f in range(2):
        M = R if f == 0 else U
        x = ratio if f == 0 else 1.0
        for j in range(n):
            M[0, j] = 1.0
        for i in range(1, n):
            M[i, 0] = 0.0
            for j in range(1, n):
                M[i, j] = M[i - 1, j] * (i - 1 - x * j) / i
    W = R @ U  # D_new = (R U)^T D, upper triangular: row i needs only rows from i on
    for table in (D, Q):
        for i in range(n):
            row = table[i]
            for k in range(row.shape[0]):
                row[k] *= W[i, i]
            for j in range(i + 1, n):
                w = W[j, i]
                if w != 0.0:
                    other = table[j]
                    for k in range(row.shape[0]):
                        row[k] += w * other[k]


def add_step(D, d, order):
    """Backward differences at the next point, which lies ``d`` beyond the predicted one."""
    last, further = D[order + 1], D[order + 2]
    for k in range(d.shape[0]):
        further[k] = d[k] - last[k]
        last[k] = d[k]
    for j in range(order, -1, -1):
        row, add = D[j], D[j + 1]
        for k in range(d.shape[0]):
            row[k] += add[k]


def interpolate(D, order, t, h, time, y, yd):
    """Dense output: y and y' at ``time`` in the last step, from differences at t."""
    n = D.shape[1]
    p, dp = 1.0, 0.0
    row = D[0]
    for k in range(n):
        y[k] = row[k]
        yd[k] = 0.0
    for j in range(order):
        x = (time - (t - h * j)) / (h * (1 + j))
        dp = dp * x + p / (h * (1 + j))
        p = p * x
        row = D[j + 1]
        for k in range(n):
            y[k] += row[k] * p
            yd[k] += row[k] * dp


def worst(a, weight, factor):
    """Largest weighted entry; infinite if any is not finite."""
    s = total = 0.0
    for k in range(a.shape[0]):
        x = abs(a[k]) * weight[k]
        total += x  # carries whatever is not a number
        s = max(s, x)
    return s * factor if total <= 1e300 else np.inf


def missed(h, h_last, power, weight):
    """Largest weighted error of the trapezoidal rule over a step h after one of ``h_last``; that of
    the formula is of the same size."""
    most = total = 0.0
    for k in range(weight.shape[0]):
        bend = (power[1, k] - power[0, k]) / h - (power[0, k] - power[2, k]) / h_last
        x = abs(bend) * weight[k]
        total += x  # carries whatever is not a number
        most = max(most, x)
    return most * h**3 / (6.0 * (h + h_last)) if total <= 1e300 else np.inf


def allowed(error, order, work):
    """How many times as long a step could be for these errors of y and of integrals."""
    of_work = max(work, 1e-10) ** (-1.0 / 3.0)
    return min(max(error, 1e-10) ** (-1.0 / (order + 1)), of_work)


def correct(fns, data, st, opt, t_new, c):
    """Newton-Raphson from vec[0] (predictor) with psi in vec[1]; d in vec[2]. True: converged."""
    residual, linearise, factor, backsolve = fns[0], fns[1], fns[2], fns[3]
    y_p, psi, d = st.vec[0], st.vec[1], st.vec[2]
    y, yd, r = st.vec[3], st.vec[4], st.vec[5]
    order = st.count[ORDER]
    n = y.shape[0]
    alpha = 1.0 / c
    error_constant = st.coef[2, order]
    for _ in range(2):
        if st.count[HAVE_J] == 0:
            for k in range(n):
                yd[k] = psi[k] * alpha
                y[k] = y_p[k]
            linearise(t_new, y, yd, data)
            st.count[JACOBIANS] += 1
            st.count[HAVE_J] = 1
            st.count[AGE] = 0
            st.real[ALPHA] = 0.0
            st.real[RATE] = 1.0
        fresh = st.count[AGE] == 0
        ratio = st.real[ALPHA] / alpha
        if ratio < 0.75 or ratio > 1.33:
            if not factor(alpha, data):
                return False
            st.count[FACTORS] += 1
            st.real[ALPHA] = alpha
            ratio = 1.0
        for k in range(n):
            d[k] = 0.0
            y[k] = y_p[k]
            yd[k] = psi[k] * alpha
        previous = 0.0
        converged = False
        scale = 2.0 / (1.0 + 1.0 / ratio)
        for it in range(NEWTON_MAX):
            residual(t_new, y, yd, data, r, st.power[1])
            st.count[RESIDUALS] += 1
            backsolve(st.real[ALPHA], y, r, data)
            for k in range(n):
                r[k] *= scale
                d[k] += r[k]
                y[k] = y_p[k] + d[k]
                yd[k] = (psi[k] + d[k]) * alpha
            size = worst(r, st.weight, error_constant)
            st.count[ITERATIONS] += 1
            if not size < 1e300:
                break
            if it > 0 and previous > 0.0:
                st.real[RATE] = max(0.2 * st.real[RATE], size / previous)
                if size > 0.9 * previous and size > opt.newton_tol:
                    break
            if size * min(1.0, st.real[RATE]) <= opt.newton_tol:
                converged = True
                break
            previous = size
        if converged:
            return True
        if fresh:
            return False
        st.count[HAVE_J] = 0
    return False


def advance(fns, data, st, opt, t_end, times, ys, yds, first, log, quads):
    """Integrate until t_end; see ``contract``."""
    residual, powers, settle, observe = fns[0], fns[4], fns[5], fns[6]
    y_p, psi, d = st.vec[0], st.vec[1], st.vec[2]
    y, yd, r = st.vec[3], st.vec[4], st.vec[5]
    D, Q, count, real = st.D, st.Q, st.count, st.real
    before, power, psi_q, d_q = st.power[0], st.power[1], st.step[0], st.step[1]
    n, n_quad = D.shape[1], Q.shape[1]
    sample, row = first, 0
    if count[BEGUN] == 0:  # the start counts as accepted
        count[BEGUN] = 1
        for k in range(n):
            y[k] = D[0, k]
            yd[k] = D[1, k] / real[H]
        residual(real[T], y, yd, data, r, before)
        exchanged = powers(real[T], y, data, before)
        settle(real[T], y, data)
        for k in range(n_quad):
            st.power[2, k] = before[k]
            Q[1, k] = real[H] * before[k] if k < exchanged else 0.0
    while real[T] < t_end:
        if row >= log.shape[0]:
            return LOG_FULL, sample, row
        if count[STEPS] >= opt.max_steps:
            return TOO_MANY, sample, row
        order = count[ORDER]
        if real[H] > opt.h_max:
            change_step(D, Q, order, opt.h_max / real[H])
            real[H] = opt.h_max
            count[EQUAL] = 0
        h = real[H]
        if h < opt.h_min:
            finite = worst(r, st.weight, 1.0) < np.inf
            return (TOO_SMALL if finite else NOT_FINITE), sample, row
        rest = t_end - real[T]
        t_new = real[T] + h
        if h > 0.5 * rest:  # land on the end exactly, by one step or by two equal ones
            steps = 1 if h > 0.999 * rest else 2
            change_step(D, Q, order, rest / (steps * h))
            h = real[H] = rest / steps
            count[EQUAL] = 0
            t_new = t_end if steps == 1 else real[T] + h
        alpha = st.coef[1, order]
        c = h / alpha
        last = D[0]
        for k in range(n):
            y_p[k] = last[k]
            psi[k] = 0.0
        for j in range(1, order + 1):
            difference, share = D[j], st.coef[0, j] / alpha
            for k in range(n):
                y_p[k] += difference[k]
                psi[k] += share * difference[k]
        iterations = count[ITERATIONS]
        if not correct(fns, data, st, opt, t_new, c):
            count[NEWTON_FAILS] += 1
            count[HAVE_J] = 0
            change_step(D, Q, order, 0.4)
            real[H] = 0.4 * h
            count[EQUAL] = 0
            continue
        error = worst(d, st.weight, st.coef[2, order])
        exchanged = powers(t_new, y, data, power)
        for k in range(n_quad):
            psi_q[k] = d_q[k] = 0.0
        for j in range(1, order + 1):
            share = st.coef[0, j] / alpha
            for k in range(exchanged):
                psi_q[k] += share * Q[j, k]
        for k in range(exchanged):
            d_q[k] = c * power[k] - psi_q[k]
        work = missed(h, real[H_LAST], st.power, st.quad_weight)
        if not max(error, work) < 1e300:
            return NOT_FINITE, sample, row
        if max(error, work) > 1.0:
            count[ERROR_FAILS] += 1
            if error > 1.0:  # an integral's failure says nothing of y
                count[RECENT] += 10
                count[FAILS] += 1
                if count[FAILS] > 1:
                    count[HAVE_J] = 0
                if count[FAILS] > 3 and error < 5.0:
                    # what no shorter step removes is the last point's distance from a constraint
                    for k in range(n):
                        D[0, k] += d[k]
                if count[RECENT] > 15 and order > 2:
                    count[ORDER] = 2
                    count[GUARD] = GUARD_STEPS
            ratio = max(0.25, 0.85 * allowed(error, order, work))
            change_step(D, Q, count[ORDER], ratio)
            real[H] = ratio * h
            count[EQUAL] = 0
            continue
        # accept
        add_step(D, d, order)
        add_step(Q, d_q, order)
        real[T] = t_new
        real[H_LAST] = h
        count[STEPS] += 1
        count[FAILS] = 0
        count[EQUAL] += 1
        count[AGE] += 1
        count[RECENT] = max(count[RECENT] - 1, 0)
        count[GUARD] = max(count[GUARD] - 1, 0)
        if count[AGE] > JACOBIAN_AGE or count[ITERATIONS] - iterations > 2:
            count[HAVE_J] = 0
        settle(t_new, y, data)
        while sample < times.shape[0] and times[sample] <= t_new + 1e-12 * h:
            interpolate(D, order, t_new, h, times[sample], ys[sample], yds[sample])
            interpolate(Q, order, t_new, h, times[sample], quads[sample], d_q)
            observe(sample, times[sample], ys[sample], yds[sample], data)
            x = 1.0 - (t_new - times[sample]) / h
            for k in range(exchanged, n_quad):
                slope = power[k] - before[k]
                quads[sample, k] = st.quad[k] + h * x * (before[k] + 0.5 * x * slope)
            sample += 1
        for k in range(exchanged, n_quad):
            st.quad[k] += 0.5 * h * (before[k] + power[k])
        for k in range(n_quad):
            st.power[2, k], before[k] = before[k], power[k]
        log[row, 0], log[row, 1], log[row, 2] = t_new, h, order
        log[row, 3], log[row, 4] = count[ITERATIONS] - iterations, max(error, work)
        row += 1
        if count[EQUAL] >= order + 1:
            _choose(st, opt, error, work)
    return DONE, sample, row


def _choose(st, opt, error, work):
    """Order and step for the next steps, from the error estimates of three neighbouring orders,
    and the step by that of the integrals, ``work``, as well."""
    D, count, real = st.D, st.count, st.real
    order = count[ORDER]
    highest = 2 if count[GUARD] > 0 and opt.max_order > 2 else opt.max_order
    best, new = 0.0, order
    for q in range(max(order - 1, 1), min(order + 1, highest) + 1):
        e = error if q == order else worst(D[q + 1], st.weight, st.coef[2, q])
        f = allowed(e, q, 0.0)
        if f > best:
            best, new = f, q
    factor = min(8.0, 0.85 * min(best, allowed(0.0, new, work)))
    if new == order and 0.9 < factor < 1.2:
        return
    count[ORDER] = new
    change_step(D, st.Q, new, factor)
    real[H] *= factor
    count[EQUAL] = 0


def _options(solver: Any) -> BDFOptions:
    return BDFOptions(
        solver.max_order, solver.max_step, solver.min_step, solver.newton_tolerance,
        solver.max_steps,
    )  # fmt: skip


def _refresh(state: BDFState) -> None:
    """Forget the Jacobian and its factors: a resumed run has none."""
    state.count[HAVE_J] = 0
    state.real[ALPHA] = 0.0


BDF = Integrator(
    name="bdf",
    advance=advance,
    functions=("residual", "linearise", "factor", "backsolve", "powers", "settle", "observe"),
    helpers=(
        "change_step",
        "add_step",
        "interpolate",
        "worst",
        "missed",
        "allowed",
        "correct",
        "_choose",
    ),
    options=_options,
    new_state=new_state,
    kept=("D", "Q", "real", "count", "power"),
    refresh=_refresh,
    last=lambda state: (state.D[0].copy(), state.D[1] / state.real[H]),
)
