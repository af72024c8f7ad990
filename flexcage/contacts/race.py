"""Roller against a raceway: slices with profile, tilt and skew, traction and rolling resistance."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.evaluation import (
    MOMENT_PSI,
    MOMENT_R,
    REPORT,
    ROLLED,
    SLIDING,
    TANGENT,
    TRACTION,
)
from flexcage.contacts.laws import EXPONENT, rolling_forces
from flexcage.contacts.roller_spot import add_spot_depth, add_spot_wrench, spot_generator
from flexcage.contacts.slices import (
    CAPACITY,
    begin_sums,
    friction_factors,
    largest,
    new_slices,
    normal_forces_of_lot,
    total,
)
from flexcage.contacts.state import (
    AXIS,
    CENTRE,
    MOMENT,
    SPIN,
    VELOCITY,
    WHOLE,
    add_generator,
    add_outer,
    add_wrench,
    clear,
    friction_tangent,
)
from flexcage.contacts.uneven import spall_depth, wave_at
from flexcage.core.jit import VECTORISED, outlined, part
from flexcage.core.vectors import combine, cross, dot, minus, plus, row, times, xyz


class RaceSide(NamedTuple):
    """One raceway: geometry and parameters that all rollers share."""

    sign: float  # normal on the roller along sign * e_d: +1 inner, -1 outer
    radius: float
    s: np.ndarray  # (ns,) slice positions along the roller
    drop: np.ndarray  # (ns,) profile
    normal: np.ndarray  # (N_NORMAL,) normal law of a slice
    friction: np.ndarray  # (N_FRICTION,)
    rolling: np.ndarray  # (2,) rolling resistance
    hydro: float  # 2 R/Rw: pressure share of the rolling resistance
    wave: np.ndarray  # (3,) and
    spall: np.ndarray  # (5,) as in ``contacts.uneven``
    spalled: np.ndarray  # (ns,) share of each slice that lies over the spall
    row: int  # row of rollers that the spall is of
    uneven: int  # 1 if there is a wave or a spall (records hold no booleans)
    spot: np.ndarray  # (5,) of the roller that has one, as a spall's on it
    spotted: np.ndarray  # (ns,) share of each slice that lies on the spot


class RaceWork(NamedTuple):
    """A lot of contacts on one race, of n slices each; those of contact m begin at m n in ``lot``.

    A law's operations wait for one another: a normal law takes 100 ns for one contact of 16 slices,
    40 for each of many (measured).
    """

    lot: np.ndarray  # (1,) record of their slices
    who: np.ndarray  # (lots,) roller of each contact
    partner: np.ndarray  # (lots, 4, 3) the ring, in the rows of ``state``
    load: np.ndarray  # (lots,)
    speed: np.ndarray  # (lots,) of the roller's and of the ring's surface, from the contact's place
    ring_speed: np.ndarray
    entrainment: np.ndarray
    rolling: np.ndarray  # (lots,) rolling resistance


def race_work(slices: int) -> RaceWork:
    most = CAPACITY // slices
    z = np.zeros
    return RaceWork(
        new_slices().row, z(most, np.int64), z((most, 4, 3)), z(most), z(most), z(most), z(most),
        z(most),
    )  # fmt: skip


class RollerAxis(NamedTuple):
    """A roller's axis across the ring's axis: at s it is at x0 + s x1, with velocity v0 + s v1."""

    x0: tuple[float, float, float]
    x1: tuple[float, float, float]
    v0: tuple[float, float, float]
    v1: tuple[float, float, float]


@part
def race_penetrations(m, pose, side, Rw, theta, onset, rw):
    """Whether a roller touches a raceway: geometry and motion of contact m of the lot ``rw``.

    ``rw.partner[m]`` is given. ``theta``: the ring's spin angle (waves,
    spall); ``onset``: speed at which the contact closed.
    """
    sl, partner = rw.lot[0], rw.partner[m]
    centre, ring_axis, ring_spin = row(partner, CENTRE), row(partner, AXIS), row(partner, SPIN)
    a = row(pose.axis, 0)
    # in F: the roller's axis at s, across the ring's axis and from it, is x0 + s x1
    x0 = combine(centre, -dot(centre, ring_axis), ring_axis)
    x1 = combine(a, -dot(a, ring_axis), ring_axis)
    n = side.s.shape[0]
    # a bound first: can any slice reach the race?
    slope = abs(a[1]) + abs(a[2]) + abs(ring_axis[1]) + abs(ring_axis[2])
    gap = side.sign * (sqrt(dot(x0, x0)) - side.radius) - Rw
    if gap > abs(side.s[n - 1]) * slope + side.wave[0]:
        return False
    # velocity of the roller's axis at s, seen from the ring's material there: v0 + s v1
    spin = minus(xyz(pose.w), ring_spin)
    v0 = minus(minus(xyz(pose.V), row(partner, VELOCITY)), cross(ring_spin, centre))
    first = np.uint64(m * n)
    line = RollerAxis(x0, x1, v0, cross(spin, a))
    _penetrations(first, side, Rw, onset, ring_axis, line, spin, sl)
    if side.uneven:
        _add_unevenness(first, pose, side, sqrt(dot(x0, x0)), ring_spin[0], theta, sl)
    if pose.spot[0] > 0.0:
        add_spot_depth(first, pose, side, line, ring_axis, spin, sl)
    if largest((first, first + np.uint64(n)), sl.d) <= 0.0:
        return False
    # the surfaces' speeds along e_psi, seen from the contact, which moves with the orbit
    orbit = pose.V[2] / centre[1]
    rw.speed[m] = (orbit - pose.w[0]) * side.sign * Rw
    rw.ring_speed[m] = (ring_spin[0] - orbit) * side.radius
    rw.entrainment[m] = 0.5 * (rw.speed[m] + rw.ring_speed[m])
    return True


@part
def race_forces(count, side, laws, rw):
    """Forces of all ``count`` contacts of the lot ``rw``."""
    normal_forces_of_lot(laws.normal, (0, count * side.s.shape[0]), rw.lot[0], side.normal)
    race_friction(count, side, laws, rw)


@part
def race_friction(count, side, laws, rw):
    """Friction and rolling resistance of the lot's contacts under their normal forces."""
    sl, n = rw.lot[0], side.s.shape[0]
    friction_factors(laws.friction, (0, count * n), sl, side.friction)
    for m in range(count):
        rw.load[m] = total((np.uint64(m * n), np.uint64((m + 1) * n)), sl.N)
    if side.rolling[0] > 0.0:
        rolling_forces(count, side.rolling, rw.entrainment, rw.load, rw.rolling)


@part
def race_wrench(m, pose, side, Rw, theta, rw, pair, mode, sums):
    """Wrench on the roller of contact m.

    ``mode`` (``evaluation``): from REPORT on with ``sums``: normal, traction, moments about e_r
    and e_psi, sliding speed at the middle (these four at REPORT alone), elastic energy, power of
    damping, friction and rolling resistance.
    """
    clear(pair, mode == TANGENT)
    sl, partner = rw.lot[0], rw.partner[m]
    centre, ring_axis = row(partner, CENTRE), row(partner, AXIS)
    a, n = row(pose.axis, 0), side.s.shape[0]
    first = np.uint64(m * n)
    span = (first, first + np.uint64(n))
    _add_forces(first, side, Rw, a, ring_axis, sl, pair.wrench)
    if mode >= REPORT:
        begin_sums(span, rw.load[m], sl, side.normal[EXPONENT], sums)
        if mode == REPORT:
            _report(first, side, Rw, a, sl, sums)
    if side.uneven:
        _add_slope_forces(first, pose, side, centre, ring_axis, theta, sl, pair, mode, sums)
    if pose.spot[0] > 0.0:
        add_spot_wrench(first, pose, side, partner, sl, pair, mode, sums)
    if mode == TANGENT:
        _tangent(first, pose, side, Rw, partner, theta, sl, pair)
    if side.rolling[0] > 0.0:
        # shear on both surfaces, and the pressure that balances it: on the roller -F t at the
        # surface and + hydro F t through its centre (hydro = 2 R/Rw); the ring gets the reaction
        # of the same wrench at the contact point
        pair.wrench[2] += (side.hydro - 1.0) * rw.rolling[m]
        pair.wrench[MOMENT] += side.sign * Rw * rw.rolling[m]
        if mode >= REPORT:
            sums[ROLLED] -= rw.rolling[m] * (rw.speed[m] + rw.ring_speed[m])


@part(fastmath=VECTORISED)
def _penetrations(first, side, Rw, onset, ring_axis, line, spin, sl):
    """Penetration, its rate, normal and sliding velocity of every slice on a round race."""
    x0, x1, v0, v1 = line
    for k in range(side.s.shape[0]):
        s, at = side.s[k], first + np.uint64(k)
        x = combine(x0, s, x1)
        distance = sqrt(dot(x, x))
        n = times(side.sign / distance, x)
        # d = (Rw - drop) - sign (|x| - R): overlap of profile and race along n
        sl.d[at] = Rw - side.drop[k] - side.sign * (distance - side.radius)
        sl.onset[at] = onset
        sl.n1[at], sl.n2[at], sl.n3[at] = n
        v = combine(v0, s, v1)
        sl.v[at] = -dot(n, v)  # d' = -n . v of the axis: rotation moves the surface along the race
        # sliding of the surface, at -(Rw - drop) n from the axis: along b and along b x e_d
        v = combine(v, side.drop[k] - Rw, cross(spin, n))
        along, across = dot(v, ring_axis), side.sign * dot(v, cross(ring_axis, n))
        sl.t1[at], sl.t2[at] = along, across
        sl.u[at] = sqrt(along * along + across * across)


@part(fastmath=VECTORISED)
def _add_forces(first, side, Rw, a, ring_axis, sl, wrench):
    """Add the slices' forces to the wrench."""
    force = moment = (0.0, 0.0, 0.0)
    for k in range(side.s.shape[0]):
        at = first + np.uint64(k)
        n = (sl.n1[at], sl.n2[at], sl.n3[at])
        # f = N (n - (mu/u) (t1 b + t2 b x e_d)) at s a - (Rw - drop) n, in F
        f = combine(n, -sl.g[at] * sl.t1[at], ring_axis)
        f = times(sl.N[at], combine(f, -sl.g[at] * sl.t2[at] * side.sign, cross(ring_axis, n)))
        r = combine(times(side.s[k], a), side.drop[k] - Rw, n)
        force = plus(force, f)
        moment = plus(moment, cross(r, f))
    for c in range(3):
        wrench[c] += force[c]
        wrench[MOMENT + c] += moment[c]


@part(fastmath=VECTORISED)
def _report(first, side, Rw, a, sl, sums):
    """Traction, moments of the normal forces, and sliding of the slice in the middle."""
    across = about_r = about_psi = 0.0
    for k in range(side.s.shape[0]):
        at = first + np.uint64(k)
        N = sl.N[at]
        n = (sl.n1[at], sl.n2[at], sl.n3[at])
        m = cross(combine(times(side.s[k], a), side.drop[k] - Rw, n), n)
        across -= N * sl.g[at] * sl.t2[at]
        about_r += N * m[1]
        about_psi += N * m[2]
    sums[TRACTION] = across
    sums[MOMENT_R] += about_r
    sums[MOMENT_PSI] += about_psi
    sums[SLIDING] = sl.t2[first + np.uint64(side.s.shape[0] // 2)]


@part
def theta_at(pose, y, z):
    """Azimuth in space of the direction (0, y, z) given in F."""
    ys = pose.F[1, 1] * y + pose.F[2, 1] * z
    zs = pose.F[1, 2] * y + pose.F[2, 2] * z
    return np.arctan2(zs, ys)


@part
def _unevenness(side, phi, k, row):
    """How much larger the race's radius is at azimuth ``phi`` [rad] on the ring, under slice k of a
    roller of a ``row``, and its slope over phi [m, m/rad]."""
    rise, slope = wave_at(side.wave, phi)
    if row != side.row:
        return rise, slope
    sunk, steep = spall_depth(side.spall, phi)
    outwards = -side.sign * side.spalled[k]
    return rise + outwards * sunk, slope + outwards * steep


@part
def _add_unevenness(first, pose, side, distance, ring_spin, theta, sl):
    """What an uneven race adds to penetrations and their rates; ``distance`` of the roller's axis
    from the ring's."""
    turn = pose.V[2] / distance - ring_spin
    for k in range(side.s.shape[0]):
        at = first + np.uint64(k)
        phi = theta_at(pose, side.sign * sl.n2[at], side.sign * sl.n3[at]) - theta
        rise, slope = _unevenness(side, phi, k, pose.spot[2])
        # a race of radius R + rise(phi): d and d' change by sign rise and sign rise' phi'
        sl.d[at] += side.sign * rise
        sl.v[at] += side.sign * slope * turn


@part
def _slope_along_race(pose, side, P, n, theta, k):
    """Slope of the penetration along the race, dd/(d dtheta), on an uneven race."""
    phi = theta_at(pose, side.sign * n[1], side.sign * n[2]) - theta
    return side.sign * _unevenness(side, phi, k, pose.spot[2])[1] / sqrt(P[1] * P[1] + P[2] * P[2])


@part
def _add_slope_forces(first, pose, side, P, b, theta, sl, pair, mode, sums):
    """What an uneven race's slope adds: its energy depends on the azimuth of the roller's axis, so
    that share of the force acts there."""
    a = row(pose.axis, 0)
    for k in range(side.s.shape[0]):
        at = first + np.uint64(k)
        n = (sl.n1[at], sl.n2[at], sl.n3[at])
        slope = _slope_along_race(pose, side, P, n, theta, k)
        # f = -N dd/d(along) b x e_d: minus the slope of the elastic energy
        f = times(-sl.N[at] * slope * side.sign, cross(b, n))
        on_axis = times(side.s[k], a)
        add_wrench(pair.wrench, f, on_axis)
        if mode == REPORT:
            moment = cross(on_axis, f)
            sums[MOMENT_R] += moment[1]
            sums[MOMENT_PSI] += moment[2]


@outlined
def _tangent(first, pose, side, Rw, partner, theta, sl, pair):
    """The slices' share of the pair's tangent."""
    a, P, b = row(pose.axis, 0), row(partner, CENTRE), row(partner, AXIS)
    Wn, Wx, Wt, Wf = pair.W[0], pair.W[1], pair.W[2], pair.W[WHOLE]
    for k in range(side.s.shape[0]):
        at = first + np.uint64(k)
        if sl.N[at] <= 0.0:
            continue
        n = (sl.n1[at], sl.n2[at], sl.n3[at])
        t = times(side.sign, cross(b, n))
        on_axis = times(side.s[k], a)
        r = combine(on_axis, side.drop[k] - Rw, n)
        slope = _slope_along_race(pose, side, P, n, theta, k) if side.uneven else 0.0
        g1, g2 = sl.g[at] * sl.t1[at], sl.g[at] * sl.t2[at]
        add_generator(t, on_axis, Wt)
        add_generator(n, r, Wn)
        for j in range(6):
            Wn[j] -= slope * Wt[j]
        if pose.spot[0] > 0.0 and side.spotted[k] > 0.0:
            spot_generator(k, n, pose, side, partner, Wn)
        add_generator(t, r, Wt)
        add_generator(b, r, Wx)
        # generators (f, r x f): K = dN/dd Wf Wn^T, C = dN/dd' Wf Wn^T + friction's own
        for j in range(6):
            Wf[j] = Wn[j] - g1 * Wx[j] - g2 * Wt[j]
        add_outer(pair.K, sl.Nd[at], Wf, Wn)
        add_outer(pair.C, sl.Nv[at], Wf, Wn)
        friction_tangent(
            pair.C, sl.N[at], sl.g[at], sl.dg[at], sl.u[at], sl.t1[at], sl.t2[at], Wx, Wt
        )  # fmt: skip
