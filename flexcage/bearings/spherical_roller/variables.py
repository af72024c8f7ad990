"""What runs of spherical roller bearings record beside what all do: as those of cylindrical
rollers, without ribs."""

from __future__ import annotations

from dataclasses import replace

from flexcage.bearings.cylindrical_roller.variables import VARIABLES as OF_ROLLERS

VARIABLES = replace(
    OF_ROLLERS,
    variables=tuple(v for v in OF_ROLLERS.variables if "rib" not in v.name),
)
