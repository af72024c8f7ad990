"""Stiffness and consistent mass of a mesh; a ring's from one sector of every kind.

The matrices of sectors that differ by a turn are those of one of them, turned. A damaged cage
has few kinds of sectors, and all elements of others need not be touched.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.sparse as sp

from flexcage.fem import elements
from flexcage.fem.elements import BlockPattern
from flexcage.fem.sectors import Sectors

Rule = tuple[np.ndarray, np.ndarray]  # points (3, n) and weights (n,) on the reference element
Matrices = tuple[sp.csr_matrix, sp.csr_matrix]  # stiffness (3N, 3N) and scalar mass (N, N)


@dataclass(frozen=True)
class ElementKind:
    """How element matrices are made: shape functions, rules exact for them, and material."""

    element: Any  # of scikit-fem
    stiffness_rule: Rule
    mass_rule: Rule
    lame: tuple[float, float]  # [Pa]
    density: float  # [kg/m^3]

    def sum(
        self, pattern: BlockPattern, points: np.ndarray, tets: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Stiffness (nnz, 3, 3) and mass (nnz,) of the ``pattern`` of these tetrahedra."""
        gradients, volumes = elements.barycentric_gradients(points, tets)
        stiffness = np.zeros((len(pattern.columns), 3, 3))
        for first in range(0, len(tets), elements.CHUNK):
            part = slice(first, first + elements.CHUNK)
            blocks = elements.stiffness_blocks(
                self.element, self.stiffness_rule, gradients[part], volumes[part], self.lame
            )
            stiffness += pattern.sum_blocks(blocks, first)
        mass = elements.mass_blocks(self.element, self.mass_rule, volumes, self.density)
        return pattern.complete(stiffness), pattern.sum(mass)


def assemble_whole(
    form: ElementKind, points: np.ndarray, tets: np.ndarray, cells: np.ndarray, n_nodes: int
) -> Matrices:
    """Matrices from all elements; ``cells`` (n_tets, 4 or 10) are their nodes."""
    pattern = BlockPattern(cells, n_nodes)
    stiffness, mass = form.sum(pattern, points, tets)
    return pattern.vector(stiffness), pattern.scalar(mass)


def assemble_ring(
    form: ElementKind, points: np.ndarray, tets: np.ndarray, cells: np.ndarray, sectors: Sectors
) -> Matrices:
    """The same of a ring, from the elements of one sector of every kind."""
    n_nodes = len(sectors.image)
    places = sectors.followed(
        np.unique(cells[sectors.cells[0]])
    )  # (count, n_local) nodes of every sector
    vertices = places[:, places[0] < len(points)]
    local = np.empty(n_nodes, np.int64)
    kinds = []
    for alike in sectors.alike(points, vertices):
        first = alike[0]
        local[places[first]] = np.arange(places.shape[1])
        part = sectors.cells[first]
        pattern = BlockPattern(local[cells[part]], places.shape[1])
        kinds.append((alike, pattern, *form.sum(pattern, points, tets[part])))
    pairs = [(places[k], pattern) for alike, pattern, *_ in kinds for k in alike]
    whole = BlockPattern.of_pairs(
        np.concatenate([own[pattern.rows] for own, pattern in pairs]),
        np.concatenate([own[pattern.columns] for own, pattern in pairs]),
        n_nodes,
    )
    stiffness = np.zeros((len(whole.columns), 9))
    mass = np.zeros(len(whole.columns))
    slots = iter(whole.slots.reshape(sectors.count, -1))  # none twice in a sector
    for alike, _, own_stiffness, own_mass in kinds:
        for k in alike:
            turn, own = sectors.turn(k - alike[0]), next(slots)
            stiffness[own] += own_stiffness.reshape(-1, 9) @ np.kron(turn, turn).T
            mass[own] += own_mass
    return whole.vector(whole.complete(stiffness.reshape(-1, 3, 3))), whole.scalar(mass)
