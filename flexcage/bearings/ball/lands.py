"""Where a cage of balls and the rings face each other, or meet."""

from __future__ import annotations

from math import sqrt

from flexcage.bearings.ball.bearing import SHOULDER, BallBearing
from flexcage.geometry.bearing import RingLand
from flexcage.geometry.cage import Cage, RingLimit

_EDGE = 0.1  # of half a cage's width: what its end touches a groove with (assumption)


def cage_space(bearing: BallBearing, cage: Cage) -> tuple[RingLimit | None, RingLimit | None]:
    """Shoulders, or grooves where the cage is narrower than these; none of a bearing that is
    open on one side, if no height is given."""
    found: list[RingLimit | None] = []
    for side, sign in (("inner", 1.0), ("outer", -1.0)):
        height, r = getattr(bearing, f"{side}_shoulder"), getattr(bearing, f"{side}_groove_radius")
        if height is None and bearing.one_sided:
            found.append(None)
            continue
        what = "shoulder" if height else "shoulder (a fifth of the ball's diameter is assumed)"
        high = height or SHOULDER * bearing.ball_diameter
        half = cage.axial_reach
        if half < r and (rise := r - sqrt(r**2 - half**2)) < high:
            high, what = rise, "groove"
        bottom = bearing.pitch_diameter - sign * bearing.ball_diameter
        found.append(RingLimit(bottom + 2.0 * sign * high, f"the {side} ring's {what}"))
    return found[0], found[1]


def land(bearing: BallBearing, cage: Cage) -> RingLand | None:
    if cage.guidance not in ("inner", "outer"):
        return None
    outer = cage.guidance == "outer"
    name, what = f"bearing.{cage.guidance}_shoulder", "outside_diameter" if outer else "bore"
    given = bearing.outer_shoulder if outer else bearing.inner_shoulder
    shoulder, own = bearing.shoulder_diameters[int(outer)], getattr(cage, what)
    groove = bearing.race_reach(cage.guidance)
    end = 0.5 * min(cage.width, bearing.width)
    return RingLand(
        clearance=None if given is None else 0.5 * (shoulder - own) * (1.0 if outer else -1.0),
        of=f"cage.{what} and {name}",
        strict=False,
        facing=end - max(cage.pocket_reach, groove),
        end=end,
    )


def stops(bearing: BallBearing, cage: Cage) -> tuple[RingLand | None, RingLand | None]:
    """Shoulders of given heights, or grooves beside them, that leave a cage a gap which only
    balls guide; none for one that is no mirror image of itbearing, like a crown."""
    if cage.has_land or cage.axial_reach > 0.5 * cage.axial_width:
        return None, None
    found: list[RingLand | None] = []
    for side, limit in zip(("inner", "outer"), cage_space(bearing, cage)):
        if limit is None or getattr(bearing, f"{side}_shoulder") is None:
            found.append(None)
            continue
        out = side == "outer"
        gap = limit.diameter - cage.outside_diameter if out else cage.bore - limit.diameter
        end, groove = min(cage.axial_reach, 0.5 * bearing.width), bearing.race_reach(side)
        rim = end - max(cage.pocket_reach, groove)
        facing = rim if rim > 0.0 else max(end - groove, _EDGE * end)
        stop = RingLand(clearance=0.5 * gap, of=limit.name, strict=False, facing=facing, end=end)
        found.append(stop if gap > 0.0 else None)
    return found[0], found[1]
