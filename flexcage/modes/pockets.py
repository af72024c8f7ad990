"""Pocket frames and the distributed unit loads on pocket faces."""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType
from typing import NamedTuple

import numpy as np
import scipy.sparse as sp

from flexcage.core.errors import InputError
from flexcage.fem.model import FEModel
from flexcage.mesh.cage_mesh import FACE_AXES
from flexcage.modes.basis import FACES

ROW_AXES = "row_axes"  # in the ``info`` of the model of a row
# of the residual vectors by modes.attachments; an interface has room for all of them
LOADS = {"linear": 2 * len(FACES), "quadratic": 3 * len(FACES)}
LOADS_PER_POCKET = LOADS["quadratic"]
# outward normals, away from the pocket's centre, in its frame (x, r, psi)
NORMALS = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])


def frames_at(azimuth: np.ndarray | float) -> np.ndarray:
    """Rows: unit vectors x, r, psi (..., 3, 3) of the frames at azimuths (...,) [rad]."""
    c, s = np.cos(azimuth), np.sin(azimuth)
    zero, one = np.zeros_like(c), np.ones_like(c)
    rows = [[one, zero, zero], [zero, c, s], [zero, -s, c]]
    return np.stack([np.stack(row, axis=-1) for row in rows], axis=-2)


def pocket_frame(pocket: float, pocket_count: int) -> np.ndarray:
    """Rows: unit vectors x, r, psi (3, 3) of the frame at azimuth 2 pi pocket/pocket_count."""
    return frames_at(2.0 * np.pi * pocket / pocket_count)


def pocket_frames(pocket_count: int) -> np.ndarray:
    """The frames (Z, 3, 3) of all pockets, or of stations evenly round the cage."""
    return frames_at(2.0 * np.pi * np.arange(pocket_count) / max(pocket_count, 1))


def vector_frames(model: FEModel, pocket_count: int) -> np.ndarray:
    """Those of the pockets that a model counts, (Z, 3, 3), as vectors of the cage: of the model of
    a row (``modes.rows``) x is that of the row."""
    frames = pocket_frames(pocket_count)
    axes = model.info.get(ROW_AXES)
    return frames if axes is None else frames @ np.array(axes, float)


class FaceAxes(NamedTuple):
    """How a pocket's faces lie in its frame (x, r, psi): outward ``normal`` (4, 3), and the unit
    vectors ``along`` (4, 3) which the coordinates on them follow, from ``start`` (4,) [m]."""

    normal: np.ndarray
    along: np.ndarray
    start: np.ndarray


#: Of crossbeam faces along x and side-beam faces along the tangent.
STRAIGHT = FaceAxes(NORMALS, np.eye(3)[[0, 0, 2, 2]], np.zeros(4))


def with_face_axes(info: Mapping[str, object], axes: FaceAxes) -> Mapping[str, object]:
    """A mesh's ``info`` that says how its pockets' faces lie, where they are not ``STRAIGHT``."""
    rows = np.column_stack([*axes[:2], axes.start])
    return MappingProxyType({**info, FACE_AXES: tuple(tuple(map(float, row)) for row in rows)})


def face_axes(model: FEModel) -> FaceAxes:
    """How the faces of a model's pockets lie."""
    rows = model.info.get(FACE_AXES)
    if rows is None:
        return STRAIGHT
    table = np.array(rows, float)
    return FaceAxes(table[:, :3], table[:, 3:6], table[:, 6])


def face_coordinate(
    points: np.ndarray, pocket: int, face: int, pocket_count: int, axes: FaceAxes = STRAIGHT
) -> np.ndarray:
    """Coordinate along a face (n,) [m]: along the roller on crossbeam faces, tangential t on side
    beams."""
    return points @ (axes.along[face] @ pocket_frame(pocket, pocket_count)) - axes.start[face]


def hat_weights(
    model: FEModel, pocket: int, face: int, stations: np.ndarray, pocket_count: int
) -> sp.csr_matrix:
    """Integrals (n_st, N) [m^2] over a face, as far as the model has it, of the stations' hats."""

    axes = face_axes(model)

    def hats(points: np.ndarray) -> np.ndarray:
        return _hats(face_coordinate(points, pocket, face, pocket_count, axes), stations)

    return model.face_weights(model.group(face_group(pocket, face)), hats)


def _hats(s: np.ndarray, stations: np.ndarray) -> np.ndarray:
    """Hat functions (n_st, n) of the stations, constant beyond the outer ones; they sum to one."""
    unit = np.eye(len(stations))
    return np.stack([np.interp(s, stations, row) for row in unit])


def face_group(pocket: int, face: int) -> str:
    """Name of the mesh group of a pocket's face."""
    return f"pocket{pocket}_{FACES[face]}"


def check_groups(model: FEModel, pocket_count: int) -> None:
    """Refuse a mesh in which a pocket face has no triangles."""
    names = [face_group(k, f) for k in range(pocket_count) for f in range(len(FACES))]
    missing = [n for n in names if n not in model.groups or not len(model.groups[n])]
    if missing:
        raise InputError(
            f"the cage mesh lacks {len(missing)} of {len(names)} pocket face groups, "
            f"the first is {missing[0]!r}",
            where="mesh",
            value=missing[0],
        )


def pocket_loads(model: FEModel, pocket: int, pocket_count: int) -> np.ndarray:
    """Nodal loads (3N, 12) of a pocket: on face f columns 2f (uniform), 2f + 1 (linear) and 8 + f
    (quadratic).

    Uniform: a total force of 1 N along the face's outward normal. Linear: the same pressure
    times x = 2 s/length, s the face coordinate: -1 to +1 from end to end, no resultant. Quadratic:
    times Legendre's (3 x^2 - 1)/2, no resultant and no moment on a face of even height.
    """
    return sparse_pocket_loads(model, pocket, pocket_count).toarray()


def sparse_pocket_loads(
    model: FEModel, pocket: int, pocket_count: int, *, count: int = LOADS_PER_POCKET
) -> sp.csc_matrix:
    """The first ``count`` of them, sparse: few nodes of the cage are on a pocket's faces."""
    normals = face_axes(model).normal @ vector_frames(model, pocket_count)[pocket]
    faces = [
        sp.kron(_load_weights(model, pocket, face, pocket_count), normals[face : face + 1]).tocsr()
        for face in range(len(FACES))
    ]
    rows = [face[:2] for face in faces] + [face[2:] for face in faces]
    return sp.csc_matrix(sp.vstack(rows)[:count].T)


def _load_weights(model: FEModel, pocket: int, face: int, pocket_count: int) -> sp.csr_matrix:
    triangles, axes = model.group(face_group(pocket, face)), face_axes(model)
    ends = face_coordinate(model.points[np.unique(triangles)], pocket, face, pocket_count, axes)
    middle, half = 0.5 * (ends.max() + ends.min()), 0.5 * np.ptp(ends)

    def patterns(points: np.ndarray) -> np.ndarray:
        x = (face_coordinate(points, pocket, face, pocket_count, axes) - middle) / half
        return np.stack([np.ones_like(x), x, 1.5 * x**2 - 0.5])

    weights = model.face_weights(triangles, patterns)
    return weights / weights[0].sum()
