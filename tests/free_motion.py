"""A body of the floating-frame kernel set free, integrated by SciPy, and looked at from outside."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike
from scipy import sparse
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation

from flexcage.bodies.floating_frame import (
    FlexibleBody,
    flexible_body,
    frame_work,
    inertia_terms,
    mass_matrix,
)
from flexcage.core.errors import RunFailed
from flexcage.core.rotation import matrix_from_quaternion, quaternion_rate

ZERO = (0.0, 0.0, 0.0)
BODY = Path(__file__).parent / "bodies" / "data" / "free_body.npz"


class Tumbler:
    """y = (position, velocity, quaternion, body angular velocity, q, q'), free of force."""

    def __init__(self, body: FlexibleBody) -> None:
        self.body, self.data, self.n = body, body.data, body.modes
        self.work = frame_work(body.modes)

    def split(self, y: np.ndarray) -> tuple[np.ndarray, ...]:
        """Position, velocity, quaternion, angular velocity, q and q' of a state."""
        n = self.n
        return y[:3], y[3:6], y[6:10], y[10:13], y[13 : 13 + n], y[13 + n :]

    def start(
        self, *, x: ArrayLike = ZERO, v: ArrayLike = ZERO, rotation: ArrayLike = ZERO,
        w: ArrayLike = ZERO, q: ArrayLike | None = None, qd: ArrayLike | None = None,
    ) -> np.ndarray:  # fmt: skip
        """State of a position, velocity, rotation vector, angular velocity and modal state."""
        zero = np.zeros(self.n)
        quaternion = Rotation.from_rotvec(rotation).as_quat(scalar_first=True)
        parts = (x, v, quaternion, w, zero if q is None else q, zero if qd is None else qd)
        return np.concatenate([np.asarray(p, float) for p in parts])

    def acceleration(self, w: np.ndarray, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        """(A^T v', w', q'') of the free body (6 + n,)."""
        inertia_terms(self.data, w, q, qd, self.work)
        force = -self.work.h.copy()
        force[6:] -= self.data.kff @ q
        return np.linalg.solve(mass_matrix(self.data, self.work), force)

    def rate(self, t: float, y: np.ndarray) -> np.ndarray:
        """y' of a state."""
        _, v, quaternion, w, q, qd = (np.ascontiguousarray(a) for a in self.split(y))
        a = self.acceleration(w, q, qd)
        A, dq = np.empty((3, 3)), np.empty(4)
        matrix_from_quaternion(quaternion, A)
        quaternion_rate(quaternion, w, dq)
        return np.concatenate([v, A @ a[:3], dq, a[3:6], qd, a[6:]])

    def fly(self, y0: np.ndarray, times: np.ndarray, *, rtol: float = 1e-11) -> np.ndarray:
        """States (n, len(y)) at the times, from y0 at zero."""
        out = solve_ivp(
            self.rate, (0.0, times[-1]), y0, method="DOP853", rtol=rtol, atol=1e-14, t_eval=times
        )
        if not out.success:
            raise RunFailed(f"the flight of the free body ended early: {out.message}")
        return out.y.T

    def nodes(
        self, y: np.ndarray, points: np.ndarray, shapes: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Positions and velocities of nodes (N, 3) with shapes (N, 3, n) in state y, in space."""
        x, v, quaternion, w, q, qd = self.split(y)
        A = Rotation.from_quat(quaternion, scalar_first=True).as_matrix()
        local, relative = points + shapes @ q, shapes @ qd
        return x + local @ A.T, v + (np.cross(w, local) + relative) @ A.T


class ProjectedMesh(Tumbler):
    """The same motion from the unreduced mesh: nodal accelerations projected on the shapes.

    J^T M (J a + b) = (0, 0, -K q) with M of the mesh, J the nodal velocities of unit generalised
    ones and b the nodal accelerations at rest of those: no inertia invariant takes part.
    """

    def __init__(
        self, body: FlexibleBody, points: np.ndarray, shapes: np.ndarray, mass: sparse.csr_matrix
    ) -> None:
        super().__init__(body)
        self.points, self.shapes, self.mass = points, shapes, mass

    def acceleration(self, w: np.ndarray, q: np.ndarray, qd: np.ndarray) -> np.ndarray:
        count = len(self.points)
        p, u = self.points + self.shapes @ q, self.shapes @ qd
        J = np.zeros((count, 3, 6 + self.n))
        for axis, unit in enumerate(np.eye(3)):
            J[:, axis, axis] = 1.0
            J[:, :, 3 + axis] = np.cross(unit, p)
        J[:, :, 6:] = self.shapes
        b = np.cross(w, np.cross(w, p)) + 2.0 * np.cross(w, u)
        moved = (self.mass @ J.reshape(count, -1)).reshape(3 * count, -1)
        force = -moved.T @ b.ravel()
        force[6:] -= self.data.kff @ q
        return np.linalg.solve(moved.T @ J.reshape(3 * count, -1), force)


def free_body() -> tuple[dict[str, np.ndarray], sparse.csr_matrix]:
    """The body of ``bodies/data/README.md``: its arrays, and its scalar mass matrix (405, 405)."""
    with np.load(BODY) as stored:
        d = dict(stored)
    upper = sparse.coo_matrix((d["mass_value"], (d["mass_row"], d["mass_col"])), shape=(405, 405))
    return d, sparse.csr_matrix(upper + sparse.triu(upper, 1).T)


def tumbler(basis: str) -> tuple[Tumbler, dict[str, np.ndarray], sparse.csr_matrix]:
    """That body reduced to its ``free`` or ``clamped`` shapes, its arrays and its mass."""
    d, mass = free_body()
    body = flexible_body(d["nodes"], mass, d[f"shapes_{basis}"], d[f"stiffness_{basis}"])
    return Tumbler(body), d, mass


def launch(flyer: Tumbler, d: dict[str, np.ndarray]) -> np.ndarray:
    """The start of the stored motion: frame at the origin, unturned."""
    return flyer.start(
        v=d["velocity"], w=d["angular_velocity"], q=d["modal_start"], qd=d["modal_rate_start"]
    )


def full_mesh_invariants(
    flyer: Tumbler, y: np.ndarray, points: np.ndarray, shapes: np.ndarray, mass: sparse.csr_matrix
) -> tuple[float, np.ndarray, np.ndarray]:
    """Energy, momentum and angular momentum from nodal motion and the mesh's own mass matrix."""
    r, v = flyer.nodes(y, points, shapes)
    mv = mass @ v
    q = flyer.split(y)[4]
    energy = 0.5 * np.sum(v * mv) + 0.5 * q @ flyer.data.kff @ q
    return energy, mv.sum(axis=0), np.cross(r, mv).sum(axis=0)


def momentum_by_nodes(
    ds: Any, nodes: np.ndarray, shapes: np.ndarray, mass: sparse.csr_matrix
) -> tuple[np.ndarray, np.ndarray]:
    """Momentum [kg m/s] and angular momentum about the origin [kg m^2/s] of a run's flexible cage,
    both (time, 3), in space, from nodal motion and the mesh's own mass matrix (N, N)."""
    turns = Rotation.from_quat(ds["cage_quaternion"].values, scalar_first=True).as_matrix()
    names = ("position", "velocity", "omega")
    parts = [ds[f"cage_{name}"].values for name in names]
    parts += [ds["modal_coordinates"].values, ds["modal_velocity"].values]
    linear, angular = [], []
    for A, x, v, w, q, qd in zip(turns, *parts):
        local = nodes + shapes @ q
        speed = v + (np.cross(w, local) + shapes @ qd) @ A.T
        pushed = mass @ speed
        linear.append(pushed.sum(axis=0))
        angular.append(np.cross(x + local @ A.T, pushed).sum(axis=0))
    return np.array(linear), np.array(angular)
