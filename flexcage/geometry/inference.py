"""Internal geometry of a bearing of which a catalogue gives the outline and the ratings.

A family proposes candidates for it, and a cage type the cage; each value that is inferred
comes with how it was found. Makers do not publish it: the ratings of ISO 76 and ISO 281 tell
how much a bearing carries, and so what must be in it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from math import log
from typing import TYPE_CHECKING, Any, Protocol

from flexcage.core.errors import InputError
from flexcage.core.units import describe, mm
from flexcage.geometry.full_complement import CAGED

if TYPE_CHECKING:
    from flexcage.geometry.bearing import Bearing
    from flexcage.geometry.cage import Cage

STATIC_TOLERANCE = 0.02  # of C0: how near a candidate comes where whole numbers allow
FURTHEST = 0.05  # of C0: a candidate further off is none
#: C of a catalogue over that of ISO 281: makers rate their steel and finish higher than the
#: standard; a catalogue that follows it rounds, and ball sizes come in steps.
MAKERS_FACTOR = (1.0, 1.25)
USUAL_FACTOR = 1.06  # of ball bearings of today's makers, at most
_ROUNDING = 0.03


@dataclass(frozen=True, kw_only=True)
class ClearanceGroup:
    """A group of radial internal clearance [m] before mounting, by ISO 5753-1; ``more`` is what
    the middle of the group has beyond that of the normal one."""

    name: str
    least: float
    largest: float
    more: float


@dataclass(frozen=True, kw_only=True)
class MarkedCage:
    """A cage that a mark of a designation names: its type, and the name of its material."""

    mark: str
    meaning: str
    type: str
    material: str


@dataclass(frozen=True, kw_only=True)
class Outline:
    """What a catalogue says of a bearing: boundary dimensions [m] and basic load ratings [N].

    ``contact_angle`` [rad] of angular contact bearings; of roller bearings the ``design``, race
    diameters F and E and those of the ribs of both rings [m]; None where they have none, or where
    the designation names no group of ``clearance``. ``complement``: of what the ratings are, and
    whether the bearing has a cage (``full_complement``); ``cage`` and ``element_material`` (its
    name): those that the designation names. ``left_out``: what else the designation says, a
    sentence each. ``further``: lengths [m] that only a family's own tables have.
    """

    type: str
    designation: str = ""
    bore: float
    outside_diameter: float
    width: float
    static_rating: float
    dynamic_rating: float
    contact_angle: float | None = None
    inner_race_diameter: float | None = None
    outer_race_diameter: float | None = None
    design: str | None = None
    inner_rib_diameter: float | None = None
    outer_rib_diameter: float | None = None
    clearance: ClearanceGroup | None = None
    complement: str = CAGED
    cage: MarkedCage | None = None
    element_material: str | None = None
    left_out: tuple[str, ...] = ()
    further: Mapping[str, float] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if not self.outside_diameter > self.bore:
            raise InputError(
                f"The outside diameter is {mm(self.outside_diameter)}, but must be larger than the "
                f"bore, {mm(self.bore)}.",
                where="outside_diameter", value=self.outside_diameter,
            )  # fmt: skip

    @property
    def boundary(self) -> dict[str, Any]:
        """Fields of a bearing's spec that the outline gives itself."""
        return {key: getattr(self, key) for key in ("bore", "outside_diameter", "width")}

    def clearance_in_operation(self, normal: float) -> tuple[float, str]:
        """Radial clearance [m], and how it was found, where ``normal`` [m] is assumed of a bearing
        with normal clearance: fits and warmth take the same from every group."""
        group = self.clearance
        if group is None:
            return normal, "assumption: in operation; less than before mounting (ISO 5753)"
        least, largest = (f"{1e6 * value:g}" for value in (group.least, group.largest))
        found = max(0.0, round(normal + group.more, 7))
        return (
            found,
            f"assumption: in operation; {group.name} is {least} to {largest} um before "
            f'mounting (ISO 5753-1); fit.clearance = "{group.name}" and your fits tell more',
        )

    def required(self, key: str, what: str) -> float:
        """A value that this type of bearing needs; InputError where the outline lacks it."""
        value = getattr(self, key)
        if value is None:
            raise InputError(f"A bearing of type '{self.type}' needs {what} as well.", where=key)
        return float(value)


@dataclass(frozen=True, kw_only=True)
class Candidate:
    """A bearing that may be the one of the outline; ``misfit`` is less for better ones.

    ``reasons`` says of each inferred dimension how it was found.
    """

    outline: Outline
    bearing: Bearing
    reasons: Mapping[str, str]
    unlikely: float  # what speaks against it beside the ratings
    least_factor: float = MAKERS_FACTOR[0]  # of ISO 281's C, at which makers rate such bearings

    @property
    def static_error(self) -> float:
        """C0 of this candidate over that of the catalogue, less 1."""
        return self.bearing.static_rating / self.outline.static_rating - 1.0

    @property
    def makers_factor(self) -> float:
        """C of the catalogue over that of this candidate by ISO 281."""
        return self.outline.dynamic_rating / self.bearing.dynamic_rating

    @property
    def misfit(self) -> float:
        low, usual = self.least_factor, USUAL_FACTOR
        below, above = log(low / self.makers_factor), log(self.makers_factor / usual)
        off = max(below / 0.02, above / 0.05, 0.0)  # makers rate higher, but never lower
        return (self.static_error / 0.01) ** 2 + off**2 + self.unlikely

    def fits(self, static_tolerance: float) -> bool:
        """Do its ratings come near those of the catalogue?"""
        low, high = self.least_factor, MAKERS_FACTOR[1]
        factor = self.makers_factor
        return (
            abs(self.static_error) <= static_tolerance
            and low - _ROUNDING <= factor <= high + _ROUNDING
        )


@dataclass(frozen=True, kw_only=True)
class Inference:
    """How a family infers internal geometry: ``candidates`` for an outline, in any order, and the
    type of cage that its types of bearing commonly have, "" of those that do not run or have none
    of usual proportions; ``count``:
    key of the number of elements; ``full``: candidates for ratings of a full complement, None where
    these tell none."""

    candidates: Callable[[Outline], Sequence[Candidate]]
    cages: Mapping[str, str]
    count: str
    full: Callable[[Outline], Sequence[Candidate]] | None = None


@dataclass(frozen=True, kw_only=True)
class ProposedCage:
    """A cage that goes between the rings of a bearing; ``reasons`` as those of a candidate."""

    cage: Cage
    reasons: Mapping[str, str]


class CageProposal(Protocol):
    """Proposes a cage of one type for a bearing."""

    def __call__(self, bearing: Any) -> ProposedCage: ...


def ranked(candidates: Sequence[Candidate]) -> list[Candidate]:
    """Candidates whose ratings fit, best first; InputError if none does.

    Those within ``STATIC_TOLERANCE`` of C0 come before all others.
    """
    near = [c for c in candidates if c.fits(FURTHEST)]
    if not near:
        raise _none_fits(candidates)
    return sorted(near, key=lambda c: (not c.fits(STATIC_TOLERANCE), c.misfit))


def _none_fits(candidates: Sequence[Candidate]) -> InputError:
    if not candidates:
        return InputError("No rolling elements have room in a bearing of these dimensions.")
    best = min(candidates, key=lambda c: c.misfit)
    outline, bearing = best.outline, best.bearing
    static, dynamic = bearing.rating_names
    low, high = best.least_factor, MAKERS_FACTOR[1]
    return InputError(
        f"No internal geometry of these dimensions gives {static} = "
        f"{_kn(outline.static_rating)} and {dynamic} = {_kn(outline.dynamic_rating)}: the "
        f"nearest, {in_short(bearing)}, has {static} = {_kn(bearing.static_rating)} by ISO 76 and, "
        f"with a maker's factor of {low:g} to {high:g}, {dynamic} = "
        f"{_kn(low * bearing.dynamic_rating)} to {_kn(high * bearing.dynamic_rating)}.",
        where="ratings",
    )


def in_short(bearing: Bearing) -> str:
    """Number and size of a bearing's elements: "9 balls of 7.938 mm"."""
    size = describe(bearing.element_diameter, "mm")
    if bearing.element_length != bearing.element_diameter or bearing.element_edge:
        size = f"{size.removesuffix(' mm')} x {describe(bearing.element_length, 'mm')}"
    return f"{bearing.element_count} {bearing.element}s of {size}"


def _kn(force: float) -> str:
    return f"{force / 1e3:.4g} kN"


def rounded(value: float, step: float) -> float:
    """A length [m] to the nearest whole number of steps [m], without digits of rounding."""
    return round(round(value / step) * step, 9)
