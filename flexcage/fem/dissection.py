"""Order of elimination by nested dissection: separators halve a mesh again and again.

Nodes are split by a plane across a coordinate axis, and those on one side of it that touch the
other are eliminated after both halves, which then do not couple (A. George, SIAM J. Numer. Anal.
10 (1973) 345).
"""

from __future__ import annotations

import numpy as np
import scipy.sparse as sp

_LEAF = 45  # nodes that are not split further
_SMALLEST = 0.3  # share of the nodes on either side of a plane, at least


def dissect(points: np.ndarray, adjacency: sp.csr_matrix) -> list[np.ndarray]:
    """Blocks of nodes (N,) in order of elimination, from their places (N, 3) and connections."""
    graph = _Graph(points, adjacency)
    blocks: list[np.ndarray] = []
    graph.cut(np.arange(len(points)), blocks)
    return [block for block in blocks if len(block)]


class _Graph:
    def __init__(self, points: np.ndarray, adjacency: sp.csr_matrix) -> None:
        self._points, self._starts, self._neighbours = points, adjacency.indptr, adjacency.indices
        self._rank = np.full(len(points), -1)  # along an axis among the nodes that are split

    def cut(self, nodes: np.ndarray, blocks: list[np.ndarray]) -> None:
        """Append the blocks of a set of nodes."""
        if len(nodes) <= _LEAF:
            blocks.append(nodes)
            return
        lower, upper, separator = min(
            (self._split(nodes, axis) for axis in range(3)), key=lambda parts: len(parts[2])
        )
        self.cut(lower, blocks)
        self.cut(upper, blocks)
        blocks.append(separator)

    def _split(self, nodes: np.ndarray, axis: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Both sides and the smallest separator of the planes across one axis."""
        n = len(nodes)
        nodes = nodes[np.argsort(self._points[nodes, axis], kind="stable")]
        own = np.arange(n)
        first, last = self._reach(nodes, own)
        low = _spans(own, last, n)  # nodes below a plane that touch one above, for every plane
        high = _spans(first, own, n)
        margin = int(_SMALLEST * n)
        planes = slice(margin, n - margin)
        below = low[planes].min() <= high[planes].min()
        at = margin + int(np.argmin((low if below else high)[planes])) + 1  # nodes below the plane
        if below:
            between = (own < at) & (last >= at)
        else:
            between = (own >= at) & (first < at)
        return nodes[(own < at) & ~between], nodes[(own >= at) & ~between], nodes[between]

    def _reach(self, nodes: np.ndarray, own: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Lowest and highest rank among every node's neighbours and itself."""
        self._rank[nodes] = own
        starts, counts = self._starts[nodes], np.diff(self._starts)[nodes]
        offsets = np.concatenate([[0], np.cumsum(counts)[:-1]])
        entries = np.repeat(starts - offsets, counts) + np.arange(counts.sum())
        ranks = self._rank[self._neighbours[entries]]
        self._rank[nodes] = -1
        last = np.maximum.reduceat(ranks, offsets)
        first = np.minimum.reduceat(np.where(ranks < 0, len(nodes), ranks), offsets)
        return np.minimum(first, own), np.maximum(last, own)


def _spans(first: np.ndarray, last: np.ndarray, n: int) -> np.ndarray:
    """How many of the intervals [first, last] hold both p and p + 1: (n,) for every p."""
    ends = np.bincount(first, minlength=n) - np.bincount(last, minlength=n)
    return np.cumsum(ends)
