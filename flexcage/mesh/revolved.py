"""Bodies of revolution that touch each other, as curved ten-node tetrahedra with matching surfaces.

A plane section of triangles is turned round the x axis in equal sectors; every prism becomes three
tetrahedra, whose diagonals follow the numbers of the section's vertices, so that neighbours fit
(J. Dompierre, P. Labbe, M.-G. Vallet, R. Camarero, Proc. 8th Int. Meshing Roundtable, 1999, 195).
Where two bodies share edges of the section, each gets nodes of its own, at the same places.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

Place = Callable[[np.ndarray, np.ndarray], tuple[np.ndarray, np.ndarray]]
#: Vertices of the six edges of a tetrahedron, in the order of its nodes 4 ... 9.
EDGES = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))
_AXIS = 1e-9  # of the section's greatest radius, within which a vertex lies on the axis


@dataclass(frozen=True, eq=False)
class HalfPlane:
    """The half-plane (radius, x): vertices (n, 2) [m], triangles (m, 3) and their bodies (m,).

    ``middles`` holds where the middle of a curved edge lies, by its sorted pair of vertices; that
    of any other is half way. ``curves`` (k, 2) are edges by name.
    """

    vertices: np.ndarray
    triangles: np.ndarray
    bodies: np.ndarray
    middles: Mapping[tuple[int, int], np.ndarray]
    curves: Mapping[str, np.ndarray]


@dataclass(frozen=True, eq=False)
class RevolvedBodies:
    """Nodes (n, 3) [m], tetrahedra of ten nodes (m, 10) and their bodies (m,).

    ``faces[curve, body]`` are that body's triangles of six nodes (k, 6), corners first, on the
    surface that a curve of the section makes; those of two bodies lie on each other, node by node.
    """

    nodes: np.ndarray
    tets: np.ndarray
    bodies: np.ndarray
    faces: Mapping[tuple[str, int], np.ndarray]

    def of_body(self, body: int) -> np.ndarray:
        """Numbers of a body's nodes."""
        return np.unique(self.tets[self.bodies == body])

    def behind(self, body: int, faces: np.ndarray) -> np.ndarray:
        """Places (m, 3) inside a body behind its faces (m, 6): middles of their tetrahedra."""
        tets = self.tets[self.bodies == body][:, :4]
        of = np.sort(tets[:, np.array([(0, 1, 2), (0, 1, 3), (0, 2, 3), (1, 2, 3)])], axis=2)
        wanted = np.sort(faces[:, :3], axis=1)
        both = np.vstack([of.reshape(-1, 3), wanted])
        _, number = np.unique(both, axis=0, return_inverse=True)
        owner = np.full(len(both), -1)
        owner[number.ravel()[: 4 * len(tets)]] = np.repeat(np.arange(len(tets)), 4)
        return np.asarray(self.nodes[tets[owner[number.ravel()[4 * len(tets) :]]]].mean(axis=1))


def revolved(
    section: HalfPlane,
    sectors: int,
    place: Place | None = None,
) -> RevolvedBodies:
    """The section turned round the x axis.

    ``place(radius, turn)`` gives (y, z) [m] at a radius of the section and at a turn, counted in
    sectors, if that is no circle.
    """
    build = _Build(section, sectors, place)
    parts = [build.body(b) for b in np.unique(section.bodies)]
    tets = np.vstack([part for part in parts if len(part)])
    owner = np.repeat(np.unique(section.bodies), [len(part) for part in parts])
    ten = np.concatenate([tets, build.middle(tets[:, np.array(EDGES)])], axis=1)
    nodes = build.nodes()
    ten = _turned_right(nodes, ten)
    faces = {
        (name, int(b)): build.faces(edges, int(b))
        for name, edges in section.curves.items()
        for b in np.unique(section.bodies)
        if build.has(edges, int(b))
    }
    return RevolvedBodies(nodes, ten, owner, faces)


class _Build:
    """Numbers vertices as (body, vertex of the section, layer), and edges as they come."""

    def __init__(self, section: HalfPlane, sectors: int, place: Place | None) -> None:
        self.section, self.sectors, self.place = section, sectors, place
        self.count = len(section.vertices)
        radius = section.vertices[:, 0]
        self.on_axis = radius < _AXIS * radius.max()
        self._keys: list[int] = []  # of vertices, in the order of their nodes
        self._node: dict[int, int] = {}
        self._edges: dict[tuple[int, int], int] = {}

    def _key(self, body: int, vertex: np.ndarray, layer: int) -> np.ndarray:
        layers = np.where(self.on_axis[vertex], 0, layer % self.sectors)
        return np.asarray((body * self.count + vertex) * self.sectors + layers)

    def body(self, body: int) -> np.ndarray:
        """Tetrahedra (n, 4) of keys."""
        v = np.sort(self.section.triangles[self.section.bodies == body], axis=1)
        found = []
        for layer in range(self.sectors):
            b, t = self._key(body, v, layer), self._key(body, v, layer + 1)
            for four in (
                (b[:, 0], b[:, 1], b[:, 2], t[:, 2]),
                (b[:, 0], b[:, 1], t[:, 1], t[:, 2]),
                (b[:, 0], t[:, 0], t[:, 1], t[:, 2]),
            ):
                tets = np.stack(four, axis=1)
                real = (np.diff(np.sort(tets, axis=1), axis=1) > 0).all(axis=1)
                found.append(tets[real])
        return self._numbered(np.vstack(found))

    def _numbered(self, keys: np.ndarray) -> np.ndarray:
        for key in np.unique(keys).tolist():
            if key not in self._node:
                self._node[key] = len(self._keys)
                self._keys.append(key)
        return np.vectorize(self._node.__getitem__, otypes=[int])(keys)

    def middle(self, pairs: np.ndarray) -> np.ndarray:
        """Nodes (...) in the middle of edges (..., 2) of vertices' nodes."""
        flat = np.sort(pairs.reshape(-1, 2), axis=1)
        unique, place = np.unique(flat, axis=0, return_inverse=True)
        numbers = np.empty(len(unique), int)
        for i, (a, b) in enumerate(unique.tolist()):
            numbers[i] = self._edges.setdefault((a, b), len(self._keys) + len(self._edges))
        return numbers[place.ravel()].reshape(pairs.shape[:-1])

    def has(self, edges: np.ndarray, body: int) -> bool:
        """Whether a body has triangles on these edges of the section."""
        own = np.unique(self.section.triangles[self.section.bodies == body])
        return bool(np.isin(edges, own).all())

    def faces(self, edges: np.ndarray, body: int) -> np.ndarray:
        e = np.sort(edges, axis=1)
        found = []
        for layer in range(self.sectors):
            b, t = self._key(body, e, layer), self._key(body, e, layer + 1)
            for three in ((b[:, 0], b[:, 1], t[:, 1]), (b[:, 0], t[:, 1], t[:, 0])):
                triangles = np.stack(three, axis=1)
                real = (np.diff(np.sort(triangles, axis=1), axis=1) > 0).all(axis=1)
                found.append(triangles[real])
        corners = self._numbered(np.vstack(found))
        pairs = np.stack([corners, np.roll(corners, -1, axis=1)], axis=2)
        return np.concatenate([corners, self.middle(pairs)], axis=1)

    def nodes(self) -> np.ndarray:
        """Places (n, 3) of all nodes."""
        keys = np.array(self._keys)
        vertex, layer = (keys // self.sectors) % self.count, keys % self.sectors
        flat, turn = self.section.vertices[vertex], layer.astype(float)
        ends = np.array(list(self._edges)).reshape(-1, 2)
        between = 0.5 * (flat[ends[:, 0]] + flat[ends[:, 1]])
        for i, pair in enumerate(np.sort(vertex[ends], axis=1).tolist()):
            if (curved := self.section.middles.get((pair[0], pair[1]))) is not None:
                between[i] = curved
        turns = turn[ends]
        axis = self.on_axis[vertex][ends]
        turns = np.where(axis, turns[:, ::-1], turns)
        gone = np.abs(np.diff(turns, axis=1)[:, 0]) > 1.0  # from the last layer to the first
        turns[gone] = np.where(turns[gone] == 0.0, float(self.sectors), turns[gone])
        return self._placed(np.vstack([flat, between]), np.concatenate([turn, turns.mean(axis=1)]))

    def _placed(self, flat: np.ndarray, turn: np.ndarray) -> np.ndarray:
        angle = 2.0 * np.pi * turn / self.sectors
        circle = flat[:, 0] * np.cos(angle), flat[:, 0] * np.sin(angle)
        across = circle if self.place is None else self.place(flat[:, 0], turn)
        return np.stack([flat[:, 1], *across], axis=1)


def _turned_right(nodes: np.ndarray, ten: np.ndarray) -> np.ndarray:
    """The tetrahedra with positive volume: two vertices change places in those that have not."""
    corner = nodes[ten[:, :4]]
    wrong = np.linalg.det(corner[:, 1:] - corner[:, :1]) < 0.0
    swapped = ten[:, [1, 0, 2, 3, 4, 6, 5, 8, 7, 9]]
    return np.where(wrong[:, None], swapped, ten)
