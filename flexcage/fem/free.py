"""Static solutions of a free body: loads balanced by the inertia of the motion they cause."""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from flexcage.core.errors import InputError
from flexcage.fem.blocked_products import inner_products, subtract_product
from flexcage.fem.condensed import CondensedRing, find_parts
from flexcage.fem.dissected import DissectedBody
from flexcage.fem.linear import linear_solver
from flexcage.fem.model import FEModel


class FreeBodySolver:
    """Inertia-relieved flexibility of a free body: one factorization, when first needed, and any
    number of loads.

    The stiffness is factored with six dofs held at three distant vertices. A balanced load has
    no reaction there, so the supports leave no trace once the rigid part of the answer is
    removed. The operator is symmetric, and the pseudo-inverse of K in the metric of the mass.
    A ring of sectors is cut into parts that are factored once for every kind (``condensed``), any
    other body as a whole: by dense fronts (``dissected``), or by the linear solver that ``kind``
    names.
    """

    def __init__(self, model: FEModel, *, kind: str = "auto") -> None:
        self.model, self._kind = model, kind
        #: called with the number of loads after every solution, to tell how far a long step is
        self.solved: Callable[[int], None] | None = None

    @cached_property
    def solver(self) -> HeldBody | DissectedBody | CondensedRing:
        """The factored body, held."""
        model, parts = self.model, find_parts(self.model)
        if parts is None and self._kind == "auto" and model.couples_by_elements:
            return DissectedBody(model, _supports(model.points))
        if parts is None:
            return HeldBody(model.K, _supports(model.points), kind=self._kind)
        vertices = np.argwhere(parts.cuts < len(model.points))
        points = model.points[parts.cuts[*vertices.T]]
        held = _supports(points, parts.sectors.turns[vertices[:, 0]])
        return CondensedRing(model, parts, vertices[held // 3], held % 3)

    def factor(self) -> None:
        """Factor the body now: before threads share it, each of which would."""
        self._rigid_and_inertia  # noqa: B018

    def solve(self, loads: np.ndarray) -> np.ndarray:
        """Displacements (3N, m) of nodal loads (3N, m), orthogonal in mass to rigid motions.

        Solves K u = F - M R (R^T F), R the mass-orthonormal rigid motions. The answer to M R is
        kept, so that a load on few nodes stays one.
        """
        work = inner_products(self.model.rigid_modes, loads)
        answer = self.solver.solve(loads)
        rigid = self.model.rigid_part(answer)
        subtract_product(answer, self._rigid_and_inertia, np.concatenate([rigid, work]))
        if self.solved is not None:
            self.solved(loads.shape[1])
        return answer

    def solve_balanced(self, loads: np.ndarray) -> np.ndarray:
        """The same for loads known to be balanced (no work on rigid motions)."""
        return self.model.remove_rigid(self.solver.solve(loads))

    @cached_property
    def _rigid_and_inertia(self) -> np.ndarray:
        """Rigid motions, and answers to their inertia without rigid motion (3N, 12)."""
        rigid = self.model.rigid_modes
        return np.hstack([rigid, self.solve_balanced(self.model.mass_times(rigid))])


class HeldBody:
    """The factored stiffness (3N, 3N) of a body held at the dofs ``held``."""

    def __init__(self, stiffness: sp.csr_matrix, held: np.ndarray, *, kind: str = "auto") -> None:
        self._free = np.setdiff1d(np.arange(stiffness.shape[0]), held)
        self._solver = linear_solver(sp.csr_matrix(stiffness[self._free][:, self._free]), kind=kind)
        self.name = self._solver.name

    def solve(self, loads: np.ndarray) -> np.ndarray:
        """Displacements (3N, m) of nodal loads (3N, m); reactions at the held dofs are free."""
        answer = np.zeros_like(loads, dtype=float)
        answer[self._free] = self._solver.solve(loads[self._free])
        return answer


def _supports(points: np.ndarray, axes: np.ndarray | None = None) -> np.ndarray:
    """Six dofs (3-2-1) at three vertices far apart that hold a body without straining it.

    ``axes`` (n, 3, 3): directions of every vertex's dofs as columns, by default those of the frame.
    """
    centre = points.mean(axis=0)
    first = int(np.argmax(np.linalg.norm(points - centre, axis=1)))
    second = int(np.argmax(np.linalg.norm(points - points[first], axis=1)))
    axis = points[second] - points[first]
    axis /= np.linalg.norm(axis)
    normal = np.cross(points - points[first], axis)
    third = int(np.argmax(np.linalg.norm(normal, axis=1)))
    if np.linalg.norm(normal[third]) < 1e-9 * np.linalg.norm(points[second] - points[first]):
        raise InputError("all mesh points lie on one line", where="mesh", value=len(points))
    axes = np.broadcast_to(np.eye(3), (len(points), 3, 3)) if axes is None else axes
    return _isostatic_dofs(points, axes, (first, second, third))


def _isostatic_dofs(
    points: np.ndarray, axes: np.ndarray, chosen: tuple[int, int, int]
) -> np.ndarray:
    """All of the first vertex and three best-conditioned dofs of the other two."""
    first, second, third = chosen
    candidates = [3 * node + comp for node in (second, third) for comp in range(3)]
    rows = np.array([_rotation_row(points, axes, first, dof) for dof in candidates])
    rows /= np.linalg.norm(points[second] - points[first])
    best, held = 0.0, candidates[:3]
    for i in range(6):
        for j in range(i):
            for k in range(j):
                size = abs(np.linalg.det(rows[[i, j, k]]))
                if size > best * (1.0 + 1e-9):
                    best, held = size, [candidates[i], candidates[j], candidates[k]]
    return np.array([3 * first, 3 * first + 1, 3 * first + 2, *held])


def _rotation_row(points: np.ndarray, axes: np.ndarray, first: int, dof: int) -> np.ndarray:
    """Displacement of a dof under unit rotations about the frame's axes through ``first``."""
    node, comp = divmod(dof, 3)
    return np.cross(np.eye(3), points[node] - points[first]) @ axes[node][:, comp]
