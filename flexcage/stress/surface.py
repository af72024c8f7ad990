"""Stress at points of a cage's surface: the mesh's vertices, and more than those on fillets."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from flexcage.fem.model import FEModel
from flexcage.stress.fillets import Fillet
from flexcage.stress.operators import VertexStress, von_mises


class SurfaceStress:
    """Smoothed stress at mesh ``vertices`` (rising), on fillets at the points of their submodels.

    ``owner`` (n_points,), rising: the vertex of each point, on a fillet the nearest one.
    """

    def __init__(self, model: FEModel, vertices: np.ndarray, fillets: Sequence[Fillet]) -> None:
        self._fillets = [f for f in fillets if np.isin(f.vertices, vertices).all()]
        covered = [f.vertices for f in self._fillets]
        plain = np.setdiff1d(vertices, np.concatenate(covered)) if covered else vertices
        owner = np.concatenate([plain, *(f.owner for f in self._fillets)])
        self._order = np.argsort(owner, kind="stable")
        self._plain = VertexStress(model, plain)
        self.owner = owner[self._order]
        self._first = np.searchsorted(self.owner, vertices)

    def __call__(self, fields: np.ndarray, forces: np.ndarray | None = None) -> np.ndarray:
        """Stresses (n_points, m, 6) [Pa] of displacements (N, 3, m) [m]; ``forces``
        (Z, F, n_st, 3, m) [N] are those at the stations, in the pockets' frames."""
        corners = [fillet.stress(fields, forces) for fillet in self._fillets]
        return np.concatenate([self._plain(fields), *corners])[self._order]

    def largest(self, values: np.ndarray) -> np.ndarray:
        """Largest of the points' values (n_points, ...) at every vertex (n_vertices, ...)."""
        return np.maximum.reduceat(values, self._first, axis=0) if len(values) else values

    def worst(self, stress: np.ndarray) -> np.ndarray:
        """Stresses (n_vertices, 6) of each vertex's most stressed point, of (n_points, 6)."""
        equivalent = von_mises(stress)
        order = np.lexsort((equivalent, self.owner))  # the last of a vertex is its largest
        last = np.append(self._first[1:], len(self.owner)) - 1
        return stress[order[last]]
