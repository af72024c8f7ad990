"""A body of the floating-frame kernel set free, integrated by SciPy, and looked at from outside."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy import sparse
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from flexcage.bodies.floating_frame import flexible_body, frame_work, inertia_terms
from flexcage.core.rotation import matrix_from_quaternion, quaternion_rate


class Tumbler:
    """y = (position, velocity, quaternion, body angular velocity, q, q')."""

    def __init__(self, body):
        self.body, self.data, self.n = body, body.data, body.modes
        self.work = frame_work(body.modes)

    def split(self, y):
        n = self.n
        return y[:3], y[3:6], y[6:10], y[10:13], y[13 : 13 + n], y[13 + n :]

    def start(self, *, x=(0, 0, 0), v=(0, 0, 0), rotation=(0, 0, 0), w=(0, 0, 0), q=None, qd=None):
        zero = np.zeros(self.n)
        quaternion = Rotation.from_rotvec(rotation).as_quat(scalar_first=True)
        parts = (x, v, quaternion, w, zero if q is None else q, zero if qd is None else qd)
        return np.concatenate([np.asarray(p, float) for p in parts])

    def rate(self, t, y):
        x, v, quat, w, q, qd = (np.ascontiguousarray(a) for a in self.split(y))
        inertia_terms(self.data, w, q, qd, self.work)
        force = -self.work.h.copy()
        force[6:] -= self.data.kff @ q
        a = np.linalg.solve(self.work.M, force)
        A, dq = np.empty((3, 3)), np.empty(4)
        matrix_from_quaternion(quat, A)
        quaternion_rate(quat, w, dq)
        return np.concatenate([v, A @ a[:3], dq, a[3:6], qd, a[6:]])

    def fly(self, y0, times, *, rtol=1e-11):
        out = solve_ivp(
            self.rate, (0.0, times[-1]), y0, method="DOP853", rtol=rtol, atol=1e-14, t_eval=times
        )
        assert out.success
        return out.y.T

    def nodes(self, y, points, shapes):
        """Positions and velocities of nodes (N, 3) with shapes (N, 3, n) in state y, in space."""
        x, v, quat, w, q, qd = self.split(y)
        A = Rotation.from_quat(quat, scalar_first=True).as_matrix()
        local, relative = points + shapes @ q, shapes @ qd
        return x + local @ A.T, v + (np.cross(w, local) + relative) @ A.T


def free_body():
    """The data set of the two programs, and its scalar mass matrix."""
    d = np.load(Path(__file__).parent / "data" / "free_body.npz")
    upper = sparse.coo_matrix((d["mass_value"], (d["mass_row"], d["mass_col"])), shape=(405, 405))
    return d, sparse.csr_matrix(upper + sparse.triu(upper, 1).T)


def tumbler(basis):
    d, mass = free_body()
    body = flexible_body(d["nodes"], mass, d[f"shapes_{basis}"], d[f"stiffness_{basis}"])
    return Tumbler(body), d, mass


def full_mesh_invariants(flyer, y, points, shapes, mass):
    """Energy, momentum and angular momentum from nodal motion and the mesh's own mass matrix."""
    r, v = flyer.nodes(y, points, shapes)
    mv = mass @ v
    q = flyer.split(y)[4]
    energy = 0.5 * np.sum(v * mv) + 0.5 * q @ flyer.data.kff @ q
    return energy, mv.sum(axis=0), np.cross(r, mv).sum(axis=0)
