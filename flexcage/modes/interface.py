"""What all cages' contact interfaces share: means over stations, and the lands' stations."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np
import scipy.sparse as sp

from flexcage.core.errors import InputError
from flexcage.fem.model import FEModel
from flexcage.modes.basis import ModeBasis
from flexcage.modes.lands import LANDS
from flexcage.modes.pockets import pocket_frames

LAND_STATIONS = 24  # round a land


def normalised(weights: sp.spmatrix, groups: Sequence[str]) -> sp.csr_matrix:
    """Rows divided by their sums, so that each is a weighted mean.

    Rows are stations of ``groups``, as many of each; InputError for one without any area.
    """
    total = np.asarray(weights.sum(axis=1)).ravel()
    empty = np.flatnonzero(total <= 1e-9 * total.max(initial=0.0))
    if len(empty):
        group, station = divmod(int(empty[0]), len(total) // len(groups))
        raise InputError(
            f"The cage's mesh has no area of group '{groups[group]}' at its contact station "
            f"{station + 1} of {len(total) // len(groups)}, and at {len(empty) - 1} others; give a "
            "group all triangles of its face.",
            where="mesh",
            value=groups[group],
        )
    return sp.csr_matrix(sp.diags_array(1.0 / total) @ weights)


def land_station_weights(model: FEModel, n_land: int) -> sp.csr_matrix:
    """Weights (2*n_land, N) of hats in azimuth on the bore and the outside; zero where absent."""
    rows = []
    for name in LANDS:
        if not n_land:
            rows.append(sp.csr_matrix((0, len(model.nodes))))
            continue
        if name not in model.groups or not len(model.groups[name]):
            rows.append(sp.csr_matrix((n_land, len(model.nodes))))
            continue
        rows.append(
            normalised(model.face_weights(model.group(name), _azimuth_hats(n_land)), [name])
        )
    return sp.csr_matrix(sp.vstack(rows))


def _azimuth_hats(n_land: int):
    def hats(points: np.ndarray) -> np.ndarray:
        place = np.arctan2(points[:, 2], points[:, 1]) * n_land / (2.0 * np.pi)
        difference = (
            place[None] - np.arange(n_land)[:, None] + 0.5 * n_land
        ) % n_land - 0.5 * n_land
        return np.maximum(1.0 - np.abs(difference), 0.0)

    return hats


def averaged(shapes: np.ndarray, weights: sp.csr_matrix) -> np.ndarray:
    """Weighted means (rows, 3, n) of shapes (N, 3, n)."""
    n_nodes, _, n = shapes.shape
    return (weights @ shapes.reshape(n_nodes, 3 * n)).reshape(weights.shape[0], 3, n)


def land_modes(basis: ModeBasis, weights: sp.csr_matrix, n_land: int) -> np.ndarray:
    """Modes (2, n_land, 3, n) at the lands' stations, components (x, r, psi) of their frames.

    Crossbeams' shapes repeat with the pockets, too fast for the stations, and would carry half a
    percent of a land's yielding: without land vectors in the basis they are zero here.
    """
    means = averaged(basis.shapes, weights).reshape(2, n_land, 3, basis.size)
    frames = pocket_frames(n_land)
    if "land" not in basis.kind:
        means[..., np.array(basis.kind) == "crossbeam"] = 0.0
    return np.ascontiguousarray(np.einsum("jab,ljbn->ljan", frames, means))
