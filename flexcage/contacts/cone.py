"""Tapered roller against a conical raceway, in slices.

A cone is the envelope of spheres about its axis. Slice k of a roller is the sphere that touches the
roller's surface where the slice's middle is; the distance of its centre p from a conical race about
the ring's axis b, with its apex at ``apex`` along that, is

    sign (D cos + (p.b - apex) sin)     D: distance of p from the ring's axis

with the sine and cosine of the race's half angle. Its gradient n is the direction of the slice's
force, which acts on the roller's axis: so forces are the slopes of one energy, tilt and skew
included. The roller's end is one sphere more, and the rib one cone more (``cone_end``). Waves and
spalls (``uneven_cone``) and spots of rollers (``roller_spot``) add to depths.
"""

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
from flexcage.contacts.laws import EXPONENT
from flexcage.contacts.roller_spot import add_spot_depth, add_spot_wrench, spot_generator
from flexcage.contacts.slices import begin_sums, largest
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
from flexcage.contacts.uneven_cone import add_slope_forces, add_unevenness, round_the_ring
from flexcage.core.jit import VECTORISED, outlined, part
from flexcage.core.vectors import combine, cross, dot, minus, plus, row, times, xyz


class ConeSide(NamedTuple):
    """One conical raceway, and how rollers meet it. Places along a roller count from its centre of
    mass, towards the apex."""

    sign: float  # +1: the inner race, with rollers outside of it; -1: the outer
    cos: float  # of the race's half angle
    sin: float
    apex: float  # place on the ring's axis, from its centre
    radius: float  # of the race under a roller's mid-length
    s: np.ndarray  # (ns,) places of the slices' spheres
    reach: np.ndarray  # (ns,) their radii, less the profile's drop
    whole: float  # radius of the sphere at the centre of mass, without a profile
    taper: float  # sine of the roller's half angle
    own: float  # radius of the roller at mid-length
    middle: float  # place of that
    normal: np.ndarray  # (N_NORMAL,) normal law of a slice
    friction: np.ndarray  # (N_FRICTION,)
    rolling: np.ndarray  # (2,) rolling resistance
    hydro: float  # pressure share of that: twice the race's radius over the pitch circle's
    wave: np.ndarray  # (3,) and
    spall: np.ndarray  # (5,) as in ``contacts.uneven``, at right angles to the race
    spalled: np.ndarray  # (ns,) share of each slice that lies over the spall
    uneven: int  # 1 if there is a wave or a spall (records hold no booleans)
    spot: np.ndarray  # (5,) of the roller that has one, as a spall's on it
    spotted: np.ndarray  # (ns,) share of each slice that lies on the spot


class ConeLine(NamedTuple):
    """A roller's axis as a ring sees it: at s it is at x0 + s x1 across the ring's axis and at
    l0 + s l1 along it, with velocity v0 + s v1 relative to the ring's material."""

    x0: tuple[float, float, float]
    x1: tuple[float, float, float]
    l0: float
    l1: float
    v0: tuple[float, float, float]
    v1: tuple[float, float, float]


@part
def cone_line(pose, partner):
    """The roller's axis seen from its ``partner`` (4, 3), and their relative angular velocity."""
    centre, ring_axis, ring_spin = row(partner, CENTRE), row(partner, AXIS), row(partner, SPIN)
    a, spin = row(pose.axis, 0), minus(xyz(pose.w), ring_spin)
    l0, l1 = dot(centre, ring_axis), dot(a, ring_axis)
    v0 = minus(minus(xyz(pose.V), row(partner, VELOCITY)), cross(ring_spin, centre))
    line = ConeLine(
        combine(centre, -l0, ring_axis), combine(a, -l1, ring_axis), l0, l1, v0, cross(spin, a)
    )
    return line, spin


@part
def cone_penetrations(m, pose, side, theta, onset, rw):
    """Whether a roller touches a conical race: geometry and motion of contact m of the lot ``rw``
    (``race.RaceWork``), of which ``partner[m]`` is given. ``theta``: the ring's spin angle;
    ``onset``: speed at which it closed."""
    sl, partner = rw.lot[0], rw.partner[m]
    ring_axis, n = row(partner, AXIS), side.s.shape[0]
    line, spin = cone_line(pose, partner)
    if _out_of_reach(side, line):
        return False
    first = np.uint64(m * n)
    _cone_penetrations(first, side, onset, ring_axis, line, spin, sl)
    if side.uneven:
        add_unevenness(first, pose, side, line, ring_axis, theta, sl)
    if pose.spot[0] > 0.0:
        add_spot_depth(first, pose, side, line, ring_axis, spin, sl)
    if largest((first, first + np.uint64(n)), sl.d) <= 0.0:
        return False
    set_speeds(m, pose, side, rw)
    return True


@part
def set_speeds(m, pose, side, rw):
    """Speeds of both surfaces of contact m along e_psi, seen from the contact, which moves with the
    orbit. ``side`` of cones or of barrels (``barrel.BarrelSide``)."""
    partner = rw.partner[m]
    orbit = pose.V[2] / partner[CENTRE, 1]
    turn = dot(xyz(pose.w), row(pose.axis, 0)) - orbit * pose.axis[0, 0]
    rw.speed[m] = -turn * side.sign * side.own
    rw.ring_speed[m] = (partner[SPIN, 0] - orbit) * side.radius
    rw.entrainment[m] = 0.5 * (rw.speed[m] + rw.ring_speed[m])


@part
def _out_of_reach(side, line):
    """A bound: the distance of the axis from the race is linear along it, but for skew."""
    x0, x1 = line.x0, line.x1
    distance = sqrt(dot(x0, x0))
    along = dot(x0, x1) / distance
    gap = side.sign * (distance * side.cos + (line.l0 - side.apex) * side.sin) - side.whole
    slope = side.sign * (along * side.cos + line.l1 * side.sin) + side.taper
    most = max(abs(side.s[0]), abs(side.s[side.s.shape[0] - 1]))
    gap -= side.wave[0]
    return gap > most * (abs(slope) + most * (dot(x1, x1) - along * along) / distance)


@part(fastmath=VECTORISED)
def _cone_penetrations(first, side, onset, ring_axis, line, spin, sl):
    """Penetration, its rate, normal and sliding velocity of every slice."""
    x0, x1, l0, l1, v0, v1 = line
    c, sn = side.cos, side.sin
    for k in range(side.s.shape[0]):
        s, at = side.s[k], first + np.uint64(k)
        x = combine(x0, s, x1)
        distance = sqrt(dot(x, x))
        e = times(1.0 / distance, x)
        n = times(side.sign, combine(times(c, e), sn, ring_axis))
        sl.d[at] = side.reach[k] - side.sign * (c * distance + sn * (l0 + s * l1 - side.apex))
        sl.onset[at] = onset
        sl.n1[at], sl.n2[at], sl.n3[at] = n
        v = combine(v0, s, v1)
        sl.v[at] = -dot(n, v)
        # sliding of the surface, at -reach n from the axis: along the race's lines and round it
        v = combine(v, -side.reach[k], cross(spin, n))
        along = c * dot(v, ring_axis) - sn * dot(v, e)
        across = dot(v, cross(ring_axis, e))
        sl.t1[at], sl.t2[at] = along, across
        sl.u[at] = sqrt(along * along + across * across)


@part
def cone_wrench(m, pose, side, theta, rw, pair, mode, sums):
    """Wrench on the roller of contact m, whose forces are known (``race.race_forces``).

    From REPORT on with ``sums``: as ``race.race_wrench``; the moments of normal forces are those
    about the roller's transverse axes.
    """
    clear(pair, mode == TANGENT)
    sl, ring_axis, n = rw.lot[0], row(rw.partner[m], AXIS), side.s.shape[0]
    first = np.uint64(m * n)
    span = (first, first + np.uint64(n))
    _add_forces(first, side, row(pose.axis, 0), ring_axis, sl, pair.wrench)
    if mode >= REPORT:
        begin_sums(span, rw.load[m], sl, side.normal[EXPONENT], sums)
        if mode == REPORT:
            _report(first, side, pose, sl, sums)
    if side.uneven:
        line, _ = cone_line(pose, rw.partner[m])
        add_slope_forces(first, pose, side, line, ring_axis, theta, sl, pair, mode, sums)
    if pose.spot[0] > 0.0:
        add_spot_wrench(first, pose, side, rw.partner[m], sl, pair, mode, sums)
    if mode == TANGENT:
        _cone_tangent(first, pose, side, rw.partner[m], theta, sl, pair)
    if side.rolling[0] > 0.0:
        add_rolling(m, pose, side, rw, pair, mode, sums)


@part
def add_rolling(m, pose, side, rw, pair, mode, sums):
    """Rolling resistance of contact m: shear on the surface, a couple about the roller's axis, and
    the pressure that balances it. ``side`` of cones or of barrels (``barrel.BarrelSide``)."""
    a, F = row(pose.axis, 0), rw.rolling[m]
    add_wrench(pair.wrench, (0.0, 0.0, (side.hydro - 1.0) * F), times(side.middle, a))
    for c in range(3):
        pair.wrench[MOMENT + c] += side.sign * side.own * F * a[c]
    if mode >= REPORT:
        sums[ROLLED] -= F * (rw.speed[m] + rw.ring_speed[m])


@part(fastmath=VECTORISED)
def _add_forces(first, side, a, ring_axis, sl, wrench):
    """Add the slices' forces to the wrench."""
    force = moment = (0.0, 0.0, 0.0)
    c, sn = side.cos, side.sin
    for k in range(side.s.shape[0]):
        at = first + np.uint64(k)
        n = (sl.n1[at], sl.n2[at], sl.n3[at])
        # N (n - (mu/u) (t1 l + t2 t)) with l = (b - sign sin n)/cos and t = sign b x n/cos
        along, across = sl.g[at] * sl.t1[at] / c, side.sign * sl.g[at] * sl.t2[at] / c
        f = combine(times(1.0 + along * side.sign * sn, n), -along, ring_axis)
        f = times(sl.N[at], combine(f, -across, cross(ring_axis, n)))
        r = combine(times(side.s[k], a), -side.reach[k], n)
        force = plus(force, f)
        moment = plus(moment, cross(r, f))
    for c in range(3):
        wrench[c] += force[c]
        wrench[MOMENT + c] += moment[c]


@part(fastmath=VECTORISED)
def _report(first, side, pose, sl, sums):
    """Traction, moments of the normal forces, and sliding of the slice in the middle."""
    across, moment, a = 0.0, (0.0, 0.0, 0.0), row(pose.axis, 0)
    for k in range(side.s.shape[0]):
        at = first + np.uint64(k)
        across -= sl.N[at] * sl.g[at] * sl.t2[at]
        n = (sl.n1[at], sl.n2[at], sl.n3[at])
        moment = combine(moment, sl.N[at] * side.s[k], cross(a, n))
    sums[TRACTION] = across
    sums[MOMENT_R] = dot(moment, row(pose.axis, 1))
    sums[MOMENT_PSI] = dot(moment, row(pose.axis, 2))
    sums[SLIDING] = sl.t2[first + np.uint64(side.s.shape[0] // 2)]


@outlined
def _cone_tangent(first, pose, side, partner, theta, sl, pair):
    """The slices' share of the pair's tangent."""
    a, b, (line, _) = row(pose.axis, 0), row(partner, AXIS), cone_line(pose, partner)
    Wn, Wl, Wt, Wf = pair.W[0], pair.W[1], pair.W[2], pair.W[WHOLE]
    for k in range(side.s.shape[0]):
        at = first + np.uint64(k)
        if sl.N[at] <= 0.0:
            continue
        n = (sl.n1[at], sl.n2[at], sl.n3[at])
        t = times(side.sign / side.cos, cross(b, n))
        l = times(1.0 / side.cos, combine(b, -side.sign * side.sin, n))
        x, on_axis = combine(line.x0, side.s[k], line.x1), times(side.s[k], a)
        r = combine(on_axis, -side.reach[k], n)
        # how the normal turns as the slice goes round the ring
        add_generator(t, on_axis, Wt)
        add_outer(pair.K, -sl.N[at] * side.sign * side.cos / sqrt(dot(x, x)), Wt, Wt)
        add_generator(n, r, Wn)
        if side.uneven:
            round_the_ring(k, pose, side, line, b, theta, Wn)
        if pose.spot[0] > 0.0 and side.spotted[k] > 0.0:
            spot_generator(k, n, pose, side, partner, Wn)
        add_generator(l, r, Wl)
        add_generator(t, r, Wt)
        g1, g2 = sl.g[at] * sl.t1[at], sl.g[at] * sl.t2[at]
        # generators (f, r x f): K = dN/dd Wf Wn^T, C = dN/dd' Wf Wn^T + friction's own
        for j in range(6):
            Wf[j] = Wn[j] - g1 * Wl[j] - g2 * Wt[j]
        add_outer(pair.K, sl.Nd[at], Wf, Wn)
        add_outer(pair.C, sl.Nv[at], Wf, Wn)
        friction_tangent(
            pair.C, sl.N[at], sl.g[at], sl.dg[at], sl.u[at], sl.t1[at], sl.t2[at], Wl, Wt
        )  # fmt: skip
