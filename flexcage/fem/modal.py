"""Elastic modes of a free body: by harmonics where all sectors are alike, else of the whole."""

from __future__ import annotations

import numpy as np

from flexcage.fem.condensed import CondensedRing
from flexcage.fem.cyclic import cyclic_modes
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.lanczos import lowest_modes

PAIR = 1e-6  # relative distance of omega^2 under which two modes are a pair


def free_modes(solver: FreeBodySolver, count: int) -> tuple[np.ndarray, np.ndarray]:
    """The first ``count`` elastic modes of a free body: (omega^2 (n,), shapes (3N, n)).

    Shapes are mass-orthonormal and orthogonal to the six rigid motions. Where ``count`` would
    cut a pair of equal frequencies in two, the partner is kept too: half a pair would single
    out a direction that a cyclic body does not have.
    """
    ring = solver.solver
    if isinstance(ring, CondensedRing) and ring.is_cyclic:
        values, shapes = cyclic_modes(solver.model, ring, count + 1)
    else:
        values, shapes = lowest_modes(solver.model, solver.solve, count + 1)
    if values[count] > values[count - 1] * (1.0 + PAIR):
        values, shapes = values[:count], shapes[:, :count]
    return values, solver.model.remove_rigid(shapes)
