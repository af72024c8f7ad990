"""Roller against a raceway: slices with profile, tilt and skew, traction and rolling resistance."""

from __future__ import annotations

from math import cos, sin, sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.laws import rolling_force
from flexcage.contacts.state import (
    add_generator,
    add_outer,
    add_wrench,
    clear,
    friction_tangent,
)
from flexcage.core.jit import part, zero
from flexcage.core.vectors import combine, cross, dot, minus, put, row, times, xyz


class RaceSide(NamedTuple):
    """One raceway: geometry and parameters that all rollers share."""

    sign: float  # normal on the roller along sign * e_d: +1 inner, -1 outer
    radius: float
    s: np.ndarray  # (ns,) slice positions along the roller
    drop: np.ndarray  # (ns,) profile
    friction: np.ndarray  # (5,)
    rolling: np.ndarray  # (2,) rolling resistance
    hydro: float  # 2 R/Rw: pressure share of the rolling resistance
    wave: np.ndarray  # (2,) waviness amplitude and order


@part
def race_contact(pose, side, Rw, P, b, Vr, wr, theta, p, law, friction, sl, pair, mode, sums):
    """Wrench on the roller from one raceway.

    P: roller centre from the ring's centre; b: ring axis; Vr, wr: the ring's velocity and angular
    velocity; all in F. ``theta``: the ring's spin angle (waviness). ``mode``: 0 wrench, 1 with
    tangent, from 2 with ``sums``: normal, traction, moments about e_r and e_psi, sliding speed at
    the middle, elastic energy, power of damping, friction and rolling resistance.
    """
    clear(pair, mode == 1)
    if mode >= 2:
        zero(sums)
    centre, ring_axis, ring_spin = xyz(P), xyz(b), xyz(wr)
    a = row(pose.axis, 0)
    # what of the roller's axis at s is perpendicular to the ring's axis: x0 + s x1
    x0 = combine(centre, -dot(centre, ring_axis), ring_axis)
    x1 = combine(a, -dot(a, ring_axis), ring_axis)
    square, mixed, lean = dot(x0, x0), dot(x0, x1), dot(x1, x1)
    n_s = side.s.shape[0]
    # quick look: is any slice near the race?
    slope = abs(a[1]) + abs(a[2]) + abs(ring_axis[1]) + abs(ring_axis[2])
    gap = side.sign * (sqrt(square) - side.radius) - Rw
    if gap > abs(side.s[n_s - 1]) * slope + side.wave[0]:
        return False
    # velocity of the roller's axis at s, seen from the ring's material there: v0 + s v1
    spin = minus(xyz(pose.w), ring_spin)
    v0 = minus(minus(xyz(pose.V), xyz(Vr)), cross(ring_spin, centre))
    v1 = cross(spin, a)
    active = False
    for k in range(n_s):
        s = side.s[k]
        d = sqrt(square + s * (2.0 * mixed + s * lean))
        sl.d[k] = Rw - side.drop[k] - side.sign * (d - side.radius)
        sl.v[k] = sl.u[k] = 0.0
        x = combine(x0, s, x1)
        if side.wave[0] > 0.0:
            phase = side.wave[1] * (theta_at(pose, x[1], x[2]) - theta)
            sl.d[k] += side.sign * side.wave[0] * cos(phase)
        if sl.d[k] > 0.0:
            active = True
            n = times(side.sign / d, x)
            put(sl.n[k], n)
            v = combine(v0, s, v1)
            sl.v[k] = -dot(n, v)
            if side.wave[0] > 0.0:
                turn = (pose.V[2] / max(d, 1e-9)) - ring_spin[0]
                sl.v[k] -= side.sign * side.wave[0] * side.wave[1] * sin(phase) * turn
            v = combine(v, side.drop[k] - Rw, cross(spin, n))  # of its surface
            sl.t[k, 0] = dot(v, ring_axis)
            sl.t[k, 1] = side.sign * dot(v, cross(ring_axis, n))
            sl.u[k] = sqrt(sl.t[k, 0] ** 2 + sl.t[k, 1] ** 2)
    if not active:
        return False
    law(n_s, sl.d, sl.v, p, sl.N, sl.Nd, sl.Nv)
    friction(n_s, sl.u, side.friction, sl.g, sl.dg)
    _collect(pose, side, Rw, centre, ring_axis, theta, sl, pair, mode, sums)
    _roll(pose, side, Rw, centre, ring_spin[0], sl, pair, mode, sums)
    if mode >= 2:
        law(n_s, sl.d, sl.zero, p, sl.u, sl.Nd, sl.Nv)
        for k in range(n_s):
            sums[5] += sl.u[k] * max(sl.d[k], 0.0) / (p[1] + 1.0)
            sums[6] -= (sl.N[k] - sl.u[k]) * sl.v[k]
    return True


@part
def theta_at(pose, y, z):
    """Azimuth in space of the direction (0, y, z) given in F."""
    ys = pose.F[1, 1] * y + pose.F[2, 1] * z
    zs = pose.F[1, 2] * y + pose.F[2, 2] * z
    return np.arctan2(zs, ys)


@part
def _wave_slope(pose, side, P, n, theta):
    """Slope of the penetration along the race, dd/(d dtheta), on a wavy race."""
    phase = side.wave[1] * (theta_at(pose, side.sign * n[1], side.sign * n[2]) - theta)
    distance = sqrt(P[1] * P[1] + P[2] * P[2])
    return -side.sign * side.wave[0] * side.wave[1] * sin(phase) / distance


@part
def _collect(pose, side, Rw, P, b, theta, sl, pair, mode, sums):
    """Sum the slices' forces into the pair, with its tangent or its report.

    On a wavy race the normal leans by the wave's slope: the energy depends on the azimuth of the
    roller's axis, so that share of the force acts there.
    """
    a = row(pose.axis, 0)
    middle = side.s.shape[0] // 2
    for k in range(side.s.shape[0]):
        N = sl.N[k]
        if N <= 0.0:
            continue
        n = xyz(sl.n[k])
        t = times(side.sign, cross(b, n))
        on_axis = times(side.s[k], a)
        r = combine(on_axis, side.drop[k] - Rw, n)
        gx, gt = sl.g[k] * sl.t[k, 0], sl.g[k] * sl.t[k, 1]
        f = times(N, combine(combine(n, -gx, b), -gt, t))
        add_wrench(pair.wrench, f, r)
        slope = 0.0
        if side.wave[0] > 0.0:
            slope = _wave_slope(pose, side, P, n, theta)
            add_wrench(pair.wrench, times(-N * slope, t), on_axis)
        if mode == 1:
            _tangent(n, b, t, r, on_axis, slope, gx, gt, k, sl, pair)
        elif mode >= 2:
            moment = cross(r, n)
            leaning = times(slope, cross(on_axis, t))
            sums[0] += N
            sums[1] -= N * gt
            sums[2] += N * (moment[1] - leaning[1])
            sums[3] += N * (moment[2] - leaning[2])
            sums[7] -= N * sl.g[k] * sl.u[k] ** 2
            if k == middle:
                sums[4] = sl.t[k, 1]


@part
def _tangent(n, b, t, r, on_axis, slope, gx, gt, k, sl, pair):
    """One slice's share of the pair's tangent."""
    Wn, Wx, Wt, Wf = pair.W[0], pair.W[1], pair.W[2], pair.W[3]
    add_generator(t, on_axis, Wt)
    add_generator(n, r, Wn)
    for j in range(6):
        Wn[j] -= slope * Wt[j]
    add_generator(t, r, Wt)
    add_generator(b, r, Wx)
    for j in range(6):
        Wf[j] = Wn[j] - gx * Wx[j] - gt * Wt[j]
    add_outer(pair.K, sl.Nd[k], Wf, Wn)
    add_outer(pair.C, sl.Nv[k], Wf, Wn)
    friction_tangent(pair.C, sl.N[k], sl.g[k], sl.dg[k], sl.u[k], sl.t[k, 0], sl.t[k, 1], Wx, Wt)


@part
def _roll(pose, side, Rw, P, ring_spin, sl, pair, mode, sums):
    """Rolling resistance: shear on both surfaces, and the pressure that balances it.

    On the roller: -F t at the surface and + hydro F t through its centre (hydro = 2 R/Rw);
    the ring gets the reaction of the same wrench at the contact point.
    """
    load = 0.0
    for k in range(side.s.shape[0]):
        load += sl.N[k]
    if side.rolling[0] <= 0.0 or load <= 0.0:
        return
    orbit = pose.V[2] / P[1]
    lever = -side.sign * Rw  # contact point along e_r from the roller's centre
    roller_speed = (pose.w[0] - orbit) * lever  # along e_psi, seen from the moving contact
    ring_speed = (ring_spin - orbit) * side.radius
    u = 0.5 * (roller_speed + ring_speed)
    F = rolling_force(side.rolling, abs(u), load)
    if u < 0.0:
        F = -F
    pair.wrench[2] += (side.hydro - 1.0) * F
    pair.wrench[3] -= lever * F
    if mode >= 2:
        sums[8] -= F * (roller_speed + ring_speed)
