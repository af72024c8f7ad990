"""Ritz basis: free modes, the centrifugal shape, and residual attachment vectors of the pockets.

The default keeps the free modes and the centrifugal shape as dynamic coordinates and leaves the
attachments quasi-static and local. ``dynamic='all'`` makes one mass-orthonormal basis of the
same space, the reference against which the default is shown right.
"""

from __future__ import annotations

import logging

import numpy as np
from scipy.linalg import eigh

from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.fem.symmetry import find_symmetry
from flexcage.modes.basis import ModeBasis, ResidualFlexibility
from flexcage.modes.pockets import LOADS_PER_POCKET, check_groups, pocket_loads
from flexcage.modes.spec import ModesSpec

log = logging.getLogger(__name__)


def build(solver: FreeBodySolver, *, pocket_count: int, spec: ModesSpec) -> ModeBasis:
    """Free modes + centrifugal shape + residual attachment vectors of all pocket faces."""
    check_groups(solver.model, pocket_count)
    omega2, free = free_modes(solver, spec.count)
    centrifugal = centrifugal_mode(solver, free)
    kept = np.column_stack([free, centrifugal])
    kept_stiffness = np.append(omega2, centrifugal @ (solver.model.K @ centrifugal))
    vectors = residual_vectors(solver, kept, kept_stiffness, pocket_count)
    kinds = ["free"] * len(omega2) + ["centrifugal"]
    if spec.dynamic == "all":
        return _all_dynamic(solver, (free, omega2), np.column_stack([centrifugal, vectors]))
    return eigen_basis(
        "ritz", kept, kept_stiffness, kinds, residual_flexibility(solver, vectors, pocket_count)
    )


def eigen_basis(
    name: str,
    shapes: np.ndarray,
    stiffness: np.ndarray,
    kinds: list[str],
    residual: ResidualFlexibility | None = None,
) -> ModeBasis:
    """Basis of mass-orthonormal, stiffness-orthogonal shapes (3N, n) with stiffnesses (n,)."""
    return ModeBasis(
        name=name,
        shapes=shapes.reshape(-1, 3, shapes.shape[1]),
        stiffness=np.diag(stiffness),
        mass=np.eye(len(stiffness)),
        frequencies=np.sqrt(stiffness) / (2.0 * np.pi),
        kind=tuple(kinds),
        residual=residual,
    )


def centrifugal_load(solver: FreeBodySolver) -> np.ndarray:
    """Nodal loads (3N,) of a unit squared spin (1 rad/s) about x through the frame's origin."""
    radial = solver.model.nodes * np.array([0.0, 1.0, 1.0])
    return solver.model.mass_times(radial.ravel())


def centrifugal_mode(solver: FreeBodySolver, modes: np.ndarray) -> np.ndarray:
    """Static shape (3N,) under spin about x, mass-orthonormal to eigenmodes (3N, n)."""
    shape = solver.solve(centrifugal_load(solver)[:, None])[:, 0]
    for _ in range(2):
        shape = shape - modes @ (modes.T @ solver.model.mass_times(shape))
    return shape / np.sqrt(shape @ solver.model.mass_times(shape))


def residual_vectors(
    solver: FreeBodySolver, kept: np.ndarray, stiffness: np.ndarray, pocket_count: int
) -> np.ndarray:
    """Residual attachment vectors (3N, 8 Z): inertia-relieved answers to the pocket loads.

    The part that the kept modes carry is taken away, so that K-products with all kept modes
    vanish (mass products too with eigenmodes; the centrifugal shape is none). Each vector is
    scaled so that its own load does a work of one on it: coordinates are metres of mean face
    displacement. On a cyclic model pocket 0 is solved and turned, otherwise all are solved.
    """
    symmetry = find_symmetry(solver.model, pocket_count)
    pockets = range(1 if symmetry else pocket_count)
    parts = []
    for pocket in pockets:
        loads = pocket_loads(solver.model, pocket, pocket_count)
        static = solver.solve(loads)
        static -= kept @ ((kept.T @ loads) / stiffness[:, None])
        parts.append(static / np.einsum("ij,ij->j", loads, static))
    if symmetry:
        parts = [symmetry.rotate(parts[0], pocket) for pocket in range(pocket_count)]
    log.info("%d residual vectors, cyclic symmetry %s", 8 * pocket_count, bool(symmetry))
    return np.column_stack(parts)


def residual_flexibility(
    solver: FreeBodySolver, vectors: np.ndarray, pocket_count: int
) -> ResidualFlexibility:
    """Stiffness of the residual coordinates, their pocket compliances and the coupling cut.

    Coordinates a obey stiffness a = Psi^T F. Cutting the coupling between pockets leaves
    a_p = compliance_p Psi_p^T F with the inverse of the pocket's own stiffness block: exact for
    the pocket's own displacement under loads in the span of its eight patterns.
    """
    per = LOADS_PER_POCKET
    stiffness = np.empty((vectors.shape[1], vectors.shape[1]))
    for start in range(0, vectors.shape[1], per):
        part = slice(start, start + per)
        stiffness[:, part] = vectors.T @ (solver.model.K @ vectors[:, part])
    stiffness = 0.5 * (stiffness + stiffness.T)
    blocks = stiffness.reshape(pocket_count, per, pocket_count, per)
    own = np.stack([np.linalg.inv(blocks[k, :, k]) for k in range(pocket_count)])
    return ResidualFlexibility(
        shapes=vectors.reshape(-1, 3, vectors.shape[1]),
        stiffness=stiffness,
        compliance=own,
        far_coupling=coupling(stiffness, pocket_count, distance=1),
    )


def coupling(stiffness: np.ndarray, pocket_count: int, *, distance: int) -> float:
    """Largest deflection a load makes at least ``distance`` pockets away, relative to its own."""
    scale = np.sqrt(np.diag(stiffness))
    pocket = np.arange(len(stiffness)) // LOADS_PER_POCKET
    apart = np.abs(pocket[:, None] - pocket[None, :])
    apart = np.minimum(apart, pocket_count - apart)
    ratios = np.abs(stiffness) / np.outer(scale, scale)
    return float(ratios[apart >= distance].max(initial=0.0))


def _all_dynamic(
    solver: FreeBodySolver, free: tuple[np.ndarray, np.ndarray], others: np.ndarray
) -> ModeBasis:
    shapes, omega2 = free
    values, vectors = ritz_modes(solver, others, away_from=shapes)
    kinds = ["free"] * len(omega2) + ["attachment"] * len(values)
    return eigen_basis(
        "ritz", np.column_stack([shapes, vectors]), np.concatenate([omega2, values]), kinds
    )


def ritz_modes(
    solver: FreeBodySolver, vectors: np.ndarray, *, away_from: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray]:
    """Eigenmodes (omega^2, shapes) of K and M projected on the elastic part of ``vectors``.

    ``away_from``: eigenmodes (3N, n) that the vectors are first made orthogonal to. Directions
    that are dependent to rounding are dropped.
    """
    model = solver.model
    vectors = model.remove_rigid(vectors)
    if away_from is not None:
        vectors = vectors - away_from @ (away_from.T @ model.mass_times(vectors))
    mass = vectors.T @ model.mass_times(vectors)
    scale = 1.0 / np.sqrt(np.diag(mass))
    size, directions = eigh(mass * np.outer(scale, scale))
    good = size > 1e-10 * size[-1]
    vectors = vectors @ (scale[:, None] * directions[:, good] / np.sqrt(size[good]))
    values, turn = eigh(vectors.T @ (model.K @ vectors))
    return values, vectors @ turn
