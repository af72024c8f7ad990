"""Cage land against a ring land: dry contact at stations round the cage, or a film."""

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


@kernel
def land_contact(A, Rc, Vc, w, q, qd, Rr, Vr, spin, data, p, laws, sl, Fc, Mc, Qm, Fr, Mr, sums):
    """Land forces: Fc, Qm on the cage (space, modal), Mc about its origin; Fr, Mr on the ring.

    Rc, Vc, w: cage origin, velocity, angular velocity in space; Rr, Vr, spin: ring centre,
    velocity, spin about x. ``sums``: elastic energy, damping power, friction power, film power.
    """
    zero(sums)
    if data.kind == 0:
        return False
    law, friction = laws
    ex, ez = Rc[1] - Rr[1], Rc[2] - Rr[2]
    reach = sqrt(ex * ex + ez * ez) + (abs(A[1, 0]) + abs(A[2, 0])) * abs(data.x[1])
    for m in range(q.shape[0]):
        reach += data.phi_max[m] * abs(q[m])
    active = False
    if data.kind == 2:
        _film(A, Rc, Vc, w, Rr, Vr, spin, data, Fc, Mc, Fr, Mr, sums)
        active = True
    if reach < data.clearance:
        return active
    n_l = data.angle.shape[0]
    e, t, c, f, v = np.empty(3), np.empty(3), np.empty(3), np.empty(3), np.empty(3)
    for side in range(2):
        for s in range(n_l):
            ur = ud = 0.0
            for m in range(q.shape[0]):
                ur += data.phi[s, 1, m] * q[m]
                ud += data.phi[s, 1, m] * qd[m]
            ca, sa = data.angle[s, 0], data.angle[s, 1]
            for j in range(3):
                e[j] = A[j, 1] * ca + A[j, 2] * sa
                c[j] = data.x[side] * A[j, 0] + (data.radius + ur) * e[j]
            y, z = Rc[1] + c[1] - Rr[1], Rc[2] + c[2] - Rr[2]
            d = sqrt(y * y + z * z)
            ring = data.radius - data.inner * data.clearance
            sl.d[0] = data.inner * (ring - d)
            if sl.d[0] <= 0.0:
                continue
            active = True
            n1, n2 = data.inner * y / d, data.inner * z / d  # normal on the cage
            for j in range(3):
                v[j] = Vc[j] - Vr[j]
            v[0] += w[1] * c[2] - w[2] * c[1]
            v[1] += w[2] * c[0] - w[0] * c[2] + spin * z
            v[2] += w[0] * c[1] - w[1] * c[0] - spin * y
            sl.v[0] = -(n1 * v[1] + n2 * v[2]) - (n1 * e[1] + n2 * e[2]) * ud
            law(1, sl.d, sl.v, p, sl.N, sl.Nd, sl.Nv)
            N = sl.N[0]
            if N <= 0.0:
                continue
            t[0], t[1], t[2] = 0.0, -n2, n1
            sl.u[0] = abs(t[1] * v[1] + t[2] * v[2])
            friction(1, sl.u, data.friction, sl.g, sl.dg)
            g = sl.g[0] * (t[1] * v[1] + t[2] * v[2])
            f[0], f[1], f[2] = 0.0, N * (n1 - g * t[1]), N * (n2 - g * t[2])
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
            for m in range(q.shape[0]):
                Qm[m] += (f[1] * e[1] + f[2] * e[2]) * data.phi[s, 1, m]
            law(1, sl.d, sl.zero, p, sl.dg, sl.Nd, sl.Nv)
            sums[0] += sl.dg[0] * sl.d[0] / (p[1] + 1.0)
            sums[1] -= (N - sl.dg[0]) * sl.v[0]
            sums[2] -= N * sl.g[0] * sl.u[0] ** 2
    return active


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
