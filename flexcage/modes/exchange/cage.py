"""A cage's modal basis from a body that was reduced elsewhere, and a body from a basis.

The nodes of the body must be those of the cage's mesh. Three kinds of bodies make a basis:

- full matrices: flexcage reduces them as it does its own (``imported_model``);
- coordinates with shapes: their elastic eigenmodes, the lowest ``modes.count`` of them dynamic.
  What the others yield to loads on pocket faces becomes quasi-static residual flexibility. If it is
  not local, as that of few modes, all are dynamic; in round pockets the interface has the rest;
- coordinates with named kinds, as flexcage writes them: taken as they are.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from flexcage.core.errors import InputError
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.imported import ImportedModel, with_matrices
from flexcage.fem.modal import PAIR
from flexcage.fem.model import FEModel
from flexcage.mesh.cage_mesh import POCKET_GROUPS, pocket_groups
from flexcage.modes.basis import BodyFit, ModeBasis, ResidualFlexibility
from flexcage.modes.exchange.body import MODAL, RESIDUAL, ReducedBody
from flexcage.modes.exchange.cage_checks import WHERE, check_mass, check_modal_mass, match_nodes
from flexcage.modes.exchange.checks import check_free, elastic_modes
from flexcage.modes.pockets import LOADS
from flexcage.modes.ritz import (
    eigen_basis,
    every_pocket_load,
    residual_flexibility,
    residual_vectors,
)
from flexcage.modes.spec import ModesSpec
from flexcage.modes.table import table_loads

_NEGLIGIBLE = 1e-11  # of the largest eigenvalue
_WELL = 1e-8  # least over largest eigenvalue of a pocket's residual flexibility that is inverted
# Higher modes become residual vectors if they are half as many as these, and if the coupling
# between pockets, which is cut, is about that of flexcage's own without its crossbeams' modes: 0.13
# for the cage of the tests.
_SHARE, _FAR = 0.5, 0.15
BODY = "body"  # name of a basis that was taken from one


def imported_model(body: ReducedBody, model: FEModel, spec: ModesSpec) -> ImportedModel:
    """The cage's model with the full matrices of a body; InputError where they do not fit."""
    order = match_nodes(body, model, spec.body_units)
    if len(body.nodes) != len(order):
        raise InputError(
            f"{body.source} has full matrices of {len(body.nodes):,} nodes, and the cage's mesh "
            f"with mesh.order = {model.order} has {len(order):,}; give both the same elements.",
            where=WHERE,
            value=len(body.nodes),
        )
    check_free(body, where=WHERE)
    check_mass(body, model, spec.body_units)
    return with_matrices(model, body.stiffness, body.mass, order)


def basis_from_body(
    body: ReducedBody, solver: FreeBodySolver, *, pocket_count: int, spec: ModesSpec
) -> ModeBasis:
    """Modal basis of a reduced body with shapes; InputError where it does not fit the cage.

    ``solver`` is the free body of the cage's own elements, which the fit is measured by.
    """
    model = solver.model
    order = match_nodes(body, model, spec.body_units)
    check_free(body, where=WHERE)
    if body.shapes is None:
        raise InputError(
            f"{body.source} has stiffness and mass of {body.size} coordinates, but not how they "
            "move the nodes of the cage's mesh; write their shapes as a matrix SHAPES, three rows "
            "a node, or the full matrices of all nodes.",
            where=WHERE,
        )
    check_mass(body, model, spec.body_units)
    shapes = body.shapes[order]
    if not body.kind:
        modes = _eigenmodes(body, shapes, model)
        mass = check_modal_mass(body.source, np.ones(len(modes[0])), _masses(modes[1], model))
        basis = _of_eigenmodes(modes, model, pocket_count, spec)
        return _fitted(basis, solver, pocket_count, mass)
    mass = check_modal_mass(body.source, np.diag(body.dense()[1]), _masses(shapes, model))
    if RESIDUAL in body.kind:
        basis = _as_named(body, shapes, model, pocket_count)
    else:
        basis = _named(body, shapes, np.arange(body.size))
    return _fitted(basis, solver, pocket_count, mass)


def _masses(shapes: np.ndarray, model: FEModel) -> np.ndarray:
    """Mass (n,) that shapes (N, 3, n), or (3N, n), make with the cage's own elements."""
    flat = shapes.reshape(model.n_dof, -1)
    return np.einsum("ij,ij->j", flat, model.mass_times(flat))


def _named(body: ReducedBody, shapes: np.ndarray, kept: np.ndarray) -> ModeBasis:
    """The basis of the coordinates ``kept``, as they are."""
    stiffness, mass = (m[np.ix_(kept, kept)] for m in body.dense())
    return ModeBasis(
        name=BODY,
        shapes=np.ascontiguousarray(shapes[:, :, kept]),
        stiffness=stiffness,
        mass=mass,
        frequencies=np.sqrt(np.diag(stiffness) / np.diag(mass)) / (2.0 * np.pi),
        kind=tuple(body.kind[k] for k in kept),
    )


def _as_named(
    body: ReducedBody, shapes: np.ndarray, model: FEModel, pocket_count: int
) -> ModeBasis:
    """Dynamic and residual coordinates as the file names them."""
    residual = np.array(body.kind) == RESIDUAL
    basis = _named(body, shapes, np.flatnonzero(~residual))
    count = int(residual.sum())
    per = count // pocket_count
    if (
        pocket_groups(model.groups) != POCKET_GROUPS
        or count != per * pocket_count
        or (per not in LOADS.values())
    ):
        raise InputError(
            f"{body.source} has {count} residual coordinates, but a cage of {pocket_count} pockets "
            f"has {' or '.join(str(n * pocket_count) for n in LOADS.values())} if its pockets have "
            "faces, and none if they are round; leave KIND out.",
            where=WHERE,
            value=count,
        )
    stiffness = body.dense()[0][np.ix_(residual, residual)]
    vectors = np.ascontiguousarray(shapes[:, :, residual]).reshape(model.n_dof, count)
    loads = every_pocket_load(model, pocket_count, per)
    work = loads.T @ basis.shapes.reshape(model.n_dof, -1)
    own = 1.0 / np.diag(stiffness)
    share = own / (own + np.einsum("ij,ij->i", work, np.linalg.solve(basis.stiffness, work.T).T))
    return replace(basis, residual=residual_flexibility(vectors, stiffness, share, pocket_count))


def _eigenmodes(
    body: ReducedBody, shapes: np.ndarray, model: FEModel
) -> tuple[np.ndarray, np.ndarray]:
    """Squared angular frequencies (m,) and shapes (3N, m) of the body's elastic modes."""
    values, turns = elastic_modes(body, where=WHERE)
    if len(values) < 1:
        raise InputError(
            f"{body.source} has rigid motions alone; write modes as well.", where=WHERE
        )
    return values, shapes.reshape(model.n_dof, -1) @ turns


def _of_eigenmodes(
    modes: tuple[np.ndarray, np.ndarray], model: FEModel, pocket_count: int, spec: ModesSpec
) -> ModeBasis:
    values, every = modes
    n = _dynamic_count(values, spec)
    residual = None
    if pocket_groups(model.groups) == POCKET_GROUPS and n < len(values):
        residual = _rest_as_residual(every, values, n, model, pocket_count, LOADS[spec.attachments])
        n = n if residual else len(values)
    return eigen_basis(BODY, every[:, :n], values[:n], ["elastic"] * n, residual)


def _rest_as_residual(
    modes: np.ndarray, values: np.ndarray, n: int, model: FEModel, pocket_count: int, per: int
) -> ResidualFlexibility | None:
    """What the modes (3N, m) from the n-th on yield to ``per`` loads on every pocket, quasi-static;
    None if they hold fewer vectors a pocket, or couple pockets by more than may be cut."""
    rest = modes[:, n:]
    if rest.shape[1] < _SHARE * per * pocket_count:
        return None
    loads = every_pocket_load(model, pocket_count, per)
    work = loads.T @ rest
    blocks = work.reshape(pocket_count, per, -1)
    own = np.einsum("pim,m,pjm->pij", blocks, 1.0 / values[n:], blocks)
    size = np.sqrt(np.einsum("pii->pi", own))
    spread = np.linalg.eigvalsh(own / np.maximum(size[:, :, None] * size[:, None, :], 1e-300))
    if (spread[:, 0] < _WELL * spread[:, -1]).any():
        return None
    answers = (rest / values[n:]) @ work.T
    vectors, stiffness, _ = residual_vectors(modes[:, :0], values[:0], loads, answers)
    kept = loads.T @ modes[:, :n]
    scale = 1.0 / np.diag(stiffness)
    share = scale / (scale + np.sum(kept**2 / values[:n], axis=1))
    made = residual_flexibility(vectors, stiffness, share, pocket_count)
    return made if made.far_coupling < _FAR else None


def _dynamic_count(values: np.ndarray, spec: ModesSpec) -> int:
    """How many of the elastic modes are dynamic; a pair of equal frequency is not cut in two."""
    if spec.dynamic == "all" or spec.count >= len(values):
        return len(values)
    n = spec.count
    return n + int(values[n] <= values[n - 1] * (1.0 + PAIR))


def _fitted(basis: ModeBasis, solver: FreeBodySolver, pocket_count: int, mass: float) -> ModeBasis:
    """The basis with what it misses beside the cage's own elements; ``mass`` as ``BodyFit``."""
    model = solver.model
    flat = basis.shapes.reshape(model.n_dof, -1)
    own = np.einsum("ij,ij->j", flat, model.K @ flat)
    _, loads = table_loads(model, pocket_count)
    whole = np.einsum("ij,ij->j", loads, solver.solve(loads))
    work = flat.T @ loads
    carried = np.sum(work * np.linalg.solve(basis.stiffness, work), axis=0)
    if basis.residual is not None:
        assert basis.residual.shapes is not None, "it was just made"
        pull = basis.residual.shapes.reshape(model.n_dof, -1).T @ loads
        carried += np.sum(pull * np.linalg.solve(basis.residual.stiffness, pull), axis=0)
    stiffer = np.diag(basis.stiffness) / own
    return replace(
        basis,
        fit=BodyFit(
            stiffness=float(stiffer[np.argmax(np.abs(np.log(stiffer)))]),
            carried=float((carried / whole).min()),
            compliance=float(whole[0]),
            mass=mass,
        ),
    )


def body_of(basis: ModeBasis, model: FEModel) -> ReducedBody:
    """The body that a basis is: its dynamic modes, then its residual vectors.

    Masses of residual vectors, which motion leaves out, and their coupling to the modes are those
    of their shapes.
    """
    shapes, stiffness, mass = basis.shapes, basis.stiffness, basis.mass
    kind = basis.kind
    if basis.residual is not None:
        assert basis.residual.shapes is not None, "a body is made of a basis with all its shapes"
        n, more = basis.size, basis.residual.shapes.shape[2]
        shapes = np.concatenate([shapes, basis.residual.shapes], axis=2)
        flat = shapes.reshape(model.n_dof, -1)
        mass = flat.T @ model.mass_times(flat)
        mass[:n, :n] = basis.mass
        stiffness = np.zeros((n + more, n + more))
        stiffness[:n, :n] = basis.stiffness
        stiffness[n:, n:] = _definite(basis.residual.stiffness)
        kind = (*kind, *[RESIDUAL] * more)
    return ReducedBody(
        stiffness=stiffness,
        mass=0.5 * (mass + mass.T),
        nodes=model.nodes,
        dofs=np.tile([MODAL, 0], (len(kind), 1)),
        shapes=shapes,
        kind=kind,
        cells=model.cells,
    )


def _definite(stiffness: np.ndarray) -> np.ndarray:
    """A symmetric matrix whose negative eigenvalues, which are rounding, are positive: combinations
    of residual vectors that answer loads of a rigid motion have next to no stiffness, of either
    sign. One that has no such eigenvalue stays to the bit."""
    values, vectors = np.linalg.eigh(stiffness)
    if values[0] > -_NEGLIGIBLE * values[-1]:
        return stiffness
    below = vectors * np.minimum(values, 0.0) @ vectors.T
    return stiffness - (below + below.T)


def full_body_of(model: FEModel) -> ReducedBody:
    """The body that a model is before reduction: stiffness and consistent mass of all nodes."""
    count = len(model.nodes)
    return ReducedBody(
        stiffness=model.K,
        mass=sp.kron(model.mass_scalar, sp.eye_array(3)).tocsr(),
        nodes=model.nodes,
        dofs=np.stack(np.divmod(np.arange(3 * count), 3), axis=1),
        cells=model.cells,
    )
