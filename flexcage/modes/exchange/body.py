"""A body as another program, or this one, reduced it: matrices, nodes, and what moves them.

The one value that an import returns, for cages, rings and housings alike. In SI.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType
from typing import Any

import numpy as np
import scipy.sparse as sp

Matrix = Any  # (n, n) array, or a sparse matrix of a body that nobody reduced

MODAL = -1  # node of a coordinate that belongs to none
RESIDUAL = "residual"  # kind of quasi-static coordinates


@dataclass(frozen=True, kw_only=True)
class ReducedBody:
    """``n`` coordinates of a body with ``N`` nodes, in SI and the frame of its nodes.

    ``stiffness`` and ``mass`` act on the coordinates; ``mass`` is None where a file has none (a
    body for statics). ``gyroscopic`` is skew, G of M q'' + w G q' + K q = f where the body spins by
    w about +x, None where a file has none. ``dofs[j]`` is (node, component) of coordinate j,
    components 0 to 5 being translations and rotations about x, y, z; the node of a modal
    coordinate is ``MODAL``.
    ``shapes`` are displacements of the nodes for a unit of each coordinate, None where the file
    has none. ``kind`` names every coordinate (those of ``ModeBasis``, and ``RESIDUAL``), or
    is empty. ``cells`` are elements, if any; ``interface`` names sets of nodes.
    """

    stiffness: Matrix  # (n, n)
    mass: Matrix | None  # (n, n)
    nodes: np.ndarray  # (N, 3) [m]
    dofs: np.ndarray  # (n, 2)
    shapes: np.ndarray | None = None  # (N, 3, n)
    kind: tuple[str, ...] = ()
    cells: np.ndarray | None = None  # (m, corners)
    interface: Mapping[str, np.ndarray] = field(default_factory=lambda: MappingProxyType({}))
    numbers: np.ndarray | None = None  # (N,) of the nodes in the file
    source: str = ""  # the file, for sentences
    gyroscopic: Matrix | None = None  # (n, n)

    def __repr__(self) -> str:
        what = "full matrices" if self.is_full else f"{self.size} coordinates"
        return (
            f"ReducedBody({len(self.nodes):,} nodes, {what}{', ' * bool(self.source)}{self.source})"
        )

    @property
    def size(self) -> int:
        """Number of coordinates."""
        return self.stiffness.shape[0]

    @cached_property
    def is_full(self) -> bool:
        """Whether coordinates are the three translations of every node: nothing was reduced."""
        every = np.stack(np.divmod(np.arange(3 * len(self.nodes)), 3), axis=1)
        return self.dofs.shape == every.shape and bool((self.dofs == every).all())

    @cached_property
    def boundary(self) -> np.ndarray:
        """Nodes (m,) that have coordinates of their own."""
        return np.unique(self.dofs[self.dofs[:, 0] != MODAL, 0])

    @cached_property
    def rigid(self) -> np.ndarray | None:
        """Coordinates (n, 6) of unit rigid motions: translations, then rotations about the origin.

        Those of dofs follow from where their nodes are, and modal coordinates, fixed-interface
        modes, are zero. Without dofs the motions are sought among the shapes; None where these do
        not hold all six.
        """
        if len(self.boundary):
            return self._rigid_of_dofs()
        return None if self.shapes is None else self._rigid_of_shapes(self.shapes)

    def _rigid_of_dofs(self) -> np.ndarray:
        motions = rigid_motions(self.nodes)
        found = np.zeros((self.size, 6))
        own = np.flatnonzero(self.dofs[:, 0] != MODAL)
        node, component = self.dofs[own].T
        turns = component >= 3
        found[own[~turns]] = motions[node[~turns], component[~turns]]
        found[own[turns], component[turns]] = 1.0
        return found

    def _rigid_of_shapes(self, shapes: np.ndarray) -> np.ndarray | None:
        motions = rigid_motions(self.nodes).reshape(-1, 6)
        found, *_ = np.linalg.lstsq(shapes.reshape(len(motions), -1), motions, rcond=None)
        missed = np.linalg.norm(shapes.reshape(len(motions), -1) @ found - motions, axis=0)
        held = missed <= 1e-6 * np.linalg.norm(motions, axis=0)
        return found if held.all() else None

    def dense(self) -> tuple[np.ndarray, np.ndarray]:
        """Stiffness and mass (n, n) as arrays, symmetric; mass zero where there is none."""
        both = (self.stiffness, self.mass)
        arrays = [m.toarray() if sp.issparse(m) else m for m in both if m is not None]
        stiffness, *mass = (0.5 * (m + m.T) for m in map(np.asarray, arrays))
        return stiffness, mass[0] if mass else np.zeros_like(stiffness)


def rigid_motions(nodes: np.ndarray) -> np.ndarray:
    """Displacements (N, 3, 6) of nodes (N, 3) in unit translations along x, y, z and unit rotations
    about them, through the origin."""
    motions = np.zeros((len(nodes), 3, 6))
    for axis in range(3):
        motions[:, axis, axis] = 1.0
        motions[:, :, 3 + axis] = np.cross(np.eye(3)[axis], nodes)
    return motions
