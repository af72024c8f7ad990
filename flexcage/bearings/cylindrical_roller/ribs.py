"""How ribs and rollers meet."""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing


def axial_clearance(b: RollerBearing) -> float:
    """Axial distance [m] by which the inner ring of a bearing with counter ribs must move from the
    middle before rollers stand between ribs of both rings."""
    assert b.counter_rib_gap is not None
    return 0.5 * (b.rib_gap + b.counter_rib_gap) - b.roller_length


def rib_height(b: RollerBearing, ring: str) -> float:
    """Where a rib of the "inner" or "outer" ring bears on a roller's end: halfway up their overlap,
    radially from the roller's axis [m]. An end is flat to 0.9 of its radius."""
    ribs, radius = b.ribs(ring), 0.9 * 0.5 * b.roller_diameter
    assert ribs is not None
    sense = 1.0 if ring == "outer" else -1.0
    return 0.5 * sense * (sense * (0.5 * ribs.diameter - b.pitch_radius) + radius)
