"""Rings that bend in a run: how races yield under rolling elements, as kernels take it.

A seated ring is an elastic body without inertia of its own deflection: its compliance C between
elements at azimuths psi_i is that of the static solution (``modes.ring``), the finite elements'
part less the half-space H under each contact, which the contact law has already,

    w_i = sum_j C(psi_i - psi_j) s_j - H F_i .

F_i are the elastic contact forces at the two ports of the race. The first part follows them with a
relaxation time tau, tau s' = F - s: a ring whose material and seat damp in proportion to their
stiffness (Kelvin and Voigt), but seen by elements as they orbit, so that loads that travel steadily
meet no lag. C is positive definite, so this takes energy. The second part is negative and follows
at once; else it would feed vibrations (``at_once``, Newton's method: one step where the force is
nearly the one that the ring bears, more where an element strikes). The axisymmetric ring may turn:
psi is measured about its centre in a frame that does not spin.

With the energy s C s/2 - F H F/2 an element feels the slope of the race that others bend,
s_i sum_j C'(psi_i - psi_j) s_j about the axis; over all elements these moments are none. Contact
damping takes the rate at which an element nears the seat, without w'. What is lost is
(F - s) w', with w' that of the first part.
"""

from __future__ import annotations

from collections.abc import Callable
from math import atan2, cos, pi, sin
from typing import Any, NamedTuple

import numpy as np

from flexcage.contacts.state import AXIS, CENTRE
from flexcage.core.jit import VECTORISED, fields, part, zero
from flexcage.core.vectors import TURN, cross, minus, turned, turned_back, xyz
from flexcage.system.data import INNER_RACE, MODAL_DAMPING, OUTER_RACE, STRAIN
from flexcage.system.layout import PER_ELEMENT, Layout, of_element
from flexcage.system.ring import inner_of, outer_of
from flexcage.system.scales import ERROR_RATE

POINTS = 4096  # of the tables, a power of two; straight lines between them
STEP = POINTS / (2.0 * pi)  # points a radian
LEAST = 0.25  # determinant of Newton's step: contacts far stiffer than H is meant for take less
STEPS = 3  # of Newton's method at the most, under an element that strikes
NEAR = 0.02  # of the force: where the last of them may begin; what it leaves is of second order
AXIAL_PORT, RADIAL_PORT, TILT_PORT = range(3)  # in ``RacesData.way``
# compliances of the two ports, and their slopes over the azimuth
C11, C12, C22, D11, D12, D22 = range(6)


class RacesData(NamedTuple):
    """Both rings, inner and outer, at their ports; those behind ``rate`` are workspaces."""

    bends: np.ndarray  # (2,) 1 if the ring bends
    way: np.ndarray  # (2,) what the ports are: axially, radially, in tilt
    table: np.ndarray  # (2, POINTS, 6) C between elements that are so far apart, round the ring
    near: np.ndarray  # (2,) points up to which elements feel each other; C is zero beyond
    own: np.ndarray  # (2, 3) C at an element's own place
    half_space: np.ndarray  # (2, 3) H
    given: np.ndarray  # (2, Z, 2) a deflection that is known beforehand, for the search of a start
    reach: np.ndarray  # (2, 2) [m] by which a port's deflection is a displacement
    rate: np.ndarray  # (2,) 1/tau
    azimuth: np.ndarray  # (2, Z) of elements, seen from the centre of either ring
    deflection: np.ndarray  # (2, Z, 2) of races at elements, the first part
    moment: np.ndarray  # (2, Z) of slopes, about the axis
    force: np.ndarray  # (2, Z, 2) elastic contact forces on the races
    kept: np.ndarray  # (2,) pairs of elements that feel each other
    pair: np.ndarray  # (2, Z (Z-1)/2, 2) which they are
    between: np.ndarray  # (2, Z (Z-1)/2, 6) C and its slope between them


def rigid_rings(elements: int) -> RacesData:
    """Data of rings that do not bend, in the types that kernels take."""
    z, pairs = np.zeros, elements * (elements - 1) // 2
    return RacesData(
        z(2, np.int64), np.array([RADIAL_PORT, TILT_PORT]), z((2, POINTS, 6)), z(2, np.int64),
        z((2, 3)), z((2, 3)), z((2, elements, 2)), np.ones((2, 2)), np.ones(2),
        z((2, elements)), z((2, elements, 2)), z((2, elements)), z((2, elements, 2)),
        z(2, np.int64),
        z((2, pairs, 2), np.int64), z((2, pairs, 6)),
    )  # fmt: skip


@part
def force_at(side, i, Z):
    """Place of element i's two forces on a ring among all of them."""
    return 2 * (side * Z + i)


@part
def deflect_races(q, inner, outer, s, rings):
    """Deflections of the races under the forces s, at the azimuths of the elements (coordinates q)
    about the centres of both rings (coordinates ``inner``, ``outer``), and the moments of slopes;
    contact forces are none yet."""
    Z = rings.moment.shape[1]
    for i in range(Z):
        radius, psi = q[PER_ELEMENT * i + 1], q[PER_ELEMENT * i + 2]
        rings.azimuth[INNER_RACE, i] = psi + _seen_from(inner, radius, psi)
        rings.azimuth[OUTER_RACE, i] = psi + _seen_from(outer, radius, psi)
    zero(rings.force)
    for side in range(2):
        w, moment = rings.deflection[side], rings.moment[side]
        own, given = rings.own[side], rings.given[side]
        zero(moment)
        rings.kept[side] = 0
        for i in range(Z):
            k = force_at(side, i, Z)  # C(0) s_i, and what is given
            w[i, 0] = own[C11] * s[k] + own[C12] * s[k + 1] + given[i, 0]
            w[i, 1] = own[C12] * s[k] + own[C22] * s[k + 1] + given[i, 1]
        if rings.bends[side] != 0:
            _bend_between(s, rings, side)


@part
def _seen_from(ring, radius, psi):
    """By how much the azimuth of an element is larger, seen from a ring's centre."""
    c, s = cos(psi), sin(psi)
    return atan2(ring[1] * s - ring[2] * c, radius - ring[1] * c - ring[2] * s)


@part
def _bend_between(s, rings, side):
    """What elements do to the race beneath others that are near."""
    Z, near, at = rings.moment.shape[1], rings.near[side], 0
    w, moment = rings.deflection[side], rings.moment[side]
    for i in range(Z):
        a, psi = force_at(side, i, Z), rings.azimuth[side, i]
        for j in range(i):
            x = (psi - rings.azimuth[side, j]) * STEP
            whole = np.floor(x)
            k = int(whole) & (POINTS - 1)
            if near < k < POINTS - 1 - near:
                continue
            b = force_at(side, j, Z)
            if s[a] == 0.0 and s[b] == 0.0:
                continue
            c = rings.between[side, at]
            rings.pair[side, at, 0], rings.pair[side, at, 1] = i, j
            at += 1
            look_up(rings.table[side], k, x - whole, c)
            # w_i += C(psi_i - psi_j) s_j and the other way round; moment s_i C' s_j
            w[i, 0] += c[C11] * s[b] + c[C12] * s[b + 1]
            w[i, 1] += c[C12] * s[b] + c[C22] * s[b + 1]
            w[j, 0] += c[C11] * s[a] + c[C12] * s[a + 1]
            w[j, 1] += c[C12] * s[a] + c[C22] * s[a + 1]
            turn = s[a] * (c[D11] * s[b] + c[D12] * s[b + 1])
            turn += s[a + 1] * (c[D12] * s[b] + c[D22] * s[b + 1])
            moment[i] += turn
            moment[j] -= turn
    rings.kept[side] = at


@part(fastmath=VECTORISED)
def look_up(table, k, share, c):
    """Compliances and slopes at a share of the way from point k of the table to the next."""
    low, high = table[k], table[(k + 1) & (POINTS - 1)]
    for m in range(c.shape[0]):
        c[m] = low[m] + share * (high[m] - low[m])


@part
def guess(side, i, s, rings):
    """Deflection of a race at element i at its two ports, taken that the element presses on it with
    the force that the ring bears."""
    k, H, w = force_at(side, i, rings.moment.shape[1]), rings.half_space[side], rings.deflection
    return (
        w[side, i, 0] - H[C11] * s[k] - H[C12] * s[k + 1],
        w[side, i, 1] - H[C12] * s[k] - H[C22] * s[k + 1],
    )


@part
def borne_of(side, i, s, rings):
    """The forces on the two ports of a race at element i that the ring bears."""
    k = force_at(side, i, rings.moment.shape[1])
    return s[k], s[k + 1]


@part
def at_once(side, taken, force, slope, rings):
    """Newton's step of w = ... - H F from a deflection with the forces ``taken`` in place of F,
    where the ``force`` F on the ports falls with the deflection by the ``slope`` (11, 12, 22)."""
    H = rings.half_space[side]
    x, y = force[0] - taken[0], force[1] - taken[1]
    x, y = -(H[C11] * x + H[C12] * y), -(H[C12] * x + H[C22] * y)
    a = 1.0 - H[C11] * slope[0] - H[C12] * slope[1]
    b = -H[C11] * slope[1] - H[C12] * slope[2]
    c = -H[C12] * slope[0] - H[C22] * slope[1]
    e = 1.0 - H[C12] * slope[1] - H[C22] * slope[2]
    det = max(a * e - b * c, LEAST)
    return (e * x - b * y) / det, (a * y - c * x) / det


@part
def after(force, slope, step):
    """The forces on the ports when the race has yielded by a step more, to first order."""
    x, y = step
    return (
        force[0] - slope[0] * x - slope[1] * y,
        force[1] - slope[1] * x - slope[2] * y,
    )


@part
def close(taken, force):
    """Is a ``force`` on the ports near the one ``taken``? Then one step more is enough."""
    error = abs(force[0] - taken[0]) + abs(force[1] - taken[1])
    return error < NEAR * (abs(force[0]) + abs(force[1]))


@part
def displace(at, ports, way):
    """Displace and tilt the ring ``at`` beside an element, rows as ``contacts.state`` has them, as
    its race is by its deflections at two ``ports``."""
    for p in range(2):
        if way[p] == TILT_PORT:
            at[AXIS, 1] += ports[p]
        else:
            at[CENTRE, way[p]] -= ports[p]


@part
def push_by_slopes(i, q, y, d):
    """Add the forces on element i of the slopes that others give the races, across its radius, and
    their reactions on the rings."""
    rings, qi = fields(d.rings), q[of_element(i)]
    _push_along(qi, inner_of(y, d), rings.moment[INNER_RACE, i] / qi[1], i, d)
    _push_along(qi, outer_of(y, d), rings.moment[OUTER_RACE, i] / qi[1], i, d)


@part
def _push_along(qi, ring, force, i, d):
    """A force on element i along its orbit, and its reaction on a ring."""
    F, work = fields(d.pose).F, fields(d.scratch)
    work.wrenches[i, 2] += force
    P = minus((qi[0], qi[1], 0.0), turned(F, xyz(ring.q)))
    moment = turned_back(F, cross(P, (0.0, 0.0, -force)))
    for c in range(3):
        work.border[ring.b + c] -= F[2, c] * force
        work.border[ring.b + TURN + c] += moment[c]


@part
def force_rows(s, sd, rings, out):
    """Rows of the forces that rings bear: s' = (F - s)/tau."""
    Z = rings.moment.shape[1]
    for side in range(2):
        for i in range(Z):
            for c in range(2):
                k = force_at(side, i, Z) + c
                out[k] = sd[k] - rings.rate[side] * (rings.force[side, i, c] - s[k])


@part
def orbit_of(q, u, i):
    """Orbital speed of element i [rad/s]."""
    own = of_element(i)
    return u[own][2] / q[own][1]


@part
def report_races(u, q, s, rings, rep):
    """Energy of rings that bend, and the power that they lose, of elements with coordinates q and
    velocities u."""
    Z = rings.moment.shape[1]
    for side in range(2):
        if rings.bends[side] == 0:
            continue
        H, own, rate = rings.half_space[side], rings.own[side], rings.rate[side]
        lost = 0.0
        for i in range(Z):
            k, F = force_at(side, i, Z), rings.force[side, i]
            w = rings.deflection[side, i]
            rep.energy[STRAIN] += 0.5 * (s[k] * w[0] + s[k + 1] * w[1])
            rep.energy[STRAIN] -= 0.5 * F[0] * (H[C11] * F[0] + 2.0 * H[C12] * F[1])
            rep.energy[STRAIN] -= 0.5 * F[1] * H[C22] * F[1]
            x, y = F[0] - s[k], F[1] - s[k + 1]
            lost += rate * (own[C11] * x * x + 2.0 * own[C12] * x * y + own[C22] * y * y)
        for n in range(rings.kept[side]):
            c, i, j = rings.between[side, n], rings.pair[side, n, 0], rings.pair[side, n, 1]
            a, b = force_at(side, i, Z), force_at(side, j, Z)
            Fi, Fj = rings.force[side, i], rings.force[side, j]
            xa, ya, xb, yb = Fi[0] - s[a], Fi[1] - s[a + 1], Fj[0] - s[b], Fj[1] - s[b + 1]
            lost += 2.0 * rate * (xa * (c[C11] * xb + c[C12] * yb))
            lost += 2.0 * rate * (ya * (c[C12] * xb + c[C22] * yb))
            turn = xa * (c[D11] * s[b] + c[D12] * s[b + 1])
            turn += ya * (c[D12] * s[b] + c[D22] * s[b + 1])
            turn += xb * (c[D11] * s[a] + c[D12] * s[a + 1])
            turn += yb * (c[D12] * s[a] + c[D22] * s[a + 1])
            lost += (orbit_of(q, u, i) - orbit_of(q, u, j)) * turn
        rep.power[MODAL_DAMPING] -= lost


def with_ring_weights(
    weights: Callable[[Any, Layout, float], np.ndarray],
) -> Callable[[Any, Layout, float], np.ndarray]:
    """``Motion.error_weights`` with those of the forces that rings bear and of their modes: what
    displaces a race by the ``length``."""

    def with_rings(model: Any, layout: Layout, length: float) -> np.ndarray:
        weight, races = weights(model, layout, length), model.rings
        moved = races.own[:, [C11, C22]] * races.reach
        layout.ring_forces(weight)[:] = moved[:, None] / length
        for side, name in enumerate(("inner_modes", "outer_modes")):
            crest = np.abs(getattr(model, name).shape * races.reach[side]).max(axis=1, initial=0.0)
            layout.q(weight)[name][:] = crest / length
            layout.u(weight)[name][:] = crest / (length * ERROR_RATE)
        return weight

    return with_rings
