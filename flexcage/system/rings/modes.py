"""Modes of rings that bend: coordinates with mass, and supports that hold a ring here and there.

A ring on a soft seat or on supports ovalises at low frequencies, and is far softer then than its
contacts: without inertia it would follow them within a tenth of a microsecond. So its low modes are
coordinates a of the ring, beside the six of its frame, which does not spin. A mode is a shape of
the section times cos n psi or sin n psi, psi the azimuth about the ring's centre in a frame that
does not spin. Race and supports are displaced by

    w_i = sum_m phi_m cos or sin(n_m psi_i) a_m + w'_i      y_k = sum_m chi_km a_m + y'_k

and, with unit masses and the ring's speed W,

    a'' + L^T (u' - g) + 2 W (P a' - T^T u) + K (a + tau a') = sum_i phi_m F_i - sum_k chi_km p_k

P couples the cosine of a wave with its sine: the ring's material passes through the wave, n times a
turn (Coriolis). The centrifugal part of that and the stiffening by the hoop stress of rotation
cancel in a thin ring, rho (W r)^2 both, and are left out: so waves travel as in Bryan's ring. L is
the inertia that modes have in common with the motions u of the frame, which a seat that moves takes
along, and T the same in P: the frame's rows have L a'' + 2 W T a'. P and T do no work.

w' and y' are of the harmonics left over (``races``), which have no mass: with their compliances C
between elements, B between elements and supports, D between supports,

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
from flexcage.contacts.ring_waves import COSINE, SINE
from flexcage.contacts.state import U_SPIN
from flexcage.core.jit import array_from, fields, kernel, outlined, part, zero
from flexcage.core.vectors import RIGID, TURN
from flexcage.system.data import GRAVITY, INNER_RACE, KINETIC, MODAL_DAMPING, OUTER_RACE, STRAIN
from flexcage.system.layout import PER_ELEMENT, RING
from flexcage.system.rings.modes_data import B1, B2, SLOPE1, SLOPE2, RingModes
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


class InModes(NamedTuple):
    """How a ring moves: velocities of its frame, and in that its modes."""

    u: np.ndarray  # (6,)
    a: np.ndarray  # (M,)
    v: np.ndarray  # (M,) rates


class MotionRows(NamedTuple):
    """Where a ring's rows begin, and how many of modes follow those of its frame."""

    q: int
    u: int
    b: int
    modes: int


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
    return _at(y, at.inner_q, at.inner_u, at.inner_modes)


@part
def _outer(y, d):
    at = fields(d.places)
    return _at(y, at.outer_q, at.outer_u, at.outer_modes)


@part
def _at(y, q, u, count):
    a, v = q + RING, u + RIGID
    return InModes(array_from(y, u), y[a : a + count], y[v : v + count])


@outlined
def _displace(side, q, u, s, own, races, modes):
    """Displace a race by its modes, and by supports; nothing presses on them yet."""
    if modes.push.shape[0] == 0:
        if modes.carried.shape[0] > 0:  # they stand, but displaced
            _set_waves(races.azimuth[side], modes)
        return
    _move(side, s, own, races, modes)
    zero(modes.total)
    zero(modes.load)
    for i in range(modes.rate.shape[0]):
        c, s = modes.wave[i, 1, COSINE], modes.wave[i, 1, SINE]
        radius = q[PER_ELEMENT * i + 1]
        modes.orbit[i] = orbit_of(q, u, i) - (c * own.u[2] - s * own.u[1]) / radius
        for p in range(2):
            modes.rate[i, p] += modes.slope[i, p] * modes.orbit[i]


@part
def _move(side, s, own, races, modes):
    w, moved, slope, rate = races.deflection[side], modes.moved, modes.slope, modes.rate
    a, v = own.a, own.v
    zero(modes.push)
    zero(modes.press)
    _set_waves(races.azimuth[side], modes)
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
        _press(side, s, a, races, modes)


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
def _set_waves(azimuth, modes):
    """Cosines and sines of all harmonics at the azimuths of the elements, by recursion."""
    wave = modes.wave
    for i in range(wave.shape[0]):
        c, s = cos(azimuth[i]), sin(azimuth[i])
        wave[i, 0, COSINE], wave[i, 0, SINE] = 1.0, 0.0
        for n in range(1, wave.shape[1]):
            x, y = wave[i, n - 1, COSINE], wave[i, n - 1, SINE]
            wave[i, n, COSINE], wave[i, n, SINE] = x * c - y * s, y * c + x * s


@part
def _press(side, s, a, races, modes):
    """What supports do to the race and to its modes."""
    Z, press = races.moment.shape[1], modes.press
    w, moment = races.deflection[side], races.moment[side]
    for k in range(press.shape[0]):  # y without p: chi a + B^T s
        support_displacement = 0.0
        for m in range(a.shape[0]):
            support_displacement += modes.chi[k, m] * a[m]
        modes.support_displacement[k] = support_displacement
        entered = support_displacement
        for i in range(Z):
            x = (races.azimuth[side, i] - modes.azimuth[k]) * STEP
            whole = np.floor(x)
            c = modes.support_compliance[k, i]
            look_up(modes.table[modes.kind[k]], int(whole) & (POINTS - 1), x - whole, c)
            f = force_at(side, i, Z)
            entered += c[B1] * s[f] + c[B2] * s[f + 1]
        modes.free_penetration[k] = entered
    press_supports(modes)
    for k in range(press.shape[0]):
        p = press[k]
        if p == 0.0:
            continue
        for m in range(a.shape[0]):
            modes.push[m] -= modes.chi[k, m] * p
        for i in range(Z):  # w' = ... - B p
            c, f = modes.support_compliance[k, i], force_at(side, i, Z)
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
    """Rows of both rings' modes; all contact forces are known. A tangent is of modes that stand."""
    at, mass = fields(d.places), fields(d.tangent).Mbb
    inner = MotionRows(at.inner_q, at.inner_u, at.inner_b, at.inner_modes)
    outer = MotionRows(at.outer_q, at.outer_u, at.outer_b, at.outer_modes)
    gravity = fields(d.bodies).gravity
    _rows(y, yd, inner, fields(d.inner_modes), gravity, out)
    _rows(y, yd, outer, fields(d.outer_modes), gravity, out)
    _on_frame(y, yd, inner, fields(d.inner_ring), fields(d.inner_modes), False, out)
    _on_frame(y, yd, outer, fields(d.outer_ring), fields(d.outer_modes), True, out)
    if mode == TANGENT:
        for ring in (inner, outer):
            for m in range(ring.b + RIGID, ring.b + RIGID + ring.modes):
                mass[m, m] = 1.0


@outlined
def _on_frame(y, yd, at, ring, modes, by_mount, out):
    """Add to the rows of a ring's frame the inertia of its modes; rows that are held ``by_mount``
    are none of momentum."""
    v, vd, speed = array_from(y, at.u + RIGID), array_from(yd, at.u + RIGID), y[at.u + U_SPIN]
    for c in range(RIGID):
        if by_mount and ring.free[c] == 0:
            continue
        for m in range(modes.push.shape[0]):  # L a'' + 2 W T a'
            out[at.u + c] += modes.coupling[c, m] * vd[m] + 2.0 * speed * modes.tilting[c, m] * v[m]


@outlined
def _rows(y, yd, at, modes, gravity, out):
    """Rows of a ring's modes; they stand if there are places for them, but none."""
    q, u, count, speed = at.q + RING, at.u + RIGID, at.modes, y[at.u + U_SPIN]
    a, v = array_from(y, q), array_from(y, u)
    r_a, r_v = array_from(out, q), array_from(out, u)
    ad, vd = array_from(yd, q), array_from(yd, u)
    frame, moves = array_from(yd, at.u), array_from(y, at.u)
    if modes.push.shape[0] == 0:
        for m in range(count):
            r_a[m], r_v[m] = ad[m], vd[m]
        return
    for m in range(count):  # a'' by the module's equation, term by term
        load = modes.load[modes.harmonic[m], modes.quarter[m]]
        borne = modes.borne[modes.harmonic[m], modes.quarter[m]]
        force = modes.push[m] + modes.shape[m, 0] * load[0] + modes.shape[m, 1] * load[1]
        for c in range(modes.section.shape[1]):
            force += modes.section[m, c] * borne[c]
        for l in range(count):  # -2 W P a'
            force -= 2.0 * speed * modes.turning[m, l] * v[l]
        force -= modes.stiffness[m] * (a[m] + modes.late[m] * v[m])
        for c in range(RIGID):  # -L^T (u' - g) + 2 W T^T u
            weight = gravity[c] if c < TURN else 0.0
            force -= modes.coupling[c, m] * (frame[c] - weight)
            force += 2.0 * speed * modes.tilting[c, m] * moves[c]
        r_a[m] = ad[m] - v[m]
        r_v[m] = vd[m] - force


@part
def report_modes(y, d):
    """Energy and weight of both rings' modes and supports, and the power that they lose, beside
    what ``races.report_races`` has."""
    races, rep, s = fields(d.rings), fields(d.report), y[fields(d.places).loads :]
    gravity = fields(d.bodies).gravity
    _report(INNER_RACE, s, _inner(y, d), races, fields(d.inner_modes), gravity, rep)
    _report(OUTER_RACE, s, _outer(y, d), races, fields(d.outer_modes), gravity, rep)


@outlined
def _report(side, s, own, races, modes, gravity, rep):
    a, v = own.a, own.v
    if modes.push.shape[0] == 0:
        return
    for m in range(a.shape[0]):
        force = modes.stiffness[m] * a[m]
        rep.energy[KINETIC] += 0.5 * v[m] * v[m]
        rep.energy[STRAIN] += 0.5 * a[m] * force
        rep.power[MODAL_DAMPING] -= v[m] * modes.stiffness[m] * modes.late[m] * v[m]
        for c in range(RIGID):  # with the frame's motions
            rep.energy[KINETIC] += own.u[c] * modes.coupling[c, m] * v[m]
            if c < TURN:
                rep.power[GRAVITY] += gravity[c] * modes.coupling[c, m] * v[m]
    if races.bends[side] == 0:
        return
    Z = races.moment.shape[1]
    for i in range(Z):  # the report took the whole deflection
        f = force_at(side, i, Z)
        for c in range(2):
            rep.energy[STRAIN] -= 0.5 * s[f + c] * modes.moved[i, c]
    for k in range(modes.press.shape[0]):
        rep.energy[STRAIN] += 0.5 * modes.press[k] * modes.support_displacement[k]
    if modes.press.shape[0] > 0:
        _lost_at_supports(side, s, v, races, modes, rep)


@part
def _lost_at_supports(side, s, v, races, modes, rep):
    """Power lost where supports keep the race from yielding: their share of (F - s) w'."""
    Z, rate, step = races.moment.shape[1], races.rate[side], modes.step
    for k in range(step.shape[0]):
        step[k] = 0.0
        for m in range(v.shape[0]):
            step[k] += modes.chi[k, m] * v[m]
        for i in range(Z):
            c, f, orbit = modes.support_compliance[k, i], force_at(side, i, Z), modes.orbit[i]
            for p in range(2):
                late = races.force[side, i, p] - s[f + p]
                step[k] += c[p] * rate * late + c[SLOPE1 + p] * s[f + p] * orbit
    # the displacements' rates in, the forces' rates out
    kept = modes.free_penetration
    for k in range(step.shape[0]):
        kept[k] = modes.press[k]
    solve_pressed(step, modes.press, modes)
    for k in range(step.shape[0]):
        step[k], modes.press[k] = modes.press[k], kept[k]
        for i in range(Z):
            c, f, orbit = modes.support_compliance[k, i], force_at(side, i, Z), modes.orbit[i]
            for p in range(2):
                late = races.force[side, i, p] - s[f + p]
                given = step[k] * c[p] + modes.press[k] * c[SLOPE1 + p] * orbit
                rep.power[MODAL_DAMPING] += late * given


@kernel
def deflect(side, q, s, ring, a, races: RacesData, modes: RingModes):
    """Set ``races.deflection`` of a side, and ``modes.press``, under forces s and modes a of a
    ``ring`` with these coordinates (6,), for a record; without H F."""
    deflect_races(q, ring, ring, s, races)
    if a.shape[0] > 0:
        _move(side, s, InModes(ring, a, a), races, modes)
