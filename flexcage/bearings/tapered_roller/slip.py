"""Spin and slip of tapered rollers: about their own axes, relative to the cage."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.results.metrics import carrier_speeds
from flexcage.results.slip import BearingNumbers, ElementSpeed, rolling_sense, slip_of

if TYPE_CHECKING:
    import xarray


def spin(ds: xarray.Dataset) -> xarray.DataArray:
    """Speed of every roller about its own axis, relative to the cage or without one to the rollers'
    mean orbit, (time, element) [rad/s]; positive in the sense of rolling."""
    skew, tilt = (ds["element_tilt"].sel(tilt=name, drop=True) for name in ("skew", "tilt"))
    lean = np.cos(skew) * np.cos(tilt)
    own = ds["element_omega"].isel(spin_axis=0, drop=True) - carrier_speeds(ds) * lean
    out: xarray.DataArray = rolling_sense(ds) * own
    out.attrs = {"units": "rad/s", "long_name": "speed of the roller about its axis, cage frame"}
    return out.transpose("time", "element").rename("element_spin")


def slip_ratio(ds: xarray.Dataset, bearing: BearingNumbers) -> xarray.DataArray:
    """(n_th - n)/n_th of every roller over time, (time, element), both relative to the cage; n_th
    follows from the instantaneous inner speed by pure rolling of cones with one apex."""
    ideal = bearing.kinematics(1.0).element_spin_in_cage * ds["inner_speed"]
    out = slip_of(rolling_sense(ds) * ideal, spin(ds))
    out.attrs = {"units": "1", "long_name": "roller slip ratio, cage frame"}
    return out.transpose("time", "element").rename("element_slip_ratio")


SPEED = ElementSpeed(
    title="Roller speed about its own axis, cage frame",
    axis="speed",
    spin=spin,
    rolling=lambda kinematics: kinematics.element_spin_in_cage,
    slip_ratio=slip_ratio,
)
