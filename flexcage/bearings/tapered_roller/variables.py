"""What runs of tapered roller bearings record beside what all do: as those of cylindrical rollers.

Tilt and skew turn a roller's axis from the bearing's, so that its tilt is about minus the angle
between both.
"""

from __future__ import annotations

from dataclasses import replace

from flexcage.bearings.cylindrical_roller.variables import VARIABLES as OF_ROLLERS

VARIABLES = replace(
    OF_ROLLERS,
    variables=tuple(v for v in OF_ROLLERS.variables if v.name != "counter_rib_force"),
)
