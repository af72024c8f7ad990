"""How fast rolling elements slide on the walls of their pockets, from recorded motions.

Bodies move as rigid ones here: the walls' own elastic velocity, some millimetres per second beside
the metres per second of a spinning element, is left out. Index letters: t sample, z pocket and its
element, s slice or point, f face.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.spatial.transform import Rotation

from flexcage.modes.pockets import frames_at

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True, eq=False)
class PocketMotion:
    """Elements as seen from the cage, vectors in space.

    ``place`` (t, z, 3) of their centres from the cage's [m], ``velocity`` (t, z, 3) less that of
    the cage there [m/s], ``spin`` (t, z, 3) less the cage's [rad/s]; ``axes`` (t, z, 3, 3) rows
    x, r, psi of the pockets; ``own`` (t, z, 3, 3) rows of the elements' non-spinning axes.
    """

    place: np.ndarray
    velocity: np.ndarray
    spin: np.ndarray
    axes: np.ndarray
    own: np.ndarray

    def along(self, vectors: np.ndarray) -> np.ndarray:
        """Components (t, z, 3), x, r, psi of the pockets, of vectors (t, z, 3) in space."""
        return np.einsum("tzij,tzj->tzi", self.axes, vectors)


def pocket_motion(ds: xarray.Dataset, azimuths: np.ndarray) -> PocketMotion:
    """Motion of the rolling elements in their pockets, which are at these azimuths (Z,) [rad]."""

    def of(variable: str) -> np.ndarray:
        return np.asarray(ds[variable].transpose("time", "element", ...).values, float)

    position, moving, omega = (of(f"element_{what}") for what in ("position", "velocity", "omega"))
    tilt = of("element_tilt") if "element_tilt" in ds else np.zeros((*omega.shape[:2], 2))
    azimuth = position[..., 2]
    around = frames_at(azimuth)
    own = _turned(azimuth, tilt)
    centre = position[..., :1] * around[..., 0, :] + position[..., 1:2] * around[..., 1, :]
    velocity = np.einsum("tzi,tzij->tzj", moving, around)
    spin = np.einsum("tzi,tzij->tzj", omega, own)
    attitude = Rotation.from_quat(ds["cage_quaternion"].values, scalar_first=True).as_matrix()
    cage_spin = np.einsum("tij,tj->ti", attitude, ds["cage_omega"].values)[:, None]
    place = centre - ds["cage_position"].values[:, None]
    relative = velocity - ds["cage_velocity"].values[:, None] - np.cross(cage_spin, place)
    axes = np.einsum("tij,zaj->tzai", attitude, frames_at(azimuths))
    return PocketMotion(place, relative, spin - cage_spin, axes, own)


def _turned(azimuth: np.ndarray, tilt: np.ndarray) -> np.ndarray:
    """Rows (..., 3, 3) of elements' axes at azimuths (...,), turned by skew and tilt (..., 2)."""
    angles = np.concatenate([azimuth[..., None], tilt], axis=-1).reshape(-1, 3)
    columns = Rotation.from_euler("XYZ", angles).as_matrix()
    return np.swapaxes(columns, 1, 2).reshape(*azimuth.shape, 3, 3)
