"""A bearing's tangent as dense matrices, for integrators that take no blocks.

As in Newton's matrix, geometry is of first order: how forces turn with it, and how inertia follows
the motion, is left out.
"""

from __future__ import annotations

import numpy as np
from c_functions import CFunctions

from flexcage.core.rotation import quaternion_rate, rotation_of_quaternion_change
from flexcage.system.layout import Layout
from flexcage.system.problem import BearingSystem

_OF_RING = (5, 3, 4)  # coordinates that belong to its (spin, skew, tilt)
_FORCED = np.array([0, 4, 5, 3])  # the inner ring's velocities that lambda acts on, in its order
_PLACED = np.array([0, 3, 4])  # its coordinates that mu moves
_ALPHA = 1e6  # [1/s] of factors that nobody uses


def newton_matrix(
    functions: CFunctions, t: float, y: np.ndarray, yd: np.ndarray, alpha: float
) -> np.ndarray:
    """dF/dy + alpha dF/dy' (n, n) of a bearing with a prescribed speed."""
    layout = functions.bearing.layout
    n_q, n_m = layout.n_q, layout.n_q + layout.n_u
    M, C, K = momentum_matrices(functions, t, y, yd)
    to_rate, to_displacement = kinematics(functions.bearing, y)
    J = np.zeros((layout.size, layout.size))
    J[:n_q, :n_q] = alpha * np.eye(n_q)
    J[:n_q, n_q:n_m] = -to_rate
    J[n_q:n_m, :n_q] = K @ to_displacement
    J[n_q:n_m, n_q:n_m] = alpha * M + C
    force, place = n_q + 6 * layout.elements + _FORCED, 6 * layout.elements + _PLACED
    lam, mu = n_m + np.arange(len(force)), n_m + len(force) + np.arange(len(place))
    J[force, lam], J[lam, force] = -1.0, 1.0
    J[place, mu], J[mu, place] = -1.0, 1.0
    return J


def momentum_matrices(
    functions: CFunctions, t: float, y: np.ndarray, yd: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """M, C, K (n_u, n_u) of M u' + C du + K d = 0, d the displacements that belong to u."""
    functions.setup(t, y, yd, _ALPHA)
    layout, data = functions.bearing.layout, functions.bearing.data
    tangent, (mass, axial, transverse) = data.work.tangent, data.model.bodies.element[:3]
    M = np.zeros((layout.n_u, layout.n_u))
    ring = 6 * layout.elements
    np.fill_diagonal(M[:ring, :ring], [*[mass] * 3, axial, transverse, transverse])
    M[ring:, ring:] = tangent.Mbb[: layout.n_u - ring, : layout.n_u - ring]
    C = _whole(tangent.Crr, tangent.Crb, tangent.Cbr, tangent.Cbb, layout)
    return M, C, _whole(tangent.Krr, tangent.Krb, tangent.Kbr, tangent.Kbb, layout)


def _whole(rr: np.ndarray, rb: np.ndarray, br: np.ndarray, bb: np.ndarray, layout: Layout):
    """Blocks and border as one matrix (n_u, n_u)."""
    ring = 6 * layout.elements
    border = layout.n_u - ring
    whole = np.zeros((layout.n_u, layout.n_u))
    for i in range(layout.elements):
        block = slice(6 * i, 6 * i + 6)
        whole[block, block] = rr[i]
        whole[block, ring:] = rb[i, :, :border]
        whole[ring:, block] = br[i, :border]
    whole[ring:, ring:] = bb[:border, :border]
    return whole


def kinematics(bearing: BearingSystem, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(n_q, n_u) rates of coordinates by velocities, and (n_u, n_q) displacements of changes."""
    layout, turns = bearing.layout, bearing.data.work.tangent.turns
    Z = layout.elements
    rate = np.zeros((layout.n_q, layout.n_u))
    back = np.zeros((layout.n_u, layout.n_q))
    for body in range(Z + 2):  # elements, then both rings
        order = np.array([0, 1, 2, *(turns if body < Z else _OF_RING)])
        coordinates, velocities = 6 * body + order, 6 * body + np.arange(6)
        scale = np.ones(6)
        scale[2] = y[6 * body + 1] if body < Z else 1.0
        rate[coordinates, velocities] = 1.0 / scale
        back[velocities, coordinates] = scale
    z = 6 * (Z + 2)  # of the cage
    for c in range(3):
        rate[z + c, z + c] = back[z + c, z + c] = 1.0
    quaternion = y[z + 3 : z + 7].copy()
    for c in range(3):
        quaternion_rate(quaternion, np.eye(3)[c], column := np.zeros(4))
        rate[z + 3 : z + 7, z + 3 + c] = column
    for c in range(4):
        rotation_of_quaternion_change(quaternion, np.eye(4)[c], turned := np.zeros(3))
        back[z + 3 : z + 6, z + 3 + c] = turned
    modes = np.arange(layout.modes)
    rate[z + 7 + modes, z + 6 + modes] = back[z + 6 + modes, z + 7 + modes] = 1.0
    return rate, back
