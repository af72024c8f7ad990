"""Single-row cylindrical roller bearings."""

from flexcage.bearings.family import Family
from flexcage.geometry.cylindrical_roller import RollerBearing

FAMILY = Family(name="cylindrical_roller", types=(RollerBearing,))
