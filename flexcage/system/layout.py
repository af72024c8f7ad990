"""The index map of y = (q, u, lambda, mu, s): which unknown lives where."""

from __future__ import annotations

from collections.abc import Mapping
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
RING_FORCES = 4  # of every element on rings that bend: two on either ring
N_LAMBDA = 4  # inner ring: axial position, skew, tilt, drive
N_MU = 3  # position-level constraints among them
N_OWN = N_LAMBDA + N_MU  # multipliers of every bearing, before those of further constraints
CONSTRAINTS = ("axial_force", "moment_y", "moment_z", "drive_torque")
AXIAL_FORCE, MOMENT_Y, MOMENT_Z, DRIVE_TORQUE = range(N_LAMBDA)  # places in lambda
# the inner ring's velocities on which they act
HELD_VELOCITIES = (INNER, INNER_TURN + 1, INNER_TURN + 2, INNER_TURN)
REACTION_UNITS = ("N", "N m", "N m", "N m")  # of their multipliers


class Places(NamedTuple):
    """Where in y kernels find what: first come the elements' coordinates, at 0."""

    rest_q: int  # coordinates of rings and cage, ``Q_INNER`` to ``Q_MODES``
    u: int  # velocities of the elements
    rest_u: int  # of rings and cage, ``INNER`` to ``MODES``
    lam: int  # multipliers of drive and load
    held: int  # those of further constraints


def _places(elements: int, modes: int) -> Places:
    """The places in y of a bearing with so many elements and modes."""
    own = PER_ELEMENT * elements
    u = own + Q_MODES + modes
    lam = u + own + MODES + modes
    return Places(own, u, u + own, lam, lam + N_OWN)


places = part(_places)  # in kernels


@part
def of_element(i):
    """Where those of element i are among the coordinates or velocities of the elements."""
    return slice(PER_ELEMENT * i, PER_ELEMENT * (i + 1))


# where behind the elements q and u have what; modes follow
_IN_Q = {
    "inner": slice(Q_INNER, Q_OUTER),
    "outer": slice(Q_OUTER, Q_CAGE),
    "cage": slice(Q_CAGE, Q_QUATERNION),
    "quaternion": slice(Q_QUATERNION, Q_MODES),
}
_IN_U = {
    "inner": slice(INNER, OUTER),
    "outer": slice(OUTER, CAGE),
    "cage": slice(CAGE, CAGE_TURN),
    "omega": slice(CAGE_TURN, MODES),
}


@dataclass(frozen=True)
class Layout:
    """Slices of y for Z rolling elements and n modes.

    q: elements (x, r, psi, skew, tilt, spin); inner ring (x, y, z, skew, tilt, spin); outer ring
    (y, z); cage (x, y, z, quaternion, modes). u: elements (v_x, v_r, v_psi, w_axis, w_2, w_3);
    ring (v, w in its non-spinning frame); outer (v_y, v_z); cage (v in space, w in the body,
    modal rates). The border of Newton's matrix is (ring 6, outer 2, cage 6 + n, lambda, mu), and
    the further constraints' lambda and mu, one of each for every name in ``held``. Where rings bend
    y ends with the forces s that they bear of every element (``system.bending``), and with the
    coordinates and velocities of an outer ring that swings (``system.swinging``).
    """

    elements: int
    modes: int
    held: tuple[str, ...] = ()  # names of the scalar constraints beyond ``CONSTRAINTS``
    bends: bool = False  # do rings bend?
    ring_modes: int = 0  # coordinates of an outer ring that swings

    @property
    def n_q(self) -> int:
        return self._places.u

    @property
    def n_u(self) -> int:
        return self._places.lam - self._places.u

    @property
    def _places(self) -> Places:
        return _places(self.elements, self.modes)

    @property
    def n_border(self) -> int:
        return MODES + self.modes + N_OWN + 2 * len(self.held)

    @property
    def size(self) -> int:
        return self._swings + 2 * self.ring_modes

    @property
    def _end(self) -> int:
        """Where the multipliers end."""
        return self._places.held + 2 * len(self.held)

    @property
    def _swings(self) -> int:
        """Where the forces that rings bear end."""
        return self._end + (RING_FORCES * self.elements if self.bends else 0)

    @property
    def reactions(self) -> tuple[str, ...]:
        """Names of the multipliers, in their order."""
        return (*CONSTRAINTS, *self.held)

    def q(self, y: np.ndarray) -> dict[str, np.ndarray]:
        """Named views of the coordinates in y (or of their rates in y')."""
        return self._views(y, _IN_Q, Q_MODES)

    def u(self, y: np.ndarray) -> dict[str, np.ndarray]:
        """Named views of the velocities in y (or of accelerations in y')."""
        return self._views(y[..., self._places.u :], _IN_U, MODES)

    def _views(
        self, v: np.ndarray, bodies: Mapping[str, slice], modes: int
    ) -> dict[str, np.ndarray]:
        """Views of the elements, then of rings and cage, then of the modes from ``modes`` on."""
        end = self._places.rest_q
        own, rest = v[..., :end], v[..., end:]
        return {
            "elements": own.reshape(*v.shape[:-1], self.elements, PER_ELEMENT),
            **{name: rest[..., where] for name, where in bodies.items()},
            "modes": rest[..., modes : modes + self.modes],
        }

    def ring_forces(self, y: np.ndarray) -> np.ndarray:
        """View (..., 2, Z, 2) of the forces that both rings bear, at their ports; none where rings
        are rigid."""
        count = self.elements if self.bends else 0
        return y[..., self._end : self._swings].reshape(*y.shape[:-1], 2, count, 2)

    def ring_coordinates(self, y: np.ndarray) -> np.ndarray:
        """View (..., 2, M) of the coordinates of an outer ring that swings, then velocities."""
        return y[..., self._swings :].reshape(*y.shape[:-1], 2, self.ring_modes)

    def multipliers(self, y: np.ndarray) -> np.ndarray:
        """Forces and torques of the constraints ``reactions``, a copy."""
        start, further = self._places.lam, self._places.held
        own, more = y[..., start : start + N_LAMBDA], y[..., further : further + len(self.held)]
        return np.concatenate([own, more], axis=-1)
