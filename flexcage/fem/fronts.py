"""Some unknowns of a symmetric positive definite matrix eliminated block by block.

To eliminate a block changes the matrix only among the later unknowns that it touches, its border:
a small dense matrix, its front, holds all that the step needs (multifrontal method, I. S. Duff and
J. K. Reid, ACM Trans. Math. Softw. 9 (1983) 302). Blocks from a nested dissection have small
fronts, and nearly all work is products of dense matrices, four to five times faster in a part of a
cage than the sparse triangular solutions of a general solver.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.linalg import blas, lapack

from flexcage.core.errors import RunFailed
from flexcage.fem.linear import SINGULAR

Contribution = tuple[np.ndarray, np.ndarray]  # rising unknowns (n,), matrix (n, n) added to them


@dataclass(frozen=True)
class Front:
    """One block's step: K_oo and K_bo are what the earlier blocks left of the matrix."""

    own: slice
    border: np.ndarray  # (n_border,) later unknowns
    inverse: np.ndarray  # K_oo^-1 (n_own, n_own)
    coupling: np.ndarray  # K_bo K_oo^-1 (n_border, n_own)


class Elimination:
    """K of which the ``blocks`` are eliminated one after the other, and the last unknowns left.

    ``matrix`` (n, n): sparse, no entry twice, unknowns in order of elimination; rows of those left
    are not read. ``blocks``: sizes. ``more``: dense matrices to add to it, lower triangles read.
    """

    def __init__(
        self,
        matrix: sp.csr_matrix,
        blocks: Sequence[int] | np.ndarray,
        more: Iterable[Contribution] = (),
    ) -> None:
        ends = np.cumsum(blocks)
        self.size = matrix.shape[1]
        self.eliminated = int(ends[-1])  # unknowns 0 to here
        block_of = np.searchsorted(ends, np.arange(self.size), side="right")  # last: what is left
        waiting: list[list[Contribution]] = [[] for _ in range(len(blocks) + 1)]
        for unknowns, values in more:
            waiting[block_of[unknowns[0]]].append((unknowns, values))
        self.fronts: list[Front] = []
        for k, (size, end) in enumerate(zip(blocks, ends)):
            front, rest = _eliminate(matrix, slice(end - size, end), waiting[k])
            waiting[k] = []
            self.fronts.append(front)
            if len(front.border):
                waiting[block_of[front.border[0]]].append((front.border, rest))
        self._left = waiting[-1]

    @property
    def schur(self) -> np.ndarray:
        """What eliminating adds to the matrix of the unknowns left: -K_lo K_oo^-1 K_ol."""
        left = np.zeros((self.size - self.eliminated,) * 2)
        for unknowns, values in self._left:
            at = unknowns - self.eliminated
            left[np.ix_(at, at)] += np.tril(values)
        return left + np.tril(left, -1).T

    def condense(self, loads: np.ndarray) -> None:
        """Loads (n, m) in place: those on unknowns eliminated move on to later ones."""
        for front in self.fronts:
            own = loads[front.own]
            if _acts(own):
                loads[front.border] -= front.coupling @ own

    def expand(self, fields: np.ndarray, loaded: int | None = None) -> None:
        """Condensed loads over answers of the unknowns left (n, m), in place: to answers of all.

        ``loaded``: so many first columns have loads on eliminated unknowns, by default all.
        """
        for front in reversed(self.fronts):
            own = fields[front.own]
            moved = front.coupling.T @ fields[front.border]
            if _acts(own[:, :loaded]):
                own[:, :loaded] = front.inverse @ own[:, :loaded]
            own -= moved


def _acts(loads: np.ndarray) -> bool:
    """Whether any of loads (n, m) is not zero; of most that act the first is not."""
    return loads.size > 0 and bool(loads[0, 0] != 0.0 or loads.any())


def _eliminate(
    matrix: sp.csr_matrix, own: slice, added: Sequence[Contribution]
) -> tuple[Front, np.ndarray]:
    """A block's front, and the matrix (n_border, n_border) that it leaves, as a lower triangle."""
    first, end = matrix.indptr[own.start], matrix.indptr[own.stop]
    columns, size = matrix.indices[first:end], own.stop - own.start
    rows = np.repeat(np.arange(size), np.diff(matrix.indptr[own.start : own.stop + 1]))
    later = columns >= own.start
    touched = np.concatenate([columns, *(unknowns for unknowns, _ in added)])
    border = np.unique(touched[touched >= own.stop])
    total = np.zeros((size + len(border),) * 2)  # transposed: the upper triangle by rows
    total[rows[later], _place(columns[later], own, border)] = matrix.data[first:end][later]
    for unknowns, values in added:
        _add_upper(total, _place(unknowns, own, border), values.T)
    whole = total.T
    lower, info = lapack.dpotrf(whole[:size, :size], lower=1)
    if info:
        raise RunFailed(SINGULAR.format(what=f"pivot {own.start + info}"))
    inverse = np.tril(lapack.dpotri(lower, lower=1)[0])
    inverse += np.tril(inverse, -1).T
    across, rest = whole[size:, :size], whole[size:, size:]
    if not len(border):
        return Front(own, border, inverse, across), rest
    half = blas.dtrsm(1.0, lower, across, side=1, lower=1, trans_a=1)
    rest = blas.dsyrk(-1.0, half, beta=1.0, c=rest, lower=1)
    coupling = blas.dtrsm(1.0, lower, half, side=1, lower=1, overwrite_b=1)
    return Front(own, border, inverse, coupling), rest


def _add_upper(total: np.ndarray, at: np.ndarray, values: np.ndarray) -> None:
    """Add the upper triangle of ``values`` (n, n) at rows and columns ``at``, rising: columns that
    stay together go together, which is twice as fast as one by one."""
    ends = np.append(np.flatnonzero(np.diff(at) != 1) + 1, len(at))
    first = 0
    for end in ends.tolist():
        place = int(at[first])
        total[at[:end], place : place + end - first] += values[:end, first:end]
        first = end


def _place(unknowns: np.ndarray, own: slice, border: np.ndarray) -> np.ndarray:
    """Where unknowns are in a front."""
    size = own.stop - own.start
    return np.where(
        unknowns < own.stop, unknowns - own.start, size + np.searchsorted(border, unknowns)
    )
