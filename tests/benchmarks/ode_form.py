"""The bearing's equations as x' = f(t, x), x = (q, u), for integrators that know no constraints.

The rates are those of flexcage's own explicit method (``flexcage.system.rates`` says how
constraints are eliminated); here they are a function of Python, with their Jacobian.
"""

from __future__ import annotations

import numpy as np
from c_functions import CFunctions
from dense_tangent import kinematics, momentum_matrices

_HELD = (0, 3, 4, 5)  # of the inner ring's velocities


class OdeForm:
    """``rates`` and ``jacobian`` of a bearing with a fixed outer ring and a prescribed speed."""

    def __init__(self, functions: CFunctions) -> None:
        bearing = functions.bearing
        bodies = bearing.data.model.bodies
        if (
            bodies.by_shaft
            or np.ptp(bodies.speed[1]) > 0.0
            or bearing.data.model.outer_ring.free.any()
        ):
            raise ValueError("the Jacobian needs a fixed outer ring and a constant speed")
        self.c, self.layout = functions, bearing.layout
        self.size = self.layout.n_q + self.layout.n_u

    def rates(self, t: float, x: np.ndarray) -> np.ndarray:
        """f(t, x), a new array."""
        dx = np.empty(self.c.size)
        self.c.rates(t, self.full(x), dx)
        return dx[: self.size]

    def full(self, x: np.ndarray) -> np.ndarray:
        """y of x, with multipliers of zero."""
        return np.concatenate([x, np.zeros(self.c.size - self.size)])

    def jacobian(self, t: float, x: np.ndarray) -> np.ndarray:
        """df/dx (n, n), as exact as Newton's matrix."""
        y = self.full(x)
        M, C, K = momentum_matrices(self.c, t, y, np.zeros_like(y))
        to_rate, to_displacement = kinematics(self.c.bearing, y)
        n_q, ring = self.layout.n_q, 6 * self.layout.elements
        J = np.zeros((self.size, self.size))
        J[:n_q, n_q:] = to_rate
        J[n_q:, :n_q] = -K @ to_displacement
        J[n_q:, n_q:] = -C
        force = J[n_q:]
        force[:ring] /= np.diag(M)[:ring, None]
        force[ring:] = np.linalg.solve(M[ring:, ring:], force[ring:])
        force[[ring + c for c in _HELD]] = 0.0
        return J
