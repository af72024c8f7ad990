"""Matrices of straight (affine) tetrahedra, for all elements at once.

On an affine tetrahedron every shape gradient is a fixed combination of the four gradients of
the barycentric coordinates, so that the integral of dN_i/dx_a dN_j/dx_b over all elements is
one matrix product of a constant table with the outer products of those four gradients. This is
exact and about ten times faster than a loop over quadrature points and strain components; shape
functions, quadrature and numbering are scikit-fem's.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

CHUNK = 20_000  # elements at a time: bounds the memory of dense element matrices


def reference_gradients(element, points: np.ndarray) -> np.ndarray:
    """Reference shape gradients as combinations of barycentric ones: (n_shape, 4, n_points)."""
    gradients = [element.lbasis(points, i)[1] for i in range(element_size(element))]
    stacked = np.stack(gradients)  # (n_shape, 3, n_points): xi_1..3 are barycentric 2..4
    return np.concatenate([np.zeros_like(stacked[:, :1]), stacked], axis=1)


def element_size(element) -> int:
    """Number of shape functions of a scalar element."""
    return len(element.doflocs)


def barycentric_gradients(points: np.ndarray, tets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Gradients (n_tets, 4, 3) of the barycentric coordinates, and volumes (n_tets,) > 0."""
    corners = points[tets]
    jacobian = corners[:, 1:] - corners[:, :1]  # rows: edge vectors
    determinant = np.linalg.det(jacobian)
    inverse = np.linalg.inv(jacobian)  # column m: gradient of coordinate m + 1
    gradients = np.empty((len(tets), 4, 3))
    gradients[:, 1:] = inverse.transpose(0, 2, 1)
    gradients[:, 0] = -gradients[:, 1:].sum(axis=1)
    return gradients, np.abs(determinant) / 6.0


def stiffness_blocks(
    element, quadrature, gradients: np.ndarray, volumes: np.ndarray, lame: tuple[float, float]
) -> np.ndarray:
    """Element stiffness (n_tets, n_shape, n_shape, 3, 3) of isotropic linear elasticity."""
    points, weights = quadrature
    table = reference_gradients(element, points)
    n = table.shape[0]
    constant = np.einsum("imq,jnq,q->ijmn", table, table, weights / weights.sum())
    outer = np.einsum("ema,enb,e->mneab", gradients, gradients, volumes, optimize=True)
    dyad = (constant.reshape(n * n, 16) @ outer.reshape(16, -1)).reshape(n, n, -1, 3, 3)
    dyad = np.ascontiguousarray(dyad.transpose(2, 0, 1, 3, 4))
    first, shear = lame
    blocks = first * dyad + shear * dyad.transpose(0, 1, 2, 4, 3)
    trace = shear * np.einsum("eijaa->eij", dyad)
    for axis in range(3):
        blocks[..., axis, axis] += trace
    return blocks


def mass_blocks(element, quadrature, volumes: np.ndarray, density: float) -> np.ndarray:
    """Scalar consistent element mass (n_tets, n_shape, n_shape)."""
    points, weights = quadrature
    values = np.stack([element.lbasis(points, i)[0] for i in range(element_size(element))])
    reference = np.einsum("iq,jq,q->ij", values, values, weights / weights.sum())
    return density * volumes[:, None, None] * reference


class BlockPattern:
    """Node-to-node sparsity of a mesh; sums element blocks into it without sorting again."""

    def __init__(self, cells: np.ndarray, n_nodes: int) -> None:
        n = cells.shape[1]
        self._number(np.repeat(cells, n, axis=1).ravel(), np.tile(cells, (1, n)).ravel(), n_nodes)

    @classmethod
    def of_pairs(cls, rows: np.ndarray, columns: np.ndarray, n_nodes: int) -> BlockPattern:
        """The same of node pairs (n,), (n,), which are then cells of one block each."""
        pattern = cls.__new__(cls)
        pattern._number(rows, columns, n_nodes)
        return pattern

    def _number(self, rows: np.ndarray, columns: np.ndarray, n_nodes: int) -> None:
        by_column = _counted(columns, n_nodes)
        order = by_column[_counted(rows[by_column], n_nodes)]
        rows, columns = rows[order], columns[order]
        new = np.append(True, (np.diff(rows) != 0) | (np.diff(columns) != 0))
        self.slots = np.empty(len(order), np.int32)
        self.slots[order] = np.cumsum(new) - 1
        self.columns = columns[new].astype(np.int32)
        counts = np.bincount(rows[new], minlength=n_nodes)
        self.starts = np.concatenate([[0], np.cumsum(counts)]).astype(np.int32)
        self.n_nodes = n_nodes

    @property
    def rows(self) -> np.ndarray:
        """Row of every entry (nnz,)."""
        return np.repeat(np.arange(self.n_nodes), np.diff(self.starts))

    def sum(self, blocks: np.ndarray, first: int = 0) -> np.ndarray:
        """Sum (n_cells, n, n) values of cells ``first``.. into the pattern's data."""
        n2 = blocks.shape[1] * blocks.shape[2]
        slots = self.slots[first * n2 : (first + len(blocks)) * n2]
        return np.bincount(slots, weights=blocks.ravel(), minlength=len(self.columns))

    def sum_blocks(self, blocks: np.ndarray, first: int = 0) -> np.ndarray:
        """Sums (nnz, 3, 3) of (n_cells, n, n, 3, 3) blocks of cells ``first``..."""
        n, n2 = blocks.size // 9, blocks.shape[1] * blocks.shape[2]
        slots = self.slots[first * n2 : first * n2 + n]
        adding = sp.csc_matrix((np.ones(n), slots, np.arange(n + 1)), (len(self.columns), n))
        summed = adding @ blocks.reshape(n, 9)
        return summed.reshape(-1, 3, 3)

    def complete(self, data: np.ndarray) -> np.ndarray:
        """``data`` with other lower triangles: the block (b, a) at (i, j) is (a, b) at (j, i)."""
        numbered = self.scalar(np.arange(1, len(self.columns) + 1, dtype=np.int64))
        transposed = numbered.T.tocsr().data - 1
        for a in range(3):
            for b in range(a):
                data[:, a, b] = data[transposed, b, a]
        return data

    def scalar(self, data: np.ndarray) -> sp.csr_matrix:
        return sp.csr_matrix((data, self.columns, self.starts), (self.n_nodes, self.n_nodes))

    def vector(self, data: np.ndarray) -> sp.csr_matrix:
        """csr (3N, 3N) of (nnz, 3, 3) node blocks; dof = 3 node + component."""
        size = 3 * self.n_nodes
        return sp.bsr_matrix((data, self.columns, self.starts), shape=(size, size)).tocsr()


def _counted(numbers: np.ndarray, n: int) -> np.ndarray:
    """The stable order of numbers (m,) from 0 to n - 1, by counting: faster than comparing them."""
    m = len(numbers)
    entries = (np.ones(m, np.int8), numbers, np.arange(m + 1))
    return sp.csr_matrix(entries, (m, n)).tocsc().indices
