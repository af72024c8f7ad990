"""Modes of rings that bend: coordinates with mass, and supports that hold a ring here and there.

A ring on a soft seat or on supports ovalises at low frequencies, and is far softer then than its
contacts: without inertia it would follow them within a tenth of a microsecond. So its low modes are
coordinates a of the ring, beside the six of its frame, which does not spin. A mode is a shape of
the section times cos n psi or sin n psi, psi the azimuth in space. Race and supports are displaced
by

    w_i = sum_m phi_m cos or sin(n_m psi_i) a_m + w'_i      y_k = sum_m chi_km a_m + y'_k

and, with unit masses and the ring's speed W,

    a'' + 2 W P a' + K (a + tau a') = sum_i phi_m F_i - sum_k chi_km p_k

P couples the cosine of a wave with its sine: the ring's material passes through the wave, n times a
turn (Coriolis). The centrifugal part of that and the stiffening by the hoop stress of rotation
cancel in a thin ring, rho (W r)^2 both, and are left out: so waves travel as in Bryan's ring.
P does no work. w' and y' are of the harmonics left over (``races``), which have no mass: with their
compliances C between elements, B between elements and supports, D between supports,

    w' = C s - B p - H F      y' = B^T s - D p      y <= 0, p >= 0, y p = 0 at every support

where s follows the contact forces F, and p presses on the ring; y = 0 where supports pull, too. The
supports' forces are those of least energy, found anew in every state: nothing is remembered.

Elements feel the slope F_i phi_m n_m cos' a_m of the modes beside s_i w_i', about the axis. The
seat bears what these moments leave over. Contacts feel the rate of the modes' share of w as well,
so F_i in these two places is all of the contact force, with damping and friction.

Ribs and the cage's lands follow the modes too: ``sections``.
"""

from __future__ import annotations

from math import cos, sin
from typing import NamedTuple

import numpy as np

from flexcage.contacts.evaluation import TANGENT
from flexcage.contacts.ring_waves import COSINE, PLACE, SINE, no_waves
from flexcage.contacts.state import U_SPIN
from flexcage.core.jit import array_from, fields, kernel, outlined, part, zero
from flexcage.core.vectors import RIGID
from flexcage.system.data import INNER_RACE, KINETIC, MODAL_DAMPING, OUTER_RACE, STRAIN
from flexcage.system.layout import PER_ELEMENT, RING
from flexcage.system.rings.races import (
    POINTS,
    STEP,
    RacesData,
    deflect_races,
    force_at,
    look_up,
    orbit_of,
)
from flexcage.system.rings.sections import set_sections
from flexcage.system.rings.supports import press_supports, solve_pressed

B1, B2, SLOPE1, SLOPE2 = range(4)  # in ``RingModes.table``: of both ports, and over the azimuth


class RingModes(NamedTuple):
    """Modes of one ring, and its supports; those behind ``holds`` are workspaces."""

    harmonic: np.ndarray  # (M,) n of a mode's wave round the ring
    quarter: np.ndarray  # (M,) COSINE or SINE of ``contacts.ring_waves``
    shape: np.ndarray  # (M, 2) by which it displaces the race at its crest, at both ports
    section: np.ndarray  # (M, 3) and the section as a whole, as ``contacts.ring_waves`` has it
    stiffness: np.ndarray  # (M,) for unit masses
    late: np.ndarray  # (M,) time tau by which its spring damps it
    turning: np.ndarray  # (M, M) P, antisymmetric
    azimuth: np.ndarray  # (S,) of supports
    chi: np.ndarray  # (S, M) by which modes displace the ring outwards at supports
    table: np.ndarray  # (K, POINTS, 4) B of an element so far round the ring from a support
    kind: np.ndarray  # (S,) of the support in ``table``: supports as wide as it
    between: np.ndarray  # (S, S) D
    holds: int  # 1 if supports pull as well
    crest: np.ndarray  # (N + 1, 2, 4) of cosine and sine: displacement and rate at both ports
    load: np.ndarray  # (N + 1, 2, 2) contact forces on them, at both ports
    carried: np.ndarray  # (N + 1, 2, 2, 3) the section's waves; none if the ring has no modes
    borne: np.ndarray  # (N + 1, 2, 3) forces of ribs and lands on them
    wall: np.ndarray  # (3, 3) of the section beside a rib's roller, see ``sections``
    wave: np.ndarray  # (Z, N + 1, 2) cosine and sine of n psi
    moved: np.ndarray  # (Z, 2) displacement of the race by modes, at its ports
    slope: np.ndarray  # (Z, 2) of that over the azimuth
    rate: np.ndarray  # (Z, 2) of that in time, as an element feels it that orbits
    total: np.ndarray  # (Z, 2) of all contact forces on the race, friction too, at its ports
    push: np.ndarray  # (M,) forces of supports on modes
    beside: np.ndarray  # (S, Z, 4) of the table
    swung: np.ndarray  # (S,) displacement of supports by modes
    room: np.ndarray  # (S,) what they would be entered by if none pressed
    press: np.ndarray  # (S,) forces on the ring, inwards
    kept: np.ndarray  # (S,) supports that press, those first
    bears: np.ndarray  # (S,) does it press?
    factor: np.ndarray  # (S, S) Cholesky's factor of D, for those that press
    step: np.ndarray  # (S,)


class InModes(NamedTuple):
    """How a ring moves in its modes."""

    a: np.ndarray  # (M,)
    v: np.ndarray  # (M,) rates


@part
def displace_by_modes(q, u, y, d):
    """Displace both races by their rings' modes and supports; ``races.deflect_races`` comes
    before."""
    races, s = fields(d.rings), y[fields(d.places).loads :]
    _displace(INNER_RACE, q, u, s, _inner(y, d), races, fields(d.inner_modes))
    _displace(OUTER_RACE, q, u, s, _outer(y, d), races, fields(d.outer_modes))


@part
def _inner(y, d):
    at = fields(d.places)
    return _at(y, at.inner_q + RING, at.inner_u + RIGID, at.inner_modes)


@part
def _outer(y, d):
    at = fields(d.places)
    return _at(y, at.outer_q + RING, at.outer_u + RIGID, at.outer_modes)


@part
def _at(y, a, v, count):
    return InModes(y[a : a + count], y[v : v + count])


@outlined
def _displace(side, q, u, s, own, races, modes):
    """Displace a race by its modes, and by supports; nothing presses on them yet."""
    if modes.push.shape[0] == 0:
        if modes.carried.shape[0] > 0:  # they stand, but displaced
            _set_waves(q, modes)
        return
    _move(side, q, s, own, races, modes)
    zero(modes.total)
    zero(modes.load)
    for i in range(modes.rate.shape[0]):
        orbit = orbit_of(q, u, i)
        for p in range(2):
            modes.rate[i, p] += modes.slope[i, p] * orbit


@part
def _move(side, q, s, own, races, modes):
    w, moved, slope, rate = races.deflection[side], modes.moved, modes.slope, modes.rate
    a, v = own.a, own.v
    zero(modes.push)
    zero(modes.press)
    _set_waves(q, modes)
    _set_crests(a, v, modes)
    set_sections(a, v, modes)
    for i in range(w.shape[0]):
        for p in range(2):
            x = turn = moves = 0.0
            for n in range(modes.crest.shape[0]):
                cos_n, sin_n = modes.wave[i, n, COSINE], modes.wave[i, n, SINE]
                even, odd = modes.crest[n, COSINE], modes.crest[n, SINE]
                x += cos_n * even[p] + sin_n * odd[p]
                turn += n * (cos_n * odd[p] - sin_n * even[p])
                moves += cos_n * even[2 + p] + sin_n * odd[2 + p]
            moved[i, p], slope[i, p], rate[i, p] = x, turn, moves
            w[i, p] += x
    if modes.press.shape[0] > 0:
        _press(side, q, s, a, races, modes)


@part
def _set_crests(a, v, modes):
    """Displacements and rates of all waves at their crests, of both ports."""
    zero(modes.crest)
    for m in range(a.shape[0]):
        crest = modes.crest[modes.harmonic[m], modes.quarter[m]]
        for p in range(2):
            crest[p] += modes.shape[m, p] * a[m]
            crest[2 + p] += modes.shape[m, p] * v[m]


@part
def _set_waves(q, modes):
    """Cosines and sines of all harmonics at the azimuths of the elements, by recursion."""
    wave = modes.wave
    for i in range(wave.shape[0]):
        psi = q[PER_ELEMENT * i + 2]
        c, s = cos(psi), sin(psi)
        wave[i, 0, COSINE], wave[i, 0, SINE] = 1.0, 0.0
        for n in range(1, wave.shape[1]):
            x, y = wave[i, n - 1, COSINE], wave[i, n - 1, SINE]
            wave[i, n, COSINE], wave[i, n, SINE] = x * c - y * s, y * c + x * s


@part
def _press(side, q, s, a, races, modes):
    """What supports do to the race and to its modes."""
    Z, press = races.moment.shape[1], modes.press
    w, moment = races.deflection[side], races.moment[side]
    for k in range(press.shape[0]):
        swung = 0.0
        for m in range(a.shape[0]):
            swung += modes.chi[k, m] * a[m]
        modes.swung[k] = swung
        entered = swung
        for i in range(Z):
            x = (q[PER_ELEMENT * i + 2] - modes.azimuth[k]) * STEP
            whole = np.floor(x)
            c = modes.beside[k, i]
            look_up(modes.table[modes.kind[k]], int(whole) & (POINTS - 1), x - whole, c)
            f = force_at(side, i, Z)
            entered += c[B1] * s[f] + c[B2] * s[f + 1]
        modes.room[k] = entered
    press_supports(modes)
    for k in range(press.shape[0]):
        p = press[k]
        if p == 0.0:
            continue
        for m in range(a.shape[0]):
            modes.push[m] -= modes.chi[k, m] * p
        for i in range(Z):
            c, f = modes.beside[k, i], force_at(side, i, Z)
            w[i, 0] -= p * c[B1]
            w[i, 1] -= p * c[B2]
            moment[i] -= p * (s[f] * c[SLOPE1] + s[f + 1] * c[SLOPE2])


@part
def push_modes_by_element(i, d):
    """What element i does to both rings' modes, and their slope to it; its contact forces are
    known, and ``races.push_by_slopes`` comes after."""
    moment = fields(d.rings).moment
    moment[INNER_RACE, i] += _pushed(i, fields(d.inner_modes))
    moment[OUTER_RACE, i] += _pushed(i, fields(d.outer_modes))


@outlined
def _pushed(i, modes):
    """Add element i's contact forces to the load on a ring's waves; the moment of their slope."""
    if modes.push.shape[0] == 0:
        return 0.0
    x, y = modes.total[i, 0], modes.total[i, 1]
    if x == 0.0 and y == 0.0:
        return 0.0
    for n in range(modes.load.shape[0]):
        for quarter in range(2):
            modes.load[n, quarter, 0] += modes.wave[i, n, quarter] * x
            modes.load[n, quarter, 1] += modes.wave[i, n, quarter] * y
    return x * modes.slope[i, 0] + y * modes.slope[i, 1]


@part
def mode_rows(y, yd, d, out, mode):
    """Rows of both rings' modes, and their slopes if asked for; all contact forces are known."""
    at, tan = fields(d.places), fields(d.tangent)
    inner = MotionRows(at.inner_q, at.inner_u, at.inner_b, at.inner_modes)
    outer = MotionRows(at.outer_q, at.outer_u, at.outer_b, at.outer_modes)
    _rows(y, yd, inner, fields(d.inner_modes), out)
    _rows(y, yd, outer, fields(d.outer_modes), out)
    if mode == TANGENT:
        _slopes(y, inner, fields(d.inner_modes), tan)
        _slopes(y, outer, fields(d.outer_modes), tan)


class MotionRows(NamedTuple):
    """Where a ring's rows begin, and how many of modes follow those of its frame."""

    q: int
    u: int
    b: int
    modes: int


@outlined
def _slopes(y, at, modes, tan):
    """Slopes of the rows of a ring's modes that follow from its own motion."""
    b, speed = at.b + RIGID, y[at.u + U_SPIN]
    for m in range(at.modes):
        tan.Mbb[b + m, b + m] = 1.0
    for m in range(modes.push.shape[0]):
        tan.Kbb[b + m, b + m] += modes.stiffness[m]
        tan.Cbb[b + m, b + m] += modes.stiffness[m] * modes.late[m]
        for l in range(at.modes):
            tan.Cbb[b + m, b + l] += 2.0 * speed * modes.turning[m, l]


@outlined
def _rows(y, yd, at, modes, out):
    """Rows of a ring's modes; they stand if there are places for them, but none."""
    q, u, count, speed = at.q + RING, at.u + RIGID, at.modes, y[at.u + U_SPIN]
    a, v = array_from(y, q), array_from(y, u)
    r_a, r_v = array_from(out, q), array_from(out, u)
    ad, vd = array_from(yd, q), array_from(yd, u)
    if modes.push.shape[0] == 0:
        for m in range(count):
            r_a[m], r_v[m] = ad[m], vd[m]
        return
    for m in range(count):
        load = modes.load[modes.harmonic[m], modes.quarter[m]]
        borne = modes.borne[modes.harmonic[m], modes.quarter[m]]
        force = modes.push[m] + modes.shape[m, 0] * load[0] + modes.shape[m, 1] * load[1]
        for c in range(modes.section.shape[1]):
            force += modes.section[m, c] * borne[c]
        for l in range(count):
            force -= 2.0 * speed * modes.turning[m, l] * v[l]
        force -= modes.stiffness[m] * (a[m] + modes.late[m] * v[m])
        r_a[m] = ad[m] - v[m]
        r_v[m] = vd[m] - force


@part
def report_modes(q, u, y, d):
    """Energy of both rings' modes and supports, and the power that they lose, beside what
    ``races.report_races`` has."""
    races, rep, s = fields(d.rings), fields(d.report), y[fields(d.places).loads :]
    _report(INNER_RACE, q, u, s, _inner(y, d), races, fields(d.inner_modes), rep)
    _report(OUTER_RACE, q, u, s, _outer(y, d), races, fields(d.outer_modes), rep)


@outlined
def _report(side, q, u, s, own, races, modes, rep):
    a, v = own.a, own.v
    if modes.push.shape[0] == 0:
        return
    for m in range(a.shape[0]):
        force = modes.stiffness[m] * a[m]
        rep.energy[KINETIC] += 0.5 * v[m] * v[m]
        rep.energy[STRAIN] += 0.5 * a[m] * force
        rep.power[MODAL_DAMPING] -= v[m] * modes.stiffness[m] * modes.late[m] * v[m]
    if races.bends[side] == 0:
        return
    Z = races.moment.shape[1]
    for i in range(Z):  # the report took the whole deflection
        f = force_at(side, i, Z)
        for c in range(2):
            rep.energy[STRAIN] -= 0.5 * s[f + c] * modes.moved[i, c]
    for k in range(modes.press.shape[0]):
        rep.energy[STRAIN] += 0.5 * modes.press[k] * modes.swung[k]
    if modes.press.shape[0] > 0:
        _lost_at_supports(side, q, u, s, v, races, modes, rep)


@part
def _lost_at_supports(side, q, u, s, v, races, modes, rep):
    """Power lost where supports keep the race from yielding: their share of (F - s) w'."""
    Z, rate, step = races.moment.shape[1], races.rate[side], modes.step
    for k in range(step.shape[0]):
        step[k] = 0.0
        for m in range(v.shape[0]):
            step[k] += modes.chi[k, m] * v[m]
        for i in range(Z):
            c, f, orbit = modes.beside[k, i], force_at(side, i, Z), orbit_of(q, u, i)
            for p in range(2):
                late = races.force[side, i, p] - s[f + p]
                step[k] += c[p] * rate * late + c[SLOPE1 + p] * s[f + p] * orbit
    # the displacements' rates in, the forces' rates out
    kept = modes.room
    for k in range(step.shape[0]):
        kept[k] = modes.press[k]
    solve_pressed(step, modes.press, modes)
    for k in range(step.shape[0]):
        step[k], modes.press[k] = modes.press[k], kept[k]
        for i in range(Z):
            c, f, orbit = modes.beside[k, i], force_at(side, i, Z), orbit_of(q, u, i)
            for p in range(2):
                late = races.force[side, i, p] - s[f + p]
                given = step[k] * c[p] + modes.press[k] * c[SLOPE1 + p] * orbit
                rep.power[MODAL_DAMPING] += late * given


@kernel
def deflect(side, q, s, a, races: RacesData, modes: RingModes):
    """Set ``races.deflection`` of a side, and ``modes.press``, under forces s and modes a, for a
    record; without H F."""
    deflect_races(q, s, races)
    if a.shape[0] > 0:
        _move(side, q, s, InModes(a, a), races, modes)


def no_modes(elements: int) -> RingModes:
    """Data of a ring without modes, in the types that kernels take."""
    none = np.zeros(0)
    return modes_of(
        elements, np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 2)),
        np.zeros((0, 3)), none, none, np.zeros((0, 0)),
    )  # fmt: skip


def standing(elements: int, made: RingModes, at: np.ndarray) -> RingModes:
    """Data of a ring whose section stays where modes ``at`` (M,) put it, for ribs in the search of
    a start."""
    still = no_modes(elements)
    if not len(at):
        return still
    carried, borne = 0.0 * made.carried, 0.0 * made.borne
    np.add.at(carried[:, :, PLACE], (made.harmonic, made.quarter), made.section * at[:, None])
    return still._replace(carried=carried, borne=borne, wave=0.0 * made.wave)


def modes_of(
    elements: int, harmonic: np.ndarray, quarter: np.ndarray, shape: np.ndarray,
    section: np.ndarray, stiffness: np.ndarray, late: np.ndarray, turning: np.ndarray, *,
    azimuth: np.ndarray | None = None, chi: np.ndarray | None = None,
    table: np.ndarray | None = None, kind: np.ndarray | None = None,
    between: np.ndarray | None = None, holds: bool = False,
) -> RingModes:  # fmt: skip
    """Modes and, if any are given, supports, with room to work."""
    count, held = len(harmonic), 0 if azimuth is None else len(azimuth)
    waves, z, st = int(harmonic.max(initial=0)) + 1, np.zeros, np.ascontiguousarray
    carried, borne = no_waves() if count == 0 else (z((waves, 2, 2, 3)), z((waves, 2, 3)))
    return RingModes(
        harmonic, quarter, st(shape), st(section), st(stiffness), late, st(turning),
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
