"""Where cage and rings face each other: ribs where the design has them, else races."""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.bearings.cylindrical_roller.designs import DESIGNS
from flexcage.geometry.bearing import RingLand
from flexcage.geometry.cage import Cage, RingLimit


def limit(b: RollerBearing, ring: str) -> RingLimit:
    """What of the "inner" or "outer" ring the cage meets first."""
    ribs = b.cage_ribs(ring)
    if ribs is None:
        radius = b.outer_race_radius if ring == "outer" else b.inner_race_radius
        return RingLimit(2.0 * radius, f"the {ring} race")
    return RingLimit(ribs.diameter, f"the {ring} ring's {ribs.name}")


def limits(b: RollerBearing, cage: Cage | None) -> tuple[RingLimit, RingLimit]:
    """The same of both rings, whatever the cage."""
    return limit(b, "inner"), limit(b, "outer")


def land(b: RollerBearing, cage: Cage) -> RingLand:
    """The land on the ring that guides the cage, or that it may touch. A cage has a land at each
    end, or none: a single rib makes none."""
    ring, outer = cage.land_ring, cage.land_ring == "outer"
    begin, end = cage.pocket_reach, 0.5 * min(cage.width, b.width)
    ribs, met = b.cage_ribs(ring), limit(b, ring).diameter
    own, size = (
        ("cage.outside_diameter", cage.outside_diameter) if outer else ("cage.bore", cage.bore)
    )
    of = f"the {ring} race"
    if ribs is not None:
        of = f"bearing.{'' if ring == DESIGNS[b.design].guide else 'counter_'}rib_diameter"
        begin = max(begin, 0.5 * ribs.gap) if all(ribs.sides) else end
    clearance = 0.5 * (met - size if outer else size - met)
    return RingLand(
        clearance=clearance, of=f"{own} and {of}", strict=True, facing=end - begin, end=end
    )
