"""Loads of a recorded cage: from datasets to what the recovery takes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.stress.recovery import CageLoads

if TYPE_CHECKING:
    import xarray

N_LAND = 24


def land_station_forces(ds: xarray.Dataset, *, inner: bool, n_land: int = N_LAND) -> np.ndarray:
    """Land force of every sample as station forces (nt, 2, n_land, 3), components (x, r, psi).

    Only the resultant is recorded; it is given to the two land stations next to its direction,
    as a radial force (a land pushes along its normal; its friction is left out).
    """
    force = ds["land_force"].values
    out = np.zeros((len(force), 2, n_land, 3))
    size = np.hypot(force[:, 1], force[:, 2])
    hit = np.flatnonzero(size > 0.0)
    if not len(hit):
        return out
    w, x, y, z = ds["cage_quaternion"].values[hit].T
    turn = np.arctan2(2.0 * (y * z + w * x), 1.0 - 2.0 * (x * x + z * z))
    outward = np.arctan2(force[hit, 2], force[hit, 1]) - turn
    place = (outward if inner else outward + np.pi) * n_land / (2.0 * np.pi) % n_land
    first = place.astype(int) % n_land
    share = place - np.floor(place)
    sign = 1.0 if inner else -1.0
    land = 0 if inner else 1
    out[hit, land, first, 1] = sign * size[hit] * (1.0 - share)
    out[hit, land, (first + 1) % n_land, 1] = sign * size[hit] * share
    return out


class LandForces:
    """``land_station_forces`` of a recorded run, sample by sample as they are asked for."""

    def __init__(self, ds: xarray.Dataset, *, inner: bool) -> None:
        self._recorded = ds[["land_force", "cage_quaternion"]].load()
        self._inner = inner

    def __len__(self) -> int:
        return self._recorded.sizes["time"]

    def __bool__(self) -> bool:
        """Whether any sample has a force."""
        return bool(np.any(self._recorded["land_force"].values))

    def __getitem__(self, part: slice) -> np.ndarray:
        return land_station_forces(self._recorded.isel(time=part), inner=self._inner)


def cage_loads(ds: xarray.Dataset, index: int, *, inner: bool) -> CageLoads:
    """Loads at sample ``index``; ``inner``: the cage rides on the inner ring's land."""
    one = ds.isel(time=[index])
    return CageLoads(
        station_forces=one["station_force"].values[0].astype(float),
        land_forces=land_station_forces(one, inner=inner)[0],
        angular_velocity=one["cage_omega"].values[0],
        modal_coordinates=one["modal_coordinates"].values[0].astype(float),
    )
