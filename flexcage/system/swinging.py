"""Outer rings that swing: coordinates with mass, and supports that hold a ring here and there.

A ring on supports ovalises at low frequencies, and is far softer then than its contacts: without
inertia it would follow them within a hundredth of ``relaxation``. So its low modes a have mass, and
so have the motions of a ring in a housing. They stand in space, as the outer ring and its supports
do. Race and supports are displaced by

    w_i = sum_m phi_m cos or sin(n_m psi_i) a_m + w'_i      y_k = sum_m chi_km a_m + y'_k

and a'' = -K a - tau K a' + sum_i phi_m F_i - sum_k chi_km p_k with unit masses. w' and y' are of
the harmonics left over (``bending``), which have no mass: with their compliances C between
elements, B between elements and supports, D between supports,

    w' = C s - B p - H F      y' = B^T s - D p      y <= 0, p >= 0, y p = 0 at every support

where s follows the contact forces F, and p presses on the ring; y = 0 where supports pull, too. The
supports' forces are those of least energy, found anew in every state: nothing is remembered.

Elements feel the slope F_i phi_m n_m cos' a_m of the modes beside s_i w_i', about the axis. The
seat bears what these moments leave over.
"""

from __future__ import annotations

from math import cos, sin
from typing import NamedTuple

import numpy as np

from flexcage.core.jit import VECTORISED, fields, kernel, part, zero
from flexcage.system.bending import (
    POINTS,
    STEP,
    RingsData,
    bend_rings,
    force_at,
    look_up,
    orbit_of,
    ring_forces_at,
)
from flexcage.system.data import KINETIC, MODAL_DAMPING, OUTER_RACE, STRAIN
from flexcage.system.layout import PER_ELEMENT, RING_FORCES
from flexcage.system.supports import press_supports, solve_pressed

COSINE, SINE = range(2)  # in ``Swings.quarter``
B1, B2, SLOPE1, SLOPE2 = range(4)  # in ``Swings.table``: of both ports, and over the azimuth


class Swings(NamedTuple):
    """Coordinates of the outer race and supports; those behind ``holds`` are workspaces."""

    harmonic: np.ndarray  # (M,) n of a coordinate's wave round the ring
    quarter: np.ndarray  # (M,) COSINE or SINE
    shape: np.ndarray  # (M, 2) by which it displaces the race at its crest, at both ports
    stiffness: np.ndarray  # (M, M) for unit masses
    late: np.ndarray  # (M,) relaxation time tau
    azimuth: np.ndarray  # (S,) of supports
    chi: np.ndarray  # (S, M) by which coordinates displace the ring outwards at supports
    table: np.ndarray  # (POINTS, 4) B of an element so far round the ring from a support
    between: np.ndarray  # (S, S) D
    holds: int  # 1 if supports pull as well
    wave: np.ndarray  # (Z, N + 1, 2) cosine and sine of n psi
    moved: np.ndarray  # (Z, 2) displacement of the race by coordinates, at its ports
    slope: np.ndarray  # (Z, 2) of that over the azimuth
    push: np.ndarray  # (M,) forces on coordinates
    beside: np.ndarray  # (S, Z, 4) of the table
    swung: np.ndarray  # (S,) displacement of supports by coordinates
    room: np.ndarray  # (S,) what they would be entered by if none pressed
    press: np.ndarray  # (S,) forces on the ring, inwards
    kept: np.ndarray  # (S,) supports that press, those first
    bears: np.ndarray  # (S,) does it press?
    factor: np.ndarray  # (S, S) Cholesky's factor of D, for those that press
    step: np.ndarray  # (S,)


class SwingsAt(NamedTuple):
    """Where in y coordinates and velocities are."""

    a: int
    v: int
    end: int


@part
def swings_at(d):
    """Places of coordinates and velocities in y, behind the forces that rings bear."""
    M = fields(d.swings).shape.shape[0]
    a = ring_forces_at(d) + RING_FORCES * fields(d.rings).moment.shape[1]
    return SwingsAt(a, a + M, a + 2 * M)


@part
def swing(q, y, d):
    """Displace the outer race by its coordinates and supports; ``bend_rings`` comes before."""
    if fields(d.swings).shape.shape[0] == 0:
        return
    at, bent = swings_at(d), ring_forces_at(d)
    _swing(q, y[bent : at.a], y[at.a : at.v], fields(d.rings), fields(d.swings))


@part
def _swing(q, s, a, rings, swings):
    Z, M = rings.moment.shape[1], a.shape[0]
    w, moved, slope = rings.deflection[OUTER_RACE], swings.moved, swings.slope
    zero(swings.push)
    zero(swings.press)
    _set_waves(q, swings)
    for i in range(Z):
        x = y = turn_x = turn_y = 0.0
        for m in range(M):
            wave, turn = _wave_of(i, m, swings)
            x += wave * swings.shape[m, 0] * a[m]
            y += wave * swings.shape[m, 1] * a[m]
            turn_x += turn * swings.shape[m, 0] * a[m]
            turn_y += turn * swings.shape[m, 1] * a[m]
        moved[i, 0], moved[i, 1], slope[i, 0], slope[i, 1] = x, y, turn_x, turn_y
        w[i, 0] += x
        w[i, 1] += y
    if swings.press.shape[0] > 0:
        _press(q, s, a, rings, swings)


@part
def _set_waves(q, swings):
    """Cosines and sines of all harmonics at the azimuths of the elements, by recursion."""
    wave = swings.wave
    for i in range(wave.shape[0]):
        psi = q[PER_ELEMENT * i + 2]
        c, s = cos(psi), sin(psi)
        wave[i, 0, COSINE], wave[i, 0, SINE] = 1.0, 0.0
        for n in range(1, wave.shape[1]):
            x, y = wave[i, n - 1, COSINE], wave[i, n - 1, SINE]
            wave[i, n, COSINE], wave[i, n, SINE] = x * c - y * s, y * c + x * s


@part
def _wave_of(i, m, swings):
    """The wave of coordinate m at element i, and its slope over the azimuth."""
    n = swings.harmonic[m]
    c, s = swings.wave[i, n, COSINE], swings.wave[i, n, SINE]
    if swings.quarter[m] == COSINE:
        return c, -n * s
    return s, n * c


@part
def _press(q, s, a, rings, swings):
    """What supports do to the race and to its coordinates."""
    Z, press = rings.moment.shape[1], swings.press
    w, moment = rings.deflection[OUTER_RACE], rings.moment[OUTER_RACE]
    for k in range(press.shape[0]):
        swung = 0.0
        for m in range(a.shape[0]):
            swung += swings.chi[k, m] * a[m]
        swings.swung[k] = swung
        entered = swung
        for i in range(Z):
            x = (q[PER_ELEMENT * i + 2] - swings.azimuth[k]) * STEP
            whole = np.floor(x)
            c = swings.beside[k, i]
            look_up(swings.table, int(whole) & (POINTS - 1), x - whole, c)
            f = force_at(OUTER_RACE, i, Z)
            entered += c[B1] * s[f] + c[B2] * s[f + 1]
        swings.room[k] = entered
    press_supports(swings)
    for k in range(press.shape[0]):
        p = press[k]
        if p == 0.0:
            continue
        for m in range(a.shape[0]):
            swings.push[m] -= swings.chi[k, m] * p
        for i in range(Z):
            c, f = swings.beside[k, i], force_at(OUTER_RACE, i, Z)
            w[i, 0] -= p * c[B1]
            w[i, 1] -= p * c[B2]
            moment[i] -= p * (s[f] * c[SLOPE1] + s[f + 1] * c[SLOPE2])


@part
def push_swings(i, d):
    """What element i does to the coordinates, and their slope to it; its contact forces are known,
    and ``bending.push_by_slopes`` comes after."""
    swings, rings = fields(d.swings), fields(d.rings)
    x, y = rings.force[OUTER_RACE, i, 0], rings.force[OUTER_RACE, i, 1]
    if x == 0.0 and y == 0.0:
        return
    for m in range(swings.push.shape[0]):
        wave, _ = _wave_of(i, m, swings)
        swings.push[m] += wave * (swings.shape[m, 0] * x + swings.shape[m, 1] * y)
    if swings.push.shape[0] > 0:
        rings.moment[OUTER_RACE, i] += x * swings.slope[i, 0] + y * swings.slope[i, 1]


@part(fastmath=VECTORISED)
def swing_rows(y, yd, d, out):
    """Rows of coordinates and their velocities."""
    swings, at = fields(d.swings), swings_at(d)
    a, v = y[at.a : at.v], y[at.v : at.end]
    for m in range(a.shape[0]):
        force = swings.push[m]
        for l in range(a.shape[0]):
            force -= swings.stiffness[m, l] * (a[l] + swings.late[l] * v[l])
        out[at.a + m] = yd[at.a + m] - v[m]
        out[at.v + m] = yd[at.v + m] - force


@part
def swing_report(q, u, y, d):
    """Energy of coordinates and supports, and the power that they lose, beside what
    ``bending.ring_report`` has."""
    swings, rings, rep = fields(d.swings), fields(d.rings), fields(d.report)
    if swings.push.shape[0] == 0:
        return
    at, s = swings_at(d), y[ring_forces_at(d) :]
    a, v = y[at.a : at.v], y[at.v : at.end]
    for m in range(a.shape[0]):
        rep.energy[KINETIC] += 0.5 * v[m] * v[m]
        for l in range(a.shape[0]):
            force = swings.stiffness[m, l] * a[l]
            rep.energy[STRAIN] += 0.5 * a[m] * force
            rep.power[MODAL_DAMPING] -= v[m] * swings.stiffness[m, l] * swings.late[l] * v[l]
    if rings.bends[OUTER_RACE] == 0:
        return
    Z = rings.moment.shape[1]
    for i in range(Z):  # the report took the whole deflection
        f = force_at(OUTER_RACE, i, Z)
        for c in range(2):
            rep.energy[STRAIN] -= 0.5 * s[f + c] * swings.moved[i, c]
    for k in range(swings.press.shape[0]):
        rep.energy[STRAIN] += 0.5 * swings.press[k] * swings.swung[k]
    if swings.press.shape[0] > 0:
        _lost_at_supports(q, u, s, v, d)


@part
def _lost_at_supports(q, u, s, v, d):
    """Power lost where supports keep the race from yielding: their share of (F - s) w'."""
    swings, rings, rep = fields(d.swings), fields(d.rings), fields(d.report)
    Z, rate, step = rings.moment.shape[1], rings.rate[OUTER_RACE], swings.step
    for k in range(step.shape[0]):
        step[k] = 0.0
        for m in range(v.shape[0]):
            step[k] += swings.chi[k, m] * v[m]
        for i in range(Z):
            c, f, orbit = swings.beside[k, i], force_at(OUTER_RACE, i, Z), orbit_of(q, u, i)
            for p in range(2):
                late = rings.force[OUTER_RACE, i, p] - s[f + p]
                step[k] += c[p] * rate * late + c[SLOPE1 + p] * s[f + p] * orbit
    # the displacements' rates in, the forces' rates out
    kept = swings.room
    for k in range(step.shape[0]):
        kept[k] = swings.press[k]
    solve_pressed(step, swings.press, swings)
    for k in range(step.shape[0]):
        step[k], swings.press[k] = swings.press[k], kept[k]
        for i in range(Z):
            c, f, orbit = swings.beside[k, i], force_at(OUTER_RACE, i, Z), orbit_of(q, u, i)
            for p in range(2):
                late = rings.force[OUTER_RACE, i, p] - s[f + p]
                given = step[k] * c[p] + swings.press[k] * c[SLOPE1 + p] * orbit
                rep.power[MODAL_DAMPING] += late * given


@kernel
def deflect(q, s, a, rings: RingsData, swings: Swings):
    """Set ``rings.deflection`` and ``swings.press`` under forces s, for a record; without H F."""
    bend_rings(q, s, rings)
    if a.shape[0] > 0:
        _swing(q, s, a, rings, swings)


def no_swings(elements: int) -> Swings:
    """Data of a ring that does not swing, in the types that kernels take."""
    none = np.zeros(0)
    return swings_of(
        elements, np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 2)),
        np.zeros((0, 0)), none,
    )  # fmt: skip


def swings_of(
    elements: int, harmonic: np.ndarray, quarter: np.ndarray, shape: np.ndarray,
    stiffness: np.ndarray, late: np.ndarray, *, azimuth: np.ndarray | None = None,
    chi: np.ndarray | None = None, table: np.ndarray | None = None,
    between: np.ndarray | None = None, holds: bool = False,
) -> Swings:  # fmt: skip
    """Coordinates and, if any are given, supports, with room to work."""
    count, held = len(harmonic), 0 if azimuth is None else len(azimuth)
    waves, z, st = int(harmonic.max(initial=0)) + 1, np.zeros, np.ascontiguousarray
    return Swings(
        harmonic, quarter, st(shape), st(stiffness), late,
        z(0) if azimuth is None else azimuth,
        z((held, count)) if chi is None else st(chi),
        z((POINTS, 4)) if table is None else st(table),
        z((held, held)) if between is None else st(between),
        int(holds), z((elements, waves, 2)), z((elements, 2)), z((elements, 2)), z(count),
        z((held, elements, 4)), z(held), z(held), z(held), z(held, np.int64), z(held, np.int64),
        z((held, held)), z(held),
    )  # fmt: skip
