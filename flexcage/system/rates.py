"""The equations as y' = f(t, y) for an explicit integrator: their constraints eliminated.

What the constraints hold are single coordinates of the inner ring, whose mass matrix is diagonal:
its axial position, skew and tilt stand still (those that are not free), or its whole centre, and
its spin is a given function of time (unless a compliant shaft drives it). These coordinates are
set, the others accelerate by M u' = Q, and the rows left over say what forces hold them: the
multipliers (of a held centre the axial one alone). Of motions that are free these are the shaft's.
Further constraints, of any form, are found at every evaluation: coordinates and velocities are
moved onto them, and their multipliers are those with which they stay.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from flexcage.bodies.floating_frame import BodyData, modal_product
from flexcage.contacts.evaluation import ACCEPT, REPORT, RESIDUAL
from flexcage.contacts.state import Q_SKEW, Q_TILT, U_SKEW, U_SPIN, U_TILT
from flexcage.core.jit import VECTORISED, array_from, fields, kernel, part, zero
from flexcage.core.vectors import RIGID, TURN
from flexcage.solve.bordered import lu_factor, lu_solve
from flexcage.solve.oscillators import Oscillators, no_oscillators
from flexcage.system.constraints import BORNE, PROJECT
from flexcage.system.data import (
    AXIAL,
    CONSTRAINT_EQUATIONS,
    HOLD,
    MASS,
    OF_SPEED,
    TRANSVERSE,
)
from flexcage.system.equations import speed_at
from flexcage.system.floating import take_cage
from flexcage.system.layout import (
    AXIAL_FORCE,
    DRIVE_TORQUE,
    HELD_VELOCITIES,
    Layout,
    cage_at,
    of_element,
)
from flexcage.system.ring import ring_springs
from flexcage.system.sampling import give_powers, is_main, keep_force, keep_report
from flexcage.system.time_functions import table_slope, wave_slope


class RatesWork(NamedTuple):
    """Workspace for the cage's accelerations; n modes."""

    modal: np.ndarray  # (n, n) inverse of the constant modal mass
    coupled: np.ndarray  # (6, n) its product with the coupling of rigid motion and modes
    rigid: np.ndarray  # (6, 6) mass of the rigid motion while modes follow; then its factors
    pivot: np.ndarray  # (6,)
    x: np.ndarray  # (6,)
    given: np.ndarray  # (n,)


def new_rates_work(modal_mass: np.ndarray) -> RatesWork:
    n = len(modal_mass)
    return RatesWork(
        np.ascontiguousarray(np.linalg.inv(modal_mass)), np.zeros((6, n)), np.zeros((6, 6)),
        np.zeros(6, np.int64), np.zeros(6), np.zeros(n),
    )  # fmt: skip


def modal_oscillators(body: BodyData, layout: Layout) -> Oscillators:
    """The cages' modes as the linear oscillators that they are where its matrices are diagonal.

    Others, and modes that do not swing (w = 0), are left among the other unknowns.
    """
    if not (layout.has_cage and body.plain):
        return no_oscillators()
    mass = np.diag(body.mff)
    decay = 0.5 * np.diag(body.dff) / mass
    squared = np.diag(body.kff) / mass - decay**2
    oscillating = np.flatnonzero(squared > 0.0)
    at = np.arange(layout.size)
    views = (layout.q(at), layout.u(at))
    place = np.stack([view["modes"][..., oscillating].ravel() for view in views])
    alike = decay[oscillating], np.sqrt(squared[oscillating])
    return Oscillators(place, *(np.tile(x, layout.cages) for x in alike))


def rates(t, y, yd, data, power):
    """y' into yd, held coordinates and multipliers into y, powers into ``power`` if it has room."""
    _rates(t, y, yd, data, ACCEPT if power.shape[0] > 0 else RESIDUAL)
    give_powers(t, y, data[0], power)


def sample(sample, t, y, yd, data):
    """Keep the report at sampling time t; at whole samples y' and multipliers are those of y."""
    s = fields(data[0].samples)
    if is_main(sample, s.stride):
        _rates(t, y, yd, data, REPORT)
        keep_report(s, sample // s.stride, fields(data[0].report), fields(data[0].events))
    keep_force(sample, t, s, fields(data[0].events))


@part
def _rates(t, y, yd, data, mode):
    d = data[0]
    bodies, out, at = fields(d.bodies), fields(d.scratch).out, fields(d.places)
    inner, end, law = fields(d.inner_ring), at.lam, data[1]
    ring_q, ring_u, lam = array_from(y, at.inner_q), array_from(y, at.inner_u), array_from(y, end)
    _hold(t, ring_q, ring_u, inner, bodies)
    zero(y[end : at.loads])
    law[HOLD](t, y, yd, d, law[CONSTRAINT_EQUATIONS], out, PROJECT)
    pull = fields(d.scratch).pull
    ring_springs(inner, ring_q, ring_u, pull)
    for k in range(3):
        lam[k] = pull[HELD_VELOCITIES[k]]
    zero(yd)
    data[2](t, y, yd, d, data[1], out, mode)
    for k in range(end):
        yd[k] = -out[k]
    for k in range(at.loads, y.shape[0]):  # of rings that bend
        yd[k] = -out[k]
    linear, axial, transverse = (
        1.0 / bodies.element[MASS],
        1.0 / bodies.element[AXIAL],
        1.0 / bodies.element[TRANSVERSE],
    )
    for i in range(at.elements):
        a = yd[at.u :][of_element(i)]
        for c in range(3):
            a[c] *= linear
        a[U_SPIN] *= axial
        a[U_SKEW] *= transverse
        a[U_TILT] *= transverse
    a, row = array_from(yd, at.inner_u), array_from(out, at.inner_u)
    _by_inertia(inner, at.inner_modes, a)
    for k in range(3):
        c = HELD_VELOCITIES[k]
        if inner.free[c] == 0:
            a[c], lam[k] = 0.0, row[c] + _with_modes(inner, c, a)
    if inner.stands != 0:
        if inner.free[0] != 0:
            lam[AXIAL_FORCE] += row[0] + _with_modes(inner, 0, a)
        a[0] = a[1] = a[2] = 0.0
    if inner.free[U_SPIN] == 0:
        a[U_SPIN] = table_slope(bodies.speed, t) + wave_slope(bodies.waves[OF_SPEED], t)
        lam[DRIVE_TORQUE] = row[U_SPIN] + inner.inertia[AXIAL] * a[U_SPIN]
    # what is held has none
    _by_inertia(fields(d.outer_ring), at.outer_modes, array_from(yd, at.outer_u))
    for k in range(at.cages):
        first = cage_at(k, at).u
        accelerate_cage(k, y, yd[first : first + RIGID + at.modes], d)
    law[HOLD](t, y, yd, d, law[CONSTRAINT_EQUATIONS], out, BORNE)


@part
def accelerate_cage(k, y, v, d):
    """Accelerations of cage k and its modes in place of the forces v on them, after an evaluation
    at y."""
    frame, work, plain = fields(d.frame), fields(d.rates), fields(d.cage).plain
    M, H = frame.rigid, frame.coupled
    if fields(d.places).cages > 1:
        take_cage(k, y, d)
        M, H = frame.each_rigid[k], frame.each_coupled[k]
    cage_accelerations(M, H, plain, fields(d.scratch).A, v, work)


@part
def _with_modes(ring, c, a):
    """Force on a ring's velocity c by which its modes are accelerated."""
    force = 0.0
    for m in range(ring.coupling.shape[1]):
        force += ring.coupling[c, m] * a[RIGID + m]
    return force


@part
def _by_inertia(ring, modes, a):
    """Accelerations of a ring and its modes in place of the forces a on them."""
    if modes > 0:
        by_inverse(ring, a)
        return
    for k in range(3):
        a[k] /= ring.inertia[MASS]
    a[U_SPIN] /= ring.inertia[AXIAL]
    a[U_SKEW] /= ring.inertia[TRANSVERSE]
    a[U_TILT] /= ring.inertia[TRANSVERSE]


@part
def by_inverse(ring, a):
    """Accelerations of a ring with modes, in place of the forces a on it and on them."""
    n, forces = ring.inverse.shape[0], ring.spare
    for k in range(n):
        forces[k] = a[k]
    for k in range(n):
        total = 0.0
        for l in range(n):
            total += ring.inverse[k, l] * forces[l]
        a[k] = total


@part
def _hold(t, q, u, ring, bodies):
    """Give the inner ring's held coordinates and velocities their values."""
    if ring.free[0] == 0:
        q[0], u[0] = ring.rest[0], 0.0
    if ring.free[U_SKEW] == 0:
        q[Q_SKEW], u[U_SKEW] = ring.rest[U_SKEW], 0.0
    if ring.free[U_TILT] == 0:
        q[Q_TILT], u[U_TILT] = ring.rest[U_TILT], 0.0
    if ring.stands != 0:
        u[0] = u[1] = u[2] = 0.0
    if ring.free[U_SPIN] == 0:
        u[U_SPIN] = speed_at(bodies, t)


@kernel(fastmath=VECTORISED)
def cage_accelerations(M, H, plain, A, v, work):
    """Solve for the accelerations of a cage in place of its forces v, translations in space.

    M (6, 6) and H (6, n): the rigid motion's mass and its coupling with the modes, in the body's
    frame. The modal mass is constant (``plain``: diagonal), so the modes are eliminated by its
    inverse.
    """
    W, X, S, x, given = work.modal, work.coupled, work.rigid, work.x, work.given
    n = W.shape[0]
    forces = v[RIGID : RIGID + n]
    for c in range(3):
        x[c] = A[0, c] * v[0] + A[1, c] * v[1] + A[2, c] * v[2]
        x[TURN + c] = v[TURN + c]
    for r in range(6):
        modal_product(W, plain, H[r], X[r])
        for m in range(n):
            x[r] -= X[r, m] * forces[m]
        for c in range(6):
            taken = 0.0
            for m in range(n):
                taken += X[r, m] * H[c, m]
            S[r, c] = M[r, c] - taken
    lu_factor(S, work.pivot)
    lu_solve(S, work.pivot, x)
    modal_product(W, plain, forces, given)
    for m in range(n):
        total = given[m]
        for r in range(6):
            total -= X[r, m] * x[r]
        forces[m] = total
    for c in range(3):
        v[c] = A[c, 0] * x[0] + A[c, 1] * x[1] + A[c, 2] * x[2]
        v[TURN + c] = x[TURN + c]
