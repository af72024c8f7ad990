"""The bearing as a problem for the integrator: six functions over one tuple of data.

Newton's matrix is formed in velocities: with displacements d = T^+ dq = (du + dmu - r_s)/alpha
the momentum rows become (alpha M + C + K/alpha) du = -r_u + K r_s/alpha, so that blocks stay
6 by 6. Constraints are rows of the border.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numba
import numpy as np
from numba import types

from flexcage.contacts import laws
from flexcage.contacts.spec import Contacts
from flexcage.core.jit import (
    LEAN,
    OPTIONS,
    VECTORISED,
    Box,
    allocating_kernel,
    boxed,
    copy_into,
    fields,
    kernel,
    zero,
)
from flexcage.core.rotation import quaternion_rate, rotation_of_quaternion_change
from flexcage.solve import bdf
from flexcage.solve import bordered as bordered_system
from flexcage.solve.bordered import Bordered, new_bordered
from flexcage.system.layout import Layout
from flexcage.system.model import Memory, Model, Work, new_work
from flexcage.system.residual import evaluate

_factor_bordered = bordered_system.factor
_solve_bordered = bordered_system.solve


class Events(NamedTuple):
    """Contact changes: a buffer of (time, roller or -1, place, 1 closed, 0 opened) and its fill."""

    rows: np.ndarray  # (n, 4)
    fill: np.ndarray  # (1,)
    closed: np.ndarray  # (Z, 8) contact flags at the last accepted step
    land: np.ndarray  # (2,) the same for the cage's lands
    force: np.ndarray  # (2, 3) of the last two accepted steps: time, force on the outer ring
    peak: np.ndarray  # (Z, 4) largest pocket force of a step so far
    peak_time: np.ndarray  # (Z, 4)


class Samples(NamedTuple):
    """One block of reports on the sampling grid; every ``stride``-th fine sample is a main one."""

    stride: int
    race: np.ndarray  # (n, Z, 2, 9)
    pocket_normal: np.ndarray  # (n, Z, 4)
    pocket_friction: np.ndarray
    slice_normal: np.ndarray  # (n, Z, 2, ns)
    slice_friction: np.ndarray
    station: np.ndarray  # (n, Z, 4, nst, 3)
    residual: np.ndarray  # (n, Z, 8)
    rib: np.ndarray  # (n, Z, 2)
    land: np.ndarray  # (n, 3)
    energy: np.ndarray  # (n, 4)
    force: np.ndarray  # (n * stride, 2) on the outer ring, fine grid


class BearingData(NamedTuple):
    model: Model
    memory: Memory
    work: Work
    matrix: Bordered
    events: Events
    samples: Samples


class Parts(NamedTuple):
    """The same as the compiled functions receive it: a reference to each group of arrays."""

    bodies: Box
    cage: Box
    inner: Box
    outer: Box
    rib: Box
    pocket: Box
    land: Box
    memory: Box
    pose: Box
    slices: Box
    pair: Box
    pocket_work: Box
    land_work: Box
    frame: Box
    scratch: Box
    tangent: Box
    report: Box
    matrix: Box
    events: Box
    samples: Box


def parts(data: BearingData) -> Parts:
    """References to the groups of arrays of a bearing."""
    groups = (*data.model, data.memory, *data.work, data.matrix, data.events, data.samples)
    return Parts(*(boxed(group) for group in groups))


def new_samples(n: int, stride: int, model: Model) -> Samples:
    Z = len(model.bodies.radius)
    ns, nst = len(model.pocket.s), model.pocket.phi.shape[2]
    z = np.zeros
    return Samples(
        stride, z((n, Z, 2, 9)), z((n, Z, 4)), z((n, Z, 4)), z((n, Z, 2, ns)), z((n, Z, 2, ns)),
        z((n, Z, 4, nst, 3)), z((n, Z, 8)), z((n, Z, 2)), z((n, 3)), z((n, 4)),
        z((n * stride, 2)),
    )  # fmt: skip


# ``data`` is (Parts, laws, evaluate): evaluated through a function value, the residual
# is compiled once, not again inside each of the functions below.


def _residual(t, y, yd, data, out):
    data[2](t, y, yd, data[0], data[1], out, 0)


def _linearise(t, y, yd, data):
    data[2](t, y, yd, data[0], data[1], fields(data[0].scratch).out, 1)


def _factor(alpha, data):
    d = data[0]
    return assemble(alpha, fields(d.bodies), fields(d.tangent), fields(d.matrix))


@kernel(fastmath=VECTORISED)
def assemble(alpha, bodies, tan, m):
    """Newton's matrix alpha M + C + K/alpha in blocks, and its factors."""
    mass, Ia, It = bodies.roller[0], bodies.roller[1], bodies.roller[2]
    b = 1.0 / alpha
    nb = m.S.shape[0]
    n6 = nb - 7
    for i in range(m.A.shape[0]):
        high = nb if m.active[i] else m.low
        for r in range(6):
            for c in range(6):
                m.A[i, r, c] = tan.Crr[i, r, c] + b * tan.Krr[i, r, c]
            for c in range(high):
                m.B[i, r, c] = tan.Crb[i, r, c] + b * tan.Krb[i, r, c]
                m.C[i, c, r] = tan.Cbr[i, c, r] + b * tan.Kbr[i, c, r]
        # the stored rotation order is (x, r, psi) as velocities: spin, skew, tilt
        for r in range(3):
            m.A[i, r, r] += alpha * mass
        m.A[i, 3, 3] += alpha * Ia
        m.A[i, 4, 4] += alpha * It
        m.A[i, 5, 5] += alpha * It
    for r in range(nb):
        for c in range(nb):
            m.S[r, c] = alpha * tan.Mbb[r, c] + tan.Cbb[r, c] + b * tan.Kbb[r, c]
    # multipliers: forces on ring coordinates (axial, skew, tilt, spin) and position rows
    coordinate = (0, 4, 5, 3)
    for k in range(4):
        m.S[coordinate[k], n6 + k] -= 1.0
    for k in range(3):
        m.S[n6 + k, coordinate[k]] = 1.0
        m.S[n6 + 4 + k, coordinate[k]] = b
        m.S[n6 + 4 + k, n6 + 4 + k] = b
    if bodies.drive[0] > 0.0:
        m.S[n6 + 3, n6 + 3] = 1.0
    else:
        m.S[n6 + 3, 3] = 1.0
    return _factor_bordered(m)


def _backsolve(alpha, y, r, data):
    newton_step(alpha, y, r, fields(data[0].tangent), fields(data[0].matrix))


@kernel(fastmath=VECTORISED)
def newton_step(alpha, y, r, tan, m):
    """r <- Newton step for the residual r, all unknowns; alpha is that of the factors."""
    Z = m.A.shape[0]
    nb = m.S.shape[0]
    nm = nb - 21
    nq, nu = 6 * Z + 15 + nm, 6 * Z + 14 + nm
    b = 1.0 / alpha
    s, sb = m.blocks[0], m.border[0]  # kinematic residuals as displacements
    x, xb = m.blocks[1], m.border[1]  # right-hand side, then velocities
    zero(sb)
    for i in range(Z):
        o = 6 * i
        s[i, 0], s[i, 1], s[i, 2] = r[o], r[o + 1], r[o + 2] * y[o + 1]
        s[i, 3], s[i, 4], s[i, 5] = r[o + 5], r[o + 3], r[o + 4]
    z = 6 * Z
    sb[0], sb[1], sb[2] = r[z], r[z + 1], r[z + 2]
    sb[3], sb[4], sb[5] = r[z + 5], r[z + 3], r[z + 4]
    for c in range(5):
        sb[6 + c] = r[z + 6 + c]
    rotation_of_quaternion_change(y[z + 11 : z + 15], r[z + 11 : z + 15], sb[11:14])
    stretch, norm = 0.0, 0.0  # of the quaternion: no rotation, but it must not run away
    for c in range(11, 15):
        stretch += y[z + c] * r[z + c]
        norm += y[z + c] * y[z + c]
    for k in range(nm):
        sb[14 + k] = r[z + 15 + k]
    for k in range(14 + nm):
        f = 0.0
        for c in range(14 + nm):
            f += tan.Kbb[k, c] * sb[c]
        xb[k] = -r[nq + z + k] + b * f
    for k in range(7):
        xb[14 + nm + k] = -r[nq + nu + k]
        if k >= 4:
            coordinate = 0 if k == 4 else k - 1
            xb[14 + nm + k] += b * sb[coordinate]
    for i in range(Z):
        high = nb if m.active[i] else m.low
        for k in range(6):
            f = 0.0
            for c in range(6):
                f += tan.Krr[i, k, c] * s[i, c]
            for c in range(high):
                f += tan.Krb[i, k, c] * sb[c]
            x[i, k] = -r[nq + 6 * i + k] + b * f
        for k in range(high):
            f = 0.0
            for c in range(6):
                f += tan.Kbr[i, k, c] * s[i, c]
            xb[k] += b * f
    _solve_bordered(m, x, xb)
    for i in range(Z):
        o = 6 * i
        for k in range(6):
            r[nq + o + k] = x[i, k]
            s[i, k] = b * (x[i, k] - s[i, k])
        r[o], r[o + 1], r[o + 2] = s[i, 0], s[i, 1], s[i, 2] / y[o + 1]
        r[o + 3], r[o + 4], r[o + 5] = s[i, 4], s[i, 5], s[i, 3]
    for k in range(14 + nm):
        r[nq + z + k] = xb[k]
        sb[k] = b * (xb[k] - sb[k])
    for k in range(7):
        r[nq + nu + k] = xb[14 + nm + k]
    sb[0] += b * xb[14 + nm + 4]
    sb[4] += b * xb[14 + nm + 5]
    sb[5] += b * xb[14 + nm + 6]
    r[z], r[z + 1], r[z + 2] = sb[0], sb[1], sb[2]
    r[z + 3], r[z + 4], r[z + 5] = sb[4], sb[5], sb[3]
    for c in range(5):
        r[z + 6 + c] = sb[6 + c]
    quaternion_rate(y[z + 11 : z + 15], sb[11:14], r[z + 11 : z + 15])
    for c in range(11, 15):
        r[z + c] -= b * stretch / norm * y[z + c]
    for k in range(nm):
        r[z + 15 + k] = sb[14 + k]


def _accepted(t, y, yd, data, power):
    d, report = data[0], fields(data[0].report)
    data[2](t, y, yd, d, data[1], fields(d.scratch).out, 3)
    events = fields(d.events)
    remember(t, fields(d.memory), report, events)
    for c in range(3):
        events.force[0, c] = events.force[1, c]
    events.force[1, 0] = t
    events.force[1, 1], events.force[1, 2] = report.body_force[0], report.body_force[1]
    for k in range(power.shape[0]):
        power[k] = report.power[k]


@kernel
def remember(t, memory, rep, events):
    """Keep the onset speed of every contact, contact changes, and peaks."""
    for i in range(rep.contact.shape[0]):
        for k in range(8):
            closed = rep.contact[i, k]
            if closed == 0 or events.closed[i, k] == 0:
                speed = max(rep.approach[i, k], 0.0)
                if k < 2:
                    memory.race[i, k, 3] = speed
                elif k < 6:
                    memory.pocket[i, k - 2, 3] = speed
                else:
                    memory.rib[i, k - 6, 3] = speed
            if closed != events.closed[i, k]:
                events.closed[i, k] = closed
                _note(events, t, i, k, closed)
        for f in range(4):
            if rep.pocket_normal[i, f] > events.peak[i, f]:
                events.peak[i, f] = rep.pocket_normal[i, f]
                events.peak_time[i, f] = t
        copy_into(memory.deflection[i], rep.residual[i])
    for side in range(2):
        closed = 1 if rep.land_touch[side, 0] > 0.0 else 0
        if closed == 0 or events.land[side] == 0:
            memory.land[side, 3] = max(rep.land_touch[side, 1], 0.0)
        if closed != events.land[side]:
            events.land[side] = closed
            _note(events, t, -1, 8 + side, closed)


@kernel
def _note(events, t, roller, place, closed):
    """Write down that a contact closed or opened; a full buffer keeps the first ones."""
    n = events.fill[0]
    if n < events.rows.shape[0]:
        row = events.rows[n]
        row[0], row[1], row[2], row[3] = t, roller, place, closed
        events.fill[0] = n + 1


def _observe(sample, t, y, yd, data):
    s, rep = fields(data[0].samples), fields(data[0].report)
    if sample % s.stride == s.stride - 1:
        data[2](t, y, yd, data[0], data[1], fields(data[0].scratch).out, 2)
        k = sample // s.stride
        copy_into(s.race[k], rep.race)
        copy_into(s.pocket_normal[k], rep.pocket_normal)
        copy_into(s.pocket_friction[k], rep.pocket_friction)
        copy_into(s.slice_normal[k], rep.slice_normal)
        copy_into(s.slice_friction[k], rep.slice_friction)
        copy_into(s.station[k], rep.station)
        copy_into(s.residual[k], rep.residual)
        copy_into(s.rib[k], rep.rib)
        copy_into(s.land[k], rep.land)
        copy_into(s.energy[k], rep.energy)
    before, after = fields(data[0].events).force[0], fields(data[0].events).force[1]
    w = (t - before[0]) / (after[0] - before[0])
    for c in range(2):
        s.force[sample, c] = (1.0 - w) * before[1 + c] + w * after[1 + c]


def law_functions(contacts: Contacts) -> tuple:
    """The ten law functions: normal (race, pocket, side, rib, land), then friction."""
    places = (contacts.race, contacts.pocket, contacts.side, contacts.rib, contacts.land)
    return tuple(laws.NORMAL_LAWS[p.normal.law] for p in places) + tuple(
        laws.FRICTION_LAWS[p.friction.law] for p in places
    )


class Bearing:
    """A bearing ready to be integrated: compiled functions and their data."""

    def __init__(
        self, model: Model, memory: Memory, contacts: Contacts, layout: Layout,
        *, block: int = 250, stride: int = 4,
    ) -> None:  # fmt: skip
        self.layout = layout
        work = new_work(model, layout)
        self.data = BearingData(
            model, memory, work,
            new_bordered(layout.rollers, layout.n_border, 8, work.tangent.active),
            Events(
                np.zeros((200_000, 4)), np.zeros(1, np.int64),
                np.zeros((layout.rollers, 8), np.int64), np.zeros(2, np.int64),
                np.zeros((2, 3)),
                np.zeros((layout.rollers, 4)), np.zeros((layout.rollers, 4)),
            ),
            new_samples(block, stride, model),
        )  # fmt: skip
        self.laws = law_functions(contacts)
        self._compile()
        self.args = self.arguments(self.data, self.laws)

    def _compile(self) -> None:
        f8, i8 = types.float64, types.int64
        vector, matrix = types.Array(f8, 1, "C"), types.Array(f8, 2, "C")
        law_type = types.Tuple((laws.NORMAL_TYPE,) * 5 + (laws.FRICTION_TYPE,) * 5)
        bearing = numba.typeof(parts(self.data))
        evaluation = types.void(f8, vector, vector, bearing, law_type, vector, i8)
        compiled: Any = numba.njit(evaluation, **LEAN)
        self.evaluate: Any = compiled(evaluate)
        data = types.Tuple((bearing, law_type, types.FunctionType(evaluation)))
        signatures = (
            types.void(f8, vector, vector, data, vector),
            types.void(f8, vector, vector, data),
            types.boolean(f8, data),
            types.void(f8, vector, vector, data),
            types.void(f8, vector, vector, data, vector),
            types.void(i8, f8, vector, vector, data),
        )
        bodies = (_residual, _linearise, _factor, _backsolve, _accepted, _observe)
        self.functions: tuple[Any, ...] = tuple(
            numba.njit(s, **LEAN)(f)  # type: ignore[type-var]
            for s, f in zip(signatures, bodies, strict=True)
        )
        state = bdf.new_state(0.0, np.zeros(2), np.zeros(2), weight=np.zeros(2), h0=1.0, n_quad=1)
        options = bdf.Options(2, 1.0, 0.0, 0.1, 1)
        advance = types.Tuple((i8, i8, i8))(
            types.Tuple(tuple(types.FunctionType(s) for s in signatures)), data,
            numba.typeof(state), numba.typeof(options), f8, vector, matrix, matrix, i8, matrix,
            matrix,
        )  # fmt: skip
        self._advance: Any = numba.njit(advance, **OPTIONS)(_advance)

    def arguments(self, data: BearingData, law: tuple) -> tuple:
        """What the compiled functions take as their data."""
        return parts(data), law, self.evaluate

    def residual(self, t: float, y: np.ndarray, yd: np.ndarray, mode: int = 0) -> np.ndarray:
        """F(t, y, y'), a new array; mode 1 also fills the tangent, mode 2 the report."""
        out = np.zeros(self.layout.size)
        self.evaluate(t, y, yd, self.args[0], self.args[1], out, mode)
        return out

    def advance(self, state, options, t_end, times, ys, yds, first, log, quads):
        """``bdf.advance`` compiled for this bearing."""
        return self._advance(
            self.functions, self.args, state, options, t_end, times, ys, yds, first, log, quads
        )


# the integrator is plain Python that knows no compiler: its functions are compiled here, callees
# first, so that each finds the compiled one under its name
for _name in ("change_step", "interpolate", "worst", "correct", "_choose"):
    if not hasattr(getattr(bdf, _name), "py_func"):
        setattr(bdf, _name, allocating_kernel(getattr(bdf, _name)))


def _advance(fns, data, st, opt, t_end, times, ys, yds, first, log, quads):
    return _advance_kernel(fns, data, st, opt, t_end, times, ys, yds, first, log, quads)


_advance_kernel = allocating_kernel(bdf.advance)
