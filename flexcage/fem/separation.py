"""How the matching surfaces of elastic bodies separate, with all else eliminated.

At every place that nodes of two or three bodies share, the motion of the first one's node stays a
motion; those of the others are counted from it. These differences, the separations, are
all that contact depends on. Every other unknown is eliminated once, by nested dissection and dense
fronts (``dissection``, ``fronts``); what is left is a small full matrix.
"""

from __future__ import annotations

import logging
import time
from collections.abc import Iterable

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from flexcage.fem.condensed import dofs_of
from flexcage.fem.dissection import dissect
from flexcage.fem.fronts import Elimination

log = logging.getLogger(__name__)


class SeparationModel:
    """Bodies of stiffness K (3n, 3n) with nodes (n, 3) and elements ``cells`` (m, k), whose
    ``surfaces`` are pairs of arrays of nodes at the same places. The dofs ``held`` do not move.

    ``springs`` [N/m] hold every dof, so weakly that they carry no load. ``stiffness`` (d, d) is
    that of the separations.
    """

    def __init__(
        self,
        K: sp.csr_matrix,
        nodes: np.ndarray,
        cells: np.ndarray,
        surfaces: Iterable[tuple[np.ndarray, np.ndarray]],
        held: np.ndarray,
        *,
        springs: float,
    ) -> None:
        started = time.perf_counter()
        self.nodes, self.springs = nodes, springs
        base = _bases(len(nodes), surfaces)
        separating = np.flatnonzero(base != np.arange(len(nodes)))
        self._onto = _from_bases(base, separating)
        rest = np.setdiff1d(np.arange(len(nodes)), separating)
        blocks = dissect(
            nodes[cells[:, :4]].mean(axis=1), np.concatenate([cells, base[cells]], axis=1), rest
        )
        order = dofs_of(rest[np.concatenate(blocks)])
        free = ~np.isin(order, held)
        of_block = np.repeat(np.arange(len(blocks)), [3 * len(block) for block in blocks])
        sizes = np.bincount(of_block[free], minlength=len(blocks))
        self._order = np.concatenate([order[free], dofs_of(separating)])
        whole = K + springs * sp.identity(K.shape[0], format="csr")
        matrix = (self._onto.T @ whole @ self._onto).tocsr()[self._order][:, self._order]
        matrix.sum_duplicates()
        self._elimination = Elimination(matrix, sizes[sizes > 0])
        self._first = self._elimination.eliminated
        left = matrix[self._first :, self._first :].toarray()
        self.stiffness = left + self._elimination.schur
        seconds = time.perf_counter() - started
        log.debug("parted %d unknowns, %d left, in %.1f s", K.shape[0], len(left), seconds)

    def of_separations(self, rows: sp.csr_matrix) -> sp.csr_matrix:
        """Rows (q, 3n) that depend on separations alone, by these: (q, d)."""
        return (rows @ self._onto).tocsc()[:, self._order[self._first :]].tocsr()

    def condensed(self, loads: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Loads (d,) on the separations that nodal loads (n, 3) amount to, and what ``expanded``
        wants."""
        fields = (self._onto.T @ loads.ravel())[self._order][:, None]
        self._elimination.condense(fields)
        return fields[self._first :, 0].copy(), fields

    def expanded(self, separations: np.ndarray, fields: np.ndarray) -> np.ndarray:
        """Displacements (n, 3) of all nodes at these separations, under the loads of ``fields``."""
        fields[self._first :, 0] = separations
        self._elimination.expand(fields)
        moved = np.zeros(self._onto.shape[1])
        moved[self._order] = fields[:, 0]
        return np.asarray(self._onto @ moved).reshape(-1, 3)


def _bases(n: int, surfaces: Iterable[tuple[np.ndarray, np.ndarray]]) -> np.ndarray:
    """The node (n,) that every node's motion is counted from: the first of those at its place."""
    pairs = np.vstack([np.stack([a.ravel(), b.ravel()], axis=1) for a, b in surfaces])
    graph = sp.coo_matrix((np.ones(len(pairs)), tuple(pairs.T)), (n, n))
    _, place = connected_components(graph, directed=False)
    first = np.full(place.max() + 1, n)
    np.minimum.at(first, place, np.arange(n))
    return np.asarray(first[place])


def _from_bases(base: np.ndarray, separating: np.ndarray) -> sp.csr_matrix:
    """Motions (3n,) by those of the bases and the separations: the identity, and the base's motion
    added to every separation."""
    ones = np.ones(3 * len(separating))
    rows, columns = dofs_of(separating), dofs_of(base[separating])
    size = 3 * len(base)
    extra = sp.csr_matrix((ones, (rows, columns)), (size, size))
    return (sp.identity(size, format="csr") + extra).tocsr()
