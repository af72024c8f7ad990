"""Contact angles that a summary's kinematics refer to, in words."""

from __future__ import annotations

import numpy as np

from flexcage.results.metrics import BearingNumbers


def at_angles(bearing: BearingNumbers) -> str:
    """At which contact angles a bearing's kinematics are taken, in words; "" for rollers' angle."""
    if bearing.own_angles is None:
        return ""
    inner, outer = np.degrees(bearing.own_angles)
    return f"pure rolling at the mean contact angles, {inner:.1f} deg inner, {outer:.1f} deg outer"


def at_nominal(bearing: BearingNumbers) -> str:
    """Likewise at the nominal contact angle."""
    return f"by the nominal contact angle, {np.degrees(bearing.contact_angle):.4g} deg"
