"""Rollers in the pockets of conical cages: their clearance, and what leaves them no room."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import cos, hypot
from typing import Any, Protocol

from flexcage.core.units import describe, mm
from flexcage.geometry.cage import HeldElements, Objection

# assumption: how far angle and pitch diameter of a cage may be from the rollers': 1 um over the
# half length of a roller of 10 mm, and 10 um, below what it notices within its clearances
ANGLE_OFF, PITCH_OFF = 2e-4, 20e-6


class Revolved(Protocol):
    """A roller: its radius [m] at a place [m] along it."""

    def radius(self, x: float) -> float: ...


class Frustum(Revolved, Protocol):
    """A roller as a truncated cone."""

    @property
    def ends(self) -> tuple[float, float]: ...


class InclinedRollers(HeldElements, Protocol):
    """What a cage with a wall about a cone asks of its bearing."""

    @property
    def axis_angle(self) -> float: ...
    @property
    def roller(self) -> Any: ...


class TaperedRollers(InclinedRollers, Protocol):
    """What a conical cage asks of its bearing."""

    @property
    def rib_height(self) -> float: ...
    @property
    def roller(self) -> Frustum: ...


def clearance_around(cage: Any, roller: Revolved, s: float) -> float:
    """How far [m] a roller in the middle of its pocket is from both bars together, measured across
    its axis, at a place s [m] along it."""
    return 2.0 * (cage.nearest(s)[2] - roller.radius(s))


def obstructions(cage: Any, bearing: HeldElements) -> Iterator[Objection]:
    """What leaves no room in the cage for the rollers, or for itself between the rings."""
    rollers: TaperedRollers = bearing  # type: ignore[assignment]
    yield from off_axes(cage, rollers)
    yield from tight(cage, rollers, {"pocket_width_large": -0.5, "pocket_width_small": 0.5})
    yield from edges_in_fillets(cage, rollers)
    yield from _between_races(cage, rollers)


def off_axes(cage: Any, b: InclinedRollers) -> Iterator[Objection]:
    """Pockets that do not lie along the rollers."""
    for name, own, theirs, unit, most in (
        ("cone_angle", cage.cone_angle, b.axis_angle, "deg", ANGLE_OFF),
        ("pitch_diameter", cage.pitch_diameter, b.pitch_diameter, "mm", PITCH_OFF),
    ):
        if abs(own - theirs) > most:
            yield name, f"but the rollers' axes have {describe(theirs, unit)}; give that"


def tight(cage: Any, b: InclinedRollers, ends: Mapping[str, float]) -> Iterator[Objection]:
    """Pockets that rollers do not go into; ``ends``: keys of widths, and where along a roller, over
    its length, these count."""
    along = cage.pocket_length - b.element_length
    if along <= 0.0:
        yield (
            "pocket_length",
            f"a clearance of {mm(along)}; it must be greater than the {b.element}'s length, "
            f"{mm(b.element_length)}",
        )
    for name, s in ends.items():
        gap = clearance_around(cage, b.roller, s * b.element_length)
        if gap <= 0.0:
            least = getattr(cage, name) - gap / cos(cage.flank_angle)
            yield (
                name,
                (
                    f"a clearance of {mm(gap)} round the {b.element} there; it must be greater "
                    f"than {mm(least)}"
                ),
            )


def edges_in_fillets(cage: Any, b: InclinedRollers) -> Iterator[Objection]:
    edge, radius = b.element_edge, cage.fillet_radius
    along = radius - edge - 0.5 * (cage.pocket_length - b.element_length)
    for s in (-0.5 * b.element_length, 0.5 * b.element_length):
        aside = radius - edge - 0.5 * clearance_around(cage, b.roller, s)
        depth = hypot(max(aside, 0.0), max(along, 0.0)) + edge - radius
        if depth > 0.0 and min(aside, along) > 0.0:
            yield (
                "fillet_radius",
                f"so that the edges of a {b.element} in the middle of its pocket, with a radius of "
                f"{mm(edge)}, lie {mm(depth)} inside the fillets; make it smaller, or the pockets "
                "larger",
            )
            return


def _between_races(cage: Any, b: TaperedRollers) -> Iterator[Objection]:
    """A wall that cuts through a race, drawn on beside the small rim, or through the large rib."""
    at = cage.section
    race = b.roller.radius(at.small)
    for what, gap in (
        ("outer race beside the small rim", race - at.outside),
        ("inner race beside the small rim", race + at.inside),
        ("large rib", b.roller.ends[0] + at.inside - b.rib_height),
    ):
        if gap <= 0.0:
            yield "offset", f"so that the wall cuts {mm(-gap)} into the {what}"
