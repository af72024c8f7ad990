"""Loads of a recorded cage: from datasets to what the recovery takes."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.modes.interface import LAND_STATIONS
from flexcage.stress.recovery import CageLoads

if TYPE_CHECKING:
    import xarray


LANDS = "land_station_force"


def land_station_forces(ds: xarray.Dataset, *, inner: bool) -> np.ndarray:
    """Land forces of every sample (nt, 2, n_land, 3) on the stations of the inner and the outer
    land, components (x, r, psi)."""
    return on_lands(ds[LANDS].values, inner=inner)


def on_lands(force: np.ndarray, *, inner: bool) -> np.ndarray:
    """Forces (nt, n_land, 2) of the guiding land, components (r, psi), as
    ``land_station_forces``; of (nt, 2 n_land, 2) the second half is on the other land."""
    both = force.shape[1] == 2 * LAND_STATIONS
    n = LAND_STATIONS if both else force.shape[1]
    out = np.zeros((len(force), 2, n, 3), force.dtype)
    out[:, 0 if inner else 1, :, 1:] = force[:, :n]
    if both:
        out[:, 1 if inner else 0, :, 1:] = force[:, n:]
    return out


class LandLoads:
    """``land_station_forces`` of a recorded run, sample by sample as they are asked for."""

    def __init__(self, ds: xarray.Dataset, *, inner: bool) -> None:
        self._recorded = ds[[LANDS]].load()
        self._inner = inner

    def __len__(self) -> int:
        return self._recorded.sizes["time"]

    def __bool__(self) -> bool:
        """Whether any sample has a force."""
        return bool(np.any(self._recorded[LANDS].values))

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
