"""How further constraints enter the equations: their rows, and what an explicit method does.

A bearing without any calls ``hold_nothing`` in their place, and need not compile them.
"""

from __future__ import annotations

from flexcage.contacts.evaluation import TANGENT
from flexcage.core.jit import fields, part, zero
from flexcage.core.rotation import quaternion_rate
from flexcage.solve.bordered import lu_factor, lu_solve
from flexcage.system.constraints import BORNE, OFF, POSITION, PROJECT
from flexcage.system.data import FIXED
from flexcage.system.equations import ring_rates
from flexcage.system.layout import (
    AXIAL_FORCE,
    CAGE,
    CAGE_TURN,
    DRIVE_TORQUE,
    HELD_VELOCITIES,
    MODES,
    MOMENT_Y,
    MOMENT_Z,
    N_OWN,
    OUTER,
    Q_MODES,
    Q_QUATERNION,
    places,
)
from flexcage.system.rates import cage_accelerations

INSTANT = 1e-6  # [s] over which constraints are differentiated in time


def hold_nothing(t, y, yd, d, rows, out, mode):
    """Nothing is held beyond drive and load."""


def hold(t, y, yd, d, rows, out, mode):
    """The part of the constraints ``rows`` (``constraints.ALL_ROWS``) in an evaluation.

    ``mode`` of ``residual.evaluate``: their rows, and what multipliers add to those of rings and
    cage. ``PROJECT``: coordinates and velocities in y are moved onto the constraints. ``BORNE``:
    multipliers into y, and what they do to the accelerations in yd.
    """
    Z, nm = fields(d.bodies).radius.shape[0], fields(d.pocket).phi_max.shape[0]
    at = places(Z, nm)
    q, u = y[at.rest_q :][:Q_MODES], y[at.rest_u :][:MODES]
    if mode == PROJECT:
        _project(t, q, u, d, rows)
    elif mode == BORNE:
        _bear(t, q, u, yd[at.rest_q :][:Q_MODES], yd[at.rest_u : at.lam], y[at.lam :], d, rows)
    else:
        r_q, r_u = out[at.rest_q : at.u], out[at.rest_u : at.lam]
        _rows(t, q, u, y[at.held :], d, rows, r_q, r_u, out[at.held :], mode)


@part
def _evaluate(t, q, u, c, rows):
    """G, g and h of all constraints at coordinates and velocities of rings and cage."""
    zero(c.G)
    zero(c.g)
    zero(c.h)
    rows(t, q, u, c.p, c.G, c.g, c.h)


@part
def _displaced(q, shift, rates, out):
    """Change (15,) of the coordinates q of rings and cage that a displacement (14,), in the order
    of velocities, makes; ``rates``: room for six numbers."""
    ring_rates(q, shift, rates)
    for k in range(OUTER):
        out[k] = rates[k]
    for k in range(OUTER, CAGE_TURN):
        out[k] = shift[k]
    turn = out[Q_QUATERNION:Q_MODES]
    quaternion_rate(q[Q_QUATERNION:Q_MODES], shift[CAGE_TURN:MODES], turn)


@part
def _rows(t, q, u, multipliers, d, rows, r_q, r_u, out, mode):
    """Rows of the constraints into ``out``, and what their ``multipliers``, lambda then mu, add to
    the rows of rings and cage; slopes if asked for."""
    c, tan, work = fields(d.constraints), fields(d.tangent), fields(d.scratch)
    fixed = fields(d.bodies).support == FIXED  # then nothing moves the outer ring
    _evaluate(t, q, u, c, rows)
    m, shift = c.level.shape[0], work.shift
    lam, mu = multipliers[:m], multipliers[m : 2 * m]
    zero(shift)
    for k in range(m):
        held = c.level[k] != OFF
        out[k] = c.h[k] if held else lam[k]
        out[m + k] = c.g[k] if c.level[k] == POSITION else mu[k]
        for j in range(MODES):
            acts = 0.0 if fixed and OUTER <= j < CAGE else c.G[k, j]
            r_u[j] -= acts * lam[k] if held else 0.0
            if c.level[k] == POSITION:
                shift[j] += acts * mu[k]
            if mode == TANGENT:
                tan.held[k, j] = acts if held else 0.0
    _displaced(q, shift, work.S[0], work.moved)
    for j in range(Q_MODES):
        r_q[j] -= work.moved[j]
    if mode == TANGENT:
        _slopes(c, tan)


@part
def _slopes(c, tan):
    """Slopes of the constraints' rows in velocities, displacements and multipliers."""
    m = c.level.shape[0]
    first = tan.Kbb.shape[0] - 2 * m
    for k in range(m):
        rate, place = first + k, first + m + k
        held, kept = c.level[k] != OFF, c.level[k] == POSITION
        for j in range(MODES):
            if held:
                tan.Cbb[rate, j] = c.G[k, j]
            if kept:
                tan.Kbb[place, j] = c.G[k, j]
        if not held:
            tan.Cbb[rate, rate] = 1.0
        if not kept:
            tan.Cbb[place, place] = 1.0
        for l in range(m if kept else 0):
            if c.level[l] == POSITION:
                for j in range(MODES):
                    tan.Kbb[place, first + m + l] += c.G[k, j] * tan.held[l, j]


@part
def _project(t, q, u, d, rows):
    """Move coordinates q and velocities u of rings and cage onto the constraints, along what these
    pull; one step of Newton's, as a step's error leaves them close."""
    c, work = fields(d.constraints), fields(d.scratch)
    m = c.level.shape[0]
    for which in range(2):  # places first: velocities depend on them
        _evaluate(t, q, u, c, rows)
        for k in range(m):
            kept = which == 1 or c.level[k] == POSITION
            c.x[k] = -(c.g[k] if which == 0 else c.h[k]) if kept else 0.0
            for l in range(m):
                both = kept and (which == 1 or c.level[l] == POSITION)
                c.S[k, l] = 0.0 if k != l or both else 1.0
                for j in range(MODES if both else 0):
                    c.S[k, l] += c.G[k, j] * c.ease[j] * c.G[l, j]
        lu_factor(c.S, c.pivot)
        lu_solve(c.S, c.pivot, c.x)
        for j in range(MODES):
            work.shift[j] = 0.0
            for k in range(m):
                work.shift[j] += c.ease[j] * c.G[k, j] * c.x[k]
        if which == 1:
            for j in range(MODES):
                u[j] += work.shift[j]
        else:
            _displaced(q, work.shift, work.S[0], work.moved)
            for j in range(Q_MODES):
                q[j] += work.moved[j]


@part
def _bear(t, q, u, qd, a, multipliers, d, rows):
    """Multipliers of the constraints, and what they do to the accelerations a of rings and cage,
    so that h stays zero: G (a + M^-1 G^T lambda) + dh/dt at constant velocities = 0.

    ``multipliers``: those of drive and load (4, and 3 of places), which bear what is held already,
    then these.
    """
    c, frame = fields(d.constraints), fields(d.frame)
    m = c.level.shape[0]
    for side in range(2):
        late = -INSTANT if side == 0 else INSTANT
        for j in range(Q_MODES):
            c.place[side, j] = q[j] + late * qd[j]
        zero(c.spare)
        zero(c.late[side])
        zero(c.g)
        rows(t + late, c.place[side], u, c.p, c.spare, c.g, c.late[side])
    _evaluate(t, q, u, c, rows)
    for k in range(m):
        pull = c.pull[k]
        zero(pull)
        for j in range(MODES):
            pull[j] = c.G[k, j] if j >= CAGE else c.G[k, j] * c.ease[j]
        cage_accelerations(
            frame.rigid, frame.coupled, fields(d.cage).plain, fields(d.scratch).A, pull[CAGE:],
            fields(d.rates),
        )  # fmt: skip
    for k in range(m):
        c.x[k] = -0.5 * (c.late[1, k] - c.late[0, k]) / INSTANT
        for j in range(MODES):
            c.x[k] -= c.G[k, j] * a[j]
        for l in range(m):
            c.S[k, l] = 0.0
            for j in range(MODES):
                c.S[k, l] += c.G[k, j] * c.pull[l, j]
    lu_factor(c.S, c.pivot)
    lu_solve(c.S, c.pivot, c.x)
    for k in range(m):
        multipliers[N_OWN + k] = c.x[k]
        for row in (AXIAL_FORCE, DRIVE_TORQUE, MOMENT_Y, MOMENT_Z):  # what holds the ring bears it
            j = HELD_VELOCITIES[row]
            multipliers[row] -= c.G[k, j] * c.x[k] if c.ease[j] == 0.0 else 0.0
        for j in range(a.shape[0]):
            a[j] += c.pull[k, j] * c.x[k]
