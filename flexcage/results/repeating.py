"""Mode shapes of a cage whose sectors repeat, in few bytes and without loss.

A mode runs round the ring as a few waves do, so that its shape in one sector is nearly a
combination of all modes' shapes in another, turned. One sector is kept; of the others a matrix
each, and what the matrix leaves: a step or two, more in sectors that a defect has changed.

Every processor must find the same numbers again. So shapes and matrices are whole numbers, small
enough for their products and sums to be exact in floating point, in whatever order they are added.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from flexcage.fem.sectors import edge_keys, edges_of, find_sectors
from flexcage.mesh.cage_mesh import CageMesh

_EXACT = 52  # bits of a whole number that floating point holds
_SHAPE = 24  # bits of a shape's whole steps, with sign
PACKED = ("left", "nodes", "turns", "mix", "scale")

Arrays = Mapping[str, np.ndarray]


def pack(basis: Arrays, mesh: CageMesh) -> Arrays:
    """Arrays of a rounded basis (``modes.storage``) with ``PACKED`` in place of ``steps``; as they
    are where the mesh does not repeat."""
    steps = basis["steps"]
    nodes = _sectors(mesh, len(steps))
    if nodes is None:
        return basis
    angles = 2.0 * np.pi * np.arange(len(nodes)) / len(nodes)
    turns = np.stack([np.cos(angles), np.sin(angles)], axis=1)
    n = steps.shape[2]
    inverse = np.linalg.pinv(steps[nodes[0]].reshape(-1, n).astype(float), rcond=1e-12)
    back = turns * [1.0, -1.0]
    exact = np.stack(
        [inverse @ _turned(steps[k], by).reshape(-1, n) for k, by in zip(nodes[1:], back[1:])]
    )
    scale = np.exp2(np.ceil(np.log2(np.abs(exact).max(axis=(1, 2)) + 1e-300)) - 2 * _bits(n))
    new = {
        "nodes": nodes.astype(np.int32),
        "turns": turns,
        "mix": np.rint(exact / scale[:, None, None]).astype(np.int64),
        "scale": scale,
    }
    left = steps - _predicted(steps, new)
    left = (left << 1) ^ (left >> 31)  # signs at the end: small numbers in few bytes
    return {
        **{name: value for name, value in basis.items() if name != "steps"},
        **new,
        "left": np.ascontiguousarray(np.moveaxis(left, 0, 2)),  # what is alike side by side
    }


def unpack(basis: Arrays) -> Arrays:
    """The arrays that ``pack`` was given."""
    if "left" not in basis:
        return basis
    left = np.ascontiguousarray(np.moveaxis(basis["left"], 2, 0))
    steps = (left >> 1) ^ -(left & 1)
    steps += _predicted(steps, basis)
    return {**{name: v for name, v in basis.items() if name not in PACKED}, "steps": steps}


def _predicted(steps: np.ndarray, packed: Arrays) -> np.ndarray:
    """What the kept sector's ``steps`` say of all others' (N, 3, n) int32; 0 for other nodes."""
    nodes, n = packed["nodes"], steps.shape[2]
    bits = _bits(n)
    first = steps[nodes[0]].reshape(-1, n).astype(float)
    predicted = np.zeros_like(steps)
    for own, by, mix, scale in zip(nodes[1:], packed["turns"][1:], packed["mix"], packed["scale"]):
        high, low = (half.astype(float) for half in np.divmod(mix, 2**bits))
        there = ((first @ high) * 2.0**bits + first @ low) * scale
        predicted[own] = np.rint(_turned(there.reshape(-1, 3, n), by))
    return predicted


def _bits(modes: int) -> int:
    """Bits of half a matrix' entry, so that sums over the modes are exact."""
    return _EXACT - _SHAPE - modes.bit_length()


def _turned(vectors: np.ndarray, by: np.ndarray) -> np.ndarray:
    """Vectors (m, 3, n) turned about x by an angle with (cosine, sine)."""
    turned = vectors.astype(float)
    y, z = vectors[:, 1], vectors[:, 2]
    turned[:, 1] = by[0] * y - by[1] * z
    turned[:, 2] = by[1] * y + by[0] * z
    return turned


def _sectors(mesh: CageMesh, count: int) -> np.ndarray | None:
    """Nodes (sectors, m) that follow each other round the ring, of ``count`` in all (vertices, and
    midpoints of edges if there are more); the first row is that of a sector that is like most
    and has no cut.

    None where the mesh does not repeat.
    """
    vertices = len(mesh.points)
    edges = edges_of(mesh.tets) if count > vertices else np.empty((0, 2), np.int64)
    sectors = find_sectors(mesh.info, mesh.tets, vertices, edges)
    if sectors is None or count != vertices + len(edges):
        return None
    lowest = now = np.arange(count)
    for _ in range(sectors.count):
        now = sectors.image[now]
        lowest = np.minimum(lowest, now)
    tets = mesh.tets[sectors.cells[0]]
    inner = edges_of(tets) if len(edges) else edges
    middles = np.searchsorted(edge_keys(edges, vertices), edge_keys(inner, vertices))
    own = sectors.place[np.concatenate([tets.ravel(), vertices + middles])]
    nodes = sectors.followed(own[np.unique(lowest[own], return_index=True)[1]])
    alike = sectors.alike(mesh.points, nodes[:, nodes[0] < vertices])
    cut: Any = np.isin(nodes, sectors.place[sectors.doubled]).any(axis=1)
    most = np.array(max(alike, key=len))
    return np.roll(nodes, -most[np.argmin(cut[most])], axis=0)
