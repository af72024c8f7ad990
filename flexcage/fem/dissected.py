"""Static solutions of any body as a whole, by nested dissection and dense fronts.

A mesh that does not repeat cannot share factors between its sectors. Its unknowns are eliminated
block by block in the order of a nested dissection of its nodes (``dissection``, ``fronts``). On a
freely meshed N1013 cage of 297,000 unknowns this factors as fast as CHOLMOD, and solves 64
right-hand sides together in an eighth of its time. A load on few nodes costs half of that: blocks
that no load reaches are ignored.
"""

from __future__ import annotations

import logging
import time

import numpy as np

from flexcage.fem.condensed import dofs_of
from flexcage.fem.dissection import dissect
from flexcage.fem.fronts import Elimination
from flexcage.fem.linear import check_factor
from flexcage.fem.model import FEModel

log = logging.getLogger(__name__)

_TOGETHER = 64  # right-hand sides that are solved at once: bounds the memory
_HOLLOW = 0.5  # least radius over the largest, above which a body is cut as a ring


class DissectedBody:
    """The factored stiffness of a body held at the dofs ``held`` (6,)."""

    def __init__(self, model: FEModel, held: np.ndarray) -> None:
        started = time.perf_counter()
        middles = _places(model.points[model.tets].mean(axis=1))
        blocks = dissect(middles, model.cells, np.arange(len(model.nodes)))
        order = dofs_of(np.concatenate(blocks))
        free = ~np.isin(order, held)
        of_block = np.repeat(np.arange(len(blocks)), [3 * len(block) for block in blocks])
        sizes = np.bincount(of_block[free], minlength=len(blocks))
        self._order = np.append(order[free], held)
        self._back = np.argsort(self._order)
        matrix = model.K[self._order][:, self._order]
        self._elimination = Elimination(matrix, sizes[sizes > 0])
        self.name = f"dense fronts, {len(blocks)} blocks"
        check_factor(self.solve, model.K, held)
        seconds = time.perf_counter() - started
        log.debug("factored %d unknowns with %s in %.1f s", model.n_dof, self.name, seconds)

    def solve(self, loads: np.ndarray) -> np.ndarray:
        """Displacements (3N, m) of nodal loads (3N, m); reactions at the held dofs are free."""
        columns = np.asarray(loads, float).reshape(len(loads), -1)
        answer = np.empty_like(columns)
        for first in range(0, columns.shape[1], _TOGETHER):
            some = slice(first, first + _TOGETHER)
            fields = columns[:, some].take(self._order, axis=0)
            self._elimination.condense(fields)
            fields[self._elimination.eliminated :] = 0.0
            self._elimination.expand(fields)
            answer[:, some] = fields.take(self._back, axis=0)
        return answer.reshape(loads.shape)


def _places(points: np.ndarray) -> np.ndarray:
    """Coordinates (n, 3) across which a body is cut: x, r, psi of a ring about x, else x, y, z."""
    radius = np.hypot(points[:, 1], points[:, 2])
    if radius.min() < _HOLLOW * radius.max():
        return points
    return np.stack([points[:, 0], radius, np.arctan2(points[:, 2], points[:, 1])], axis=1)
