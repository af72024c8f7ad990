"""Stress in the fillets of a cage's pocket corners, by submodels of their surroundings.

A medium mesh by itself reads the peaks in fillets 5 to 20 % low: elements are few along an arc,
their stresses scatter, and the peak lies between vertices. But its displacements a few millimetres
away are right. So the surroundings of a corner are divided once, and what touches the fillet once
more (``fem.submodel``), new vertices following the arc. The stress there is linear in the cage's
displacements on the cut and in the forces on the pocket faces within. Corners that differ by turns
and mirrors share this operator.
"""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from flexcage.core.threads import on_all_cores
from flexcage.fem.model import FEModel
from flexcage.fem.sectors import edges_of
from flexcage.fem.submodel import Submodel, row_of, submodel
from flexcage.modes.basis import FACES
from flexcage.modes.lands import LANDS
from flexcage.modes.pockets import STRAIGHT, face_axes, face_group, hat_weights, pocket_frame
from flexcage.stress.operators import VertexStress

log = logging.getLogger(__name__)

Arrays = dict[str, np.ndarray]
Keeping = Callable[[Callable[[], Arrays]], Arrays]  # gives what it keeps, or makes it
_MIRRORS = ((1, 1), (-1, 1), (1, -1), (-1, -1))  # signs of x and psi of a pocket's corners
_REACH = 1.2  # of the cage's thickness, from the fillet to the cut
_REACH_MOST = 0.6  # of the pocket's length and width, that no other corner of it is reached
_REACH_CLOSE = 0.4  # of the fillet's extent: what is divided twice
_FINE = 7  # edges on a fillet's arc from which on it is divided once alone,
_REACH_FINE = 2.0  # extents of the fillet round it: such a mesh is right there
_ALIKE = 1e-9  # misfit of vertices of corners that share an operator, relative to the cage's size
_MOST_KINDS = 16  # of corners; a mesh of more repeats nothing, and its own stresses are taken
_TOGETHER = 128  # columns that are solved at once
_VOIGT = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
_UNIT_TENSORS = np.array(
    [[[{i, j} == {a, b} for b in range(3)] for a in range(3)] for i, j in _VOIGT], float
)


@dataclass(frozen=True)
class Corner:
    """One corner of a pocket: its fillet and the elements around."""

    pocket: int
    mirror: tuple[int, int]  # signs of x and psi of the corner in its pocket's frame
    frame: np.ndarray  # (3, 3) rows x, r, psi, mirrored: cage frame to that of the corner (+, +)
    fillet: np.ndarray  # (n, 3) triangles
    cells: np.ndarray
    vertices: np.ndarray  # (n_v,) of the cells
    places: np.ndarray  # (n_v, 3) of these in the corner's frame [m]
    fine: bool  # the mesh has edges enough along the arc for one division
    sign: float = 1.0  # of its row's x in the cage's frame

    def faces(self, pocket_count: int) -> list[tuple[int, int]]:
        """Pocket and face of what may be pushed near the corner, of so many pockets a row:
        crossbeam and side beam of the
        pocket, then the same crossbeam's other face and the side beam of the next pocket."""
        along, across = self.mirror
        beam, side = (0 if across > 0 else 1), (2 if along > 0 else 3)
        first = self.pocket // pocket_count * pocket_count  # of its row
        following = first + (self.pocket + across) % pocket_count
        return [(self.pocket, beam), (self.pocket, side), (following, 1 - beam), (following, side)]


@dataclass(frozen=True)
class Fillet:
    """Points of one corner's fillet and their stress.

    A ``kind`` of corners shares ``moved`` (6 n, 3 n_d) [Pa/m] and ``pushed`` (6 n, 4 n_st 3)
    [Pa/N], in the frame of the corner (+, +).
    """

    corner: Corner
    kind: int
    drivers: np.ndarray  # (n_d,) nodes of the cage
    vertices: np.ndarray  # (n_f,) mesh vertices of the fillet
    owner: np.ndarray  # (n,) the one of these that is nearest to a point
    moved: np.ndarray
    pushed: np.ndarray
    pocket_count: int

    def stress(self, fields: np.ndarray, forces: np.ndarray | None) -> np.ndarray:
        """Stresses (n, m, 6) [Pa] of displacements (N, 3, m) and station forces (Z, F, n_st, 3, m)
        [N] in the pockets' frames; cage frame."""
        frame = self.corner.frame
        own = np.einsum("ab,nbm->nam", frame, fields[self.drivers])
        values = self.moved @ own.reshape(-1, fields.shape[2])
        if forces is not None and (near := self._near(forces)).any():
            values += self.pushed @ near
        return _turned(values.reshape(len(self.owner), 6, -1), frame)

    def _near(self, forces: np.ndarray) -> np.ndarray:
        """Forces (4 n_st 3, m) on the faces near the corner, as the corner (+, +) sees them."""
        along, across = self.corner.mirror
        rows = []
        for pocket, face in self.corner.faces(self.pocket_count):
            order = along if face < 2 else across  # stations are even about mid-pocket
            rows.append(forces[pocket, face, ::order])
        signs = np.array([self.corner.sign * along, 1.0, across])[:, None]
        return (np.stack(rows) * signs).reshape(-1, forces.shape[-1])


def _turned(values: np.ndarray, frame: np.ndarray) -> np.ndarray:
    """Stresses (n, m, 6) in the cage's frame of those (n, 6, m) in a corner's."""
    return (_voigt_turn(frame) @ values).transpose(0, 2, 1)


def _voigt_turn(frame: np.ndarray) -> np.ndarray:
    """Matrix (6, 6) from stresses along a frame's rows (3, 3) to those along the axes."""
    first, second = np.array(_VOIGT).T
    turned = np.einsum("ai,kab,bj->kij", frame, _UNIT_TENSORS, frame)
    return turned[:, first, second].T


def find_corners(model: FEModel, pocket_count: int) -> list[Corner]:
    """Corners with a fillet and what lies within reach of each."""
    corners = []
    middles = model.points[model.tets].mean(axis=1)
    fillets = corner_fillets(model, pocket_count)
    thickness = _thickness(model, fillets, pocket_count)
    for (pocket, along, across), fillet in fillets.items():
        mirrored = np.diag([along, 1.0, across]) @ pocket_frame(pocket, pocket_count)
        faces = [model.points[model.group(face_group(pocket, f))] @ mirrored.T for f in range(4)]
        width = max(np.ptp(faces[2][..., 2]), np.ptp(faces[3][..., 2]))
        length = max(np.ptp(faces[0][..., 0]), np.ptp(faces[1][..., 0]))
        reach = min(_REACH * thickness, _REACH_MOST * min(width, length))
        arc = model.points[np.unique(fillet)] @ mirrored[[0, 2]].T
        extent = np.ptp(arc[:, 0])
        fine = extent * 0.5 * np.pi > (_FINE - 0.5) * _arc_edge(model.points, fillet)
        if fine:
            reach = min(reach, _REACH_FINE * extent)
        near = np.flatnonzero(middles @ mirrored[1] > 0.0)
        across_radius = middles[near] @ mirrored[[0, 2]].T
        distance = cKDTree(arc).query(across_radius, distance_upper_bound=reach)[0]
        cells = near[np.isfinite(distance)]
        vertices = np.unique(model.tets[cells])
        corners.append(
            Corner(
                pocket, (along, across), mirrored, fillet, cells, vertices,
                model.points[vertices] @ mirrored.T, bool(fine),
            )
        )  # fmt: skip
    return corners


def _thickness(
    model: FEModel, fillets: dict[tuple[int, int, int], np.ndarray], pocket_count: int
) -> float:
    """Thickness [m] of the cage's wall: of one that lies askew, along a fillet."""
    axes = face_axes(model)
    if axes is STRAIGHT or not fillets:
        return float(np.ptp(np.hypot(model.points[:, 1], model.points[:, 2])))
    (pocket, *_), fillet = next(iter(fillets.items()))
    outwards = np.cross(axes.along[2], axes.along[0]) @ pocket_frame(pocket, pocket_count)
    return float(np.ptp(model.points[fillet] @ outwards))


def rounded(model: FEModel, pocket: int) -> bool:
    """Has the mesh a group of the fillets at this pocket's corners?"""
    return bool(len(model.groups.get(f"pocket{pocket}_fillet", ())))


def corner_fillets(model: FEModel, pocket_count: int) -> dict[tuple[int, int, int], np.ndarray]:
    """Triangles (n, 3) of the fillet at every pocket corner, by pocket and signs of x and psi; none
    where a mesh has no fillet groups."""
    found: dict[tuple[int, int, int], np.ndarray] = {}
    for pocket in range(pocket_count):
        if not rounded(model, pocket):
            continue
        fillet = model.groups[f"pocket{pocket}_fillet"]
        along, _, across = (
            model.points[fillet].mean(axis=1) @ pocket_frame(pocket, pocket_count).T
        ).T
        for right, ahead in _MIRRORS:
            own = (along * right > 0.0) & (across * ahead > 0.0)
            if own.any():
                found[pocket, right, ahead] = fillet[own]
    return found


def find_fillets(
    model: FEModel,
    stations: np.ndarray,
    pocket_count: int,
    *,
    keep: Keeping = lambda make: make(),
) -> list[Fillet]:
    """The corners' fillets with their operators, which ``keep(make)`` gives from where it keeps
    them; none where the mesh has no fillets, or corners of too many kinds.

    ``stations`` (F, n_st) [m], even about mid-pocket, are those of the forces on the faces.
    """
    corners = find_corners(model, pocket_count)
    kinds: list[Corner] = []
    matched = []
    for corner in corners:
        for kind, first in enumerate(kinds):
            place = _match(model, first, corner)
            if place is not None:
                matched.append((kind, place))
                break
        else:
            kinds.append(corner)
            matched.append((len(kinds) - 1, np.arange(len(corner.vertices))))
            if len(kinds) > _MOST_KINDS:
                log.debug("the mesh's pocket corners differ: stress in fillets is the mesh's own")
                return []
    arrays = keep(lambda: _operators(model, kinds, stations, pocket_count)) if kinds else {}
    fillets = []
    for corner, (kind, place) in zip(corners, matched):
        first = kinds[kind]
        image = np.full(len(model.points), -1)
        image[first.vertices] = corner.vertices[place]
        fillets.append(
            Fillet(
                corner, kind, _nodes_at(model, image, arrays[f"drivers{kind}"]),
                image[np.unique(first.fillet)], image[arrays[f"owner{kind}"]],
                arrays[f"moved{kind}"], arrays[f"pushed{kind}"], pocket_count,
            )
        )  # fmt: skip
    return fillets


def _match(model: FEModel, first: Corner, other: Corner) -> np.ndarray | None:
    """Which vertex (n_v,) of ``other`` has the place of each of ``first``; None if they differ."""
    if len(first.places) != len(other.places) or len(first.cells) != len(other.cells):
        return None
    distance, place = cKDTree(other.places).query(first.places)
    if distance.max() > _ALIKE * np.abs(model.points).max():
        return None
    wanted = place[np.searchsorted(first.vertices, model.tets[first.cells])]
    there = np.searchsorted(other.vertices, model.tets[other.cells])
    alike = (row_of(np.sort(there, axis=1), np.sort(wanted, axis=1)) >= 0).all()
    return place if alike else None


def _nodes_at(model: FEModel, image: np.ndarray, nodes: np.ndarray) -> np.ndarray:
    """Nodes (n,) that are to vertices ``image`` (n_points,) what ``nodes`` are to all vertices."""
    count = len(model.points)
    out = image[np.minimum(nodes, count - 1)]
    middle = nodes >= count
    if middle.any():
        out[middle] = model.edge_nodes(image[model.edges[nodes[middle] - count]])
    return out


def _operators(
    model: FEModel, kinds: list[Corner], stations: np.ndarray, pocket_count: int
) -> Arrays:
    """``drivers``, ``owner``, ``moved`` and ``pushed`` of every kind, numbered by it; the first two
    name nodes and vertices at the kind's first corner."""
    made = on_all_cores(lambda c: _operator(model, c, stations, pocket_count), kinds)
    return {f"{name}{k}": value for k, arrays in enumerate(made) for name, value in arrays.items()}


def _operator(model: FEModel, corner: Corner, stations: np.ndarray, pocket_count: int) -> Arrays:
    zooms = _zooms(model, corner)
    points = _points(model, corner, zooms)
    stress = VertexStress(zooms[-1].model, points)
    vertices = np.unique(corner.fillet)
    owner = cKDTree(model.points[vertices]).query(zooms[-1].model.points[points])[1]
    totals = [
        np.asarray(hat_weights(model, k, f, stations[f], pocket_count).sum(axis=1)).ravel()
        for k, f in corner.faces(pocket_count)
    ]
    pushes = [_face_loads(z.model, corner, stations, totals, pocket_count) for z in zooms]
    drivers = zooms[0].drivers
    # columns: unit displacements of the drivers along the corner's axes, then unit forces
    moves = np.kron(np.eye(len(drivers)), corner.frame.T).reshape(len(drivers), 3, -1)
    moves = np.concatenate([moves, np.zeros((*moves.shape[:2], pushes[0].shape[2]))], axis=2)
    pushes = [np.concatenate([np.zeros((len(p), 3, 3 * len(drivers))), p], axis=2) for p in pushes]
    columns = []
    for first in range(0, moves.shape[2], _TOGETHER):
        some = slice(first, first + _TOGETHER)
        fields = zooms[0].solve(moves[..., some], pushes[0][..., some])
        for zoom, push in zip(zooms[1:], pushes[1:]):
            fields = zoom.solve(fields[zoom.drivers], push[..., some])
        columns.append(stress(fields))
    both = np.concatenate(columns, axis=1).transpose(0, 2, 1)
    local = _turned(both, corner.frame.T).transpose(0, 2, 1)
    local = local.reshape(6 * len(points), -1).astype(np.float32)
    return {
        "drivers": drivers,
        "owner": vertices[owner],
        "moved": local[:, : 3 * len(drivers)],
        "pushed": local[:, 3 * len(drivers) :],
    }


def _zooms(model: FEModel, corner: Corner) -> list[Submodel]:
    """The surroundings of a corner, divided, and what is close to the fillet, divided again."""
    names = [face_group(corner.pocket, f) for f in range(len(FACES))]

    def flanks(part: FEModel) -> np.ndarray:
        return np.concatenate([part.groups[name] for name in names if name in part.groups])

    around = submodel(model, corner.cells, curved=corner.fillet, flanks=flanks(model))
    if corner.fine:
        return [around]
    cells = _close(around, corner)
    return [
        around,
        submodel(around.model, cells, curved=around.curved, flanks=flanks(around.model)),
    ]


def _close(around: Submodel, corner: Corner) -> np.ndarray:
    """Tetrahedra of the first submodel that touch the fillet or nearly so, off its cut."""
    model, axes = around.model, corner.frame[[0, 2]].T
    arc = model.points[np.unique(around.curved)] @ axes
    reach = _REACH_CLOSE * np.ptp(arc[:, 0])
    distance = cKDTree(arc).query(model.points[model.tets].mean(axis=1) @ axes)[0]
    on_cut = np.isin(model.tets, around.cut).any(axis=1)
    touching = np.isin(model.tets, around.curved).any(axis=1)
    return np.flatnonzero(((distance < reach) | touching) & ~on_cut)


def _points(model: FEModel, corner: Corner, zooms: list[Submodel]) -> np.ndarray:
    """Vertices of the last submodel at which stress is looked for: those of the mesh, in the middle
    between them along the arc, and next to the lands, where a peak along the radius is."""
    found = np.searchsorted(zooms[0].kept, np.unique(corner.fillet))
    arcs = _along_arc(model.points, corner.fillet)
    found = np.concatenate([found, zooms[0].midpoints(arcs)])
    whole, curved = model, corner.fillet
    for zoom in zooms[1:]:
        found = np.searchsorted(zoom.kept, found)
        whole, curved = zooms[0].model, zooms[0].curved
    return np.concatenate([found, zooms[-1].midpoints(_off_lands(whole, curved))])


def _off_lands(model: FEModel, curved: np.ndarray) -> np.ndarray:
    """Edges (n, 2) of a surface that leave a land most along the radius, one at every vertex."""
    ends = np.intersect1d(curved, _on_lands(model))
    edges = edges_of(curved)
    at_end = np.isin(edges, ends)
    single = at_end.sum(axis=1) == 1
    edges, at_end = edges[single], at_end[single]
    order = np.argsort(-_radial_share(model.points, edges), kind="stable")
    _, steepest = np.unique(edges[at_end][order], return_index=True)
    return edges[order[steepest]]


def _along_arc(points: np.ndarray, fillet: np.ndarray) -> np.ndarray:
    """A fillet's edges (n, 2) along its arc."""
    edges = edges_of(fillet)
    return edges[_radial_share(points, edges) < 0.5]


def _arc_edge(points: np.ndarray, fillet: np.ndarray) -> float:
    """Mean length [m] of a fillet's edges along its arc."""
    arcs = points[_along_arc(points, fillet)]
    return float(np.linalg.norm(np.diff(arcs, axis=1), axis=2).mean())


def _on_lands(model: FEModel) -> np.ndarray:
    """Vertices of the lands that the model has."""
    own = [model.groups[name].ravel() for name in LANDS if name in model.groups]
    return np.unique(np.concatenate(own)) if own else np.empty(0, int)


def _radial_share(points: np.ndarray, edges: np.ndarray) -> np.ndarray:
    """How much of edges (n, 2) runs along the radius."""
    ends = points[edges]
    radius = np.hypot(ends[..., 1], ends[..., 2])
    return np.abs(np.diff(radius)[:, 0]) / np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)


def _face_loads(
    part: FEModel,
    corner: Corner,
    stations: np.ndarray,
    totals: list[np.ndarray],
    pocket_count: int,
) -> np.ndarray:
    """Nodal loads (n, 3, 4 n_st 3) of the forces that ``Fillet`` takes, as far as they act on the
    part: face by face, station by station, components of the pockets' frames, mirrored."""
    along, across = corner.mirror
    n_st = stations.shape[1]
    out = np.zeros((len(part.nodes), 3, 4, n_st, 3))
    for i, (pocket, face) in enumerate(corner.faces(pocket_count)):
        if face_group(pocket, face) not in part.groups:
            continue
        rows = hat_weights(part, pocket, face, stations[face], pocket_count).toarray()
        rows = (rows / totals[i][:, None])[:: along if face < 2 else across]
        axes = np.diag([along, 1.0, across]) @ pocket_frame(pocket, pocket_count)
        out[:, :, i] = np.einsum("sn,cb->nbsc", rows, axes)
    return out.reshape(len(part.nodes), 3, -1)
