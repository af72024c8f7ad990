"""A part of a model meshed finer, moved on its cut by the model's own displacements.

Every tetrahedron of the part is divided into eight. Displacements of a coarse mesh are far more
precise than its stresses, so that imposing them on the cut and solving the fine part inside gives
the stress of a mesh as fine throughout, as long as the cut is far enough from where it varies
(submodelling, N. G. Cormier, B. S. Smallwood, G. B. Sinclair, G. Meda, Int. J. Numer. Meth. Engng
46 (1999) 889).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from types import MappingProxyType

import numpy as np
import scipy.sparse as sp

from flexcage.fem.condensed import dofs_of
from flexcage.fem.dissection import dissect
from flexcage.fem.fronts import Elimination
from flexcage.fem.model import FEModel, assemble, boundary_of, triangle_shapes
from flexcage.fem.sectors import edges_of
from flexcage.mesh.cage_mesh import FACE_AXES, CageMesh

_PAIRS = ((0, 1), (0, 2), (0, 3), (1, 2), (1, 3), (2, 3))
_CORNERS = ((0, 4, 5, 6), (4, 1, 7, 8), (5, 7, 2, 9), (6, 8, 9, 3))  # children at the corners
# the four around a diagonal of the octahedron that is left, for each of its three diagonals
_INSIDE = (
    ((4, 9, 5, 6), (4, 9, 6, 8), (4, 9, 8, 7), (4, 9, 7, 5)),
    ((5, 8, 4, 6), (5, 8, 6, 9), (5, 8, 9, 7), (5, 8, 7, 4)),
    ((6, 7, 4, 5), (6, 7, 5, 9), (6, 7, 9, 8), (6, 7, 8, 4)),
)
_DIAGONALS = ((4, 9), (5, 8), (6, 7))
_TRIANGLE = ((0, 3, 5), (3, 1, 4), (5, 4, 2), (3, 4, 5))  # children; 3, 4, 5: mids of 01, 12, 20
# barycentric places of corners and mids
_PLACES = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [0, 1, 1], [1, 0, 1]], float)
_PLACES[3:] *= 0.5


@dataclass(frozen=True)
class Submodel:
    """The fine part, ``model``, and how the one that it is a part of moves it.

    Its vertices are the other's ``kept`` (n,), then the middles of the other's ``edges`` (n_e, 2),
    sorted pairs of vertices. Its nodes ``cut`` (n_cut,) follow the other's nodes ``drivers``
    (n_d,) by ``onto_cut`` (n_cut, n_d). ``curved`` (n, 3): what the triangles on the curved surface
    became.
    """

    model: FEModel
    kept: np.ndarray
    edges: np.ndarray
    curved: np.ndarray
    cut: np.ndarray
    drivers: np.ndarray
    onto_cut: sp.csr_matrix

    def midpoints(self, pairs: np.ndarray) -> np.ndarray:
        """Vertices (n,) in the middle of edges (n, 2), pairs of the other's vertices."""
        return len(self.kept) + row_of(self.edges, np.sort(pairs, axis=1))

    @cached_property
    def _interior(self) -> tuple[np.ndarray, sp.csr_matrix, Elimination]:
        """Dofs off the cut in order of elimination, what couples them with the cut, factors."""
        free, model = np.setdiff1d(np.arange(len(self.model.nodes)), self.cut), self.model
        blocks = dissect(model.points[model.tets].mean(axis=1), model.cells, free)
        dofs = dofs_of(free[np.concatenate(blocks)])
        rows = model.K[dofs]
        factors = Elimination(rows[:, dofs], [3 * len(block) for block in blocks])
        return dofs, rows[:, dofs_of(self.cut)], factors

    def solve(self, moved: np.ndarray, loads: np.ndarray) -> np.ndarray:
        """Displacements (n, 3, m) of all nodes from those ``moved`` (n_d, 3, m) of the drivers and
        from nodal loads (n, 3, m)."""
        driven = self.onto_cut @ moved.reshape(len(moved), -1)
        answer = np.zeros(loads.shape)
        answer[self.cut] = driven.reshape(len(self.cut), *moved.shape[1:])
        flat = answer.reshape(3 * len(answer), -1)
        interior, coupling, factors = self._interior
        own = loads.reshape(flat.shape)[interior] - coupling @ flat[dofs_of(self.cut)]
        factors.condense(own)
        factors.expand(own)
        flat[interior] = own
        return answer


def submodel(
    model: FEModel, cells: np.ndarray, *, curved: np.ndarray, flanks: np.ndarray
) -> Submodel:
    """The tetrahedra ``cells`` of a model, divided; groups are those of the model on them.

    New vertices on those boundary triangles ``curved`` (n, 3) that the part has follow the smooth
    surface that these stand for, which leaves the triangles ``flanks`` (m, 3) without a bend; both
    turn one way round.
    """
    tets = model.tets[cells]
    old = np.unique(tets)
    owner, corners = model.surface_cells
    outside = np.isin(owner, cells)
    surface = np.sort(model.tets[owner[outside, None], corners[outside]], axis=1)

    def of_part(triangles: np.ndarray) -> np.ndarray:
        return triangles[row_of(surface, np.sort(triangles, axis=1)) >= 0]

    edges, of_tets = np.unique(_edges(tets), axis=0, return_inverse=True)
    first = len(old)
    normals = {**_normals(model.points, curved), **_normals(model.points, flanks)}
    curved = of_part(curved)
    bulge = _bulge(model.points, edges, row_of(edges, edges_of(curved)), normals)
    points = np.concatenate([model.points[old], model.points[edges].mean(axis=1) + bulge])
    ten = np.concatenate([np.searchsorted(old, tets), first + of_tets.reshape(-1, 6)], axis=1)
    fine_tets = _divided(points, ten)

    def divided(triangles: np.ndarray) -> np.ndarray:
        """Children (4n, 3) of triangles (n, 3) of the model, in the fine numbering."""
        pairs = np.sort(np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2), axis=2)
        mids = first + row_of(edges, pairs.reshape(-1, 2)).reshape(-1, 3)
        six = np.concatenate([np.searchsorted(old, triangles), mids], axis=1)
        return six[:, np.array(_TRIANGLE)].reshape(-1, 3)

    own = {name: divided(of_part(triangles)) for name, triangles in model.groups.items()}
    groups = {name: triangles for name, triangles in own.items() if len(triangles)}
    info = {name: model.info[name] for name in (FACE_AXES,) if name in model.info}
    mesh = CageMesh(points, fine_tets, MappingProxyType(groups), info=MappingProxyType(info))
    fine = assemble(mesh, model.material, order=model.order)
    cell, corners = boundary_of(tets)
    faces = np.sort(tets[cell[:, None], corners], axis=1)
    cut = faces[row_of(surface, faces) < 0]
    return Submodel(fine, old, edges, divided(curved), *_driven(model, cut, fine, divided(cut)))


def _driven(
    model: FEModel, triangles: np.ndarray, fine: FEModel, children: np.ndarray
) -> tuple[np.ndarray, np.ndarray, sp.csr_matrix]:
    """Fine nodes on the cut (n,), the model's nodes there (n_d,), and displacements of the former
    by those of the latter (n, n_d).

    ``children`` (4n, 3): what the ``triangles`` (n, 3) of the cut are divided into.
    """
    corners = _PLACES[np.array(_TRIANGLE)]  # (4, 3, 3) barycentric places of children's corners
    mids = 0.5 * (corners + np.roll(corners, -1, axis=1))  # of 01, 12, 20
    places = np.concatenate([corners, mids], axis=1) if fine.order == 2 else corners
    shapes = triangle_shapes(places[..., 1:].reshape(-1, 2).T, model.order)
    parents = model.face_nodes(triangles)  # (n, n_shape)
    nodes = fine.face_nodes(children).reshape(len(triangles), shapes.shape[1])
    cut, row = np.unique(nodes, return_index=True)
    triangle, place = np.divmod(row, nodes.shape[1])
    rows = np.repeat(np.arange(len(cut)), parents.shape[1])
    values = shapes[:, place].T
    matrix = sp.csr_matrix(
        (values.ravel(), (rows, parents[triangle].ravel())), (len(cut), len(model.nodes))
    )
    matrix.eliminate_zeros()
    drivers = np.unique(matrix.indices)
    return cut, drivers, matrix[:, drivers]


def _edges(tets: np.ndarray) -> np.ndarray:
    """Sorted vertex pairs (6n, 2) of the edges of tetrahedra (n, 4)."""
    return np.sort(tets[:, np.array(_PAIRS)], axis=2).reshape(-1, 2)


def row_of(table: np.ndarray, rows: np.ndarray) -> np.ndarray:
    """Where ``rows`` (n, k) of non-negative integers are in ``table`` (m, k); -1 where not."""
    if not len(table):
        return np.full(len(rows), -1)
    base = int(max(table.max(initial=0), rows.max(initial=0))) + 1
    weights = base ** np.arange(table.shape[1], dtype=np.int64)
    keys, wanted = table @ weights, rows @ weights
    order = np.argsort(keys)
    place = order[np.minimum(np.searchsorted(keys[order], wanted), len(keys) - 1)]
    return np.where(keys[place] == wanted, place, -1)


def _divided(points: np.ndarray, ten: np.ndarray) -> np.ndarray:
    """Eight tetrahedra (8n, 4) each, from vertices and midpoints of edges (n, 10).

    The inner four share the shortest diagonal (S. Zhang, Houston J. Math. 21 (1995) 541).
    """
    corners = ten[:, np.array(_CORNERS)].reshape(-1, 4)
    ends = points[ten[:, np.array(_DIAGONALS)]]
    shortest = np.linalg.norm(ends[:, :, 1] - ends[:, :, 0], axis=2).argmin(axis=1)
    inner = ten[np.arange(len(ten))[:, None, None], np.array(_INSIDE)[shortest]]
    return np.concatenate([corners, inner.reshape(-1, 4)])


def _bulge(
    points: np.ndarray, edges: np.ndarray, on: np.ndarray, normals: dict[int, np.ndarray]
) -> np.ndarray:
    """How far (n, 3) a surface is from the middle of edges (n, 2), those numbered ``on``.

    With the surface's ``normals`` at the edge's ends, which lean by alpha against it, it is the
    rise of an arc, half the edge times tan(alpha/2), or the mean of both ends'.
    """
    out = np.zeros((len(edges), 3))
    along = np.diff(points[edges[on]], axis=1)[:, 0]
    length = np.linalg.norm(along, axis=1)
    ends = [np.array([normals[v] for v in e]).reshape(-1, 3) for e in edges[on].T.tolist()]
    upwards = sum(ends)
    upwards /= np.linalg.norm(upwards, axis=1)[:, None]
    slopes = [np.einsum("ij,ij->i", along, normal) / length for normal in ends]
    first, second = (slope / (1.0 + np.sqrt(1.0 - slope**2)) for slope in slopes)
    out[on] = (0.25 * length * (second - first))[:, None] * upwards
    return out


def _normals(points: np.ndarray, triangles: np.ndarray) -> dict[int, np.ndarray]:
    """Unit normals (3,) of a surface of triangles by vertex, adjacent ones weighted by angle."""
    corner = points[triangles]
    normal = np.cross(corner[:, 1] - corner[:, 0], corner[:, 2] - corner[:, 0])
    normal /= np.linalg.norm(normal, axis=1)[:, None]
    total = np.zeros((len(points), 3))
    for i in range(3):
        ahead = corner[:, (i + 1) % 3] - corner[:, i]
        back = corner[:, (i + 2) % 3] - corner[:, i]
        cosine = np.einsum("ij,ij->i", ahead, back)
        cosine /= np.linalg.norm(ahead, axis=1) * np.linalg.norm(back, axis=1)
        angle = np.arccos(np.clip(cosine, -1.0, 1.0))
        np.add.at(total, triangles[:, i], angle[:, None] * normal)
    vertices = np.unique(triangles)
    unit = total[vertices] / np.linalg.norm(total[vertices], axis=1)[:, None]
    return dict(zip(vertices.tolist(), unit))
