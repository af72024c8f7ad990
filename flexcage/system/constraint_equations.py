"""How further constraints enter the equations: their rows, and what an explicit method does.

A bearing without any calls ``no_constraints`` in their place, and need not compile them.
"""

from __future__ import annotations

from flexcage.contacts.evaluation import TANGENT
from flexcage.core.jit import array_from, copy_into, fields, part, zero
from flexcage.core.rotation import quaternion_rate
from flexcage.core.vectors import RIGID, TURN
from flexcage.solve.bordered import lu_factor, lu_solve
from flexcage.system.constraints import BORNE, OFF, POSITION, PROJECT
from flexcage.system.layout import (
    AXIAL_FORCE,
    DRIVE_TORQUE,
    FRAME,
    HELD_VELOCITIES,
    MOMENT_Y,
    MOMENT_Z,
    N_OWN,
    QUATERNION,
    RING,
    Places,
    cage_at,
)
from flexcage.system.rates import accelerate_cage, by_inverse
from flexcage.system.ring import ring_rates

INSTANT = 1e-6  # [s] over which constraints are differentiated in time


def no_constraints(t, y, yd, d, rows, out, mode):
    """Nothing is held beyond drive and load."""


def apply_constraints(t, y, yd, d, rows, out, mode):
    """The part of the constraints ``rows`` (``constraints.ALL_ROWS``) in an evaluation.

    ``mode`` of ``residual.evaluate``: their rows, and what multipliers add to those of the bodies.
    ``PROJECT``: coordinates and velocities in y are moved onto the constraints. ``BORNE``:
    multipliers into y, and what they do to the accelerations in yd.
    """
    if mode == PROJECT:
        _project(t, y, d, rows)
    elif mode == BORNE:
        _bear(t, y, yd, d, rows)
    else:
        _rows(t, y, d, rows, out, mode)


@part
def _places(at):
    """The places as the functions of constraints take them."""
    return Places(
        at.elements, at.cages, at.in_cage, at.modes, at.inner_modes, at.outer_modes, at.q, at.u,
        at.inner_q, at.inner_u, at.inner_b, at.outer_q, at.outer_u, at.outer_b, at.cage_q,
        at.cage_u, at.cage_b, at.bodies_q, at.bodies_u, at.border, at.coordinates, at.lam, at.held,
        at.loads,
    )  # fmt: skip


@part
def _evaluate(t, y, d, rows):
    """G, g and h of all constraints at y."""
    c = fields(d.constraints)
    zero(c.G)
    zero(c.g)
    zero(c.h)
    rows(t, y, _places(fields(d.places)), c.p, c.G, c.g, c.h)


@part
def _displaced(y, d, shift, out):
    """Change of the bodies' coordinates that a displacement of all bodies, in the order of
    velocities, makes."""
    at, rates = fields(d.places), fields(d.scratch).S[0]
    for q, b, modes in (
        (at.inner_q, at.inner_b, at.inner_modes), (at.outer_q, at.outer_b, at.outer_modes),
    ):  # fmt: skip
        ring_rates(array_from(y, q), array_from(shift, b), rates)
        for k in range(RING):
            out[q - at.bodies_q + k] = rates[k]
        for m in range(modes):
            out[q - at.bodies_q + RING + m] = shift[b + RIGID + m]
    for n in range(at.cages):
        place = cage_at(n, at)
        own, cage = array_from(shift, place.b), array_from(out, place.q - at.bodies_q)
        for k in range(3):
            cage[k] = own[k]
        turn = array_from(cage, QUATERNION)
        quaternion_rate(array_from(y, place.q + QUATERNION), array_from(own, TURN), turn)
        for m in range(at.modes):
            cage[FRAME + m] = own[RIGID + m]


@part
def _rows(t, y, d, rows, out, mode):
    """Rows of the constraints into ``out``, and what their multipliers add to the rows of bodies;
    slopes if asked for."""
    c, tan, work, at = fields(d.constraints), fields(d.tangent), fields(d.scratch), fields(d.places)
    outer = fields(d.outer_ring).free
    r_q, r_u = array_from(out, at.bodies_q), array_from(out, at.bodies_u)
    multipliers, missed = array_from(y, at.held), array_from(out, at.held)
    _evaluate(t, y, d, rows)
    m, shift = c.level.shape[0], work.shift
    zero(shift)
    for k in range(m):
        for j in range(RING):  # nothing moves what the mount holds
            if outer[j] == 0:
                c.G[k, at.outer_b + j] = 0.0
        lam, mu, held = multipliers[k], multipliers[m + k], c.level[k] != OFF
        missed[k] = c.h[k] if held else lam
        missed[m + k] = c.g[k] if c.level[k] == POSITION else mu
        for j in range(at.border):
            r_u[j] -= c.G[k, j] * lam if held else 0.0
            if c.level[k] == POSITION:
                shift[j] += c.G[k, j] * mu
            if mode == TANGENT:
                tan.held[k, j] = c.G[k, j] if held else 0.0
    _displaced(y, d, shift, work.moved)
    for j in range(at.coordinates):
        r_q[j] -= work.moved[j]
    if mode == TANGENT:
        _slopes(c, at, tan)


@part
def _slopes(c, at, tan):
    """Slopes of the constraints' rows in velocities, displacements and multipliers."""
    m, first = c.level.shape[0], at.border + N_OWN
    for k in range(m):
        rate, place = first + k, first + m + k
        held, kept = c.level[k] != OFF, c.level[k] == POSITION
        for j in range(at.border):
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
                for j in range(at.border):
                    tan.Kbb[place, first + m + l] += c.G[k, j] * tan.held[l, j]


@part
def _project(t, y, d, rows):
    """Move coordinates and velocities in y onto the constraints, along what these pull; one step of
    Newton's, as a step's error leaves them close."""
    c, work, at = fields(d.constraints), fields(d.scratch), fields(d.places)
    m, q, u = c.level.shape[0], array_from(y, at.bodies_q), array_from(y, at.bodies_u)
    for which in range(2):  # places first: velocities depend on them
        _evaluate(t, y, d, rows)
        for k in range(m):
            kept = which == 1 or c.level[k] == POSITION
            c.x[k] = -(c.g[k] if which == 0 else c.h[k]) if kept else 0.0
            for l in range(m):
                both = kept and (which == 1 or c.level[l] == POSITION)
                c.S[k, l] = 0.0 if k != l or both else 1.0
                for j in range(at.border if both else 0):
                    c.S[k, l] += c.G[k, j] * c.ease[j] * c.G[l, j]
        lu_factor(c.S, c.pivot)
        lu_solve(c.S, c.pivot, c.x)
        for j in range(at.border):
            work.shift[j] = 0.0
            for k in range(m):
                work.shift[j] += c.ease[j] * c.G[k, j] * c.x[k]
        if which == 1:
            for j in range(at.border):
                u[j] += work.shift[j]
        else:
            _displaced(y, d, work.shift, work.moved)
            for j in range(at.coordinates):
                q[j] += work.moved[j]


@part
def _bear(t, y, yd, d, rows):
    """Multipliers of the constraints into y, and what they do to the accelerations of bodies in yd,
    so that h stays zero: G (a + M^-1 G^T lambda) + dh/dt at constant velocities = 0.

    Those of drive and load bear what is held already.
    """
    c, at = fields(d.constraints), fields(d.places)
    m, lam, a = c.level.shape[0], array_from(y, at.lam), array_from(yd, at.bodies_u)
    for side in range(2):
        late = -INSTANT if side == 0 else INSTANT
        copy_into(c.place, y)
        for j in range(at.coordinates):
            c.place[at.bodies_q + j] += late * yd[at.bodies_q + j]
        zero(c.spare)
        zero(c.late[side])
        zero(c.g)
        rows(t + late, c.place, _places(at), c.p, c.spare, c.g, c.late[side])
    _evaluate(t, y, d, rows)
    for k in range(m):
        pull = c.pull[k]
        for j in range(at.border):
            pull[j] = c.G[k, j] if j >= at.cage_b else c.G[k, j] * c.ease[j]
        for ring, b, modes in (
            (fields(d.inner_ring), at.inner_b, at.inner_modes),
            (fields(d.outer_ring), at.outer_b, at.outer_modes),
        ):
            if modes > 0:
                for j in range(b, b + RIGID + modes):
                    pull[j] = c.G[k, j]
                by_inverse(ring, array_from(pull, b))
        for n in range(at.cages):
            first = cage_at(n, at).b
            accelerate_cage(n, y, pull[first : first + RIGID + at.modes], d)
    for k in range(m):
        c.x[k] = -0.5 * (c.late[1, k] - c.late[0, k]) / INSTANT
        for j in range(at.border):
            c.x[k] -= c.G[k, j] * a[j]
        for l in range(m):
            c.S[k, l] = 0.0
            for j in range(at.border):
                c.S[k, l] += c.G[k, j] * c.pull[l, j]
    lu_factor(c.S, c.pivot)
    lu_solve(c.S, c.pivot, c.x)
    for k in range(m):
        lam[N_OWN + k] = c.x[k]
        for row in (AXIAL_FORCE, DRIVE_TORQUE, MOMENT_Y, MOMENT_Z):  # what holds the ring bears it
            j = at.inner_b + HELD_VELOCITIES[row]
            lam[row] -= c.G[k, j] * c.x[k] if c.ease[j] == 0.0 else 0.0
        for j in range(at.border):
            a[j] += c.pull[k, j] * c.x[k]
