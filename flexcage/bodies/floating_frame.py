"""A flexible body in a floating frame: r = R + A (s + Phi q), every inertia term, any basis.

The consistent mass matrix enters through invariants computed once. Notation, body frame:
p = s + Phi q; c(q) first moment of mass, J(q) inertia, H(q) rotation-modal and C
translation-modal coupling, E_k(q) = int phi_k p^T dm. Equations of motion (Shabana, Dynamics of
Multibody Systems, ch. 5), v in space, w in the body frame:

    m v' + A (w' x c + C q'' + w x (w x c) + 2 w x C q')                       = F
    c x A^T v' + J w' + H q'' + w x J w + 2 (tr(D) 1 - D^T) w                  = M
    C^T A^T v' + H^T w' + m_ff q'' + [w^T E_k w - w^2 tr E_k] + 2 w.(P_k q')   = Q - K q - d q'

with D = int p u^T dm, u = Phi q', and (P_k)_l = int phi_l x phi_k dm.

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

from flexcage.core.errors import InputError
from flexcage.core.jit import VECTORISED, kernel, part, zero


class BodyData(NamedTuple):
    """Invariants of one body for the kernels; n may be zero (a rigid body)."""

    mass: float
    c0: np.ndarray  # (3,) first moment
    C: np.ndarray  # (3, n) translation-modal coupling
    G0: np.ndarray  # (3, 3) second moment int s s^T
    S: np.ndarray  # (n, 3, 3) int phi_k s^T
    SS: np.ndarray  # (n, n, 3, 3) int phi_k phi_l^T
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


def scalar_mass(mass: sparse.spmatrix, n_nodes: int) -> sparse.csr_matrix:
    """The (N, N) matrix m of a consistent mass M = m (x) 1_3 given as (N, N) or (3N, 3N)."""
    mass = sparse.csr_matrix(mass)
    if mass.shape[0] == n_nodes:
        return mass
    blocks = [[mass[i::3, j::3] for j in range(3)] for i in range(3)]
    scale = abs(mass).max()
    for i in range(3):
        for j in range(3):
            rest = blocks[i][j] if i != j else blocks[i][i] - blocks[0][0]
            if abs(rest).max() > 1e-9 * scale:
                raise InputError(
                    "the mass matrix is not a consistent mass of the same value in x, y and z, "
                    "so its invariants cannot be formed; give the (N, N) scalar mass matrix",
                    where="mass",
                    value=mass.shape,
                )
    return blocks[0][0]


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
    SS = np.einsum("aik,ajl->klij", shapes, mphi, optimize=True)
    data = BodyData(
        mass=float(ones @ m1),
        c0=nodes.T @ m1,
        C=np.ascontiguousarray(np.einsum("a,aik->ik", m1, shapes)),
        G0=np.ascontiguousarray(nodes.T @ ms),
        S=np.ascontiguousarray(np.einsum("aik,aj->kij", shapes, ms)),
        SS=np.ascontiguousarray(SS),
        mff=_without_rounding(np.einsum("klii->kl", SS)),
        kff=_without_rounding(np.asarray(stiffness, float).reshape(n, n)),
        dff=np.zeros((n, n)) if damping is None else _without_rounding(damping),
        gff=np.zeros((0, 0)) if geometric is None else np.ascontiguousarray(geometric, float),
        plain=0,
    )
    return FlexibleBody(marked(data))


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
        z((0, 3, 3)), z((0, 0, 3, 3)), z((0, 0)), z((0, 0)), z((0, 0)), z((0, 0)), 1,
    )  # fmt: skip
    return FlexibleBody(data)


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
    E: np.ndarray  # (n, 3, 3) int phi_k (s + u)^T dm
    Ed: np.ndarray  # (n, 3, 3) int u' phi_k^T dm
    c: np.ndarray  # (2, 3) first moment of mass and its rate
    G: np.ndarray  # (2, 3, 3) second moment of mass, and int p u'^T dm
    w: np.ndarray  # (3, 6+n) vectors of the cage's rows


def frame_work(n: int) -> FrameWork:
    z = np.zeros
    return FrameWork(
        z((6, 6)), z((6, n)), z(6 + n), z((n, 3, 3)), z((n, 3, 3)), z((2, 3)), z((2, 3, 3)),
        z((3, 6 + n)),
    )  # fmt: skip


def mass_matrix(data: BodyData, work: FrameWork) -> np.ndarray:
    """Mass matrix (6+n, 6+n) of what ``inertia_terms`` left, translations in body axes."""
    return np.block([[work.rigid, work.coupled], [work.coupled.T, data.mff]])


@part(fastmath=VECTORISED)
def _superpose(parts, q, qd, out, outd):
    """out = sum_l q_l parts[l] and outd = sum_l qd_l parts[l], entry by entry.

    Both in one pass, and four parts at a time: ``parts`` are more than the nearest cache holds.
    """
    n = q.shape[0]
    total, rate = out.reshape(out.size), outd.reshape(out.size)
    rows = parts.reshape(n, total.size)
    first = n % 4
    zero(total)
    zero(rate)
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


@kernel
def inertia_terms(d, w, q, qd, work):
    """Mass matrix and velocity terms at modal state (q, qd) and body angular velocity w.

    Fills ``work.rigid``, ``work.coupled`` and ``work.h`` so that M [A^T v', w', q''] + h =
    generalised forces, all three groups in body axes, with ``mass_matrix`` M; elastic and damping
    forces are not included. SS_lk = int phi_l phi_k^T dm is the transpose of SS_kl, so that sums
    over modes run along memory.
    """
    M, H, h, E, Ed = work.rigid, work.coupled, work.h, work.E, work.Ed
    c, cd, G, D = work.c[0], work.c[1], work.G[0], work.G[1]
    n = q.shape[0]
    zero(h)
    zero(D)
    _superpose(d.SS, q, qd, E, Ed)
    for i in range(3):
        c[i], cd[i] = d.c0[i], 0.0
        for k in range(n):
            c[i] += d.C[i, k] * q[k]
            cd[i] += d.C[i, k] * qd[k]
        for j in range(3):
            G[i, j] = d.G0[i, j]
    for k in range(n):
        for i in range(3):  # E_k = S_k + the transpose of what was superposed
            for j in range(i):
                x = E[k, i, j]
                E[k, i, j] = d.S[k, i, j] + E[k, j, i]
                E[k, j, i] = d.S[k, j, i] + x
            E[k, i, i] += d.S[k, i, i]
        for i in range(3):
            for j in range(3):
                # int p p^T = G0 + sum q_k (S_k + S_k^T) + q q SS; E_k already holds S_k + SS q
                G[i, j] += q[k] * (E[k, i, j] + d.S[k, j, i])
                D[j, i] += E[k, i, j] * qd[k]
    trace = G[0, 0] + G[1, 1] + G[2, 2]
    w2 = w[0] * w[0] + w[1] * w[1] + w[2] * w[2]
    for i in range(3):
        for j in range(3):
            M[i, j] = M[i, 3 + j] = 0.0
            M[3 + i, 3 + j] = -0.5 * (G[i, j] + G[j, i])
        M[i, i] = d.mass
        M[3 + i, 3 + i] += trace
    shortening = 0.0  # half the rate of the inertia that geometric stiffening takes
    for k in range(d.gff.shape[0]):
        for l in range(n):
            h[6 + k] += d.gff[k, l] * q[l]
        M[3, 3] -= q[k] * h[6 + k]
        shortening += qd[k] * h[6 + k]
    # rows of translation: w' x c = -c~ w'
    M[0, 4], M[0, 5] = c[2], -c[1]
    M[1, 3], M[1, 5] = -c[2], c[0]
    M[2, 3], M[2, 4] = c[1], -c[0]
    for i in range(3):
        for j in range(3):
            M[3 + j, i] = M[i, 3 + j]
    wc = w[0] * c[0] + w[1] * c[1] + w[2] * c[2]
    h[0] = w[0] * wc - c[0] * w2 + 2.0 * (w[1] * cd[2] - w[2] * cd[1])
    h[1] = w[1] * wc - c[1] * w2 + 2.0 * (w[2] * cd[0] - w[0] * cd[2])
    h[2] = w[2] * wc - c[2] * w2 + 2.0 * (w[0] * cd[1] - w[1] * cd[0])
    Jw0 = M[3, 3] * w[0] + M[3, 4] * w[1] + M[3, 5] * w[2]
    Jw1 = M[4, 3] * w[0] + M[4, 4] * w[1] + M[4, 5] * w[2]
    Jw2 = M[5, 3] * w[0] + M[5, 4] * w[1] + M[5, 5] * w[2]
    trD = D[0, 0] + D[1, 1] + D[2, 2]
    h[3] = w[1] * Jw2 - w[2] * Jw1 + 2.0 * trD * w[0]
    h[4] = w[2] * Jw0 - w[0] * Jw2 + 2.0 * trD * w[1]
    h[5] = w[0] * Jw1 - w[1] * Jw0 + 2.0 * trD * w[2]
    h[3] -= 2.0 * shortening * w[0]
    for j in range(3):
        for i in range(3):
            h[3 + j] -= 2.0 * D[i, j] * w[i]
    for k in range(n):
        for i in range(3):
            H[i, k] = d.C[i, k]
        # int p x phi_k from E_k,ij = int phi_i p_j
        H[3, k] = E[k, 2, 1] - E[k, 1, 2]
        H[4, k] = E[k, 0, 2] - E[k, 2, 0]
        H[5, k] = E[k, 1, 0] - E[k, 0, 1]
        s = w[0] * w[0] * h[6 + k] - w2 * (E[k, 0, 0] + E[k, 1, 1] + E[k, 2, 2])
        for i in range(3):
            for j in range(3):
                s += w[i] * w[j] * E[k, i, j]
        # 2 w . int u' x phi_k
        s += 2.0 * w[0] * (Ed[k, 1, 2] - Ed[k, 2, 1])
        s += 2.0 * w[1] * (Ed[k, 2, 0] - Ed[k, 0, 2])
        s += 2.0 * w[2] * (Ed[k, 0, 1] - Ed[k, 1, 0])
        h[6 + k] = s


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
