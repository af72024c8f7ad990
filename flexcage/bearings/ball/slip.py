"""Spin and slip of balls: about their own axes, relative to the cage."""

from __future__ import annotations

from typing import TYPE_CHECKING

from flexcage.results.metrics import carrier_speeds
from flexcage.results.slip import (
    BearingNumbers,
    ElementSpeed,
    at_own_angles,
    rolling_sense,
    slip_of,
)

if TYPE_CHECKING:
    import xarray


def spin(ds: xarray.Dataset) -> xarray.DataArray:
    """Speed of every ball about its own axis, relative to the cage or without one to the balls'
    mean orbit, (time, element) [rad/s]; negative where it turns about the bearing axis against the
    sense of rolling."""
    omega = ds["element_omega"].transpose("time", "element", "spin_axis")
    axial = omega.sel(spin_axis="axial", drop=True) - carrier_speeds(ds)
    across = (omega.sel(spin_axis=["radial", "tangential"]) ** 2).sum("spin_axis")
    speed = (axial**2 + across) ** 0.5
    out: xarray.DataArray = speed.where(rolling_sense(ds) * axial >= 0.0, -speed)
    out.attrs = {"units": "rad/s", "long_name": "speed of the ball about its own axis, cage frame"}
    return out.transpose("time", "element").rename("element_spin")


def slip_ratio(
    ds: xarray.Dataset, bearing: BearingNumbers, *, nominal: bool = False
) -> xarray.DataArray:
    """(n_th - n)/n_th of every ball over time, (time, element), both relative to the cage.

    n_th follows from the instantaneous inner speed by pure rolling with an ideal cage: at the mean
    contact angles of the loaded balls of ``ds``, or at the ``nominal`` contact angle.
    """
    used = bearing.nominal if nominal else at_own_angles(ds, bearing)
    unit = used.kinematics(1.0).element_spin_in_cage
    out = slip_of(rolling_sense(ds) * unit * ds["inner_speed"], spin(ds))
    out.attrs = {"units": "1", "long_name": "ball slip ratio, cage frame"}
    return out.transpose("time", "element").rename("element_slip_ratio")


SPEED = ElementSpeed(
    title="Ball speed about its own axis, cage frame",
    axis="speed",
    spin=spin,
    rolling=lambda kinematics: kinematics.element_spin_in_cage,
    slip_ratio=slip_ratio,
)
