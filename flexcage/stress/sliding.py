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

from flexcage.modes.pockets import frames_at, pocket_frames
from flexcage.results import metrics

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


def pocket_motion(ds: xarray.Dataset) -> PocketMotion:
    """Motion of the rolling elements in their pockets."""
    name = metrics.element(ds)

    def of(variable: str) -> np.ndarray:
        return np.asarray(ds[variable].transpose("time", name, ...).values, float)

    position, moving, omega = (of(f"{name}_{what}") for what in ("position", "velocity", "omega"))
    tilt = of("roller_tilt") if name == "roller" else np.zeros((*omega.shape[:2], 2))
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
    axes = np.einsum("tij,zaj->tzai", attitude, pocket_frames(position.shape[1]))
    return PocketMotion(place, relative, spin - cage_spin, axes, own)


def _turned(azimuth: np.ndarray, tilt: np.ndarray) -> np.ndarray:
    """Rows (..., 3, 3) of elements' axes at azimuths (...,), turned by skew and tilt (..., 2)."""
    angles = np.concatenate([azimuth[..., None], tilt], axis=-1).reshape(-1, 3)
    columns = Rotation.from_euler("XYZ", angles).as_matrix()
    return np.swapaxes(columns, 1, 2).reshape(*azimuth.shape, 3, 3)


def slice_speeds(motion: PocketMotion, slices: np.ndarray, radius: float) -> np.ndarray:
    """Sliding speeds (t, z, 2, s) [m/s] of rollers of that radius [m] on their crossbeam faces, at
    ``slices`` (s,) along them [m] from mid-length."""
    centre = motion.along(motion.velocity)
    along = motion.along(np.cross(motion.spin, motion.own[..., 0, :]))
    across = radius * motion.along(np.cross(motion.spin, motion.axes[..., 2, :]))
    out = np.empty((*centre.shape[:2], 2, len(slices)))
    for f, side in enumerate((1.0, -1.0)):
        middle = (centre + side * across)[..., None]
        slip = middle + along[..., None] * slices
        out[:, :, f] = np.hypot(slip[..., 0, :], slip[..., 1, :])
    return out


def end_speeds(motion: PocketMotion, points: np.ndarray, half_length: float) -> np.ndarray:
    """Sliding speeds (t, z, 2) [m/s] of rollers' ends on the side beams +x and -x, means over the
    ``points`` (s, 2) of an end along its two transverse axes [m]."""
    centre = motion.along(motion.velocity)
    turning = [motion.along(np.cross(motion.spin, motion.own[..., k, :])) for k in range(3)]
    out = np.zeros((*centre.shape[:2], 2))
    for f, side in enumerate((1.0, -1.0)):
        for y, z in points:
            slip = centre + side * half_length * turning[0] + y * turning[1] + z * turning[2]
            out[..., f] += np.hypot(slip[..., 1], slip[..., 2]) / len(points)
    return out


@dataclass(frozen=True, eq=False)
class BallTouch:
    """Balls on the walls of round pockets: ``normal`` (t, z, 3) towards the wall, components x, r,
    psi of the pockets, and sliding ``speed`` (t, z) [m/s]; zero where they do not touch."""

    normal: np.ndarray
    speed: np.ndarray


def ball_touch(
    motion: PocketMotion, force: np.ndarray, normal: np.ndarray, friction: np.ndarray, radius: float
) -> BallTouch:
    """Touch by the forces (t, z, 3) [N] on the walls, whose normal and friction parts (t, z) are
    ``normal`` and ``friction``: the force less friction, which follows sliding, is normal."""
    touching = normal > 0.0
    size = np.where(touching, normal, 1.0)
    n = np.where(touching[..., None], force / size[..., None], 0.0)
    n = n / np.where(touching, np.linalg.norm(n, axis=-1), 1.0)[..., None]
    centre, spin = motion.along(motion.velocity), motion.along(motion.spin)
    for _ in range(4):  # friction turns the force by a few degrees; each pass leaves a hundredth
        slip = centre + radius * np.cross(spin, n)
        slip = slip - (slip * n).sum(-1, keepdims=True) * n
        speed = np.linalg.norm(slip, axis=-1)
        drag = (friction / np.where(speed > 0.0, speed, 1.0))[..., None] * slip
        n = np.where(touching[..., None], (force - drag) / size[..., None], 0.0)
        n = n / np.where(touching, np.linalg.norm(n, axis=-1), 1.0)[..., None]
    return BallTouch(n, np.where(touching, speed, 0.0))
