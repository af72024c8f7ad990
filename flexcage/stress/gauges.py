"""Strain gauges on a flexible cage over a run, by mode acceleration as stresses (``fields``).

A gauge's strain is linear in displacements, g u. So one solution under the loads g gives, by the
symmetry of the free body's flexibility, what every contact force adds:

    strain(t) = (g Phi) q(t) + sum_j F_j(t) [u_g at j - (g Phi) k^-1 (Phi at j)]

with the modes Phi, their stiffness k, and the displacements u_g under the loads g.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from flexcage.core.hashing import content_hash
from flexcage.modes.pockets import pocket_frames
from flexcage.results.signals.spec import StrainGauge
from flexcage.stress.gauge_lines import gauge_rows
from flexcage.stress.history import Sliced
from flexcage.stress.recovery import StressRecovery

GAUGE_VERSION = 1  # of what is kept: raise it when the same gauge gives other numbers
_READ = 512  # samples at a time


@dataclass(frozen=True)
class GaugeFields:
    """Strains of n gauges per unit modal coordinate (n, modes), per newton at the stations of
    pockets (n, Z, F, n_st, 3) and of lands (n, 2, n_land, 3), beyond the modes."""

    modes: np.ndarray
    stations: np.ndarray
    lands: np.ndarray

    def strains(
        self, q: Sliced, station_forces: Sliced, land_forces: Sliced | None = None
    ) -> np.ndarray:
        """Strains (n_gauges, nt) [1]; arguments as in ``history.stress_history``."""
        found = []
        for first in range(0, len(q), _READ):
            part = slice(first, min(first + _READ, len(q)))
            pushed = np.asarray(station_forces[part], float)
            own = np.asarray(q[part], float) @ self.modes.T
            own += np.tensordot(pushed, self.stations, (range(1, 5), range(1, 5)))
            if land_forces is not None:
                land = np.asarray(land_forces[part], float)
                own += np.tensordot(land, self.lands, (range(1, 4), range(1, 4)))
            found.append(own)
        return np.concatenate(found).T


def gauge_fields(
    recovery: StressRecovery, gauges: Sequence[StrainGauge], radius: float
) -> GaugeFields:
    """Fields of gauges on a recovery's cage, the middle of whose wall has a ``radius`` [m]; they
    are kept as those of stresses are. InputError for a gauge beside the cage's surface."""
    rows = gauge_rows(recovery.model, gauges, recovery.pocket_count, radius)
    name = f"gauges_{content_hash(GAUGE_VERSION, rows)}"
    return GaugeFields(**recovery.keep(name, lambda: vars(_fields(recovery, rows))))


def _fields(recovery: StressRecovery, rows: np.ndarray) -> GaugeFields:
    shapes = recovery.basis.shapes
    modes = rows @ shapes.reshape(rows.shape[1], -1)
    static = recovery.solver.solve(np.ascontiguousarray(rows.T)).reshape(-1, 3, len(rows))
    own = modes @ np.linalg.inv(recovery.basis.stiffness)  # (n, modes)
    count, faces = recovery.pocket_count, len(recovery.interface.single)
    per_pocket = recovery.weights.shape[0] // count
    frames = np.repeat(recovery.frames, per_pocket, axis=0)

    def beyond(weights: sp.csr_matrix, frames: np.ndarray, pushed: np.ndarray) -> np.ndarray:
        """Of forces along the rows of frames (m, 3, 3) at m stations: (n, m, 3)."""
        there = _at(weights, static, frames) - _at(weights, shapes, frames) @ (own * pushed).T
        return np.moveaxis(there, -1, 0)

    every = np.ones(modes.shape[1])
    stations = beyond(recovery.weights, frames, every)
    n_land = recovery.land_weights.shape[0] // 2
    around = np.tile(pocket_frames(n_land), (2, 1, 1))
    lands = beyond(recovery.land_weights, around, recovery.felt_by_lands)
    return GaugeFields(
        modes=modes,
        stations=stations.reshape(len(rows), count, faces, -1, 3),
        lands=lands.reshape(len(rows), 2, n_land, 3),
    )


def _at(weights: sp.csr_matrix, fields: np.ndarray, frames: np.ndarray) -> np.ndarray:
    """Displacements (m, 3, n) at m stations of fields (N, 3, n), along the rows of frames."""
    moved = (weights @ fields.reshape(len(fields), -1)).reshape(-1, 3, fields.shape[2])
    return np.einsum("mab,mbn->man", frames, moved)
