"""Cage land against a ring land: dry contact where it is nearest, or a film."""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.laws import short_bearing
from flexcage.core.jit import kernel, zero


class LandData(NamedTuple):
    """Land of the cage; kind 0 none, 1 dry, 2 film (with dry contact beneath it)."""

    kind: int
    inner: float  # +1: the cage rides on the inner ring, -1: inside the outer ring
    clearance: float
    radius: float
    x: np.ndarray  # (2,) axial positions of the two lands
    angle: np.ndarray  # (nl, 2) cos, sin of the stations in the cage frame
    phi: np.ndarray  # (nl, 3, nm) modes at the stations: (x, r, psi)
    phi_max: np.ndarray  # (nm,)
    friction: np.ndarray  # (5,)
    film: np.ndarray  # (4,) eta, L, R, C


class LandWork(NamedTuple):
    """Buffers of the land's contact."""

    u: np.ndarray  # (nl,) radial displacement of the stations by the modes
    d: np.ndarray  # (nl,) penetration of one land's stations
    weight: np.ndarray  # (3,) of the stations that share a touch


def land_work(n_stations: int) -> LandWork:
    return LandWork(np.zeros(n_stations), np.zeros(n_stations), np.zeros(3))


@kernel
def land_contact(A, Rc, Vc, w, q, qd, Rr, Vr, spin, data, p, laws, sl, lw, Fc, Mc, Qm, Fr, Mr, sums):
    """Land forces: Fc, Qm on the cage (space, modal), Mc about its origin; Fr, Mr on the ring.

    Rc, Vc, w: cage origin, velocity, angular velocity in space; Rr, Vr, spin: ring centre,
    velocity, spin about x; p (2, N_NORMAL) for the lands at -x and +x. Dry contact acts where the
    penetration round the land has a maximum: the vertex of the parabola through three stations,
    which share its force by the same weights, so that a cage that rolls on its land does not feel
    the stations pass. ``sums``: elastic energy, damping power, friction power, film power; then
    of each land its normal force and the approach speed where it is nearest to the ring.
    """
    zero(sums)
    if data.kind == 0:
        return False
    ey, ez = Rc[1] - Rr[1], Rc[2] - Rr[2]
    reach = sqrt(ey * ey + ez * ez) + (abs(A[1, 0]) + abs(A[2, 0])) * abs(data.x[1])
    for m in range(q.shape[0]):
        reach += data.phi_max[m] * abs(q[m])
    active = False
    if data.kind == 2:
        _film(A, Rc, Vc, w, Rr, Vr, spin, data, Fc, Mc, Fr, Mr, sums)
        active = True
    if reach < data.clearance:
        return active
    n_l = data.angle.shape[0]
    e, c = np.empty(3), np.empty(3)
    for s in range(n_l):
        lw.u[s] = 0.0
        for m in range(q.shape[0]):
            lw.u[s] += data.phi[s, 1, m] * q[m]
    ring = data.radius - data.inner * data.clearance
    for side in range(2):
        deepest = 0
        for s in range(n_l):
            _station(A, data, side, s, lw.u[s], e, c)
            y, z = Rc[1] + c[1] - Rr[1], Rc[2] + c[2] - Rr[2]
            lw.d[s] = data.inner * (ring - sqrt(y * y + z * z))
            if lw.d[s] > lw.d[deepest]:
                deepest = s
        for s in range(n_l):
            before, here, after = lw.d[s - 1], lw.d[s], lw.d[(s + 1) % n_l]
            if here < before or here < after or (here == after and here > before):
                continue
            bend = before - 2.0 * here + after
            x = 0.5 * (before - after) / bend if bend < 0.0 else 0.0
            sl.d[0] = here - 0.25 * (before - after) * x
            if sl.d[0] > 0.0 or s == deepest:
                lw.weight[0], lw.weight[1] = 0.5 * x * (x - 1.0), 1.0 - x * x
                lw.weight[2] = 0.5 * x * (x + 1.0)
                active = True
                _touch(
                    A, Rc, Vc, w, qd, Rr, Vr, spin, data, side, s, p[side], laws, sl, lw,
                    Fc, Mc, Qm, Fr, Mr, sums,
                )  # fmt: skip
    return active


@kernel
def _station(A, data, side, s, u, e, c):
    """Outward direction ``e`` of a station and its place ``c`` from the cage's origin, in space."""
    ca, sa = data.angle[s, 0], data.angle[s, 1]
    for j in range(3):
        e[j] = A[j, 1] * ca + A[j, 2] * sa
        c[j] = data.x[side] * A[j, 0] + (data.radius + u) * e[j]


@kernel
def _touch(
    A, Rc, Vc, w, qd, Rr, Vr, spin, data, side, middle, p, laws, sl, lw, Fc, Mc, Qm, Fr, Mr, sums
):
    """One touch of a land, shared by three stations with ``lw.weight``; penetration in sl.d[0]."""
    law, friction = laws
    e, c, v, f = np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    n_l = data.angle.shape[0]
    approach = slide = 0.0
    N = g = 0.0
    for turn in range(2):  # first the rates, then the forces that follow from them
        if turn == 1:
            sl.v[0], sl.u[0] = approach, abs(slide)
            law(1, sl.d, sl.v, p, sl.N, sl.Nd, sl.Nv)
            N = sl.N[0]
            if N <= 0.0:
                return
            friction(1, sl.u, data.friction, sl.g, sl.dg)
            g = sl.g[0] * slide
        for k in range(3):
            s = (middle + k - 1 + n_l) % n_l
            _station(A, data, side, s, lw.u[s], e, c)
            y, z = Rc[1] + c[1] - Rr[1], Rc[2] + c[2] - Rr[2]
            d = sqrt(y * y + z * z)
            n1, n2 = data.inner * y / d, data.inner * z / d  # normal on the cage; tangent (-n2, n1)
            lift = n1 * e[1] + n2 * e[2]  # of the wall's radial displacement along the normal
            if turn == 0:
                ud = 0.0
                for m in range(qd.shape[0]):
                    ud += data.phi[s, 1, m] * qd[m]
                for j in range(3):
                    v[j] = Vc[j] - Vr[j]
                v[1] += w[2] * c[0] - w[0] * c[2] + spin * z
                v[2] += w[0] * c[1] - w[1] * c[0] - spin * y
                approach -= lw.weight[k] * (n1 * v[1] + n2 * v[2] + lift * ud)
                slide += lw.weight[k] * (n1 * v[2] - n2 * v[1])
                continue
            share = lw.weight[k] * N
            f[0], f[1], f[2] = 0.0, share * (n1 + g * n2), share * (n2 - g * n1)
            for j in range(3):
                Fc[j] += f[j]
                Fr[j] -= f[j]
            Mc[0] += c[1] * f[2] - c[2] * f[1]
            Mc[1] += c[2] * f[0] - c[0] * f[2]
            Mc[2] += c[0] * f[1] - c[1] * f[0]
            x = Rc[0] + c[0] - Rr[0]
            Mr[0] -= y * f[2] - z * f[1]
            Mr[1] += x * f[2]
            Mr[2] -= x * f[1]
            for m in range(qd.shape[0]):
                Qm[m] += (f[1] * e[1] + f[2] * e[2]) * data.phi[s, 1, m]
        if turn == 0:
            sums[6 + side] = approach
            if sl.d[0] <= 0.0:
                return
    law(1, sl.d, sl.zero, p, sl.dg, sl.Nd, sl.Nv)
    sums[4 + side] += N
    sums[0] += sl.dg[0] * sl.d[0] / (p[1] + 1.0)
    sums[1] -= (N - sl.dg[0]) * sl.v[0]
    sums[2] -= N * sl.g[0] * sl.u[0] ** 2


@kernel
def _film(A, Rc, Vc, w, Rr, Vr, spin, data, Fc, Mc, Fr, Mr, sums):
    """Short-bearing film on both lands: whirl and squeeze included."""
    out = np.empty(3)
    eta, L, R, C = data.film
    for side in range(2):
        x = data.x[side]
        cy, cz = x * A[1, 0], x * A[2, 0]
        ey, ez = Rc[1] + cy - Rr[1], Rc[2] + cz - Rr[2]
        vy = Vc[1] - Vr[1] + w[2] * x * A[0, 0] - w[0] * cz
        vz = Vc[2] - Vr[2] + w[0] * cy - w[1] * x * A[0, 0]
        short_bearing(eta, L, R, C, ey, ez, vy, vz, spin + w[0], abs(spin - w[0]), out)
        torque = out[2] if spin > w[0] else -out[2]
        Fc[1] += out[0]
        Fc[2] += out[1]
        Fr[1] -= out[0]
        Fr[2] -= out[1]
        Mc[0] += torque + cy * out[1] - cz * out[0]
        Mc[1] -= x * A[0, 0] * out[1]
        Mc[2] += x * A[0, 0] * out[0]
        lever = Rc[0] + x * A[0, 0] - Rr[0]
        Mr[0] -= torque + ey * out[1] - ez * out[0]
        Mr[1] += lever * out[1]
        Mr[2] -= lever * out[0]
        sums[3] += out[0] * vy + out[1] * vz + torque * (w[0] - spin)
        sums[3] -= spin * (ey * out[1] - ez * out[0])
