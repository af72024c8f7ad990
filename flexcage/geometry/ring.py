"""Flexible rings: the specs of how they sit, and their sections as bearing families give them."""

from __future__ import annotations

from dataclasses import dataclass
from math import pi
from typing import Any, Protocol

from flexcage.core.spec import option, quantity
from flexcage.geometry.materials import Material

RINGS = ("rigid", "flexible")
SUPPORTED = ("arcs", "points")  # seats that hold a ring here and there
_BENDS = {"ring": ("flexible",)}


@dataclass(frozen=True, kw_only=True)
class FlexibleRing:
    """A ring that bends, or not: its material, and the seat that holds it.

    ``seat``: "rigid" holds the whole cylinder by which the ring sits; "foundation" is an elastic
    layer under it, of equal stiffness in every direction.
    """

    ring: str = option("rigid", doc="does the ring bend?", choices=RINGS)
    material: Material | None = option(
        None, doc="material of the ring (default: the bearing's)", when=_BENDS
    )
    diameter: float | None = quantity(
        "mm", None, doc="diameter of its seat (default: the bearing's)", above=0.0, when=_BENDS
    )
    seat: str = option(
        "rigid", doc="what holds the ring", choices=("rigid", "foundation"), when=_BENDS
    )
    foundation: float = quantity(
        "N/mm^3", 1e13, doc="stiffness of a foundation, per area of the seat", above=0.0,
        when={**_BENDS, "seat": ("foundation",)},
        assumption="10 N/um on every square millimetre: 20 mm of steel behind the seat",
    )  # fmt: skip

    relaxation: float = quantity(
        "us", 1e-5, doc="time in which a race yields to a load in a run, by 63 %", above=0.0,
        when=_BENDS,
        assumption="half and twice as long moves no force by 1 %; half of it damps the modes of a "
        "ring in proportion to its stiffness, 3 % of the critical at 2 kHz, as joints do",
    )  # fmt: skip

    @property
    def bends(self) -> bool:
        return self.ring == "flexible"

    @property
    def held_at(self) -> tuple[float, ...]:
        """Azimuths [rad] of supports; none where the seat holds the ring all around."""
        return ()

    @property
    def held_over(self) -> float:
        """Angle [rad] that each support takes."""
        return 0.0


@dataclass(frozen=True, kw_only=True)
class InnerRing(FlexibleRing):
    """The inner ring on its shaft. Its seat is what the load moves."""


@dataclass(frozen=True, kw_only=True)
class OuterRing(FlexibleRing):
    """The outer ring in its housing, which stands.

    Two seats hold it here and there, across the axis: "arcs" are rigid saddles that press wherever
    the ring lies on them and never pull; "points" (bolts, pins) each hold it both ways by one force
    in the middle of their arc, about which it pivots. Along the axis, in tilt and about the axis
    the seat then holds the ring evenly.
    """

    seat: str = option(
        "rigid", doc="what holds the ring", choices=("rigid", "foundation", *SUPPORTED), when=_BENDS
    )
    supports: tuple[float, ...] = quantity(
        "deg",
        (),
        doc="azimuths of the supports' middles, for seats 'arcs' and 'points'",
        when=_BENDS,
    )
    support_arc: float = quantity(
        "deg",
        pi / 18,
        doc="angle that each support takes",
        above=0.0,
        maximum=pi / 2,
        when={**_BENDS, "seat": SUPPORTED},
    )

    @property
    def held_at(self) -> tuple[float, ...]:
        return self.supports if self.seat in SUPPORTED else ()

    @property
    def held_over(self) -> float:
        return self.support_arc


@dataclass(frozen=True)
class Raceway:
    """Where elements press on a ring, in its section.

    ``place`` (x, r) [m]: middle of the contact; ``normal``: from there into the ring. ``extent``
    [m] is half of the contact's length across the rolling direction: of an ellipse under the
    heaviest load, or of a line, along which a roller also tilts.
    """

    place: tuple[float, float]
    normal: tuple[float, float]
    extent: float
    line: bool


@dataclass(frozen=True)
class RingSection:
    """Outline (x, r) [m] of a ring, counter-clockwise, straight from point to point.

    ``names``: of the edge from every point to the next, "race" and "seat" or none. ``wall``: the
    least thickness [m] between race and seat.
    """

    outline: tuple[tuple[float, float], ...]
    names: tuple[str, ...]
    raceway: Raceway
    wall: float


class SectionsOf(Protocol):
    """What a bearing family supplies: the sections of inner and outer ring.

    ``angle``: contact angles [rad] at inner and outer race; ``across``: halves [m] of the contacts'
    extent there under the heaviest load; ``seat``: diameters [m] of bore and outside.
    """

    def __call__(
        self,
        bearing: Any,
        /,
        *,
        angle: tuple[float, float],
        across: tuple[float, float],
        seat: tuple[float, float],
    ) -> tuple[RingSection, RingSection]: ...
