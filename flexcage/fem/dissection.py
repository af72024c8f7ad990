"""Order of elimination by nested dissection: separators halve a mesh again and again.

Elements are split by their centres across a coordinate axis. Nodes that both halves share are
eliminated after all others, which then do not couple (A. George, SIAM J. Numer. Anal. 10 (1973)
345). Such a separator is a surface of element faces, and has half the nodes of the layer that a
plane between nodes leaves.
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

_LEAF = 45  # nodes that are not split further
_SMALLEST = 0.3  # share of the elements on either side of a plane, at least


def dissect(middles: np.ndarray, cells: np.ndarray, nodes: np.ndarray) -> list[np.ndarray]:
    """Blocks of the ``nodes`` (n,) in order of elimination, as places in ``nodes``, from the
    elements that have any of them: their centres (m, d) and nodes (m, k)."""
    mesh = _Mesh(middles, cells, nodes)
    blocks: list[np.ndarray] = []
    mesh.cut(np.arange(len(nodes)), np.arange(len(cells)), blocks)
    return [block for block in blocks if len(block)]


class _Mesh:
    def __init__(self, middles: np.ndarray, cells: np.ndarray, nodes: np.ndarray) -> None:
        self._middles = middles
        number = np.full(max(int(cells.max(initial=0)), int(nodes.max(initial=0))) + 1, -1)
        number[nodes] = np.arange(len(nodes))
        own = number[cells]
        element = np.broadcast_to(np.arange(len(cells))[:, None], cells.shape)[own >= 0]
        incident = sp.csr_matrix(
            (np.ones(len(element), np.int8), (own[own >= 0], element)), (len(nodes), len(cells))
        )
        self._starts, self._elements = incident.indptr, incident.indices
        self._rank = np.empty(len(cells), np.int64)  # along an axis among elements that are split

    def cut(self, nodes: np.ndarray, elements: np.ndarray, blocks: list[np.ndarray]) -> None:
        """Append the blocks of nodes that only these elements have."""
        if len(nodes) <= _LEAF or len(elements) < 2:
            blocks.append(nodes)
            return
        starts, counts = self._starts[nodes], np.diff(self._starts)[nodes]
        offsets = np.concatenate([[0], np.cumsum(counts)[:-1]])
        entries = np.repeat(starts - offsets, counts) + np.arange(counts.sum())
        around = self._elements[entries], offsets
        splits = [self._split(elements, axis, around) for axis in range(self._middles.shape[1])]
        _, order, at, first, last = min(splits, key=lambda split: split[0])
        below, above = last <= at, first > at
        self.cut(nodes[below], elements[order[: at + 1]], blocks)
        self.cut(nodes[above], elements[order[at + 1 :]], blocks)
        blocks.append(nodes[~(below | above)])

    def _split(
        self, elements: np.ndarray, axis: int, around: tuple[np.ndarray, np.ndarray]
    ) -> tuple[int, np.ndarray, int, np.ndarray, np.ndarray]:
        """The smallest separator of the planes across one axis: how many nodes, the order of
        elements, the last below the plane, and the lowest and highest rank around every node."""
        n = len(elements)
        order = np.argsort(self._middles[elements, axis], kind="stable")
        self._rank[elements[order]] = np.arange(n)
        ranks, offsets = self._rank[around[0]], around[1]
        first, last = np.minimum.reduceat(ranks, offsets), np.maximum.reduceat(ranks, offsets)
        shared = _spans(first, last, n)
        margin = int(_SMALLEST * n)
        at = margin + int(np.argmin(shared[margin : n - margin - 1]))
        return int(shared[at]), order, at, first, last


def _spans(first: np.ndarray, last: np.ndarray, n: int) -> np.ndarray:
    """How many of the intervals [first, last] hold both p and p + 1: (n,) for every p."""
    ends = np.bincount(first, minlength=n) - np.bincount(last, minlength=n)
    return np.cumsum(ends)
