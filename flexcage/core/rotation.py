"""Rotations for kernels: quaternions (scalar first), rotation matrices."""

from __future__ import annotations

from math import sqrt

from flexcage.core.jit import kernel


@kernel
def matrix_from_quaternion(q, out):
    """Rotation matrix A(q/|q|), body to space, into ``out`` (3, 3)."""
    n = 1.0 / sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    w, x, y, z = q[0] * n, q[1] * n, q[2] * n, q[3] * n
    out[0, 0] = 1.0 - 2.0 * (y * y + z * z)
    out[0, 1] = 2.0 * (x * y - w * z)
    out[0, 2] = 2.0 * (x * z + w * y)
    out[1, 0] = 2.0 * (x * y + w * z)
    out[1, 1] = 1.0 - 2.0 * (x * x + z * z)
    out[1, 2] = 2.0 * (y * z - w * x)
    out[2, 0] = 2.0 * (x * z - w * y)
    out[2, 1] = 2.0 * (y * z + w * x)
    out[2, 2] = 1.0 - 2.0 * (x * x + y * y)


@kernel
def quaternion_rate(q, w, out):
    """dq/dt of a quaternion with body-frame angular velocity ``w`` into ``out`` (4,)."""
    out[0] = 0.5 * (-q[1] * w[0] - q[2] * w[1] - q[3] * w[2])
    out[1] = 0.5 * (q[0] * w[0] - q[3] * w[1] + q[2] * w[2])
    out[2] = 0.5 * (q[3] * w[0] + q[0] * w[1] - q[1] * w[2])
    out[3] = 0.5 * (-q[2] * w[0] + q[1] * w[1] + q[0] * w[2])


@kernel
def rotation_of_quaternion_change(q, dq, out):
    """Body-frame rotation vector that belongs to a small change ``dq``: the inverse of the rate."""
    n = 2.0 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3])
    out[0] = n * (-q[1] * dq[0] + q[0] * dq[1] + q[3] * dq[2] - q[2] * dq[3])
    out[1] = n * (-q[2] * dq[0] - q[3] * dq[1] + q[0] * dq[2] + q[1] * dq[3])
    out[2] = n * (-q[3] * dq[0] + q[2] * dq[1] - q[1] * dq[2] + q[0] * dq[3])
