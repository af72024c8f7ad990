"""Balls on the walls of round pockets, by sectors round the pocket."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING

import numpy as np

from flexcage.cages.round_pocket.cage import BallCage
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage
from flexcage.geometry.hertz import PointContact
from flexcage.stress.rubbing import Rubbing, modulus, spread, weighted
from flexcage.stress.sliding import PocketMotion, pocket_motion

if TYPE_CHECKING:
    import xarray

SECTORS = 24  # round a round pocket, whose depths are told apart


def rubbing(ds: xarray.Dataset, bearing: Bearing, cage: Cage) -> Rubbing:
    """Balls on the walls of round pockets, by sectors round the pocket."""
    assert isinstance(cage, BallCage)
    motion = pocket_motion(ds, bearing.element_azimuths)
    radius = 0.5 * bearing.element_diameter
    station = ds["station_force"].transpose("time", "pocket", "face", "station", "cyl").values
    force, friction = (
        ds[f"pocket_{what}"].transpose("time", "pocket", "face").values[..., 0].astype(float)
        for what in ("force", "friction")
    )
    touch = ball_touch(motion, station.sum(axis=(2, 3)), force, friction, radius)
    power = (force * touch.speed)[..., None]
    place = motion.along(motion.place)[..., 1] + radius * touch.normal[..., 1]
    wall = 0.5 * cage.pocket_diameter
    across = 1.0 / (1.0 / radius - 1.0 / wall)
    along = across if cage.pocket_shape == "spherical" else radius
    hertz = PointContact(across, along, modulus(bearing, cage))
    height = spread(place[..., None], power) + 2.0 * hertz.semi_axes(weighted(force))[0][:, None]
    turn = np.arctan2(touch.normal[..., 0], touch.normal[..., 2]) / (2.0 * pi) % 1.0
    sector = np.minimum((SECTORS * turn).astype(int), SECTORS - 1)
    cells = np.stack([np.bincount(s, p, SECTORS) for s, p in zip(sector.T, power[..., 0].T)])[
        :, None
    ] / len(power)
    lengths = np.full_like(cells, 2.0 * pi * wall / SECTORS)
    heights = np.broadcast_to(height[..., None], cells.shape)
    drag = (friction * touch.speed).sum(axis=1)
    return Rubbing(power, cells, lengths, heights, np.array([radius]), drag)


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
