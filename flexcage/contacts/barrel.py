"""Barrel against a race whose profile is an arc, in slices: a groove, or a sphere.

A barrel is the envelope of spheres about its axis. Slice k is the sphere that touches the barrel's
surface where the slice's middle is; an arc of a circle turned about the ring's axis b is a torus,
and a sphere one whose circle of centres is a point of the axis. How deep the slice's centre p is
pressed in follows from its distance to that circle,

    d = hypot(p.b - axial, D - centre) + reach - radius     D: distance of p from the ring's axis

along the normal n on the barrel, towards the arc's centre. The slice's force acts on the barrel's
axis: so forces are slopes of one energy, tilt and skew included, and a barrel turns freely about
the centre of a sphere. Every slice slides at the speed of its own surface: it rolls in two places
of the line and slides between them and beyond (Heathcote), and turns on the contact's normal as
far as the ring does.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.cone import add_rolling, cone_line, set_speeds
from flexcage.contacts.evaluation import (
    MOMENT_PSI,
    MOMENT_R,
    REPORT,
    SLIDING,
    TANGENT,
    TRACTION,
)
from flexcage.contacts.laws import EXPONENT
from flexcage.contacts.slices import begin_sums, largest
from flexcage.contacts.state import (
    AXIS,
    MOMENT,
    WHOLE,
    add_generator,
    add_outer,
    clear,
    friction_tangent,
)
from flexcage.core.jit import VECTORISED, outlined, part
from flexcage.core.vectors import combine, cross, dot, plus, row, times


class BarrelSide(NamedTuple):
    """One raceway, and how barrels meet it. Places along a barrel count from its middle."""

    sign: float  # +1: the inner race, with barrels outside of it; -1: the outer
    axial: float  # place on the ring's axis of the circle of the arc's centres, from its centre
    centre: float  # radius of that circle; 0 of a sphere
    arc: float  # radius of the arc
    radius: float  # of the race under a barrel's middle
    s: np.ndarray  # (ns,) places of the slices' spheres
    reach: np.ndarray  # (ns,) their radii
    own: float  # radius of the barrel in its middle
    middle: float  # place of that
    normal: np.ndarray  # (N_NORMAL,) normal law of a slice
    friction: np.ndarray  # (N_FRICTION,)
    rolling: np.ndarray  # (2,) rolling resistance
    hydro: float  # pressure share of that: twice the race's radius over the pitch circle's


@part
def barrel_penetrations(m, pose, side, onset, rw):
    """Whether a barrel touches a race: geometry and motion of contact m of the lot ``rw``
    (``race.RaceWork``), of which ``partner[m]`` is given; ``onset``: speed at which it closed."""
    sl, partner = rw.lot[0], rw.partner[m]
    ring_axis, n = row(partner, AXIS), side.s.shape[0]
    line, spin = cone_line(pose, partner)
    if _out_of_reach(side, line):
        return False
    first = np.uint64(m * n)
    _penetrations(first, side, onset, ring_axis, line, spin, sl)
    if largest((first, first + np.uint64(n)), sl.d) <= 0.0:
        return False
    set_speeds(m, pose, side, rw)
    return True


@part
def _out_of_reach(side, line):
    """A bound: barrels are more curved than the race, so that slices off the middle are less deep,
    but for the lean of the axis against the race, and for skew."""
    x0, x1 = line.x0, line.x1
    distance = sqrt(dot(x0, x0))
    aside, above = line.l0 - side.axial, distance - side.centre
    far, along = sqrt(aside * aside + above * above), dot(x0, x1) / distance
    slope = abs(aside * line.l1 + above * along) / far
    most = max(abs(side.s[0]), abs(side.s[side.s.shape[0] - 1]))
    skewed = most * (dot(x1, x1) - along * along) / distance
    return side.arc - side.own - far > most * (slope + skewed)


@part(fastmath=VECTORISED)
def _penetrations(first, side, onset, ring_axis, line, spin, sl):
    """Penetration, its rate, normal and sliding velocity (t1, t2, t3) of every slice."""
    x0, x1, l0, l1, v0, v1 = line
    for k in range(side.s.shape[0]):
        s, at = side.s[k], first + np.uint64(k)
        x = combine(x0, s, x1)
        share = 1.0 - side.centre / sqrt(dot(x, x))
        arm = combine(times(share, x), l0 + s * l1 - side.axial, ring_axis)
        far = sqrt(dot(arm, arm))
        n = times(-1.0 / far, arm)
        sl.d[at] = far + side.reach[k] - side.arc
        sl.onset[at] = onset
        sl.n1[at], sl.n2[at], sl.n3[at] = n
        v = combine(v0, s, v1)
        rate = dot(n, v)
        sl.v[at] = -rate
        # sliding of the surface, at -reach n from the axis
        v = combine(combine(v, -rate, n), -side.reach[k], cross(spin, n))
        sl.t1[at], sl.t2[at], sl.t3[at] = v
        sl.u[at] = sqrt(dot(v, v))


@part
def barrel_wrench(m, pose, side, rw, pair, mode, sums):
    """Wrench on the barrel of contact m, whose forces are known (``race.race_forces``).

    From REPORT on with ``sums``: as ``race.race_wrench``; the moments of normal forces are those
    about the barrel's transverse axes.
    """
    clear(pair, mode == TANGENT)
    sl, n = rw.lot[0], side.s.shape[0]
    first = np.uint64(m * n)
    span = (first, first + np.uint64(n))
    _add_forces(first, side, row(pose.axis, 0), sl, pair.wrench)
    if mode >= REPORT:
        begin_sums(span, rw.load[m], sl, side.normal[EXPONENT], sums)
        if mode == REPORT:
            _report(first, side, pose, row(rw.partner[m], AXIS), sl, sums)
    if mode == TANGENT:
        _barrel_tangent(first, pose, side, rw.partner[m], sl, pair)
    if side.rolling[0] > 0.0:
        add_rolling(m, pose, side, rw, pair, mode, sums)


@part(fastmath=VECTORISED)
def _add_forces(first, side, a, sl, wrench):
    """Add the slices' forces to the wrench."""
    force = moment = (0.0, 0.0, 0.0)
    for k in range(side.s.shape[0]):
        at = first + np.uint64(k)
        n = (sl.n1[at], sl.n2[at], sl.n3[at])
        f = combine(n, -sl.g[at], (sl.t1[at], sl.t2[at], sl.t3[at]))
        f = times(sl.N[at], f)
        r = combine(times(side.s[k], a), -side.reach[k], n)
        force = plus(force, f)
        moment = plus(moment, cross(r, f))
    for c in range(3):
        wrench[c] += force[c]
        wrench[MOMENT + c] += moment[c]


@part
def _directions(at, ring_axis, sl):
    """Of slice ``at``: its normal, and directions of sliding along the race's profile and round
    the ring, on the inner race forwards."""
    n = (sl.n1[at], sl.n2[at], sl.n3[at])
    t = cross(ring_axis, n)
    t = times(1.0 / sqrt(dot(t, t)), t)
    return n, cross(t, n), t


@part
def _report(first, side, pose, ring_axis, sl, sums):
    """Traction, moments of the normal forces, and sliding of the slice in the middle."""
    moment, a, half = (0.0, 0.0, 0.0), row(pose.axis, 0), side.s.shape[0] // 2
    for k in range(side.s.shape[0]):
        at = first + np.uint64(k)
        n, _, t = _directions(at, ring_axis, sl)
        sliding = side.sign * dot(t, (sl.t1[at], sl.t2[at], sl.t3[at]))
        sums[TRACTION] -= sl.N[at] * sl.g[at] * sliding
        moment = combine(moment, sl.N[at] * side.s[k], cross(a, n))
        if k == half:
            sums[SLIDING] = sliding
    sums[MOMENT_R] = dot(moment, row(pose.axis, 1))
    sums[MOMENT_PSI] = dot(moment, row(pose.axis, 2))


@outlined
def _barrel_tangent(first, pose, side, partner, sl, pair):
    """The slices' share of the pair's tangent."""
    a, b, (line, _) = row(pose.axis, 0), row(partner, AXIS), cone_line(pose, partner)
    Wn, Wl, Wt, Wf = pair.W[0], pair.W[1], pair.W[2], pair.W[WHOLE]
    for k in range(side.s.shape[0]):
        at = first + np.uint64(k)
        if sl.N[at] <= 0.0:
            continue
        n, l, t = _directions(at, b, sl)
        x, on_axis = combine(line.x0, side.s[k], line.x1), times(side.s[k], a)
        r, far = combine(on_axis, -side.reach[k], n), side.arc - side.reach[k] + sl.d[at]
        # normals turn towards the arc's centre along the profile, to the ring's axis round it
        add_generator(l, on_axis, Wl)
        add_generator(t, on_axis, Wt)
        add_outer(pair.K, sl.N[at] / far, Wl, Wl)
        add_outer(pair.K, sl.N[at] * (1.0 - side.centre / sqrt(dot(x, x))) / far, Wt, Wt)
        add_generator(n, r, Wn)
        add_generator(l, r, Wl)
        add_generator(t, r, Wt)
        v, g = (sl.t1[at], sl.t2[at], sl.t3[at]), sl.g[at]
        t1, t2 = dot(v, l), dot(v, t)
        # generators (f, r x f): K = dN/dd Wf Wn^T, C = dN/dd' Wf Wn^T + friction's own
        for j in range(6):
            Wf[j] = Wn[j] - g * (t1 * Wl[j] + t2 * Wt[j])
        add_outer(pair.K, sl.Nd[at], Wf, Wn)
        add_outer(pair.C, sl.Nv[at], Wf, Wn)
        friction_tangent(pair.C, sl.N[at], g, sl.dg[at], sl.u[at], t1, t2, Wl, Wt)
