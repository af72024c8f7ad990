"""A flexible body in a floating frame: r = R + A (s + Phi q), every inertia term, any basis.

The consistent mass matrix enters through invariants computed once. Notation, body frame:
p = s + Phi q; c(q) first moment of mass, J(q) inertia, H(q) rotation-modal and C
translation-modal coupling, E_k(q) = int phi_k p^T dm. Equations of motion (Shabana, Dynamics of
Multibody Systems, ch. 5), v in space, w in the body frame:

    m v' + A (w' x c + C q'' + w x (w x c) + 2 w x C q')                       = F
    c x A^T v' + J w' + H q'' + w x J w + 2 (tr(D) 1 - D^T) w                  = M
    C^T A^T v' + H^T w' + m_ff q'' + [w^T E_k w - w^2 tr E_k] + 2 w.(P_k q')   = Q - K q - d q'

with D = int p u^T dm, u = Phi q', and (P_k)_l = int phi_l x phi_k dm. Of E_k only the symmetric
part enters, H_k = int p x phi_k dm has the other; and 2 D^T w = 2 sym(D) w + (int p x u dm) x w.

Geometric stiffening, if asked for, adds w_x^2 G q to the last row: G is the geometric stiffness of
the centrifugal stress at unit spin about x (Wallrapp and Schwertassek, Int. J. Numer. Methods Eng.
32 (1991) 1833: the term of a squared angular velocity). A field that stretches nothing draws the
body inwards to second order and takes q^T G q from its inertia about x (Kane, Ryan and Banerjee,
J. Guidance 10 (1987) 139). With that term in J as well, and so in the torque about x, the equations
keep energy and angular momentum. Left out, of the same order as G: stress from w_y and w_z, from
angular acceleration and from contact forces; the second-order motion's share of the mass centre
and of the other inertias; the stiffening of quasi-static residual vectors.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from scipy import sparse

from flexcage.core.jit import VECTORISED, copy_into, kernel, part, zero
from flexcage.core.vectors import RIGID, TURN, combine, cross, minus, plus, times, xyz
from flexcage.fem.mass import scalar_mass

XX, YY, ZZ, YZ, ZX, XY = range(6)  # rows of a symmetric part


class BodyData(NamedTuple):
    """Invariants of one body for the kernels; n may be zero (a rigid body).

    Symmetric parts of second moments are six rows: xx, yy, zz, yz, zx, xy.
    """

    mass: float
    c0: np.ndarray  # (3,) first moment
    C: np.ndarray  # (3, n) translation-modal coupling
    G0: np.ndarray  # (3, 3) second moment int s s^T
    S: np.ndarray  # (6, n) int phi_k s^T, symmetric part
    X: np.ndarray  # (3, n) int s x phi_k
    SS: np.ndarray  # (n, 6, n) int phi_l phi_k^T, symmetric part
    XX: np.ndarray  # (n, 3, n) int phi_l x phi_k
    mff: np.ndarray  # (n, n)
    kff: np.ndarray  # (n, n)
    dff: np.ndarray  # (n, n) modal damping
    gff: np.ndarray  # (n, n) geometric stiffness per squared spin about x; (0, 0) for none
    plain: int  # 1 if mff, kff and dff are diagonal, as eigenmodes make them


@dataclass(frozen=True)
class FlexibleBody:
    """A body reduced to modes, here or elsewhere: nodes, mass, stiffness and shapes."""

    data: BodyData

    def __repr__(self) -> str:
        kind = "rigid" if self.modes == 0 else f"{self.modes} modes"
        return f"FlexibleBody({self.data.mass * 1e3:.2f} g, {kind})"

    @property
    def modes(self) -> int:
        return self.data.mff.shape[0]

    @property
    def centre_of_mass(self) -> np.ndarray:
        """Centre of mass of the undeformed body [m], body frame (3,)."""
        return self.data.c0 / self.data.mass

    @property
    def inertia(self) -> np.ndarray:
        """Inertia tensor of the undeformed body about the frame's origin [kg m^2] (3, 3)."""
        return np.trace(self.data.G0) * np.eye(3) - self.data.G0


def flexible_body(
    nodes: np.ndarray,
    mass: sparse.spmatrix,
    shapes: np.ndarray,
    stiffness: np.ndarray,
    damping: np.ndarray | None = None,
    *,
    geometric: np.ndarray | None = None,
) -> FlexibleBody:
    """Reduce a body: nodes (N, 3) [m], consistent mass (N, N) or (3N, 3N) [kg], shapes (N, 3, n).

    ``stiffness``, ``damping`` and ``geometric``, the stiffness per squared spin about x, are
    reduced, (n, n). The frame's origin is where nodes are zero.
    """
    n = shapes.shape[2]
    m = scalar_mass(mass, len(nodes))
    ones = np.ones(len(nodes))
    ms, m1 = m @ nodes, m @ ones
    mphi = (m @ shapes.reshape(len(nodes), 3 * n)).reshape(shapes.shape)
    S = np.einsum("aik,aj->ijk", shapes, ms)
    SS = np.einsum("aik,ajl->kijl", shapes, mphi, optimize=True)
    data = BodyData(
        mass=float(ones @ m1),
        c0=nodes.T @ m1,
        C=np.ascontiguousarray(np.einsum("a,aik->ik", m1, shapes)),
        G0=np.ascontiguousarray(nodes.T @ ms),
        S=_symmetric_part(S),
        X=_cross(np.swapaxes(S, 0, 1)),
        SS=_symmetric_part(SS),
        XX=_cross(SS),
        mff=_without_rounding(np.einsum("kiil->kl", SS)),
        kff=_without_rounding(np.asarray(stiffness, float).reshape(n, n)),
        dff=np.zeros((n, n)) if damping is None else _without_rounding(damping),
        gff=np.zeros((0, 0)) if geometric is None else np.ascontiguousarray(geometric, float),
        plain=0,
    )
    return FlexibleBody(marked(data))


def _symmetric_part(moments: np.ndarray) -> np.ndarray:
    """Six rows of the symmetric part of second moments (..., 3, 3, n)."""
    pairs = ((0, 0), (1, 1), (2, 2), (1, 2), (2, 0), (0, 1))
    rows = [0.5 * (moments[..., i, j, :] + moments[..., j, i, :]) for i, j in pairs]
    return np.ascontiguousarray(np.stack(rows, axis=-2))


def _cross(moments: np.ndarray) -> np.ndarray:
    """int a x b (..., 3, n) from int a b^T (..., 3, 3, n)."""
    pairs = ((1, 2), (2, 0), (0, 1))
    rows = [moments[..., i, j, :] - moments[..., j, i, :] for i, j in pairs]
    return np.ascontiguousarray(np.stack(rows, axis=-2))


def marked(data: BodyData) -> BodyData:
    """The invariants with ``plain`` as their matrices are, whoever changed those."""
    matrices = (data.mff, data.kff, data.dff)
    plain = all(np.array_equal(m, np.diag(np.diag(m))) for m in matrices)
    return data._replace(plain=int(plain))


def _without_rounding(matrix: np.ndarray) -> np.ndarray:
    """The symmetric matrix without entries that are rounding beside their diagonal."""
    size = np.sqrt(np.abs(np.diag(matrix)))
    kept = np.abs(matrix) > 1e-12 * np.outer(size, size)
    return np.ascontiguousarray(np.where(kept, matrix, 0.0))


def rigid_body(mass: float, centre: np.ndarray, second_moment: np.ndarray) -> FlexibleBody:
    """A rigid body from its mass, centre of mass (3,) and second moment int s s^T dm (3, 3)."""
    z = np.zeros
    data = BodyData(
        float(mass), mass * np.asarray(centre, float), z((3, 0)),
        np.ascontiguousarray(second_moment, dtype=float),
        z((6, 0)), z((3, 0)), z((0, 6, 0)), z((0, 3, 0)), z((0, 0)), z((0, 0)), z((0, 0)),
        z((0, 0)), 1,
    )  # fmt: skip
    return FlexibleBody(data)


def no_body() -> FlexibleBody:
    """What stands for a body that is not there: nothing may read its numbers, which are none."""
    return rigid_body(np.nan, np.full(3, np.nan), np.full((3, 3), np.nan))


def mirrored(data: BodyData) -> BodyData:
    """The body's mirror image in the plane x = 0, with mirror images of its modes."""
    polar, axial = np.array([-1.0, 1.0, 1.0]), np.array([1.0, -1.0, -1.0])
    second = np.array([1.0, 1.0, 1.0, 1.0, -1.0, -1.0])  # of xx, yy, zz, yz, zx, xy
    return data._replace(
        c0=data.c0 * polar, C=data.C * polar[:, None], G0=data.G0 * np.outer(polar, polar),
        S=data.S * second[:, None], X=data.X * axial[:, None],
        SS=data.SS * second[:, None], XX=data.XX * axial[:, None],
    )  # fmt: skip


def with_point_mass(body: FlexibleBody, mass: float, position: np.ndarray) -> FlexibleBody:
    """The body with a point mass that rides on the undeformed frame (an unbalance).

    Its centrifugal force adds nothing to the geometric stiffness.
    """
    d = body.data
    s = np.asarray(position, float)
    data = d._replace(mass=d.mass + mass, c0=d.c0 + mass * s, G0=d.G0 + mass * np.outer(s, s))
    return FlexibleBody(data)


class FrameWork(NamedTuple):
    """Workspace of the inertia kernel: the mass matrix, whose modal block is constant, and the
    velocity terms; translations in body axes."""

    rigid: np.ndarray  # (6, 6) mass of the rigid motion
    coupled: np.ndarray  # (6, n) coupling of the rigid motion and the modes
    h: np.ndarray  # (6+n,) gyroscopic and centrifugal terms
    E: np.ndarray  # (6, n) int phi_k p^T dm, symmetric part
    P: np.ndarray  # (2, 3, n) int p x phi_k dm, and int u x phi_k dm
    c: np.ndarray  # (2, 3) first moment of mass and its rate
    G: np.ndarray  # (2, 6) second moment of mass, and the symmetric part of int p u^T dm
    w: np.ndarray  # (3, 6+n) vectors of the cage's rows
    # (cages, 6, 6) and (cages, 6, n): ``rigid`` and ``coupled`` of each of several cages
    each_rigid: np.ndarray
    each_coupled: np.ndarray


def frame_work(n: int, bodies: int = 1) -> FrameWork:
    """That of one body after the other, all with n modes."""
    z, several = np.zeros, bodies if bodies > 1 else 0
    return FrameWork(
        z((6, 6)), z((6, n)), z(6 + n), z((6, n)), z((2, 3, n)), z((2, 3)), z((2, 6)),
        z((3, 6 + n)), z((several, 6, 6)), z((several, 6, n)),
    )  # fmt: skip


def mass_matrix(data: BodyData, work: FrameWork) -> np.ndarray:
    """Mass matrix (6+n, 6+n) of what ``inertia_terms`` left, translations in body axes."""
    return np.block([[work.rigid, work.coupled], [work.coupled.T, data.mff]])


@part(fastmath=VECTORISED)
def _superpose(parts, q, out):
    """out += sum_l q_l parts[l], entry by entry.

    Four parts at a time: all of them are more than the nearest cache holds.
    """
    n, total = q.shape[0], out.reshape(out.size)
    rows = parts.reshape(n, total.size)
    first = n % 4
    for l in range(first):
        for k in range(total.size):
            total[k] += q[l] * rows[l, k]
    for l in range(first, n, 4):
        a, b, c, d = q[l], q[l + 1], q[l + 2], q[l + 3]
        for k in range(total.size):
            x, y, z, w = rows[l, k], rows[l + 1, k], rows[l + 2, k], rows[l + 3, k]
            total[k] += a * x + b * y + c * z + d * w


@part(fastmath=VECTORISED)
def _superpose_both(parts, q, qd, out, outd):
    """The same for two sets of factors in one pass."""
    n, total, rate = q.shape[0], out.reshape(out.size), outd.reshape(out.size)
    rows = parts.reshape(n, total.size)
    first = n % 4
    for l in range(first):
        for k in range(total.size):
            total[k] += q[l] * rows[l, k]
            rate[k] += qd[l] * rows[l, k]
    for l in range(first, n, 4):
        a, b, c, d = q[l], q[l + 1], q[l + 2], q[l + 3]
        ad, bd, cd, dd = qd[l], qd[l + 1], qd[l + 2], qd[l + 3]
        for k in range(total.size):
            x, y, z, w = rows[l, k], rows[l + 1, k], rows[l + 2, k], rows[l + 3, k]
            total[k] += a * x + b * y + c * z + d * w
            rate[k] += ad * x + bd * y + cd * z + dd * w


@part
def _times_symmetric(G, w):
    """Product of a symmetric matrix, given as six numbers, with a vector."""
    return (
        G[XX] * w[0] + G[XY] * w[1] + G[ZX] * w[2],
        G[XY] * w[0] + G[YY] * w[1] + G[YZ] * w[2],
        G[ZX] * w[0] + G[YZ] * w[1] + G[ZZ] * w[2],
    )


@part(fastmath=VECTORISED)
def _moments(d, q, qd, work):
    """First and second moments of mass, their rates, and the coupling with the modes."""
    c, cd, G, D = work.c[0], work.c[1], work.G[0], work.G[1]
    H, E, P, Pd = work.coupled, work.E, work.P[0], work.P[1]
    n = q.shape[0]
    copy_into(E, d.S)
    copy_into(P, d.X)
    zero(Pd)
    _superpose(d.SS, q, E)
    _superpose_both(d.XX, q, qd, P, Pd)
    for i in range(3):
        moved = rate = 0.0
        for k in range(n):
            H[i, k], H[TURN + i, k] = d.C[i, k], P[i, k]
            moved += d.C[i, k] * q[k]
            rate += d.C[i, k] * qd[k]
        c[i], cd[i] = d.c0[i] + moved, rate
    for r in range(6):
        moved = rate = 0.0
        for k in range(n):  # int p p^T = G0 + sum q_k (S_k + S_k^T) + q q SS
            moved += q[k] * (E[r, k] + d.S[r, k])
            rate += qd[k] * E[r, k]
        i, j = (r, r) if r < 3 else ((r + 1) % 3, (r + 2) % 3)
        G[r], D[r] = d.G0[i, j] + moved, rate


@part
def _rigid_mass(mass, c, G, M):
    """Mass matrix (6, 6) of the rigid motion."""
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        for l in range(3):
            M[i, l] = M[i, TURN + l] = M[TURN + l, i] = 0.0
        M[i, i] = mass
        M[TURN + i, TURN + i] = G[j] + G[k]
        M[TURN + j, TURN + k] = M[TURN + k, TURN + j] = -G[YZ + i]
    # rows of translation: w' x c = -c~ w'
    M[0, TURN + 1], M[0, TURN + 2] = c[2], -c[1]
    M[1, TURN], M[1, TURN + 2] = -c[2], c[0]
    M[2, TURN], M[2, TURN + 1] = c[1], -c[0]
    for i in range(3):
        for j in range(3):
            M[TURN + j, i] = M[i, TURN + j]


@kernel(fastmath=VECTORISED)
def inertia_terms(d, w, q, qd, work):
    """Mass matrix and velocity terms at modal state (q, qd) and body angular velocity w.

    Fills ``work.rigid``, ``work.coupled`` and ``work.h`` so that M [A^T v', w', q''] + h =
    generalised forces, all three groups in body axes, with ``mass_matrix`` M; elastic and damping
    forces are not included.
    """
    _moments(d, q, qd, work)
    M, H, h, E, Pd, D = work.rigid, work.coupled, work.h, work.E, work.P[1], work.G[1]
    _rigid_mass(d.mass, work.c[0], work.G[0], M)
    n, spin = q.shape[0], xyz(w)
    wx, wy, wz = spin
    shortening = 0.0  # half the rate of the inertia that geometric stiffening takes
    zero(h)
    for k in range(d.gff.shape[0]):
        for l in range(n):
            h[RIGID + k] += d.gff[k, l] * q[l]
        M[TURN, TURN] -= q[k] * h[RIGID + k]
        shortening += qd[k] * h[RIGID + k]
    w2 = wx * wx + wy * wy + wz * wz
    for k in range(n):
        # w^T E_k w - w^2 tr E_k + 2 w . int u x phi_k
        s = (wx * wx - w2) * E[XX, k] + (wy * wy - w2) * E[YY, k] + (wz * wz - w2) * E[ZZ, k]
        s += 2.0 * (wy * wz * E[YZ, k] + wz * wx * E[ZX, k] + wx * wy * E[XY, k])
        s += 2.0 * (wx * Pd[0, k] + wy * Pd[1, k] + wz * Pd[2, k])
        h[RIGID + k] = wx * wx * h[RIGID + k] + s
    flow = (0.0, 0.0, 0.0)  # int p x u
    for k in range(n):
        flow = combine(flow, qd[k], (H[TURN, k], H[TURN + 1, k], H[TURN + 2, k]))
    first, rate = xyz(work.c[0]), xyz(work.c[1])
    force = plus(cross(spin, cross(spin, first)), times(2.0, cross(spin, rate)))
    Jw = (
        M[TURN, TURN] * wx + M[TURN, TURN + 1] * wy + M[TURN, TURN + 2] * wz,
        M[TURN + 1, TURN] * wx + M[TURN + 1, TURN + 1] * wy + M[TURN + 1, TURN + 2] * wz,
        M[TURN + 2, TURN] * wx + M[TURN + 2, TURN + 1] * wy + M[TURN + 2, TURN + 2] * wz,
    )
    moment = minus(cross(spin, Jw), cross(flow, spin))
    moment = combine(moment, 2.0 * (D[XX] + D[YY] + D[ZZ]), spin)
    moment = combine(moment, -2.0, _times_symmetric(D, spin))
    for i in range(3):
        h[i], h[TURN + i] = force[i], moment[i]
    h[TURN] -= 2.0 * shortening * wx


@part(fastmath=VECTORISED)
def modal_product(matrix, plain, x, out):
    """out = matrix . x for a matrix (n, n) over the modes; ``plain``: it is diagonal."""
    n = x.shape[0]
    for k in range(n):
        total = 0.0
        if plain != 0:
            total = matrix[k, k] * x[k]
        else:
            for l in range(n):
                total += matrix[k, l] * x[l]
        out[k] = total
