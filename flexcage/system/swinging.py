"""Outer rings that swing: coordinates with mass, and supports that hold a ring here and there.

A ring on supports ovalises at low frequencies, and is far softer then than its contacts: without
inertia it would follow them within a tenth of a microsecond. So its low modes a have mass. They
stand in space, as the outer ring and its supports do. Race and supports are displaced by

    w_i = sum_m phi_m cos or sin(n_m psi_i) a_m + w'_i      y_k = sum_m chi_km a_m + y'_k

and a'' = -K a - tau K a' + sum_i phi_m F_i - sum_k chi_km p_k with unit masses. w' and y' are of
the harmonics left over (``bending``), which have no mass: with their compliances C between
elements, B between elements and supports, D between supports,

    w' = C s - B p - H F      y' = B^T s - D p      y <= 0, p >= 0, y p = 0 at every support

where s follows the contact forces F, and p presses on the ring; y = 0 where supports pull, too. The
supports' forces are those of least energy, found anew in every state: nothing is remembered.

Elements feel the slope F_i phi_m n_m cos' a_m of the modes beside s_i w_i', about the axis. The
seat bears what these moments leave over. Contacts feel the rate of the modes' share of w as well,
so F_i in these two places is all of the contact force, with damping and friction.

Ribs and the cage's lands follow the coordinates too: ``ring_walls``.
"""

from __future__ import annotations

from math import cos, sin
from typing import NamedTuple

import numpy as np

from flexcage.contacts.ring_waves import COSINE, PLACE, SINE, no_waves
from flexcage.core.jit import VECTORISED, fields, kernel, part, zero
from flexcage.system.bending import (
    POINTS,
    STEP,
    RingsData,
    bend_rings,
    force_at,
    look_up,
    orbit_of,
)
from flexcage.system.data import KINETIC, MODAL_DAMPING, OUTER_RACE, STRAIN
from flexcage.system.layout import PER_ELEMENT
from flexcage.system.ring_walls import set_sections
from flexcage.system.supports import press_supports, solve_pressed

B1, B2, SLOPE1, SLOPE2 = range(4)  # in ``Swings.table``: of both ports, and over the azimuth


class Swings(NamedTuple):
    """Coordinates of the outer race and supports; those behind ``holds`` are workspaces."""

    harmonic: np.ndarray  # (M,) n of a coordinate's wave round the ring
    quarter: np.ndarray  # (M,) COSINE or SINE of ``contacts.ring_waves``
    shape: np.ndarray  # (M, 2) by which it displaces the race at its crest, at both ports
    section: np.ndarray  # (M, 3) and the section as a whole, as ``contacts.ring_waves`` has it
    stiffness: np.ndarray  # (M, M) for unit masses
    late: np.ndarray  # (M,) time tau by which its spring damps it
    azimuth: np.ndarray  # (S,) of supports
    chi: np.ndarray  # (S, M) by which coordinates displace the ring outwards at supports
    table: np.ndarray  # (K, POINTS, 4) B of an element so far round the ring from a support
    kind: np.ndarray  # (S,) of the support in ``table``: supports as wide as it
    between: np.ndarray  # (S, S) D
    holds: int  # 1 if supports pull as well
    crest: np.ndarray  # (N + 1, 2, 4) of cosine and sine: displacement and rate at both ports
    load: np.ndarray  # (N + 1, 2, 2) contact forces on them, at both ports
    carried: np.ndarray  # (N + 1, 2, 2, 3) the section's waves; none if the ring does not swing
    borne: np.ndarray  # (N + 1, 2, 3) forces of ribs and lands on them
    wall: np.ndarray  # (3, 3) of the section beside a rib's roller, see ``ring_walls``
    wave: np.ndarray  # (Z, N + 1, 2) cosine and sine of n psi
    moved: np.ndarray  # (Z, 2) displacement of the race by coordinates, at its ports
    slope: np.ndarray  # (Z, 2) of that over the azimuth
    rate: np.ndarray  # (Z, 2) of that in time, as an element feels it that orbits
    total: np.ndarray  # (Z, 2) of all contact forces on the race, friction too, at its ports
    push: np.ndarray  # (M,) forces of supports on coordinates
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
    M, a = fields(d.swings).shape.shape[0], fields(d.places).swings
    return SwingsAt(a, a + M, a + 2 * M)


@part
def swing(q, u, y, d):
    """Displace the outer race by its coordinates and supports; ``bend_rings`` comes before."""
    swings = fields(d.swings)
    if swings.push.shape[0] == 0:
        if swings.carried.shape[0] > 0:  # it stands, but displaced
            _set_waves(q, swings)
        return
    at, bent = swings_at(d), fields(d.places).loads
    _swing(q, y[bent : at.a], y[at.a : at.v], y[at.v : at.end], fields(d.rings), swings)
    zero(swings.total)
    zero(swings.load)
    for i in range(swings.rate.shape[0]):
        orbit = orbit_of(q, u, i)
        for p in range(2):
            swings.rate[i, p] += swings.slope[i, p] * orbit


@part
def _swing(q, s, a, v, rings, swings):
    w, moved, slope, rate = rings.deflection[OUTER_RACE], swings.moved, swings.slope, swings.rate
    zero(swings.push)
    zero(swings.press)
    _set_waves(q, swings)
    _set_crests(a, v, swings)
    set_sections(a, v, swings)
    for i in range(w.shape[0]):
        for p in range(2):
            x = turn = moves = 0.0
            for n in range(swings.crest.shape[0]):
                cos_n, sin_n = swings.wave[i, n, COSINE], swings.wave[i, n, SINE]
                even, odd = swings.crest[n, COSINE], swings.crest[n, SINE]
                x += cos_n * even[p] + sin_n * odd[p]
                turn += n * (cos_n * odd[p] - sin_n * even[p])
                moves += cos_n * even[2 + p] + sin_n * odd[2 + p]
            moved[i, p], slope[i, p], rate[i, p] = x, turn, moves
            w[i, p] += x
    if swings.press.shape[0] > 0:
        _press(q, s, a, rings, swings)


@part
def _set_crests(a, v, swings):
    """Displacements and rates of all waves at their crests, of both ports."""
    zero(swings.crest)
    for m in range(a.shape[0]):
        crest = swings.crest[swings.harmonic[m], swings.quarter[m]]
        for p in range(2):
            crest[p] += swings.shape[m, p] * a[m]
            crest[2 + p] += swings.shape[m, p] * v[m]


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
            look_up(swings.table[swings.kind[k]], int(whole) & (POINTS - 1), x - whole, c)
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
    if swings.push.shape[0] == 0:
        return
    x, y = swings.total[i, 0], swings.total[i, 1]
    if x == 0.0 and y == 0.0:
        return
    for n in range(swings.load.shape[0]):
        for quarter in range(2):
            swings.load[n, quarter, 0] += swings.wave[i, n, quarter] * x
            swings.load[n, quarter, 1] += swings.wave[i, n, quarter] * y
    rings.moment[OUTER_RACE, i] += x * swings.slope[i, 0] + y * swings.slope[i, 1]


@part(fastmath=VECTORISED)
def swing_rows(y, yd, d, out):
    """Rows of coordinates and their velocities; all contact forces are known."""
    swings, at = fields(d.swings), swings_at(d)
    a, v = y[at.a : at.v], y[at.v : at.end]
    for m in range(a.shape[0]):
        load = swings.load[swings.harmonic[m], swings.quarter[m]]
        borne = swings.borne[swings.harmonic[m], swings.quarter[m]]
        force = swings.push[m] + swings.shape[m, 0] * load[0] + swings.shape[m, 1] * load[1]
        for c in range(swings.section.shape[1]):
            force += swings.section[m, c] * borne[c]
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
    at, s = swings_at(d), y[fields(d.places).loads :]
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
        _swing(q, s, a, a, rings, swings)


def no_swings(elements: int) -> Swings:
    """Data of a ring that does not swing, in the types that kernels take."""
    none = np.zeros(0)
    return swings_of(
        elements, np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 2)),
        np.zeros((0, 3)), np.zeros((0, 0)), none,
    )  # fmt: skip


def standing(elements: int, made: Swings, at: np.ndarray) -> Swings:
    """Data of a ring whose section stays where coordinates ``at`` (M,) of a ring that swings put
    it, for ribs in the search of a start."""
    still = no_swings(elements)
    if not len(at):
        return still
    carried, borne = 0.0 * made.carried, 0.0 * made.borne
    np.add.at(carried[:, :, PLACE], (made.harmonic, made.quarter), made.section * at[:, None])
    return still._replace(carried=carried, borne=borne, wave=0.0 * made.wave)


def swings_of(
    elements: int, harmonic: np.ndarray, quarter: np.ndarray, shape: np.ndarray,
    section: np.ndarray, stiffness: np.ndarray, late: np.ndarray, *,
    azimuth: np.ndarray | None = None, chi: np.ndarray | None = None,
    table: np.ndarray | None = None, kind: np.ndarray | None = None,
    between: np.ndarray | None = None, holds: bool = False,
) -> Swings:  # fmt: skip
    """Coordinates and, if any are given, supports, with room to work."""
    count, held = len(harmonic), 0 if azimuth is None else len(azimuth)
    waves, z, st = int(harmonic.max(initial=0)) + 1, np.zeros, np.ascontiguousarray
    carried, borne = no_waves() if count == 0 else (z((waves, 2, 2, 3)), z((waves, 2, 3)))
    return Swings(
        harmonic, quarter, st(shape), st(section), st(stiffness), late,
        z(0) if azimuth is None else azimuth,
        z((held, count)) if chi is None else st(chi),
        z((1, POINTS, 4)) if table is None else st(table),
        z(held, np.int64) if kind is None else kind.astype(np.int64),
        z((held, held)) if between is None else st(between),
        int(holds), z((waves, 2, 4)), z((waves, 2, 2)), carried, borne, z((3, 3)),
        z((elements, waves, 2)),
        z((elements, 2)), z((elements, 2)), z((elements, 2)), z((elements, 2)), z(count),
        z((held, elements, 4)), z(held), z(held), z(held), z(held, np.int64), z(held, np.int64),
        z((held, held)), z(held),
    )  # fmt: skip
