"""What a sensor sees of a run before its chain: values on one of the run's grids."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np
from scipy.spatial.transform import Rotation

from flexcage.core.errors import InputError
from flexcage.results.instrument import LaserSetup, mark_of_run, of_run, radial_reading
from flexcage.results.registry import TIME, TIME_HF
from flexcage.results.signals.spec import (
    CAGE,
    OUTER,
    Accelerometer,
    Laser,
    Proximity,
    Sensor,
    Tacho,
    Torque,
)

if TYPE_CHECKING:
    import xarray

    from flexcage.geometry.cage import Cage


def grid_of(sensor: Sensor) -> str:
    """The run's grid that a sensor's source is on."""
    fine = isinstance(sensor, Accelerometer) and sensor.place == OUTER
    return TIME_HF if fine else TIME


def seen(ds: xarray.Dataset, sensor: Sensor, cage: Cage | None) -> np.ndarray:
    """Values (n,) on the grid of ``grid_of``, SI: what the sensor would show if it were ideal.

    Raises InputError for a sensor on a body that the run has not.
    """
    if sensor.place == CAGE and (cage is None or "cage_position" not in ds):
        raise InputError(
            f"The sensor '{sensor.name}' is on the cage, and the run's bearing has none.",
            where="sensors",
            value=sensor.name,
        )
    return np.asarray(_SOURCES[type(sensor)](ds, sensor, cage), float)


def _along(values: np.ndarray, sensor: Any) -> np.ndarray:
    """Vectors (n, 3) along the sensor's axis."""
    if sensor.axial:
        return values[:, 0]
    return values[:, 1] * np.cos(sensor.direction) + values[:, 2] * np.sin(sensor.direction)


def _acceleration(ds: xarray.Dataset, sensor: Accelerometer, cage: Any) -> np.ndarray:
    if sensor.place == CAGE:
        return _along(ds["cage_acceleration"].transpose(TIME, "axis").values, sensor)
    across = ds["outer_acceleration"].transpose(TIME_HF, "axis2").values
    return _along(np.column_stack([np.zeros(len(across)), across]), sensor)


def _displacement(ds: xarray.Dataset, sensor: Proximity, cage: Any) -> np.ndarray:
    body = sensor.place.removesuffix("_ring")
    place = ds[f"{body}_position"].transpose(TIME, "axis").values
    if sensor.place != OUTER:
        place = place - ds["outer_position"].transpose(TIME, "axis").values
    return _along(place, sensor)


def _laser(ds: xarray.Dataset, sensor: Laser, cage: Cage) -> np.ndarray:
    radius, half = 0.5 * cage.outside_diameter, 0.5 * cage.width
    setup = LaserSetup(
        radius=radius, half_width=half, plane=sensor.plane, circle=radius, spot=sensor.spot
    )
    turn = Rotation.from_rotvec([-sensor.direction, 0.0, 0.0])
    centre, axis = (turn.apply(values) for values in of_run(ds))
    return radial_reading(1, centre, axis, turn.apply(mark_of_run(ds)), setup)


def _torque(ds: xarray.Dataset, sensor: Torque, cage: Any) -> np.ndarray:
    power = np.gradient(ds["work"].sel(channel="drive").values, ds[TIME].values)
    speed = ds["inner_speed"].values
    moving = np.abs(speed) > 0.0
    return np.where(moving, power / np.where(moving, speed, 1.0), 0.0)


def _turned(ds: xarray.Dataset, sensor: Tacho, cage: Any) -> np.ndarray:
    return sensor.pulses * ds["inner_angle"].values / (2.0 * np.pi)


_SOURCES: dict[type, Callable[..., np.ndarray]] = {
    Accelerometer: _acceleration, Proximity: _displacement, Laser: _laser, Torque: _torque,
    Tacho: _turned,
}  # fmt: skip
