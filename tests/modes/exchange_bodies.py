"""A small box of tetrahedra as a body: what files of all programs hold, with known answers."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import skfem
from scipy.linalg import eigh

from flexcage.fem.model import FEModel, assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.modes.exchange.body import MODAL, ReducedBody

STEEL = MATERIALS["steel"]
SIZE = np.array([40e-3, 20e-3, 10e-3])


def box(points: int = 3, size: np.ndarray = SIZE) -> FEModel:
    """A steel block off the origin, linear elements: (points)^3 nodes."""
    grid = [np.linspace(0.0, 1.0, points)] * 3
    mesh = skfem.MeshTet.init_tensor(*grid)
    placed = mesh.p.T * size + [5e-3, -3e-3, 2e-3]
    return assemble(SimpleNamespace(points=placed, tets=mesh.t.T, groups={}), STEEL, order=1)


def full(model: FEModel) -> ReducedBody:
    count = len(model.nodes)
    return ReducedBody(
        stiffness=model.K.toarray(),
        mass=np.kron(model.mass_scalar.toarray(), np.eye(3)),
        nodes=model.nodes,
        dofs=np.stack(np.divmod(np.arange(3 * count), 3), axis=1),
    )


def craig_bampton(model: FEModel, nodes: np.ndarray, modes: int, *, shapes: bool = True):
    """Constraint modes of ``nodes`` and fixed-interface modes (Craig and Bampton, AIAA Journal 6
    (1968) 1313): here by dense algebra, in flexcage by another road."""
    K, M = full(model).dense()
    held = (3 * nodes[:, None] + np.arange(3)).ravel()
    free = np.setdiff1d(np.arange(len(K)), held)
    values, fixed = eigh(K[np.ix_(free, free)], M[np.ix_(free, free)])
    basis = np.zeros((len(K), len(held) + modes))
    basis[held, np.arange(len(held))] = 1.0
    basis[free, : len(held)] = -np.linalg.solve(K[np.ix_(free, free)], K[np.ix_(free, held)])
    basis[free, len(held) :] = fixed[:, :modes]
    dofs = [(node, axis) for node in nodes for axis in range(3)] + [(MODAL, 0)] * modes
    return ReducedBody(
        stiffness=basis.T @ K @ basis,
        mass=basis.T @ M @ basis,
        nodes=model.nodes,
        dofs=np.array(dofs),
        shapes=basis.reshape(-1, 3, basis.shape[1]) if shapes else None,
    )


def frequencies(body: ReducedBody) -> np.ndarray:
    """Elastic frequencies [Hz] of a free body by dense algebra: all eigenvalues but six."""
    values = eigh(*body.dense(), eigvals_only=True)
    return np.sqrt(values[6:]) / (2.0 * np.pi)
