"""What contact kernels share: a roller's pose, a pair's wrench and tangent.

Components of a roller's quantities are in its orbital frame F = (e_x, e_r, e_psi) at azimuth psi,
which turns with the roller's orbit; a 6-vector is (force or translation, moment or rotation)
about the roller's centre. Index letters: i roller, k slice, f face, s station, m mode.
"""

from __future__ import annotations

from math import cos, sin
from typing import NamedTuple

import numpy as np

from flexcage.core.jit import outlined, part, zero
from flexcage.core.vectors import MOMENT, TURN

# places behind the centre's, in coordinates and in velocities of a roller or the inner ring
Q_SKEW, Q_TILT, Q_SPIN = 3, 4, 5
U_SPIN, U_SKEW, U_TILT = 3, 4, 5
# rows (4, 3) of a ring as a roller's partner, in F: roller's centre from the ring's, ring's axis,
# velocity of its centre, angular velocity
CENTRE, AXIS, VELOCITY, SPIN = range(4)
WHOLE = 3  # row of a slice's generators: all of its force
# rows of a pose that is kept, behind those of F: axes, velocity, angular velocity, spot
KEPT_AXES, KEPT_V, KEPT_W, KEPT_SPOT, KEPT = 3, 6, 7, 8, 9


class RollerPose(NamedTuple):
    """One roller's kinematics, refilled for each roller."""

    F: np.ndarray  # (3, 3) rows e_x, e_r, e_psi in space
    axis: np.ndarray  # (3, 3) rows: roller axis, its two transverse axes (non-spinning), in F
    V: np.ndarray  # (3,) velocity in F
    w: np.ndarray  # (3,) angular velocity in F
    # (3,) 1 if it has a spot, its middle's angle [rad] from the first transverse axis to the
    # second, and the row of the roller
    spot: np.ndarray


class Pair(NamedTuple):
    """Result of one contact on a roller, about its centre, components in F."""

    wrench: np.ndarray  # (6,)
    K: np.ndarray  # (6, 6) minus d wrench / d displacement
    C: np.ndarray  # (6, 6) minus d wrench / d velocity
    W: np.ndarray  # (4, 6) generators of one slice: normal, two tangents, all of its force (WHOLE)


class CageModes(NamedTuple):
    """The cage's modes at one moment."""

    q: np.ndarray  # (n,) coordinates
    qd: np.ndarray  # (n,) rates
    margin: float  # no wall of a pocket moves by more along its normal


def new_pose() -> RollerPose:
    return RollerPose(np.zeros((3, 3)), np.zeros((3, 3)), np.zeros(3), np.zeros(3), np.zeros(3))


def new_pair() -> Pair:
    return Pair(np.zeros(6), np.zeros((6, 6)), np.zeros((6, 6)), np.zeros((4, 6)))


@part
def set_frame(psi, F):
    """Rows (e_x, e_r, e_psi) of the orbital frame at an azimuth."""
    c, s = cos(psi), sin(psi)
    F[0, 0], F[0, 1], F[0, 2] = 1.0, 0.0, 0.0
    F[1, 0], F[1, 1], F[1, 2] = 0.0, c, s
    F[2, 0], F[2, 1], F[2, 2] = 0.0, -s, c


@part
def set_pose(q, u, pose):
    """Fill the pose from a roller's coordinates (x, r, psi, skew, tilt, spin) and velocities.

    The axis is e_x turned by the skew about e_r, then by the tilt about the turned e_psi.
    """
    set_frame(q[2], pose.F)
    cx, sx, ce, se = cos(q[Q_SKEW]), sin(q[Q_SKEW]), cos(q[Q_TILT]), sin(q[Q_TILT])
    a = pose.axis
    a[0, 0], a[0, 1], a[0, 2] = cx * ce, se, -sx * ce
    a[1, 0], a[1, 1], a[1, 2] = -cx * se, ce, sx * se
    a[2, 0], a[2, 1], a[2, 2] = sx, 0.0, cx
    for j in range(3):
        pose.V[j] = u[j]
        pose.w[j] = u[U_SPIN] * a[0, j] + u[U_SKEW] * a[1, j] + u[U_TILT] * a[2, j]


@part
def keep_pose(pose, rows):
    """Copy a pose into ``KEPT`` rows of three numbers."""
    for j in range(3):
        for k in range(3):
            rows[j, k], rows[KEPT_AXES + j, k] = pose.F[j, k], pose.axis[j, k]
        rows[KEPT_V, j], rows[KEPT_W, j] = pose.V[j], pose.w[j]
        rows[KEPT_SPOT, j] = pose.spot[j]


@part
def take_pose(rows, pose):
    """The pose that ``keep_pose`` put into rows."""
    for j in range(3):
        for k in range(3):
            pose.F[j, k], pose.axis[j, k] = rows[j, k], rows[KEPT_AXES + j, k]
        pose.V[j], pose.w[j] = rows[KEPT_V, j], rows[KEPT_W, j]
        pose.spot[j] = rows[KEPT_SPOT, j]


@part
def clear(pair, tangent):
    """Zero a pair's wrench and, if asked, its tangent."""
    zero(pair.wrench)
    if tangent:
        zero(pair.K)
        zero(pair.C)


@part
def add_generator(n, r, out):
    """out = (n, r x n): the wrench about the centre of a unit force n at lever r."""
    out[0], out[1], out[2] = n[0], n[1], n[2]
    out[MOMENT] = r[1] * n[2] - r[2] * n[1]
    out[MOMENT + 1] = r[2] * n[0] - r[0] * n[2]
    out[MOMENT + 2] = r[0] * n[1] - r[1] * n[0]


@part
def add_wrench(out, f, r):
    """out += (f, r x f)."""
    out[0] += f[0]
    out[1] += f[1]
    out[2] += f[2]
    out[MOMENT] += r[1] * f[2] - r[2] * f[1]
    out[MOMENT + 1] += r[2] * f[0] - r[0] * f[2]
    out[MOMENT + 2] += r[0] * f[1] - r[1] * f[0]


@part
def add_force_and_moment(out, f, m):
    """out += (f, m)."""
    for c in range(3):
        out[c] += f[c]
        out[MOMENT + c] += m[c]


@part
def add_end_generator(n, r, axis, distance, out):
    """Generator of a normal force on a roller's end, with nothing left to the spin.

    An end looks the same however far it has spun, but its points, which keep their place towards
    the bearing's axis (at ``distance``), would give a force askew to the end a moment about the
    roller's axis. That moment m is taken out, and the force along the orbit that does as much when
    the roller goes round as m does on the axis is put in: the gradient of an energy that knows
    orbit, not spin.
    """
    add_generator(n, r, out)
    m = axis[0] * out[MOMENT] + axis[1] * out[MOMENT + 1] + axis[2] * out[MOMENT + 2]
    for j in range(3):
        out[MOMENT + j] -= m * axis[j]
    out[2] += m * axis[0] / distance


@part
def approach(W, rel, spin):
    """Rate at which roller and partner approach along generator W.

    ``rel``: velocity of the roller's centre less that of the partner's point there; ``spin``: the
    difference of their angular velocities.
    """
    s = W[0] * rel[0] + W[1] * rel[1] + W[2] * rel[2]
    return -(s + W[MOMENT] * spin[0] + W[MOMENT + 1] * spin[1] + W[MOMENT + 2] * spin[2])


@outlined
def add_outer(M, scale, a, b):
    """M += scale a b^T for 6-vectors."""
    for i in range(6):
        x = scale * a[i]
        if x != 0.0:
            for j in range(6):
                M[i, j] += x * b[j]


@part
def shift_matrix(R, lever, S):
    """6x6 map of a partner's (translation, rotation) to the motion at the roller's centre, in F.

    ``R`` (3, 3) takes the partner's translation components to F in ``R[0]`` and its rotation
    components in ``R[1]``; ``lever`` is the roller's centre from the partner's origin, in F.
    """
    for i in range(3):
        for j in range(3):
            S[i, j] = R[0, i, j]
            S[TURN + i, TURN + j] = R[1, i, j]
            S[TURN + i, j] = 0.0
    for j in range(3):
        S[0, TURN + j] = R[1, 1, j] * lever[2] - R[1, 2, j] * lever[1]
        S[1, TURN + j] = R[1, 2, j] * lever[0] - R[1, 0, j] * lever[2]
        S[2, TURN + j] = R[1, 0, j] * lever[1] - R[1, 1, j] * lever[0]


@outlined
def friction_tangent(C, N, g, dg, u, tx, tt, Wx, Wt):
    """C += -d(friction)/d(velocity) of one slice; sliding (tx, tt) along generators Wx, Wt."""
    h = dg / u if u > 1e-12 else 0.0
    add_outer(C, N * (g + h * tx * tx), Wx, Wx)
    add_outer(C, N * (g + h * tt * tt), Wt, Wt)
    if h != 0.0:
        add_outer(C, N * h * tx * tt, Wx, Wt)
        add_outer(C, N * h * tx * tt, Wt, Wx)
