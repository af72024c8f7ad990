"""Ritz basis: free modes, the centrifugal shape, and residual attachment vectors of the pockets.

The default keeps the free modes and the centrifugal shape as dynamic coordinates and leaves the
attachments quasi-static and local. ``land=True`` makes static land vectors dynamic as well.
``dynamic='all'`` makes one mass-orthonormal basis of the same space, the reference for the default
(tests/verification/test_basis_in_the_bearing.py: right in motion, loads and root stress; the peaks
of single contacts come out 20 to 50 % high).
"""

from __future__ import annotations

import logging
from collections.abc import Iterator

import numpy as np
import scipy.sparse as sp
from scipy.linalg import eigh

from flexcage.core.errors import InputError
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.fem.symmetry import find_symmetry
from flexcage.modes.basis import ModeBasis, ResidualFlexibility
from flexcage.modes.lands import land_vectors
from flexcage.modes.pockets import LOADS_PER_POCKET, check_groups, pocket_loads
from flexcage.modes.spec import ModesSpec

log = logging.getLogger(__name__)


def build(solver: FreeBodySolver, *, pocket_count: int, spec: ModesSpec) -> ModeBasis:
    """Free modes + centrifugal shape + residual attachment vectors of all pocket faces."""
    check_groups(solver.model, pocket_count)
    kept, kept_stiffness, kinds = dynamic_modes(solver, spec)
    vectors, own_stiffness = residual_vectors(solver, kept, kept_stiffness, pocket_count)
    if spec.dynamic == "all":
        n = kinds.count("free")
        others = np.column_stack([kept[:, n:], vectors])
        return _all_dynamic(solver, (kept[:, :n], kept_stiffness[:n]), others)
    residual = residual_flexibility(vectors, own_stiffness, pocket_count)
    return eigen_basis("ritz", kept, kept_stiffness, kinds, residual)


def build_without_attachments(
    solver: FreeBodySolver, *, pocket_count: int, spec: ModesSpec
) -> ModeBasis:
    """Free modes + centrifugal shape, and land vectors if asked for.

    For cages whose interface has the rest of a pocket's flexibility in itself.
    """
    if spec.dynamic == "all":
        raise InputError(
            "modes.dynamic = 'all' makes attachment vectors of pocket faces dynamic, and this cage "
            "has none; take 'free'.",
            where="modes.dynamic",
            value=spec.dynamic,
        )
    return eigen_basis("ritz", *dynamic_modes(solver, spec))


def dynamic_modes(
    solver: FreeBodySolver, spec: ModesSpec
) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """Shapes (3N, n), stiffnesses (n,) and kinds: free modes, centrifugal shape, land vectors."""
    omega2, free = free_modes(solver, spec.count)
    centrifugal = centrifugal_mode(solver, free)
    kept = np.column_stack([free, centrifugal])
    kept_stiffness = np.append(omega2, centrifugal @ (solver.model.K @ centrifugal))
    kinds = ["free"] * len(omega2) + ["centrifugal"]
    if spec.land:
        return with_lands(solver, kept, kept_stiffness, kinds)
    return kept, kept_stiffness, kinds


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


def with_lands(
    solver: FreeBodySolver, kept: np.ndarray, kept_stiffness: np.ndarray, kinds: list[str]
) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """Shapes, stiffnesses and kinds with static land vectors among them.

    The last of ``kept``, the centrifugal shape, is made stiffness-orthogonal to the land vectors
    together with them; the vector that is most of it keeps its name.
    """
    free, centrifugal = kept[:, :-1], kept[:, -1]
    lands = land_vectors(solver, kept, kept_stiffness)
    values, shapes = ritz_modes(solver, np.column_stack([centrifugal, lands]), away_from=free)
    names = ["land"] * len(values)
    names[int(np.argmax(np.abs(shapes.T @ solver.model.mass_times(centrifugal))))] = "centrifugal"
    return (
        np.column_stack([free, shapes]),
        np.concatenate([kept_stiffness[:-1], values]),
        kinds[:-1] + names,
    )


def residual_vectors(
    solver: FreeBodySolver, kept: np.ndarray, kept_stiffness: np.ndarray, pocket_count: int
) -> tuple[np.ndarray, np.ndarray]:
    """Residual attachment vectors Psi (3N, 8 Z) and their stiffness Psi^T K Psi.

    A vector is the inertia-relieved answer to a pocket load less the part that the kept modes
    carry, so that K-products with all kept modes vanish (mass products too with eigenmodes; the
    centrifugal shape is none). It is scaled so that its own load does a work of one on it:
    coordinates are metres of mean face displacement. As K Psi_j is then the load j over its
    scale but for forces that do no work on Psi, the stiffness needs no product with K.
    """
    vectors, work = [], []
    for loads, static in pocket_statics(solver, pocket_count):
        beyond = static - kept @ ((kept.T @ loads) / kept_stiffness[:, None])
        scale = np.einsum("ij,ij->j", loads, beyond)
        vectors.append(beyond / scale)
        work.append(sp.csr_matrix((loads / scale).T))
    shapes = np.column_stack(vectors)
    stiffness = sp.vstack(work) @ shapes
    return shapes, 0.5 * (stiffness + stiffness.T)


def pocket_statics(
    solver: FreeBodySolver, pocket_count: int
) -> Iterator[tuple[np.ndarray, np.ndarray]]:
    """Pocket by pocket: its loads (3N, 8) and their inertia-relieved answers (3N, 8).

    On a cyclic model pocket 0 is solved and turned, otherwise all are solved.
    """
    symmetry = find_symmetry(solver.model, pocket_count)
    log.info("static answers of %d pockets, cyclic symmetry: %s", pocket_count, bool(symmetry))
    first = solver.solve(pocket_loads(solver.model, 0, pocket_count)) if symmetry else None
    for pocket in range(pocket_count):
        loads = pocket_loads(solver.model, pocket, pocket_count)
        if symmetry is None or first is None:
            yield loads, solver.solve(loads)
        else:
            yield loads, symmetry.rotate(first, pocket)


def residual_flexibility(
    vectors: np.ndarray, stiffness: np.ndarray, pocket_count: int
) -> ResidualFlexibility:
    """Residual vectors (3N, 8 Z) with the compliances of their pockets and the coupling cut.

    Coordinates a obey stiffness a = Psi^T F. Cutting the coupling between pockets leaves
    a_p = compliance_p Psi_p^T F with the inverse of the pocket's own stiffness block: exact for
    the pocket's own displacement under loads in the span of its eight patterns.
    """
    per = LOADS_PER_POCKET
    blocks = stiffness.reshape(pocket_count, per, pocket_count, per)
    own = np.stack([np.linalg.inv(blocks[k, :, k]) for k in range(pocket_count)])
    far = coupling(stiffness, pocket_count, distance=1)
    beyond = coupling(stiffness, pocket_count, distance=2)
    log.info("residual coupling cut: %.2f to the next pocket, %.2f beyond it", far, beyond)
    return ResidualFlexibility(
        shapes=vectors.reshape(-1, 3, vectors.shape[1]),
        stiffness=stiffness,
        compliance=own,
        far_coupling=far,
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
