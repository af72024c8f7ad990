"""Single-row cylindrical roller bearings."""

from flexcage.bearings.family import Family
from flexcage.geometry.cylindrical_roller import OTHER_DESIGNS, RollerBearing

FAMILY = Family(
    name="cylindrical_roller",
    types=(RollerBearing,),
    other_designs=OTHER_DESIGNS,
)
