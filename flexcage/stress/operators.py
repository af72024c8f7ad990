"""Stress of displacement fields: at Gauss points, smoothed at vertices, and von Mises.

Voigt order xx, yy, zz, xy, yz, xz; stresses in Pa, in the model's frame.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from flexcage.fem.elements import reference_gradients
from flexcage.fem.model import FEModel

# corners of the reference tetrahedron as columns, in scikit-fem's vertex order
_CORNERS = np.array([[0.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]])


def von_mises(stress: np.ndarray) -> np.ndarray:
    """Equivalent stress (...) of stresses (..., 6)."""
    xx, yy, zz, xy, yz, xz = np.moveaxis(stress, -1, 0)
    normal = (xx - yy) ** 2 + (yy - zz) ** 2 + (zz - xx) ** 2
    return np.sqrt(0.5 * normal + 3.0 * (xy**2 + yz**2 + xz**2))


def deviator(stress: np.ndarray) -> np.ndarray:
    """Five numbers (..., 5) linear in stresses (..., 6) whose norm is the equivalent stress."""
    xx, yy, zz, xy, yz, xz = np.moveaxis(stress, -1, 0)
    root = np.sqrt(3.0)
    parts = [0.5 * root * (xx - yy), zz - 0.5 * (xx + yy), root * xy, root * yz, root * xz]
    return np.stack(parts, axis=-1)


def hooke(model: FEModel, gradient: np.ndarray) -> np.ndarray:
    """Stresses (..., 6) of displacement gradients (..., 3, 3) [component, axis]."""
    modulus, nu = model.material.youngs_modulus, model.material.poisson_ratio
    first, shear = modulus * nu / ((1 + nu) * (1 - 2 * nu)), modulus / (2 * (1 + nu))
    strain = 0.5 * (gradient + np.swapaxes(gradient, -1, -2))
    pressure = first * np.trace(strain, axis1=-2, axis2=-1)
    normal = [pressure + 2.0 * shear * strain[..., i, i] for i in range(3)]
    mixed = [2.0 * shear * strain[..., i, j] for i, j in ((0, 1), (1, 2), (0, 2))]
    return np.stack(normal + mixed, axis=-1)


def _element(model: FEModel):
    import skfem

    return skfem.ElementTetP1() if model.order == 1 else skfem.ElementTetP2()


def shape_gradients(model: FEModel, points: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """Gradients (n_cells, n_points, n_shape, 3) of shape functions at reference points."""
    table = reference_gradients(_element(model), points)  # (n_shape, 4, n_points)
    return np.einsum("imq,ema->eqia", table, model.element_geometry[0][cells], optimize=True)


def gauss_stress(model: FEModel, displacement: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Stresses (n_tets, q, 6) at the stiffness' Gauss points of (N, 3); their weights (q,)."""
    from skfem.quadrature import get_quadrature
    from skfem.refdom import RefTet

    points, weights = get_quadrature(RefTet, 2 * (model.order - 1) or 1)
    gradients = shape_gradients(model, points, np.arange(len(model.cells)))
    values = displacement.reshape(-1, 3)[model.cells]
    return hooke(model, np.einsum("eqia,eic->eqca", gradients, values)), weights / weights.sum()


class VertexStress:
    """Smoothed stress at chosen vertices: a weighted mean of the corner values of elements.

    The stress is linear in a quadratic element, so its corner values are what the Gauss points
    extrapolate to. Inside, all adjacent elements count by volume. On the surface only those that
    own a boundary triangle at the vertex, by its area: the others extrapolate from below and
    would blunt the peak (by a fifth at fillets with two edges on an arc).
    """

    def __init__(self, model: FEModel, vertices: np.ndarray) -> None:
        self.model, self.vertices = model, vertices
        slot = np.full(len(model.points), -1)
        slot[vertices] = np.arange(len(vertices))
        weights = _corner_weights(model)
        cells = np.flatnonzero(((slot[model.tets] >= 0) & (weights > 0.0)).any(axis=1))
        at, weights = slot[model.tets[cells]], weights[cells]
        weights = np.where(at >= 0, weights, 0.0)
        weights /= np.bincount(at.ravel() + 1, weights.ravel(), len(vertices) + 1)[at + 1] + (
            at < 0
        )
        gradients = shape_gradients(model, _CORNERS, cells) * weights[:, :, None, None]
        used = np.broadcast_to((weights > 0.0)[:, :, None], gradients.shape[:3])
        rows = np.broadcast_to(at[:, :, None], used.shape)[used]
        columns = np.broadcast_to(model.cells[cells][:, None, :], used.shape)[used]
        shape = (len(vertices), len(model.nodes))
        self._gradient = [
            sp.csr_matrix((gradients[used, axis], (rows, columns)), shape) for axis in range(3)
        ]

    def __call__(self, fields: np.ndarray) -> np.ndarray:
        """Stresses (n_vertices, m, 6) of displacement fields (N, 3, m), or (n, 6) of (N, 3)."""
        n_nodes = len(self.model.nodes)
        flat = fields.reshape(n_nodes, -1)
        parts = [matrix @ flat for matrix in self._gradient]
        gradient = np.stack(parts, axis=-1).reshape(len(self.vertices), 3, flat.shape[1] // 3, 3)
        stress = hooke(self.model, gradient.transpose(0, 2, 1, 3))
        return stress[:, 0] if fields.ndim == 2 else stress


def _corner_weights(model: FEModel) -> np.ndarray:
    """Weight (n_tets, 4) of every element's corner value in the mean at its vertex."""
    weights = np.zeros(model.tets.shape)
    owner, corners = model.surface_cells
    triangles = model.points[model.tets[owner[:, None], corners]]
    normal = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    area = np.linalg.norm(normal, axis=1)
    np.add.at(weights, (owner[:, None], corners), area[:, None])
    outside = np.zeros(len(model.points), bool)
    outside[model.surface] = True
    volumes = np.broadcast_to(model.element_geometry[1][:, None], weights.shape)
    return np.where(outside[model.tets], weights, volumes)
