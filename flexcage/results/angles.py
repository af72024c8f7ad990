"""Contact angles that a summary's kinematics refer to, and what curved grooves make, in words."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.results import metrics
from flexcage.results.metrics import BearingNumbers

if TYPE_CHECKING:
    import xarray


def at_angles(bearing: BearingNumbers) -> str:
    """At which contact angles a bearing's kinematics are taken, in words; "" for rollers' angle."""
    if bearing.own_angles is None:
        return ""
    inner, outer = np.degrees(bearing.own_angles)
    return f"pure rolling at the mean contact angles, {inner:.1f} deg inner, {outer:.1f} deg outer"


def at_nominal(bearing: BearingNumbers) -> str:
    """Likewise at the nominal contact angle."""
    return f"by the nominal contact angle, {np.degrees(bearing.contact_angle):.4g} deg"


def of_curvature(ds: xarray.Dataset, bearing: BearingNumbers) -> str:
    """What the grooves' curvature makes of the cage's slip ratio, in words; "" for rollers."""
    rolling = metrics.rolling_by_curvature(ds, bearing)
    if rolling is None:
        return ""
    return f"the grooves' curvature alone makes {100.0 * rolling.cage_slip:.2g} %"
