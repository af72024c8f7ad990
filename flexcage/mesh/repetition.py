"""How a mesh from a file repeats from pocket to pocket, found from its points and tetrahedra.

Where a point turned by one pocket meets another, that one follows it; tetrahedra all of whose
vertices are followed by those of another are the seeds. From there the search walks across faces:
what lies behind a face is followed by what lies behind the face that follows. So it needs no
coordinates where a defect moved the mesh, only the same connections in every sector.
"""

from __future__ import annotations

import logging
from dataclasses import dataclass

import numpy as np
from scipy.spatial import cKDTree

from flexcage.mesh.ring import turn_about_x

log = logging.getLogger(__name__)

_SEED = 1e-5  # misfit of a turned point and the one that follows, relative to the ring's size
_ROUNDING = 1e-6  # misfit, likewise, that seven digits in a file leave: such points are set right
_FACES = np.array([[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]])  # opposite to each vertex


@dataclass(frozen=True)
class Repetition:
    """A mesh of ``count`` sectors about x of the same connections."""

    following: np.ndarray  # (n_points,) the vertex that has a vertex's place in the next sector
    cells: np.ndarray  # (count, n) tetrahedra of every sector, those of the first around psi = 0
    points: np.ndarray  # (n_points, 3) of which those that repeat but for rounding do so exactly


def find_repetition(points: np.ndarray, tets: np.ndarray, count: int) -> Repetition | None:
    """The sectors of a mesh, or None where it is not made of ``count`` sectors about x.

    Points (n_points, 3) may differ by more than a turn, as a defect leaves them; connections may
    not.
    """
    if count < 3 or len(points) % count or len(tets) % count:
        return None
    following = _followed_points(points, tets, count)
    if following is None:
        return None
    after = _rows_of(tets, following[tets])
    if after is None:
        return None
    vertices, cells = _orbits(following, count), _orbits(after, count)
    if vertices is None or cells is None:
        return None
    cells = _from_first_sector(points[tets[cells]].mean(axis=2), cells)
    return Repetition(following, cells, _set_right(points, vertices))


def _followed_points(points: np.ndarray, tets: np.ndarray, count: int) -> np.ndarray | None:
    """The vertex (n_points,) that follows each, or None."""
    turned = points @ turn_about_x(2.0 * np.pi / count).T
    distance, nearest = cKDTree(points).query(turned)
    following = np.where(distance < _SEED * np.abs(points).max(), nearest, -1)
    seeds = np.flatnonzero((following[tets] >= 0).all(axis=1))
    found = _search(tets, following[tets[seeds]])
    seeds, found = seeds[found >= 0], found[found >= 0]
    following = np.full(len(points), -1)
    following[tets[seeds]] = nearest[tets[seeds]]
    neighbours, opposite = _neighbours(tets)
    after = np.full(len(tets), -1)
    after[seeds] = found
    while len(seeds):
        image = after[seeds]
        there = tets[image]
        fresh = []
        for i in range(4):
            mate = following[tets[seeds, i]]
            place = (there == mate[:, None]).argmax(axis=1)
            own, other = neighbours[seeds, i], neighbours[image, place]
            if ((own < 0) != (other < 0)).any():
                return None
            inner = (own >= 0) & (after[own] < 0)
            own, other = own[inner], other[inner]
            following[opposite[seeds[inner], i]] = opposite[image[inner], place[inner]]
            after[own] = other
            fresh.append(own)
        seeds = np.unique(np.concatenate(fresh))
    return following if (following >= 0).all() else None


def _neighbours(tets: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """The tetrahedron behind the face opposite to every vertex (n, 4), or -1, and the vertex of it
    that is not on that face (n, 4)."""
    faces = np.sort(tets[:, _FACES].reshape(-1, 3), axis=1)
    order = np.lexsort(faces.T)
    same = (faces[order[1:]] == faces[order[:-1]]).all(axis=1)
    first, second = order[:-1][same], order[1:][same]
    behind, opposite = np.full(len(faces), -1), np.full(len(faces), -1)
    behind[first], behind[second] = second // 4, first // 4
    flat = tets.ravel()
    opposite[first], opposite[second] = flat[second], flat[first]
    return behind.reshape(-1, 4), opposite.reshape(-1, 4)


def _search(tets: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Which tetrahedron (m,) has the vertices ``wanted`` (m, 4) in any order, or -1."""
    rows = np.sort(tets, axis=1)
    both, number = np.unique(
        np.concatenate([rows, np.sort(wanted, axis=1)]), axis=0, return_inverse=True
    )
    place = np.full(len(both), -1)
    place[number.ravel()[: len(rows)]] = np.arange(len(rows))
    return place[number.ravel()[len(rows) :]]


def _rows_of(tets: np.ndarray, wanted: np.ndarray) -> np.ndarray | None:
    """The same where every tetrahedron is wanted once; None where not."""
    found = _search(tets, wanted)
    return found if np.array_equal(np.sort(found), np.arange(len(tets))) else None


def _orbits(after: np.ndarray, count: int) -> np.ndarray | None:
    """What follows one another ``count`` times (count, n), each once; None if it does not close."""
    rows = [np.arange(len(after))]
    for _ in range(count - 1):
        rows.append(after[rows[-1]])
    orbits = np.stack(rows)
    if not np.array_equal(after[rows[-1]], rows[0]):
        return None
    own = orbits[:, orbits.min(axis=0) == rows[0]]
    return own if len(np.unique(own)) == len(after) == own.size else None


def _from_first_sector(middles: np.ndarray, cells: np.ndarray) -> np.ndarray:
    """Tetrahedra (count, n) in rows that begin around psi = 0, from their centres (count, n, 3).

    Most of those that follow one another tell their place: a defect moves few.
    """
    count = len(cells)
    pitch = 2.0 * np.pi / count
    azimuth = np.arctan2(middles[..., 2], middles[..., 1]) - pitch * np.arange(count)[:, None]
    difference = (azimuth - azimuth[0] + np.pi) % (2.0 * np.pi) - np.pi
    first = -np.round((azimuth[0] + np.median(difference, axis=0)) / pitch).astype(int)
    rows = (first + np.arange(count)[:, None]) % count
    return np.take_along_axis(cells, rows, axis=0)


def _set_right(points: np.ndarray, vertices: np.ndarray) -> np.ndarray:
    """The points, those of ``vertices`` (count, n) equal to what most are, turned, where only
    rounding parts them."""
    count, limit = len(vertices), _ROUNDING * np.abs(points).max()
    turns = np.stack([turn_about_x(2.0 * np.pi * k / count) for k in range(count)])
    back = np.einsum("knb,kba->kna", points[vertices], turns)
    place = np.median(back, axis=0)
    alike = np.linalg.norm(back - place, axis=2) < limit
    place = (
        np.where(alike[..., None], back, 0.0).sum(axis=0)
        / np.maximum(alike.sum(axis=0), 1)[:, None]
    )
    right = np.array(points)
    right[vertices[alike]] = np.einsum("kab,nb->kna", turns, place)[alike]
    moved = np.linalg.norm(right - points, axis=1).max()
    if moved > 1e-12 * np.abs(points).max():
        log.info(
            "the mesh repeats but for its file's rounding: points moved by up to %.2g nm",
            moved * 1e9,
        )
    return right
