"""Geometric stiffening of a modal basis by the stress of rotation about the x axis."""

from __future__ import annotations

import numpy as np

from flexcage.fem.free import FreeBodySolver
from flexcage.fem.prestress import geometric_stiffness
from flexcage.modes.ritz import centrifugal_load


def spin_stiffness(solver: FreeBodySolver, shapes: np.ndarray) -> np.ndarray:
    """Geometric stiffness (n, n) of shapes (N, 3, n) per squared spin about x [per (rad/s)^2].

    The stress is that of the static answer of the free body to its centrifugal load.
    """
    static = solver.solve(centrifugal_load(solver)[:, None])
    stiffness = geometric_stiffness(solver.model, static)
    reduced = sum(shapes[:, c].T @ (stiffness @ shapes[:, c]) for c in range(3))
    return 0.5 * (reduced + reduced.T)
