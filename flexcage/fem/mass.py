"""Consistent masses: of one component where all three are alike."""

from __future__ import annotations

from scipy import sparse

from flexcage.core.errors import InputError


def scalar_mass(mass: sparse.spmatrix, n_nodes: int) -> sparse.csr_matrix:
    """The (N, N) matrix m of a consistent mass M = m (x) 1_3 given as (N, N) or (3N, 3N)."""
    mass = sparse.csr_matrix(mass)
    if mass.shape[0] == n_nodes:
        return mass
    blocks = [[mass[i::3, j::3] for j in range(3)] for i in range(3)]
    scale = abs(mass).max()
    for i in range(3):
        for j in range(3):
            rest = blocks[i][j] if i != j else blocks[i][i] - blocks[0][0]
            if abs(rest).max() > 1e-9 * scale:
                raise InputError(
                    "the mass matrix is not a consistent mass of the same value in x, y and z, "
                    "so its invariants cannot be formed; give the (N, N) scalar mass matrix",
                    where="mass",
                    value=mass.shape,
                )
    return blocks[0][0]
