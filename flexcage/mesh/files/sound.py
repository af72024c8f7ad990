"""Whether a file's tetrahedra make a body: each has a volume, and no two lie in one place."""

from __future__ import annotations

import logging
from pathlib import Path

import numpy as np
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components
from scipy.spatial import cKDTree

from flexcage.core.errors import InputError
from flexcage.mesh.cage_mesh import signed_volumes
from flexcage.mesh.files.raw import RawMesh, first_alike

log = logging.getLogger(__name__)

_TOGETHER = 1e-8  # of the mesh's size
_FLAT = 1e-9  # of the mean volume
_FACES = np.array([[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]])  # outward at positive volume
# ends of the edges on which tetrahedra have nodes: of ten nodes in meshio's order, of more in gmsh'
_TEN = np.array([(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)])
_MORE = np.array([(0, 1), (1, 2), (2, 0), (3, 0), (3, 2), (3, 1)])
_ORDER = {10: 2, 20: 3, 35: 4, 56: 5, 84: 6, 120: 7, 165: 8, 220: 9, 286: 10}
_STRAIGHT = 1e-3  # of an edge's length, that a node may lie off it by rounding
_BENT = 0.5  # an edge that leaves its middle by more is none that a program meshes
_ORDERED = (
    ". Nodes that far off are no curves: they may be in the order of another program, which does "
    "no harm if the first four of each element are its corners"
)


def sound_tetrahedra(raw: RawMesh, path: Path) -> np.ndarray:
    """Corners (m, 4) of a file's tetrahedra, turned if all are numbered the other way round.

    InputError for elements of no or negative volume, or in the place of others, with their numbers;
    a warning for nodes that no element has, and for voids inside.
    """
    tets = raw.tets
    _check_places(raw, path)
    volumes = signed_volumes(raw.points, tets)
    if (volumes < 0.0).all():
        tets, volumes = tets[:, [0, 2, 1, 3]], -volumes
    _refuse_twice(raw, tets, path)
    wrong = np.flatnonzero(volumes <= _FLAT * np.abs(volumes).mean())
    if len(wrong):
        raise InputError(
            f"{path} has {len(wrong)} inverted or flat elements of {len(tets)} "
            f"({raw.solids_named(wrong)}); repair it",
            where="mesh.file",
            value=str(path),
        )
    _refuse_overlap(raw, tets, path)
    _warn_of_unused(raw, path)
    _warn_of_voids(raw, tets, path)
    return tets


def _check_places(raw: RawMesh, path: Path) -> None:
    wrong = np.flatnonzero(~np.isfinite(raw.points).all(axis=1))
    if len(wrong):
        raise InputError(
            f"{path} has nodes whose place is no number ({raw.points_named(wrong)})",
            where="mesh.file",
            value=str(path),
        )


def _refuse_twice(raw: RawMesh, tets: np.ndarray, path: Path) -> None:
    first = first_alike(np.sort(tets, axis=1))
    twice = np.flatnonzero(first != np.arange(len(tets)))
    if len(twice):
        raise InputError(
            f"{path} has elements in the place of others ({len(twice)} of {len(tets)}): "
            f"{raw.solids_named(twice)} on the nodes of {raw.solids_named(first[twice])}; delete "
            "them",
            where="mesh.file",
            value=str(path),
        )


def _refuse_overlap(raw: RawMesh, tets: np.ndarray, path: Path) -> None:
    """Refuse elements that share a face but lie on the same side of it."""
    faces = tets[:, _FACES].reshape(-1, 3)
    least = np.argmin(faces, axis=1)[:, None]
    turned = np.take_along_axis(faces, (least + [0, 1, 2]) % 3, axis=1)
    first = first_alike(turned)
    again = np.flatnonzero(first != np.arange(len(turned)))
    if len(again):
        other = np.unique(first[again] // 4)
        raise InputError(
            f"{path} has elements that lie on the same side of a face and overlap: "
            f"{raw.solids_named(np.unique(again // 4))} and {raw.solids_named(other)}; mesh it "
            "again",
            where="mesh.file",
            value=str(path),
        )


def _warn_of_unused(raw: RawMesh, path: Path) -> None:
    used = np.zeros(len(raw.points), bool)
    for block in raw.solids:
        used[block] = True
    if not used.all():
        unused = np.flatnonzero(~used)
        log.warning(
            "%s has nodes that no tetrahedron has (%d of %d): %s; they are left out",
            path, len(unused), len(used), raw.points_named(unused),
        )  # fmt: skip


def _warn_of_voids(raw: RawMesh, tets: np.ndarray, path: Path) -> None:
    """Say where the surface is in several pieces, joined at edges by two faces each: beside the
    outside each is a void, that may touch it at a node or along an edge."""
    faces = tets[:, _FACES].reshape(-1, 3)
    alike = first_alike(np.sort(faces, axis=1))
    free = faces[np.bincount(alike, minlength=len(faces))[alike] == 1]
    edges = first_alike(np.sort(free[:, [[0, 1], [1, 2], [2, 0]]].reshape(-1, 2), axis=1))
    of_two = np.bincount(edges, minlength=len(edges))[edges] == 2
    again = np.flatnonzero(of_two & (edges != np.arange(len(edges))))
    pairs = again // 3, edges[again] // 3
    joined = coo_array((np.ones(len(again), bool), pairs), shape=(len(free), len(free)))
    piece = connected_components(joined, directed=False)[1]
    inner = piece != np.argmax(np.bincount(piece))
    if inner.any():
        log.warning(
            "%s has %d voids inside, with the nodes %s: are elements missing there?",
            path, len(np.unique(piece[inner])), raw.points_named(np.unique(free[inner])),
        )  # fmt: skip


def in_one_place(raw: RawMesh, used: np.ndarray) -> str:
    """Which of the corners ``used`` (n,) lie in one place, in words; '' if none does.

    That is where a crack is, or where parts were not merged.
    """
    pairs = coincident(raw.points[used])
    return f"{len(pairs)} nodes ({raw.points_named(used[pairs[:, 1]])})" if len(pairs) else ""


def coincident(points: np.ndarray) -> np.ndarray:
    """Pairs (k, 2) of points (n, 3) that lie in one place but for rounding."""
    near = _TOGETHER * float(np.ptp(points, axis=0).max())
    return np.sort(cKDTree(points).query_pairs(near, output_type="ndarray"), axis=1)


def faces_counted(tets: np.ndarray, triangles: np.ndarray) -> np.ndarray:
    """How many tetrahedra (m, 4) have each triangle (n, 3) as a face (n,)."""
    faces = tets[:, _FACES].reshape(-1, 3)
    first = first_alike(np.sort(np.vstack([triangles, faces]), axis=1))
    count = np.bincount(first[len(triangles) :], minlength=len(first))
    return count[first[: len(triangles)]]


def refuse_shared(rows: np.ndarray, owner: np.ndarray, names: list[str], path: Path) -> None:
    """Refuse a triangle of ``rows`` (n, 3) that is in two groups (``owner`` (n,), of ``names``):
    contact would count it twice."""
    first = first_alike(np.sort(rows, axis=1))
    again = np.flatnonzero(first != np.arange(len(rows)))
    if len(again):
        one, other = names[owner[first[again[0]]]], names[owner[again[0]]]
        raise InputError(
            f"{path}: {len(again)} triangles are in two groups, as of {one!r} and {other!r}; give "
            "each to one",
            where="mesh.file",
            value=other,
        )


def warn_of_curves(raw: RawMesh, path: Path) -> None:
    """Say how far nodes lie off their edges, if that is more than rounding."""
    worst = 0.0
    for block in raw.solids:
        order = _ORDER.get(block.shape[1], 1)
        edges, each = (_TEN, 1) if order == 2 else (_MORE, order - 1)
        if not each:
            continue
        start, end = raw.points[block[:, edges]].transpose(2, 0, 1, 3)
        along, nodes = end - start, raw.points[block[:, 4 : 4 + 6 * each]]
        length = np.linalg.norm(along, axis=-1)
        for k in range(each):
            share = (k + 1) / order
            off = nodes[:, k::each] - start - share * along
            worst = max(worst, float((np.linalg.norm(off, axis=-1) / length).max()))
    if worst > _STRAIGHT:
        log.warning(
            "%s: edges of elements are curved, with nodes up to %.2g %% of an edge off its middle; "
            "elements are read by their corners, so that curved faces become flat%s",
            path, 100.0 * worst, _ORDERED if worst > _BENT else "",
        )  # fmt: skip
