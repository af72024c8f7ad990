"""What runs of tapered roller bearings record beside what all do: as those of cylindrical rollers.

Tilt and skew turn a roller's axis from the bearing's, so that its tilt is about minus the angle
between both.
"""

from __future__ import annotations

from dataclasses import replace

from flexcage.bearings.cylindrical_roller.variables import VARIABLES as OF_ROLLERS

_TAKEN = ("element_quaternion", "element_tilt", "race_moment", "rib_force")

VARIABLES = replace(
    OF_ROLLERS,
    variables=tuple(v for v in OF_ROLLERS.variables if v.name in _TAKEN),
    labels={name: OF_ROLLERS.labels[name] for name in ("tilt", "moment", "rib")},
    counted=(),
    sizes={},
)
