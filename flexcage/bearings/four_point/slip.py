"""Slip of balls on two arcs a race: how fast they turn about their own axes in rolling."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from flexcage.bearings.ball import slip
from flexcage.bearings.four_point.inertia import HELD
from flexcage.results.slip import BearingNumbers

if TYPE_CHECKING:
    import xarray


def slip_ratio(
    ds: xarray.Dataset, bearing: BearingNumbers, *, nominal: bool = False
) -> xarray.DataArray:
    """(n_th - n)/n_th of every ball over time, (time, element), as ``ball.slip.slip_ratio``.

    A ball on both arcs of the outer race rolls about an axis that leans less (``inertia``), and
    turns faster by 1/cos of what it leans less than its contact angle.
    """
    alike = slip.slip_ratio(ds, bearing, nominal=nominal)
    arcs = ds["arc_force"].sel(race="outer", drop=True)
    most = arcs.max("arc")
    share = (arcs.min("arc") / most.where(most > 0.0)).fillna(0.0)
    straight = (share / HELD).clip(max=1.0)
    angle = abs(ds["contact_angle"].sel(race="outer", drop=True))
    rolls = 1.0 - (1.0 - alike) * (straight * angle).pipe(np.cos)
    out: xarray.DataArray = rolls.transpose("time", "element").rename(alike.name)
    return out.assign_attrs(alike.attrs)


SPEED = replace(slip.SPEED, slip_ratio=slip_ratio)
