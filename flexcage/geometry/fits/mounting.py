"""What fits, warmth and speed leave of a bearing's clearance, part by part.

Without an inner ring the shaft is the race and brings its own deviation from its nominal size.
Each ring is taken as a cylinder with its bore, or outside diameter, and the area of its section;
shaft and housing are cylinders as long. An interference, after smoothing, presses ring and seat
(``cylinders``); a body that is warmer than at assembly grows by its coefficient of expansion, an
inner ring and a shaft that turn by their centrifugal stress; both also change the interference. Its
race's diameter follows. The parts are differences, each step with all before it: fits as
toleranced, then smoothed, then warm, then turning.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from math import inf
from typing import TYPE_CHECKING

from flexcage.core.errors import InputError
from flexcage.geometry.fits.changed import Changed
from flexcage.geometry.fits.cylinders import Cylinder, Press
from flexcage.geometry.fits.spec import ROUGH, SMOOTHINGS, Fit
from flexcage.geometry.fits.tolerances import bearing_limits, hole_limits, shaft_limits

if TYPE_CHECKING:
    from flexcage.geometry.bearing import Bearing
    from flexcage.geometry.materials import Material

Three = tuple[float, float, float]  # at the least clearance, in the middle, at the largest
MIDDLE = 1
_SMOOTHED = 0.8  # of both roughnesses Rz, of a diameter: DIN 7190-1


@dataclass(frozen=True)
class Part:
    """A part of the clearance [m], below zero where it is lost."""

    key: str
    title: str
    values: Three


@dataclass(frozen=True)
class Grip:
    """How a ring sits: interference [m] as toleranced, and in operation with its pressure [Pa]."""

    interference: Three
    operating: Three
    pressure: Three
    is_race: bool = False  # of a shaft on which elements run: by how much it is larger than F


@dataclass(frozen=True)
class Mounting:
    """Clearance from before mounting to operation: ``parts`` add up to the last one, the clearance
    in operation. ``taken``: which of the three values the bearing then has (``fit.at``);
    ``changed``: what follows of it. ``angles``: free contact angle [rad] before and in operation,
    of bearings whose clearance is one, and ``approach`` [m] by which the inner ring meets the
    elements earlier along the axis, of those that have a place of first contact; None otherwise."""

    parts: tuple[Part, ...]
    inner: Grip
    outer: Grip
    taken: int
    changed: Changed
    speed: float
    angles: tuple[float, float] | None = None
    approach: float | None = None

    @property
    def operating(self) -> float:
        """The clearance in operation [m] that the bearing then has."""
        return self.changed.clearance

    def part(self, key: str) -> Part:
        """A part by its key."""
        return next(part for part in self.parts if part.key == key)


@dataclass(frozen=True)
class Seat:
    """A ring on its seat. ``side`` is 1 of the inner ring, around its shaft, and -1 of the outer
    one, inside its housing; strains are thermal."""

    ring: Cylinder
    partner: Cylinder
    diameter: float
    race: float
    side: float
    strain: float
    partner_strain: float

    def joined(self, interference: float, *, warm: bool, speed: float) -> Three:
        """Growth [m] of the race's diameter, interference [m] then, and its pressure [Pa]."""
        d, grown, left = self.diameter, 0.0, interference
        if warm:
            grown += self.strain * self.race
            left += self.side * (self.partner_strain - self.strain) * d
        if speed:
            grown += self.ring.spun(self.race, speed)
            left -= self.ring.spun(d, speed) - self.partner.spun(d, speed)
        pair = (self.partner, self.ring) if self.side > 0.0 else (self.ring, self.partner)
        pressure = Press(*pair, d).pressure(left)
        pressed = {"inside": pressure} if self.side > 0.0 else {"outside": pressure}
        return grown + self.ring.pressed(self.race, **pressed), left, pressure


@dataclass(frozen=True)
class ShaftRace:
    """A shaft of a ``diameter`` [m] on which elements run, without an inner ring."""

    shaft: Cylinder
    diameter: float
    strain: float

    def joined(self, larger: float, *, warm: bool, speed: float) -> Three:
        """Growth [m] of a shaft that is ``larger`` [m] than its nominal size, how much larger it
        is, and no pressure."""
        grown = larger + (self.strain * self.diameter if warm else 0.0)
        return grown + self.shaft.spun(self.diameter, speed), larger, 0.0


def mount(
    bearing: Bearing, fit: Fit, initial: Three, walls: tuple[float, float], speed: float
) -> Mounting:
    """Clearance in operation of a bearing with an ``initial`` one [m]; ``walls``: diameters [m] of
    cylinders with the rings' sections, the inner ring's outer one and the outer ring's inner one.

    Raises InputError for tolerances that there are not, and materials whose expansion is needed and
    not known.
    """
    strains = _strains(bearing, fit)
    seats = _seats(bearing, fit, walls, strains)
    toleranced = _on_shaft(bearing, fit), _in_housing(bearing, fit)
    kept = _all_smoothed(fit, seats, toleranced)
    element = strains["element"] * bearing.element_diameter
    steps = [
        _joined(seats, fits, element if warm else 0.0, warm=warm, speed=turning)
        for fits, warm, turning in (
            (toleranced, False, 0.0), (kept, False, 0.0), (kept, True, 0.0), (kept, True, speed),
        )
    ]  # fmt: skip
    grips = [
        Grip(given, _three(j[1] for j in joints), _three(j[2] for j in joints))
        for given, joints in zip(toleranced, _joints(seats, kept, warm=True, speed=speed))
    ]
    grips[0] = replace(grips[0], is_race=not bearing.has_inner_ring)
    parts = _parts(initial, steps)
    taken = ("least", "mean", "largest").index(fit.at)
    changed = Changed(
        inner_race=steps[-1].inner[taken], outer_race=steps[-1].outer[taken], element=element,
        inner_strain=strains["inner"], outer_strain=strains["outer"],
        initial=initial[taken], clearance=parts[-1].values[taken],
    )  # fmt: skip
    return Mounting(parts, grips[0], grips[1], taken, changed, speed)


Seats = tuple[Seat | ShaftRace, Seat]  # of inner and outer ring


@dataclass(frozen=True)
class _Step:
    """Growth [m] of the diameters of both races and of elements, and what it adds to the radial
    clearance."""

    inner: Three
    outer: Three
    element: float

    @property
    def added(self) -> Three:
        return _three(o - i - 2.0 * self.element for i, o in zip(self.inner, self.outer))


def _joints(seats: Seats, fits: Sequence[Three], *, warm: bool, speed: float) -> list[list[Three]]:
    """Of inner and outer ring, the three joints; only the inner ring turns."""
    return [
        [seat.joined(i, warm=warm, speed=turning) for i in three]
        for seat, three, turning in zip(seats, fits, (speed, 0.0))
    ]


def _joined(
    seats: Seats, fits: Sequence[Three], element: float, *, warm: bool, speed: float
) -> _Step:
    inner, outer = (
        _three(joint[0] for joint in joints)
        for joints in _joints(seats, fits, warm=warm, speed=speed)
    )
    return _Step(inner, outer, element)


def _three(values: Iterable[float]) -> Three:
    a, b, c = values
    return a, b, c


def _parts(initial: Three, steps: Sequence[_Step]) -> tuple[Part, ...]:
    """Contributions to the clearance, from the growth of races and elements after each step."""
    fitted, smoothed, warmed, turned = (step.added for step in steps)

    def more(late: Three, early: Three) -> Three:
        return _three(b - a for a, b in zip(early, late))

    return (
        Part("initial", "before mounting", initial),
        Part("inner_fit", "inner fit", _three(-i for i in steps[0].inner)),
        Part("outer_fit", "outer fit", steps[0].outer),
        Part("smoothing", "smoothing of seats", more(smoothed, fitted)),
        Part("temperature", "temperature", more(warmed, smoothed)),
        Part("centrifugal", "centrifugal growth", more(turned, warmed)),
        Part("operating", "in operation", _three(a + b for a, b in zip(initial, turned))),
    )


def _strains(bearing: Bearing, fit: Fit) -> Mapping[str, float]:
    """Thermal strain of every body."""
    own, elements = bearing.material, bearing.rolling_material
    bodies: Mapping[str, tuple[Material, str]] = {
        "shaft": (fit.shaft_material, "fit.shaft_material"),
        "inner": (own, "bearing.material"),
        "element": (elements, "bearing.material" if elements is own else
                    "bearing.element_material"),
        "outer": (own, "bearing.material"),
        "housing": (fit.housing_material, "fit.housing_material"),
    }  # fmt: skip
    found = {}
    for body, warmer in fit.warmth.items():
        material, where = bodies[body]
        if warmer and material.expansion is None:
            raise InputError(
                f"[fit] has temperatures, but no thermal expansion of {material.name} is known; "
                f'give {where}.expansion, such as "12e-6 1/K" of steel.',
                where=f"{where}.expansion",
            )
        found[body] = warmer * material.expansion if warmer and material.expansion else 0.0
    return found


def _seats(
    bearing: Bearing, fit: Fit, walls: tuple[float, float], strains: Mapping[str, float]
) -> Seats:
    d, outside, own = bearing.bore, bearing.outside_diameter, bearing.material
    inner_race, outer_race = bearing.race_diameters
    thick = inf if fit.housing_thickness is None else outside + 2.0 * fit.housing_thickness
    shaft = Cylinder(fit.shaft_bore, d, fit.shaft_material)
    inner: Seat | ShaftRace = ShaftRace(shaft, d, strains["shaft"])
    if bearing.has_inner_ring:
        inner = Seat(
            Cylinder(d, walls[0], own), shaft, d, inner_race, 1.0, strains["inner"],
            strains["shaft"],
        )  # fmt: skip
    outer = Seat(
        Cylinder(walls[1], outside, own), Cylinder(outside, thick, fit.housing_material), outside,
        outer_race, -1.0, strains["outer"], strains["housing"],
    )  # fmt: skip
    return inner, outer


def _on_shaft(bearing: Bearing, fit: Fit) -> Three:
    """Interferences of shaft and bore, the largest first: it leaves the least clearance."""
    if fit.shaft_interference is not None or not fit.shaft:
        return (fit.shaft_interference or 0.0,) * 3
    shaft = shaft_limits(fit.shaft, bearing.bore, "fit.shaft")
    if not bearing.has_inner_ring:
        return _of_limits(shaft, (0.0, 0.0))
    return _of_limits(shaft, bearing_limits(bearing.bore, outside=False, where="fit.shaft"))


def _in_housing(bearing: Bearing, fit: Fit) -> Three:
    """Interferences of the outer ring and the housing, likewise."""
    if fit.housing_interference is not None or not fit.housing:
        return (fit.housing_interference or 0.0,) * 3
    size, where = bearing.outside_diameter, "fit.housing"
    hole = hole_limits(fit.housing, size, where)
    return _of_limits(bearing_limits(size, outside=True, where=where), hole)


def _of_limits(inside: tuple[float, float], hole: tuple[float, float]) -> Three:
    largest, least = inside[1] - hole[0], inside[0] - hole[1]
    return largest, 0.5 * (least + largest), least


def _all_smoothed(fit: Fit, seats: Seats, toleranced: tuple[Three, Three]) -> list[Three]:
    rough = fit.shaft_roughness, fit.housing_roughness
    return [
        _three(_smoothed(fit, seat, i, of_seat) for i in three)
        for seat, three, of_seat in zip(seats, toleranced, rough)
    ]


def _smoothed(fit: Fit, seat: Seat | ShaftRace, interference: float, roughness: float) -> float:
    """What pressing leaves of an interference [m]; a gap, and a shaft without a ring, stay."""
    if interference <= 0.0 or isinstance(seat, ShaftRace):
        return interference
    if fit.smoothing == ROUGH:
        return max(interference - _SMOOTHED * (roughness + fit.bearing_roughness), 0.0)
    size = 1e3 * seat.diameter
    return interference * size / (size + SMOOTHINGS[fit.smoothing])
