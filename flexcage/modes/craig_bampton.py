"""Craig-Bampton basis over generalised interface displacements of the pocket faces.

Interface coordinate j is the work-conjugate displacement b_j^T u of pocket load j (mean, first
and, with quadratic attachments, second moment of the face's normal displacement), so that faces
stay flexible in themselves.
Constraint modes move one of them and hold the others; fixed-interface modes hold all. Both come
from the flexibility of the free body, with the rigid motion as an unknown of a small system.
The six rigid motions in their span are removed and the rest made mass-orthonormal.
"""

from __future__ import annotations

import numpy as np
from scipy.linalg import lu_factor, lu_solve

from flexcage.fem.free import FreeBodySolver
from flexcage.fem.lanczos import lowest_modes
from flexcage.modes.basis import ModeBasis
from flexcage.modes.lands import land_vectors
from flexcage.modes.pockets import LOADS, LOADS_PER_POCKET, check_groups
from flexcage.modes.ritz import eigen_basis, pocket_statics, ritz_modes
from flexcage.modes.spec import ModesSpec


def build(solver: FreeBodySolver, *, pocket_count: int, spec: ModesSpec) -> ModeBasis:
    """Constraint modes of all pocket faces and ``spec.count`` fixed-interface modes.

    ``spec.land`` adds static land vectors; all are mixed into one mass-orthonormal basis.
    """
    check_groups(solver.model, pocket_count)
    held = HeldInterface(solver, pocket_count, LOADS[spec.attachments])
    _, fixed = lowest_modes(solver.model, held.flexibility, spec.count)
    vectors = np.column_stack([held.constraint_modes(), fixed])
    values, shapes = ritz_modes(solver, vectors)
    elastic = values > 1e-6 * np.median(values)
    values, shapes = values[elastic], shapes[:, elastic]
    if spec.land:
        lands = land_vectors(solver, shapes, values)
        values, shapes = ritz_modes(solver, np.column_stack([shapes, lands]))
    return eigen_basis("craig_bampton", shapes, values, ["constraint"] * len(values))


class HeldInterface:
    """The body held at its generalised interface displacements B^T u = 0, ``count`` a pocket."""

    def __init__(
        self, solver: FreeBodySolver, pocket_count: int, count: int = LOADS_PER_POCKET
    ) -> None:
        self._solver = solver
        model = solver.model
        self._loads, answers = pocket_statics(solver, pocket_count, count)
        self._static = answers.reshape(self._loads.shape)
        self._rigid = model.rigid_modes
        motion = self._loads.T @ self._rigid
        compliance = self._loads.T @ self._static
        compliance = 0.5 * (compliance + compliance.T)
        corner = np.zeros((6, 6))
        self._system = lu_factor(np.block([[compliance, motion], [motion.T, corner]]))

    def constraint_modes(self) -> np.ndarray:
        """Displacements (3N, m Z) that move one interface coordinate by one, the others not."""
        n = self._loads.shape[1]
        answer = lu_solve(self._system, np.vstack([np.eye(n), np.zeros((6, n))]))
        return self._static @ answer[:n] + self._rigid @ answer[n:]

    def flexibility(self, loads: np.ndarray) -> np.ndarray:
        """Displacements of the held body under nodal loads (3N, m)."""
        n = self._loads.shape[1]
        free = self._solver.solve(loads)
        target = np.vstack([-self._loads.T @ free, -self._rigid.T @ loads])
        answer = lu_solve(self._system, target)
        return free + self._static @ answer[:n] + self._rigid @ answer[n:]
