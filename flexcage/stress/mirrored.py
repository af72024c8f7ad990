"""Stress of a cage that is the mirror image, in the plane x = 0, of the one that was reduced: what
moves and pushes it is seen in the mirror, and fields are turned back."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from flexcage.stress.recovery import CageLoads

POLAR, AXIAL = np.array([-1.0, 1.0, 1.0]), np.array([1.0, -1.0, -1.0])
_TENSOR = np.array([1.0, 1.0, 1.0, -1.0, 1.0, -1.0])  # xx, yy, zz, xy, yz, xz
_SWAPPED = (1, 0, 2, 3, 4, 6, 5, 8, 7, 9)  # nodes of a tetrahedron, edges' middles included
Across = tuple[np.ndarray, np.ndarray]  # faces and stations, as ``ContactInterface.across``


@dataclass(frozen=True, eq=False)
class MirroredForces:
    """Forces on stations (nt, Z, F, n_st, 3) in the mirror, sample by sample as asked for."""

    forces: Any
    across: Across

    def __len__(self) -> int:
        return len(self.forces)

    def __getitem__(self, part: slice) -> np.ndarray:
        return in_mirror(np.asarray(self.forces[part]), self.across)


def in_mirror(forces: np.ndarray, across: Across) -> np.ndarray:
    """Forces (..., Z, F, n_st, 3) on stations, components (x, r, psi), in the mirror."""
    faces, stations = across
    seen: np.ndarray = forces[..., faces, stations, :] * POLAR.astype(forces.dtype)
    return seen


def mirrored_loads(loads: CageLoads, across: Across) -> CageLoads:
    """What pushes the cage at one instant, in the mirror; lands have no forces along x."""
    return replace(
        loads,
        station_forces=in_mirror(loads.station_forces, across),
        angular_velocity=loads.angular_velocity * AXIAL,
    )


def mirrored_fields(displacement: np.ndarray, stress: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Displacement (n, 3) and stress (m, 6), which were found in the mirror, of the cage itself."""
    return displacement * POLAR, stress * _TENSOR


def mirrored_solid(nodes: np.ndarray, cells: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Nodes (N, 3) and tetrahedra (n, 4 or 10) of the mirror image."""
    return nodes * POLAR, cells[:, list(_SWAPPED[: cells.shape[1]])]
