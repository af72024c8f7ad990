"""The index map of y = (q, u, lambda, mu): which unknown lives where."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from flexcage.core.jit import part

PER_ELEMENT = 6  # coordinates, and velocities, of a rolling element
# places in u behind the elements, and in the border: velocity of the centre (x, y, z) in space;
# angular velocity of the inner ring in its non-spinning frame (spin first), of the cage in its own
INNER, INNER_TURN, OUTER, CAGE, CAGE_TURN, MODES = 0, 3, 6, 8, 11, 14
# places in q behind the elements: centre; skew, tilt and spin of the inner ring; the outer's centre
# (y, z); quaternion
Q_INNER, Q_INNER_TURN, Q_OUTER, Q_CAGE, Q_QUATERNION, Q_MODES = 0, 3, 6, 8, 11, 15
N_LAMBDA = 4  # inner ring: axial position, skew, tilt, drive
N_MU = 3  # position-level constraints among them
N_OWN = N_LAMBDA + N_MU  # multipliers of every bearing, before those of further constraints
CONSTRAINTS = ("axial_force", "moment_y", "moment_z", "drive_torque")
AXIAL_FORCE, MOMENT_Y, MOMENT_Z, DRIVE_TORQUE = range(N_LAMBDA)  # places in lambda
REACTION_UNITS = ("N", "N m", "N m", "N m")  # of their multipliers


class Places(NamedTuple):
    """Where in y kernels find what: first come the elements' coordinates, at 0."""

    rest_q: int  # coordinates of rings and cage, ``Q_INNER`` to ``Q_MODES``
    u: int  # velocities of the elements
    rest_u: int  # of rings and cage, ``INNER`` to ``MODES``
    lam: int  # multipliers of drive and load
    held: int  # those of further constraints


@part
def places(elements, modes):
    """The places in y of a bearing with so many elements and modes."""
    own = PER_ELEMENT * elements
    u = own + Q_MODES + modes
    lam = u + own + MODES + modes
    return Places(own, u, u + own, lam, lam + N_OWN)


@part
def of_element(i):
    """Where those of element i are among the coordinates or velocities of the elements."""
    return slice(PER_ELEMENT * i, PER_ELEMENT * (i + 1))


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
        return PER_ELEMENT * self.rollers + Q_MODES + self.modes

    @property
    def n_u(self) -> int:
        return PER_ELEMENT * self.rollers + MODES + self.modes

    @property
    def n_border(self) -> int:
        return MODES + self.modes + N_OWN + 2 * len(self.held)

    @property
    def size(self) -> int:
        return self.n_q + self.n_u + N_OWN + 2 * len(self.held)

    @property
    def reactions(self) -> tuple[str, ...]:
        """Names of the multipliers, in their order."""
        return (*CONSTRAINTS, *self.held)

    def q(self, y: np.ndarray) -> dict[str, np.ndarray]:
        """Named views of the coordinates in y (or of their rates in y')."""
        z = PER_ELEMENT * self.rollers
        return {
            "rollers": y[..., :z].reshape(*y.shape[:-1], self.rollers, PER_ELEMENT),
            "inner": y[..., z : z + Q_OUTER],
            "outer": y[..., z + Q_OUTER : z + Q_CAGE],
            "cage": y[..., z + Q_CAGE : z + Q_QUATERNION],
            "quaternion": y[..., z + Q_QUATERNION : z + Q_MODES],
            "modes": y[..., z + Q_MODES : z + Q_MODES + self.modes],
        }

    def u(self, y: np.ndarray) -> dict[str, np.ndarray]:
        """Named views of the velocities in y (or of accelerations in y')."""
        v = y[..., self.n_q : self.n_q + self.n_u]
        z = PER_ELEMENT * self.rollers
        return {
            "rollers": v[..., :z].reshape(*y.shape[:-1], self.rollers, PER_ELEMENT),
            "inner": v[..., z : z + OUTER],
            "outer": v[..., z + OUTER : z + CAGE],
            "cage": v[..., z + CAGE : z + CAGE_TURN],
            "omega": v[..., z + CAGE_TURN : z + MODES],
            "modes": v[..., z + MODES : z + MODES + self.modes],
        }

    def multipliers(self, y: np.ndarray) -> np.ndarray:
        """Forces and torques of the constraints ``reactions``, a copy."""
        start = self.n_q + self.n_u
        further = start + N_OWN
        own, more = y[..., start : start + N_LAMBDA], y[..., further : further + len(self.held)]
        return np.concatenate([own, more], axis=-1)
