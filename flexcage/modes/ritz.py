"""Ritz basis: free modes, static shapes, and residual attachment vectors of the pockets.

The default keeps the free modes, the centrifugal shape and the bending of every crossbeam as
dynamic coordinates and leaves the attachments quasi-static and local. ``land=True`` makes static
land vectors dynamic as well. ``dynamic='all'`` makes one mass-orthonormal basis of the same space,
the reference for the default (tests/verification/test_basis_in_the_bearing.py: the same motion,
loads, contacts and root stress).
"""

from __future__ import annotations

import logging
from collections.abc import Mapping

import numpy as np
import scipy.sparse as sp
from scipy.linalg import eigh

from flexcage.core.errors import InputError
from flexcage.core.threads import on_all_cores
from flexcage.fem.blocked_products import inner_products, subtract_product
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.fem.model import FEModel
from flexcage.fem.symmetry import find_symmetry
from flexcage.mesh.rows import rows_in
from flexcage.modes.basis import ModeBasis, ResidualFlexibility
from flexcage.modes.lands import land_vectors
from flexcage.modes.pockets import LOADS, LOADS_PER_POCKET, check_groups, sparse_pocket_loads
from flexcage.modes.rows import row_models
from flexcage.modes.spec import ModesSpec

log = logging.getLogger(__name__)

_TOGETHER = 64  # loads of pockets that are solved at once
_STIFF = 1.5  # times the middle frequency of crossbeams: no bending of their own


def build(solver: FreeBodySolver, *, pocket_count: int, spec: ModesSpec) -> ModeBasis:
    """Free modes + centrifugal shape + residual attachment vectors of all pocket faces."""
    check_groups(solver.model, pocket_count)
    loads, answers = pocket_statics(solver, pocket_count, LOADS[spec.attachments])
    kept, kept_stiffness, kinds = dynamic_modes(solver, spec, answers)
    vectors, own_stiffness, share = residual_vectors(kept, kept_stiffness, loads, answers)
    if spec.dynamic == "all":
        n = kinds.count("free")
        others = np.column_stack([kept[:, n:], vectors])
        return _all_dynamic(solver, (kept[:, :n], kept_stiffness[:n]), others)
    residual = residual_flexibility(vectors, own_stiffness, share, pocket_count)
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
    solver: FreeBodySolver, spec: ModesSpec, answers: np.ndarray | None = None
) -> tuple[np.ndarray, np.ndarray, list[str]]:
    """Shapes (3N, n), stiffnesses (n,) and kinds: free modes, centrifugal shape, crossbeams' and
    lands' static shapes. ``answers``: to the pockets' loads (3N, Z, m), if any."""
    omega2, free = free_modes(solver, spec.count)
    static = {"centrifugal": centrifugal_mode(solver, free)[:, None]}
    if spec.crossbeams and answers is not None:
        static["crossbeam"] = crossbeam_vectors(solver, free, answers)
    values, shapes = ritz_modes(solver, np.hstack([*static.values()]), away_from=free)
    if spec.land:
        kept, stiffness = np.hstack([free, shapes]), np.append(omega2, values)
        static["land"] = land_vectors(solver, kept, stiffness)
        values, shapes = ritz_modes(solver, np.hstack([*static.values()]), away_from=free)
    kinds = ["free"] * len(omega2) + _mostly(solver, shapes, static)
    return np.hstack([free, shapes]), np.append(omega2, values), kinds


def crossbeam_vectors(solver: FreeBodySolver, free: np.ndarray, answers: np.ndarray) -> np.ndarray:
    """Mass-orthonormal shapes (3N, n), n <= Z, that pushing crossbeams adds to eigenmodes.

    ``free``: these (3N, ...); ``answers``: to the pockets' loads (3N, Z, m).

    A push is even, circumferential, half of it on either face. What free modes and rigid motion
    leave of pushes that move the cage as a whole is stiff: such shapes are left out.
    """
    front, rear = 0, 2  # a pocket's even loads there
    rows = max(len(rows_in(solver.model.info)), 1)
    ahead, behind = (answers[:, :, k].reshape(len(answers), rows, -1) for k in (front, rear))
    pushed = (ahead - np.roll(behind, -1, axis=2)).reshape(len(answers), -1)
    values, shapes = ritz_modes(solver, pushed, away_from=free)
    return shapes[:, values < _STIFF**2 * np.median(values)]


def _mostly(
    solver: FreeBodySolver, shapes: np.ndarray, groups: Mapping[str, np.ndarray]
) -> list[str]:
    """The name of the group of vectors that each of the mass-orthonormal ``shapes`` is most of."""
    spans = [np.linalg.qr(shapes.T @ solver.model.mass_times(v))[0] for v in groups.values()]
    share = [np.sum(span**2, axis=1) for span in spans]
    names = list(groups)
    return [names[k] for k in np.argmax(share, axis=0)]


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
    kept: np.ndarray, kept_stiffness: np.ndarray, loads: sp.csc_matrix, answers: np.ndarray
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Residual attachment vectors Psi (3N, m Z), m a pocket, their stiffness Psi^T K Psi, and how
    much of the deflection under a load is theirs (m Z,). Psi takes the place of ``answers``.

    A vector is the inertia-relieved answer to a pocket load less the part that the kept modes
    carry, so that K-products with all kept modes vanish (mass products too with eigenmodes; static
    shapes are none). It is scaled so that its own load does a work of one on it:
    coordinates are metres of mean face displacement. As K Psi_j is then the load j over its
    scale but for forces that do no work on Psi, the stiffness needs no product with K.
    """
    shapes = answers.reshape(loads.shape)
    work = loads.T @ kept
    carried = work / kept_stiffness
    subtract_product(shapes, kept, carried.T)
    deflection = loads.T @ shapes
    scale = np.diag(deflection)
    shapes /= scale
    stiffness = deflection / np.outer(scale, scale)
    share = scale / (scale + np.sum(carried * work, axis=1))
    return shapes, 0.5 * (stiffness + stiffness.T), share


def pocket_statics(
    solver: FreeBodySolver, pocket_count: int, count: int = LOADS_PER_POCKET
) -> tuple[sp.csc_matrix, np.ndarray]:
    """The first ``count`` loads of every pocket (3N, m Z), and the inertia-relieved answers to them
    (3N, Z, m).

    On a cyclic model the first pocket of a row is solved and turned, otherwise all are solved.
    """
    rows = row_models(solver.model)
    per_row = pocket_count // len(rows)
    symmetry = find_symmetry(solver.model, per_row)
    log.debug("static answers of %d pockets, cyclic symmetry: %s", pocket_count, bool(symmetry))
    every = every_pocket_load(solver.model, pocket_count, count)
    answers = np.empty((solver.model.n_dof, pocket_count, count))
    if symmetry:
        for row in range(len(rows)):
            begin = row * per_row * count
            first = solver.solve(every[:, begin : begin + count].toarray())
            for k in range(per_row):
                answers[:, row * per_row + k] = symmetry.rotate(first, k)
        return every, answers
    flat = answers.reshape(every.shape)
    solver.factor()

    def solve(first: int) -> None:
        some = slice(first, first + _TOGETHER)
        flat[:, some] = solver.solve(every[:, some].toarray())

    on_all_cores(solve, range(0, every.shape[1], _TOGETHER))
    return every, answers


def every_pocket_load(model: FEModel, pocket_count: int, count: int) -> sp.csc_matrix:
    """The first ``count`` loads of every pocket of all rows (3N, m Z)."""
    rows = row_models(model)
    per_row = pocket_count // len(rows)
    loads = [
        sparse_pocket_loads(row, k, per_row, count=count) for row in rows for k in range(per_row)
    ]
    return sp.hstack(loads, format="csc")


def residual_flexibility(
    vectors: np.ndarray, stiffness: np.ndarray, share: np.ndarray, pocket_count: int
) -> ResidualFlexibility:
    """Residual vectors (3N, m Z) with the compliances of their pockets and the coupling cut.

    ``share`` (m Z,): their part of the whole deflection under a load of their own.

    Coordinates a obey stiffness a = Psi^T F. Cutting the coupling between pockets leaves
    a_p = compliance_p Psi_p^T F with the inverse of the pocket's own stiffness block: exact for
    the pocket's own displacement under loads in the span of its m patterns.
    """
    per = len(share) // pocket_count
    blocks = stiffness.reshape(pocket_count, per, pocket_count, per)
    own = np.stack([np.linalg.inv(blocks[k, :, k]) for k in range(pocket_count)])
    pushes, others = coupling(stiffness, share, pocket_count)
    log.debug("coupling cut: %.3f of a push's deflection, %.3f of another load's", pushes, others)
    return ResidualFlexibility(
        shapes=vectors.reshape(-1, 3, vectors.shape[1]),
        stiffness=stiffness,
        compliance=own,
        far_coupling=pushes,
    )


def coupling(stiffness: np.ndarray, share: np.ndarray, pocket_count: int) -> tuple[float, float]:
    """Largest residual deflection that a load makes at other pockets, relative to the whole one
    that it makes where it acts: under even loads, and under the others, which have no resultant.
    """
    scale = np.sqrt(np.diag(stiffness) / share)
    pocket, local = np.divmod(np.arange(len(stiffness)), len(stiffness) // pocket_count)
    different = pocket[:, None] != pocket[None, :]
    ratios = np.where(different, np.abs(stiffness) / np.outer(scale, scale), 0.0)
    even = (local < LOADS["linear"]) & (local % 2 == 0)
    return float(ratios[:, even].max()), float(ratios[:, ~even].max())


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
        carried = inner_products(away_from, model.mass_times(vectors))
        subtract_product(vectors, away_from, carried)
    mass = inner_products(vectors, model.mass_times(vectors))
    scale = 1.0 / np.sqrt(np.diag(mass))
    size, directions = eigh(mass * np.outer(scale, scale))
    good = size > 1e-10 * size[-1]
    vectors = vectors @ (scale[:, None] * directions[:, good] / np.sqrt(size[good]))
    values, turn = eigh(inner_products(vectors, model.K @ vectors))
    return values, vectors @ turn
