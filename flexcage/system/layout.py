"""The index map of y = (q, u, lambda, mu): which unknown lives where."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

N_LAMBDA = 4  # inner ring: axial position, skew, tilt, drive
N_MU = 3  # position-level constraints among them
CONSTRAINTS = ("axial_force", "moment_y", "moment_z", "drive_torque")
REACTION_UNITS = ("N", "N m", "N m", "N m")  # of their multipliers


@dataclass(frozen=True)
class Layout:
    """Slices of y for Z rollers and n modes.

    q: rollers (x, r, psi, skew, tilt, spin); inner ring (x, y, z, skew, tilt, spin); outer ring
    (y, z); cage (x, y, z, quaternion, modes). u: rollers (v_x, v_r, v_psi, w_axis, w_2, w_3);
    ring (v, w in its non-spinning frame); outer (v_y, v_z); cage (v in space, w in the body,
    modal rates). The border of Newton's matrix is (ring 6, outer 2, cage 6 + n, lambda, mu), and
    the further constraints' lambda and mu, one of each for every name in ``held``.
    """

    rollers: int
    modes: int
    held: tuple[str, ...] = ()  # names of the scalar constraints beyond ``CONSTRAINTS``

    @property
    def n_q(self) -> int:
        return 6 * self.rollers + 15 + self.modes

    @property
    def n_u(self) -> int:
        return 6 * self.rollers + 14 + self.modes

    @property
    def n_border(self) -> int:
        return 14 + self.modes + N_LAMBDA + N_MU + 2 * len(self.held)

    @property
    def size(self) -> int:
        return self.n_q + self.n_u + N_LAMBDA + N_MU + 2 * len(self.held)

    @property
    def reactions(self) -> tuple[str, ...]:
        """Names of the multipliers, in their order."""
        return (*CONSTRAINTS, *self.held)

    def q(self, y: np.ndarray) -> dict[str, np.ndarray]:
        """Named views of the coordinates in y (or of their rates in y')."""
        z = 6 * self.rollers
        return {
            "rollers": y[..., :z].reshape(*y.shape[:-1], self.rollers, 6),
            "inner": y[..., z : z + 6],
            "outer": y[..., z + 6 : z + 8],
            "cage": y[..., z + 8 : z + 11],
            "quaternion": y[..., z + 11 : z + 15],
            "modes": y[..., z + 15 : z + 15 + self.modes],
        }

    def u(self, y: np.ndarray) -> dict[str, np.ndarray]:
        """Named views of the velocities in y (or of accelerations in y')."""
        v = y[..., self.n_q : self.n_q + self.n_u]
        z = 6 * self.rollers
        return {
            "rollers": v[..., :z].reshape(*y.shape[:-1], self.rollers, 6),
            "inner": v[..., z : z + 6],
            "outer": v[..., z + 6 : z + 8],
            "cage": v[..., z + 8 : z + 11],
            "omega": v[..., z + 11 : z + 14],
            "modes": v[..., z + 14 : z + 14 + self.modes],
        }

    def multipliers(self, y: np.ndarray) -> np.ndarray:
        """Forces and torques of the constraints ``reactions``, a copy."""
        start = self.n_q + self.n_u
        further = start + N_LAMBDA + N_MU
        own, more = y[..., start : start + N_LAMBDA], y[..., further : further + len(self.held)]
        return np.concatenate([own, more], axis=-1)
