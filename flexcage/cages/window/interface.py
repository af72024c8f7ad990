"""A window cage as contacts see it: stations on pocket faces and lands, and what moves there."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
import scipy.sparse as sp

from flexcage.cages.window.cage import WindowCage
from flexcage.cages.window.defects import WindowDefect
from flexcage.cages.window.windowed import WindowedCage
from flexcage.fem.model import FEModel
from flexcage.modes.basis import FACES, CageInterface, ModeBasis
from flexcage.modes.interface import (
    LAND_STATIONS,
    averaged,
    land_modes,
    land_station_weights,
    normalised,
)
from flexcage.modes.pockets import (
    LOADS_PER_POCKET,
    face_axes,
    face_group,
    hat_weights,
    vector_frames,
)
from flexcage.modes.reduction import CageReduction, Interfaces

OFFSET_POINTS = 65  # along a face: a bent beam's curve to a quarter of a micrometre for 0.2 mm


def face_stations(cage: WindowedCage, n_stations: int) -> np.ndarray:
    """Station coordinates (4, n_st) [m]: centres of equal cells of a face's flat part.

    Equal cells make a uniform load equal station forces; beyond the outer stations values are
    constant (clamp the coordinate when interpolating).
    """
    cells = (np.arange(n_stations) + 0.5) / n_stations - 0.5
    return np.outer(_face_lengths(cage) - 2.0 * cage.fillet_radius, cells)


def _face_lengths(cage: WindowedCage) -> np.ndarray:
    """Lengths (4,) [m] of a pocket's faces, corner to corner."""
    return np.array([*[cage.pocket_length] * 2, cage.end_width(1.0), cage.end_width(-1.0)])


def offset_points(cage: WindowedCage) -> np.ndarray:
    """Points (4, OFFSET_POINTS) [m] along the whole length of the faces, corner to corner."""
    unit = np.linspace(-0.5, 0.5, OFFSET_POINTS)
    return np.outer(_face_lengths(cage), unit)


def face_offsets(
    cage: WindowedCage, points: np.ndarray, *, pocket_count: int, defects: Sequence[WindowDefect]
) -> np.ndarray:
    """Stress-free outward displacement (Z, 4, n) [m] of the faces at ``points`` (4, n) on them."""
    offset = np.zeros((pocket_count, *points.shape))
    for defect in defects:
        offset += defect.offsets(points, cage, pocket_count=pocket_count)
    return offset


def rigid_interface(
    cage: WindowedCage,
    *,
    pocket_count: int,
    defects: Sequence[WindowDefect] = (),
    n_stations: int = 7,
    n_land: int = LAND_STATIONS,
) -> CageInterface:
    """Interface of a rigid cage: no modes, no compliance, no mesh; defects in the offsets."""
    stations, points = face_stations(cage, n_stations), offset_points(cage)
    faces = (pocket_count, len(FACES), n_stations)
    return CageInterface(
        stations=stations,
        offset=face_offsets(cage, points, pocket_count=pocket_count, defects=defects),
        offset_at=points,
        modes=np.zeros((*faces, 3, 0)),
        residual=np.zeros((*faces, LOADS_PER_POCKET)),
        compliance=np.zeros((pocket_count, LOADS_PER_POCKET, LOADS_PER_POCKET)),
        patch_half_width=_patch_half_width(cage),
        land=np.zeros((2, n_land, 3, 0)),
    )


def cage_interface(
    model: FEModel,
    basis: ModeBasis,
    *,
    pocket_count: int,
    cage: WindowedCage,
    defects: Sequence[WindowDefect] = (),
    n_stations: int = 7,
    n_land: int = LAND_STATIONS,
) -> CageInterface:
    """Interface of a flexible cage: modes and residual vectors averaged at the stations.

    ``n_land`` = 0 leaves the lands out.
    """
    stations, points = face_stations(cage, n_stations), offset_points(cage)
    weights = station_weights(model, stations, pocket_count)
    land_weights = land_station_weights(model, n_land)
    residual, compliance = _residual_at_stations(
        basis, weights, vector_frames(model, pocket_count), face_axes(model).normal
    )
    return CageInterface(
        stations=stations,
        offset=face_offsets(cage, points, pocket_count=pocket_count, defects=defects),
        offset_at=points,
        modes=_modes_at_stations(basis, weights, vector_frames(model, pocket_count)),
        residual=residual,
        compliance=compliance,
        patch_half_width=_patch_half_width(cage),
        land=land_modes(basis, land_weights, n_land),
        weights=weights,
        land_weights=land_weights,
    )


def _patch_half_width(cage: WindowedCage) -> float:
    return 0.5 * cage.wall


def station_weights(model: FEModel, stations: np.ndarray, pocket_count: int) -> sp.csr_matrix:
    """Weights (Z*4*n_st, N): station value <- nodal values, rows summing to one."""
    faces = [(k, f) for k in range(pocket_count) for f in range(len(FACES))]
    return normalised(
        sp.vstack([hat_weights(model, k, f, stations[f], pocket_count) for k, f in faces]),
        [face_group(k, f) for k, f in faces],
    )


def _modes_at_stations(basis: ModeBasis, weights: sp.csr_matrix, frames: np.ndarray) -> np.ndarray:
    means = averaged(basis.shapes, weights)
    means = means.reshape(len(frames), len(FACES), -1, 3, basis.size)
    return np.ascontiguousarray(np.einsum("kab,kfsbn->kfsan", frames, means))


def _residual_at_stations(
    basis: ModeBasis, weights: sp.csr_matrix, frames: np.ndarray, normals: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Outward displacement (Z, 4, n_st, 12) of each pocket's own vectors, and compliances.

    Vectors that the basis lacks are zero: quadratic ones with linear attachments. ``normals``
    (4, 3): the faces' normals in their pocket's frame, one of ``frames`` (Z, 3, 3).
    """
    loads, pocket_count = LOADS_PER_POCKET, len(frames)
    n_stations = weights.shape[0] // (pocket_count * len(FACES))
    at_stations = np.zeros((pocket_count, len(FACES), n_stations, loads))
    compliance = np.zeros((pocket_count, loads, loads))
    if basis.residual is None:
        return at_stations, compliance
    shapes = basis.residual.shapes
    assert shapes is not None, "an interface is made with the basis"
    per = shapes.shape[2] // pocket_count
    compliance[:, :per, :per] = basis.residual.compliance
    rows = len(FACES) * n_stations
    for pocket in range(pocket_count):
        own = shapes[:, :, pocket * per : (pocket + 1) * per]
        ways = np.repeat(normals @ frames[pocket], n_stations, axis=0)
        means = averaged(own, weights[pocket * rows : (pocket + 1) * rows])
        outward = np.einsum("sa,san->sn", ways, means)
        at_stations[pocket, ..., :per] = outward.reshape(len(FACES), n_stations, per)
    return at_stations, compliance


def reduced_interface(cage: CageReduction) -> CageInterface:
    """Interface of a reduced cage with windows."""
    return cage_interface(
        cage.model,
        cage.basis,
        pocket_count=cage.mesh.pocket_count,
        cage=cage.cage,
        defects=cage.defects,
    )


def _depends_on(
    cage: WindowCage, defects: Sequence[WindowDefect], pocket_count: int
) -> tuple[Any, ...]:
    pocket = (cage.pocket_length, cage.pocket_width, cage.fillet_radius)
    points = offset_points(cage)
    offsets = face_offsets(cage, points, pocket_count=pocket_count, defects=defects)
    return pocket, cage.bore, cage.outside_diameter, offsets


WINDOW_INTERFACES: Interfaces[WindowCage] = Interfaces(
    kind=CageInterface, rigid=rigid_interface, reduced=reduced_interface, depends_on=_depends_on
)
