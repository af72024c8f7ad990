"""Roller against a raceway: slices with profile, tilt and skew, traction and rolling resistance."""

from __future__ import annotations

from math import cos, sin, sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.laws import rolling_force
from flexcage.contacts.state import add_generator, add_outer, clear, friction_tangent
from flexcage.core.jit import kernel, zero


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


@kernel
def race_contact(pose, side, Rw, P, b, Vr, wr, theta, p, law, friction, sl, pair, mode, sums):
    """Wrench on the roller from one raceway.

    P: roller centre from the ring's centre; b: ring axis; Vr, wr: the ring's velocity and angular
    velocity; all in F. ``theta``: the ring's spin angle (waviness). ``mode``: 0 wrench, 1 with
    tangent, 2 with ``sums``: normal, traction, moments about e_r and e_psi, sliding speed at the
    middle, elastic energy, power of damping, friction and rolling resistance.
    """
    clear(pair, mode == 1)
    a = pose.axis[0]
    n_s = side.s.shape[0]
    if mode == 2:
        zero(sums)
    # quick look: is any slice near the race?
    pb = P[0] * b[0] + P[1] * b[1] + P[2] * b[2]
    d0 = sqrt(max(P[0] ** 2 + P[1] ** 2 + P[2] ** 2 - pb * pb, 1e-18))
    reach = abs(side.s[n_s - 1])
    slope = abs(a[1]) + abs(a[2]) + abs(b[1]) + abs(b[2])
    gap = side.sign * (d0 - side.radius) - Rw
    if gap > reach * slope + side.wave[0]:
        return False
    n = np.empty(3)
    active = False
    for k in range(n_s):
        s = side.s[k]
        x, y, z = P[0] + s * a[0], P[1] + s * a[1], P[2] + s * a[2]
        q = x * b[0] + y * b[1] + z * b[2]
        x, y, z = x - q * b[0], y - q * b[1], z - q * b[2]
        d = sqrt(x * x + y * y + z * z)
        sl.d[k] = Rw - side.drop[k] - side.sign * (d - side.radius)
        sl.v[k] = 0.0
        if side.wave[0] > 0.0:
            phase = side.wave[1] * (theta_at(pose, y, z) - theta)
            sl.d[k] += side.sign * side.wave[0] * cos(phase)
        if sl.d[k] > 0.0:
            active = True
            f = side.sign / d
            n[0], n[1], n[2] = f * x, f * y, f * z
            sl.v[k] = -(
                n[0] * (pose.V[0] - Vr[0] + (s * (pose.w[1] * a[2] - pose.w[2] * a[1])))
                + n[1] * (pose.V[1] - Vr[1] + (s * (pose.w[2] * a[0] - pose.w[0] * a[2])))
                + n[2] * (pose.V[2] - Vr[2] + (s * (pose.w[0] * a[1] - pose.w[1] * a[0])))
            )
            # the ring's rotation moves its surface point along n only if tilted or off centre
            cx, cy, cz = P[0] + s * a[0], P[1] + s * a[1], P[2] + s * a[2]
            sl.v[k] += n[0] * (wr[1] * cz - wr[2] * cy)
            sl.v[k] += n[1] * (wr[2] * cx - wr[0] * cz) + n[2] * (wr[0] * cy - wr[1] * cx)
            if side.wave[0] > 0.0:
                turn = (pose.V[2] / max(d, 1e-9)) - wr[0]
                sl.v[k] -= side.sign * side.wave[0] * side.wave[1] * sin(phase) * turn
    if not active:
        return False
    law(n_s, sl.d, sl.v, p, sl.N, sl.Nd, sl.Nv)
    _slide(pose, side, Rw, P, b, Vr, wr, sl)
    friction(n_s, sl.u, side.friction, sl.g, sl.dg)
    _collect(pose, side, Rw, P, b, theta, sl, pair, mode, sums)
    _roll(pose, side, Rw, P, wr, sl, pair, mode, sums)
    if mode == 2:
        law(n_s, sl.d, sl.zero, p, sl.u, sl.Nd, sl.Nv)
        for k in range(n_s):
            sums[5] += sl.u[k] * max(sl.d[k], 0.0) / (p[1] + 1.0)
            sums[6] -= (sl.N[k] - sl.u[k]) * sl.v[k]
    return True


@kernel
def theta_at(pose, y, z):
    """Azimuth in space of the direction (0, y, z) given in F."""
    ys = pose.F[1, 1] * y + pose.F[2, 1] * z
    zs = pose.F[1, 2] * y + pose.F[2, 2] * z
    return np.arctan2(zs, ys)


@kernel
def _wave_slope(pose, side, P, n, theta):
    """Slope of the penetration along the race, dd/(d dtheta), on a wavy race."""
    phase = side.wave[1] * (theta_at(pose, side.sign * n[1], side.sign * n[2]) - theta)
    distance = sqrt(P[1] * P[1] + P[2] * P[2])
    return -side.sign * side.wave[0] * side.wave[1] * sin(phase) / distance


@kernel
def _directions(pose, side, P, b, s, n, t):
    """Normal on the roller and tangent b x e_d at slice position s."""
    a = pose.axis[0]
    x, y, z = P[0] + s * a[0], P[1] + s * a[1], P[2] + s * a[2]
    q = x * b[0] + y * b[1] + z * b[2]
    x, y, z = x - q * b[0], y - q * b[1], z - q * b[2]
    d = 1.0 / sqrt(x * x + y * y + z * z)
    x, y, z = x * d, y * d, z * d
    n[0], n[1], n[2] = side.sign * x, side.sign * y, side.sign * z
    t[0], t[1], t[2] = b[1] * z - b[2] * y, b[2] * x - b[0] * z, b[0] * y - b[1] * x


@kernel
def _slide(pose, side, Rw, P, b, Vr, wr, sl):
    """Sliding velocity (axial, tangential) of the roller's surface on the race, loaded slices."""
    n, t, r, c, v = np.empty(3), np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    a = pose.axis[0]
    for k in range(side.s.shape[0]):
        sl.u[k] = 0.0
        if sl.N[k] > 0.0:
            s = side.s[k]
            _directions(pose, side, P, b, s, n, t)
            for j in range(3):
                r[j] = s * a[j] - (Rw - side.drop[k]) * n[j]
                c[j] = P[j] + r[j]
                v[j] = pose.V[j] - Vr[j]
            w = pose.w
            v[0] += w[1] * r[2] - w[2] * r[1] - wr[1] * c[2] + wr[2] * c[1]
            v[1] += w[2] * r[0] - w[0] * r[2] - wr[2] * c[0] + wr[0] * c[2]
            v[2] += w[0] * r[1] - w[1] * r[0] - wr[0] * c[1] + wr[1] * c[0]
            sl.t[k, 0] = v[0] * b[0] + v[1] * b[1] + v[2] * b[2]
            sl.t[k, 1] = v[0] * t[0] + v[1] * t[1] + v[2] * t[2]
            sl.u[k] = sqrt(sl.t[k, 0] ** 2 + sl.t[k, 1] ** 2)


@kernel
def _collect(pose, side, Rw, P, b, theta, sl, pair, mode, sums):
    """Sum the slices' forces into the pair, with its tangent or its report.

    On a wavy race the normal leans by the wave's slope: the energy depends on the azimuth of the
    roller's axis, so that share of the force acts there.
    """
    n, t, r = np.empty(3), np.empty(3), np.empty(3)
    Wn, Wt, Wx, Wf = np.empty(6), np.empty(6), np.empty(6), np.empty(6)
    a = pose.axis[0]
    middle = side.s.shape[0] // 2
    for k in range(side.s.shape[0]):
        N = sl.N[k]
        if N <= 0.0:
            continue
        _directions(pose, side, P, b, side.s[k], n, t)
        for j in range(3):
            r[j] = side.s[k] * a[j] - (Rw - side.drop[k]) * n[j]
        add_generator(n, r, Wn)
        if side.wave[0] > 0.0:
            for j in range(3):
                r[j] = side.s[k] * a[j]
            add_generator(t, r, Wt)
            slope = _wave_slope(pose, side, P, n, theta)
            for j in range(6):
                Wn[j] -= slope * Wt[j]
            for j in range(3):
                r[j] -= (Rw - side.drop[k]) * n[j]
        add_generator(t, r, Wt)
        add_generator(b, r, Wx)
        gx, gt = sl.g[k] * sl.t[k, 0], sl.g[k] * sl.t[k, 1]
        for j in range(6):
            Wf[j] = Wn[j] - gx * Wx[j] - gt * Wt[j]
            pair.wrench[j] += N * Wf[j]
        if mode == 1:
            add_outer(pair.K, sl.Nd[k], Wf, Wn)
            add_outer(pair.C, sl.Nv[k], Wf, Wn)
            friction_tangent(pair.C, N, sl.g[k], sl.dg[k], sl.u[k], sl.t[k, 0], sl.t[k, 1], Wx, Wt)
        elif mode == 2:
            sums[0] += N
            sums[1] -= N * gt
            sums[2] += N * Wn[4]
            sums[3] += N * Wn[5]
            sums[7] -= N * sl.g[k] * sl.u[k] ** 2
            if k == middle:
                sums[4] = sl.t[k, 1]


@kernel
def _roll(pose, side, Rw, P, wr, sl, pair, mode, sums):
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
    ring_speed = (wr[0] - orbit) * side.radius
    u = 0.5 * (roller_speed + ring_speed)
    F = rolling_force(side.rolling, abs(u), load)
    if u < 0.0:
        F = -F
    pair.wrench[2] += (side.hydro - 1.0) * F
    pair.wrench[3] -= lever * F
    if mode == 2:
        sums[8] -= F * (roller_speed + ring_speed) * 1.0
