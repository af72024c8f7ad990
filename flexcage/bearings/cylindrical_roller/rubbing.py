"""Rollers on crossbeams by slices, and on side beams with the mean speed of their ends.

Index letters: t sample, z pocket and its element, s slice or point, f face.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import pi, sqrt
from typing import TYPE_CHECKING

import numpy as np

from flexcage.bearings.cylindrical_roller.model import end_points
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage
from flexcage.stress.rubbing import Rubbing, modulus, spread, weighted
from flexcage.stress.sliding import PocketMotion, pocket_motion

if TYPE_CHECKING:
    import xarray

SAMPLES_READ = 2000  # samples whose slices are held at a time


@dataclass(frozen=True, eq=False)
class PocketFaces:
    """Where rollers rub on the faces of their pockets, all of which are alike.

    ``normals`` (4, 3) out of a pocket, along its axes x, r, psi; ``up`` (2, 3) the bars' faces;
    ``reach`` [m] or (s,) of the roller's surface from slices on its axis; ``ends`` (2,) the places
    of both ends' middles on that, and ``points`` (p, 2) those of an end along the transverse axes
    [m].
    """

    normals: np.ndarray
    up: np.ndarray
    reach: np.ndarray | float
    ends: np.ndarray
    points: np.ndarray


def rubbing(ds: xarray.Dataset, bearing: Bearing, cage: Cage) -> Rubbing:
    """Rollers on crossbeams by slices, and on side beams with the mean speed of their ends."""
    x, psi, half = (
        np.array([1.0, 0.0, 0.0]),
        np.array([0.0, 0.0, 1.0]),
        0.5 * bearing.element_length,
    )
    faces = PocketFaces(
        normals=np.array([psi, -psi, x, -x]), up=np.array([[0.0, 1.0, 0.0]] * 2),
        reach=0.5 * bearing.element_diameter, ends=np.array([half, -half]),
        points=end_points(bearing, cage),  # type: ignore[arg-type]
    )  # fmt: skip
    return rub_on(faces, ds, bearing, cage)


def rub_on(
    faces: PocketFaces, ds: xarray.Dataset, bearing: Bearing, cage: Cage,
    azimuths: np.ndarray | None = None,
) -> Rubbing:  # fmt: skip
    """How rollers rub on such faces, of pockets at ``azimuths`` (z,), by default the bearing's."""
    azimuths = bearing.element_azimuths if azimuths is None else azimuths
    parts = [
        _rub(ds.isel(time=slice(first, first + SAMPLES_READ)), faces, azimuths)
        for first in range(0, ds.sizes["time"], SAMPLES_READ)
    ]
    *series, sums = zip(*parts)
    power, force, place, drag = (np.concatenate(s) for s in series)
    x, radius = ds["slice"].values, 0.5 * bearing.element_diameter
    cells = np.zeros((*power.shape[1:], len(x)))
    cells[:, :2] = sum(sums) / len(power)
    cells[:, 2:] = power[..., 2:].mean(axis=0)[..., None] / len(x)
    length = len(x) * abs(x[1] - x[0])
    width = contact_width(force, length, bearing, cage)
    height = spread(place, power[..., :2]) + width
    lengths, heights = np.full_like(cells, length / len(x)), np.empty_like(cells)
    heights[:, :2], heights[:, 2:] = height[..., None], end_band(faces.points) / length
    return Rubbing(power, cells, lengths, heights, np.array([radius, radius, 0.0, 0.0]), drag)


def _rub(ds: xarray.Dataset, faces: PocketFaces, azimuths: np.ndarray) -> tuple[np.ndarray, ...]:
    """Over some samples: normal force times sliding speed on every face (t, z, 4) [W], normal force
    on crossbeams (t, z, 2) [N], rollers' places up these (t, z, 2) [m], friction of all (t,) [W],
    and the sum of the first over time by slices of crossbeams (z, 2, s) [W]."""
    motion = pocket_motion(ds, azimuths)
    beams = slice_speeds(motion, ds["slice"].values, faces)
    ends = end_speeds(motion, faces)
    order = ("time", "pocket", "face")
    force, friction = (
        ds[f"pocket_{what}"].transpose(*order).values[..., 2:] for what in ("force", "friction")
    )
    pressed, dragged = (
        ds[f"pocket_slice_{what}"].transpose("time", "pocket", "crossbeam_face", "slice").values
        for what in ("force", "friction")
    )
    by_slice = pressed * beams
    power = np.concatenate([by_slice.sum(axis=-1), force * ends], axis=2)
    drag = (dragged * beams).sum(axis=(1, 2, 3)) + (friction * ends).sum(axis=(1, 2))
    place = motion.along(motion.place) @ faces.up.T
    return power, pressed.sum(axis=-1), place, drag, by_slice.sum(axis=0)


def slice_speeds(motion: PocketMotion, slices: np.ndarray, faces: PocketFaces) -> np.ndarray:
    """Sliding speeds (t, z, 2, s) [m/s] of rollers on their crossbeam faces, at ``slices`` (s,) on
    their axes [m] from their centres."""
    centre = motion.along(motion.velocity)
    along = motion.along(np.cross(motion.spin, motion.own[..., 0, :]))
    turning = motion.along(motion.spin)
    out = np.empty((*centre.shape[:2], 2, len(slices)))
    for f, normal in enumerate(faces.normals[:2]):
        across = np.cross(turning, normal)[..., None] * faces.reach
        slip = centre[..., None] + across + along[..., None] * slices
        out[:, :, f] = _sliding(slip, normal)
    return out


def end_speeds(motion: PocketMotion, faces: PocketFaces) -> np.ndarray:
    """Sliding speeds (t, z, 2) [m/s] of rollers' ends on the side beams +x and -x, means over the
    points of an end."""
    centre = motion.along(motion.velocity)
    turning = [motion.along(np.cross(motion.spin, motion.own[..., k, :])) for k in range(3)]
    out = np.zeros((*centre.shape[:2], 2))
    for f, normal in enumerate(faces.normals[2:]):
        for y, z in faces.points:
            slip = centre + faces.ends[f] * turning[0] + y * turning[1] + z * turning[2]
            out[..., f] += _sliding(slip[..., None], normal)[..., 0] / len(faces.points)
    return out


def _sliding(slip: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Sizes (..., s) of velocities (..., 3, s) less what they have along a ``normal`` (3,)."""
    away = np.einsum("c,...cs->...s", normal, slip)
    size: np.ndarray = np.linalg.norm(slip - normal[:, None] * away[..., None, :], axis=-2)
    return size


def contact_width(force: np.ndarray, length: float, bearing: Bearing, cage: Cage) -> np.ndarray:
    """Width 2b [m] (...) of the line contact of rollers with a plane under their mean forces while
    touching, of ``force`` (nt, ...) [N] over a length [m] (Hertz; K. L. Johnson, Contact
    Mechanics, 4.3)."""
    elastic = 0.5 * modulus(bearing, cage)
    radius = 0.5 * bearing.element_diameter
    return 2.0 * np.sqrt(4.0 * weighted(force) / length * radius / (pi * elastic))


def end_band(points: np.ndarray) -> float:
    """Area [m^2] of the band whose Gauss points (``model.end_points``) these are."""
    height = sqrt(3.0) * float(np.ptp(points[:, 0]))
    return height * float(np.ptp(points[:, 1])) / float(np.polynomial.legendre.leggauss(7)[0][-1])
