"""Spin and slip of rollers: about their own axes, in the inertial frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from flexcage.core.errors import InputError
from flexcage.results.metrics import carrier_speeds
from flexcage.results.slip import BearingNumbers, ElementSpeed, rolling_sense, slip_of

if TYPE_CHECKING:
    import xarray


def spin(ds: xarray.Dataset) -> xarray.DataArray:
    """Spin of every roller about its own axis, inertial frame, (time, element) [rad/s]; positive in
    the sense of rolling."""
    out: xarray.DataArray = rolling_sense(ds) * ds["element_omega"].isel(spin_axis=0, drop=True)
    out.attrs = {"units": "rad/s", "long_name": "roller spin in the sense of rolling"}
    return out.transpose("time", "element").rename("element_spin")


def slip_ratio(
    ds: xarray.Dataset, bearing: BearingNumbers, *, frame: str = "inertial"
) -> xarray.DataArray:
    """(n_th - n)/n_th of every roller over time, both in the ``inertial`` frame or in the ``cage``.

    n is the spin about the roller's own axis; n_th follows from the instantaneous inner speed by
    pure rolling on a fixed outer ring with an ideal cage.
    """
    unit = bearing.kinematics(1.0)
    spin = ds["element_omega"].isel(spin_axis=0, drop=True)
    if frame == "inertial":
        ideal = ds["inner_speed"] * unit.element_spin
    elif frame == "cage":
        ideal = ds["inner_speed"] * unit.element_spin_in_cage
        spin = spin - carrier_speeds(ds)
    else:
        raise InputError(f"Slip is taken in the frame 'inertial' or 'cage', not {frame!r}.")
    out = slip_of(ideal, spin)
    out.attrs = {"units": "1", "long_name": f"roller slip ratio, {frame} frame"}
    return out.transpose("time", "element").rename("element_slip_ratio")


SPEED = ElementSpeed(
    title="Roller spin, inertial frame",
    axis="spin",
    spin=spin,
    rolling=lambda kinematics: kinematics.element_spin,
    slip_ratio=slip_ratio,
    inertial=True,
)
