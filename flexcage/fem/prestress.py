"""Geometric stiffness: what stress already in a body adds to its stiffness."""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

from flexcage.fem import elements
from flexcage.fem.model import FEModel, lame


def geometric_stiffness(model: FEModel, displacement: np.ndarray) -> sp.csr_matrix:
    """k (N, N) of the stress sigma that static ``displacement`` (3N,) or (N, 3) makes [N/m].

    k_ij = int sigma_ab d_a N_i d_b N_j dV: the second-order work of sigma on fields u is
    1/2 sum_c u_c^T k u_c, the same in all three directions c. Exact for affine elements.
    """
    import skfem
    from skfem.quadrature import get_quadrature
    from skfem.refdom import RefTet

    element = skfem.ElementTetP1() if model.order == 1 else skfem.ElementTetP2()
    points, weights = get_quadrature(RefTet, 3 * (model.order - 1) or 1)
    weights = weights / weights.sum()
    table = elements.reference_gradients(element, points)
    gradients, volumes = model.element_geometry
    moved = displacement.reshape(-1, 3)
    pattern = elements.BlockPattern(model.cells, len(model.nodes))
    data = np.zeros(len(pattern.columns))
    for first in range(0, len(volumes), elements.CHUNK):
        part = slice(first, first + elements.CHUNK)
        slopes = np.einsum("imq,ema->eqia", table, gradients[part], optimize=True)
        stress = _stress(model, np.einsum("eqia,eic->eqca", slopes, moved[model.cells[part]]))
        stress *= (volumes[part, None] * weights)[..., None, None]
        pulled = slopes @ stress  # (e, q, i, b)
        data += pattern.sum(np.einsum("eqib,eqjb->eij", pulled, slopes, optimize=True), first)
    return pattern.scalar(data)


def _stress(model: FEModel, gradient: np.ndarray) -> np.ndarray:
    """Stress tensors (..., 3, 3) of displacement gradients (..., 3, 3) [component, axis]."""
    first, shear = lame(model.material)
    stress = shear * (gradient + np.swapaxes(gradient, -1, -2))
    pressure = first * np.trace(gradient, axis1=-2, axis2=-1)
    for axis in range(3):
        stress[..., axis, axis] += pressure
    return stress
