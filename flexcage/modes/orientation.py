"""Signs of modes, and directions among modes of equal frequency, fixed by rule.

An eigenvector is known up to its sign, and eigenvectors of one eigenvalue up to a turn among
themselves: which of them a solver returns depends on the processor and on the release of its
libraries. The rule below looks at how the walls of the pockets move, from pocket 0 on. (The largest
entry of a shape would not do: on a cyclic cage every pocket has one, equal but for rounding.)
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import scipy.sparse as sp

from flexcage.fem.model import FEModel
from flexcage.mesh.cage_mesh import pocket_groups
from flexcage.modes.basis import ModeBasis

_EQUAL = 1e-7  # relative distance of omega^2 under which two modes are turned together
_SEEN = 0.01  # of the largest motion of any wall: a smaller one decides nothing


def oriented(basis: ModeBasis, model: FEModel, pocket_count: int) -> ModeBasis:
    """The basis with the signs and directions of its modes fixed by rule.

    The first motion of a pocket's wall that a mode has (``wall_motions``, in their order) is
    positive. Of modes of equal frequency the first takes all of that motion, the second all of the
    next one that is left, and so on. A basis with coupled modes stays as it is: its vectors are no
    eigenvectors.
    """
    if not (_diagonal(basis.stiffness) and _diagonal(basis.mass)):
        return basis
    rows = wall_motions(model, pocket_count)
    motions = rows @ basis.shapes.reshape(model.n_dof, basis.size)
    shapes, geometric = basis.shapes.copy(), basis.geometric
    whole = np.zeros((basis.size, basis.size))
    for together in _equal_frequencies(basis):
        turn = _turn(motions[:, together])
        shapes[:, :, together] = basis.shapes[:, :, together] @ turn
        whole[np.ix_(together, together)] = turn
    if geometric is not None:
        geometric = whole.T @ geometric @ whole
    return replace(basis, shapes=shapes, geometric=geometric)


def wall_motions(model: FEModel, pocket_count: int) -> sp.csr_matrix:
    """Rows (n, 3N) that take motions of the pockets' walls from nodal displacements.

    Pocket by pocket and group by group: the mean displacement along x, y and z, and the same
    weighted with the distance from the wall's centre along x, y and z, relative to its size.
    """
    parts = pocket_groups(model.groups)
    names = [f"pocket{k}_{part}" for k in range(pocket_count) for part in parts]
    blocks = []
    for name in names:
        nodes = np.unique(model.groups.get(name, np.empty((0, 3), np.int64)))
        if not len(nodes):
            continue
        arm = model.points[nodes] - model.points[nodes].mean(axis=0)
        weights = np.vstack([np.ones(len(nodes)), arm.T / max(float(np.abs(arm).max()), 1e-300)])
        place = sp.csr_matrix(
            (np.ones(len(nodes)), (np.arange(len(nodes)), nodes)),
            shape=(len(nodes), len(model.nodes)),
        )
        blocks.append(sp.kron(sp.csr_matrix(weights / len(nodes)) @ place, sp.eye_array(3)))
    return sp.csr_matrix(sp.vstack(blocks)) if blocks else sp.csr_matrix((0, model.n_dof))


def _diagonal(matrix: np.ndarray) -> bool:
    return not np.any(matrix - np.diag(np.diag(matrix)))


def _equal_frequencies(basis: ModeBasis) -> list[list[int]]:
    """Numbers of the modes of one kind that share a frequency, together; most stand alone."""
    squares = np.diag(basis.stiffness) / np.diag(basis.mass)
    found: list[list[int]] = []
    for i, square in enumerate(squares):
        near = found and basis.kind[found[-1][-1]] == basis.kind[i]
        if near and abs(square - squares[found[-1][-1]]) <= _EQUAL * square:
            found[-1].append(i)
        else:
            found.append([i])
    return found


def _turn(motions: np.ndarray) -> np.ndarray:
    """Orthogonal (m, m) that turns modes with ``motions`` (n, m) of walls as the rule says."""
    count = motions.shape[1]
    turn: np.ndarray = np.zeros((count, 0))
    seen = _SEEN * np.linalg.norm(motions, axis=1).max(initial=0.0)
    for row in motions:
        if turn.shape[1] == count:
            break
        left = row - turn @ (turn.T @ row)
        size = np.linalg.norm(left)
        if size > seen and size > 0.0:
            turn = np.column_stack([turn, left / size])
    if turn.shape[1] < count:  # no wall moves: what is left keeps the solver's choice
        rest = np.linalg.svd(turn, full_matrices=True)[0][:, turn.shape[1] :]
        turn = np.column_stack([turn, rest])
    return turn
