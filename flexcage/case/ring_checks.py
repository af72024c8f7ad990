"""Checks of [inner_ring] and [outer_ring]: rings that bend, and their supports."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import pairwise
from math import pi
from typing import TYPE_CHECKING

from flexcage.core.units import describe
from flexcage.geometry.checks import Finding
from flexcage.geometry.ring import SUPPORTED

if TYPE_CHECKING:
    from flexcage.case.sections import CaseSections, StaticSections

_LINE = 1e-6  # rad: two supports this near to a line through the axis hold across it alone


def find_in_rings(case: StaticSections) -> Iterator[Finding]:
    """Supports that are missing, superfluous, or in each other's place."""
    if case.inner_ring.bends and not case.bearing.has_inner_ring:
        yield (
            "inner_ring.ring",
            "inner_ring.ring is 'flexible', but the bearing has no inner ring: its rollers run on "
            "the shaft; leave it out, or give bearing.bore of an inner ring.",
        )
    ring, where = case.outer_ring, "outer_ring.supports"
    if ring.seat not in SUPPORTED:
        if ring.supports:
            yield (
                where,
                f"{where} has {_azimuths(ring.supports)}, but outer_ring.seat is "
                f'\'{ring.seat}\'; leave them out, or take outer_ring.seat = "arcs" or "points".',
            )
        return
    if len(ring.supports) < 2:
        yield (
            where,
            f"{where} has {_azimuths(ring.supports)}, but "
            f"outer_ring.seat = '{ring.seat}' needs two or more to hold the ring.",
        )
        return
    places = sorted(azimuth % (2.0 * pi) for azimuth in ring.supports)
    gap = min(b - a for a, b in pairwise([*places, places[0] + 2.0 * pi]))
    if gap < ring.support_arc:
        yield (
            where,
            f"{where} has two supports {describe(gap, 'deg')} apart, but each takes "
            f"{describe(ring.support_arc, 'deg')} (outer_ring.support_arc); move them apart, or "
            "make them narrower.",
        )
    if len(places) == 2 and abs(places[1] - places[0] - pi) < _LINE:
        yield (
            where,
            f"{where} has two supports on opposite sides, which do not hold the ring across the "
            "line through them; move one, or give a third.",
        )


def _azimuths(supports: tuple[float, ...]) -> str:
    """How many there are, in words."""
    return f"{len(supports) or 'no'} azimuth{'' if len(supports) == 1 else 's'}"


def find_bending_in_run(case: CaseSections) -> Iterator[Finding]:
    """What rings that bend cannot have in a run."""
    outer, mount = case.outer_ring, case.mount
    if outer.bends and outer.seat in SUPPORTED and (mount.kind != "fixed" or mount.body):
        what = "mount.body is given" if mount.body else f"mount.kind is '{mount.kind}'"
        yield (
            "outer_ring.seat",
            f"outer_ring.seat is '{outer.seat}', but {what}, and in a run supports stand still; "
            'leave out mount, or take outer_ring.seat = "rigid" or "foundation".',
        )
    yields = [
        f"{side}.ring is 'flexible'"
        for side in ("inner_ring", "outer_ring")
        if getattr(case, side).bends
    ]
    if yields and case.solver.method == "bdf":
        yield (
            "solver.method",
            f"solver.method is 'bdf', but {yields[0]}, and rings that bend move by explicit "
            "steps; take 'explicit' or 'auto'.",
        )
