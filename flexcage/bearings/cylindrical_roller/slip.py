"""Spin and slip of rollers: about their own axes, in the inertial frame."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from flexcage.core.errors import InputError
from flexcage.results.metrics import (
    BearingNumbers,
    ElementSpeed,
    carrier_speed,
    loaded_zone,
    rolling_sense,
    slip_of,
    whole_revolutions,
)

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class RollerSlip:
    """Slip ratios (n_th - n)/n_th, means over time and over the rollers of a zone, and beside
    them the mean sliding speeds [m/s] at the inner and the outer race. NaN: no roller was there.
    """

    loaded: float
    unloaded: float
    overall: float
    sliding_loaded: tuple[float, float]
    sliding_unloaded: tuple[float, float]
    loaded_share: float


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
        spin = spin - carrier_speed(ds)
    else:
        raise InputError(f"Slip is taken in the frame 'inertial' or 'cage', not {frame!r}.")
    out = slip_of(ideal, spin)
    out.attrs = {"units": "1", "long_name": f"roller slip ratio, {frame} frame"}
    return out.transpose("time", "element").rename("element_slip_ratio")


def slip(
    ds: xarray.Dataset,
    bearing: BearingNumbers,
    *,
    frame: str = "inertial",
) -> RollerSlip:
    """Roller slip, loaded and unloaded zone apart, over whole cage revolutions."""
    part = whole_revolutions(ds)
    ratio = slip_ratio(part, bearing, frame=frame).values
    zone = loaded_zone(part).transpose("time", "element").values
    sliding = np.abs(part["race_slip"].transpose("time", "element", "race").values)

    def inside(mask: np.ndarray) -> tuple[float, tuple[float, float]]:
        if not mask.any():
            return float("nan"), (float("nan"), float("nan"))
        inner, outer = sliding[mask].mean(axis=0)
        return float(ratio[mask].mean()), (float(inner), float(outer))

    loaded, speed_in = inside(zone)
    unloaded, speed_out = inside(~zone)
    return RollerSlip(
        loaded, unloaded, float(ratio.mean()), speed_in, speed_out, float(zone.mean())
    )


SPEED = ElementSpeed(
    title="Roller spin, inertial frame",
    axis="spin",
    spin=spin,
    rolling=lambda kinematics: kinematics.element_spin,
    slip_ratio=slip_ratio,
)
