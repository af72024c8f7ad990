"""What all bearing types share: the name by which a case asks for one, and what each can say of
itself: its dimensions, checks, ratings, films, and words.

A type is a spec of its own, which defines the methods of ``Bearing`` that it has an answer to; what
its family says of it are ``Rules``. The others keep their plain default, or name themselves in a
NotImplementedError.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import inf
from typing import TYPE_CHECKING, Any, ClassVar, Generic, TypeVar

import numpy as np

from flexcage.core.binding import check_value, replacement_of
from flexcage.core.errors import InputError
from flexcage.core.spec import option
from flexcage.core.units import typeset
from flexcage.core.wings import FAMILIES, Parts
from flexcage.geometry.cage import Cage, RingLimit
from flexcage.geometry.film import Film, Oil
from flexcage.geometry.life.iso281 import Endurance
from flexcage.geometry.materials import contact_modulus
from flexcage.geometry.other_kinds import kind_of, named_kind

if TYPE_CHECKING:
    from flexcage.geometry.fits.changed import Changed
    from flexcage.geometry.fits.spec import Fit
    from flexcage.geometry.materials import Material

_MISSING = object()
Spec = type  # by another name, for inside the spec ``type`` is a field

#: Specs of bearings by the name that a case gives: those of all families, and users' own.
BEARING_TYPES: Parts[Spec] = Parts(
    FAMILIES, lambda family: {name_of(spec): spec for spec in family.types}, what="bearing type"
)
#: Patterns of the names of designs that families do not have: what they have instead.
OTHER_DESIGNS: Parts[str] = Parts(
    FAMILIES, lambda family: family.other_designs, what="bearing design"
)


@dataclass(frozen=True)
class RowPlace:
    """Where a row of elements stands: its middle on the axis [m], its sense (+1: it bears load
    towards +x as its bearing alone does; -1: turned round), and the azimuth [rad] of its first
    element."""

    place: float = 0.0
    sense: float = 1.0
    turned: float = 0.0


@dataclass(frozen=True, kw_only=True)
class RingLand:
    """What the dimensions of cage and ring say of the cage's two lands, one at each end.

    ``clearance``: radial [m], None where the spec does not tell, and ``of`` the dimensions that
    leave it; ``strict``: no other clearance can be. ``facing``: axial length [m] over which an end
    of the cage and the ring face each other, and ``end`` where it ends, from the middle.
    """

    clearance: float | None
    of: str
    strict: bool
    facing: float
    end: float


@dataclass(frozen=True)
class EquivalentLoad:
    """Dynamic equivalent load P [N] of ISO 281, its factors, and the exponent of life.

    The load is not a number where the standard gives no factors.
    """

    load: float
    radial_factor: float  # X
    axial_factor: float  # Y
    exponent: float


def type_name(default: str) -> Any:
    """The field ``type`` of a bearing."""
    return option(default, doc="type of bearing", choices=BEARING_TYPES, elsewhere=OTHER_DESIGNS)


def check_type(name: Any) -> None:
    """Raise InputError for a type of bearing that there is not."""
    if isinstance(name, str) and name not in BEARING_TYPES:
        declined = named_kind(name) or kind_of(name)
        if declined and not replacement_of(name, OTHER_DESIGNS):
            raise InputError(
                f"bearing.type '{name}' is not known: {declined.removeprefix('is ')}; choose from "
                f"{', '.join(BEARING_TYPES)}.",
                where="bearing.type",
                value=name,
            )
    check_value(name, Bearing.__dataclass_fields__["type"].metadata, "bearing.type")


@dataclass(frozen=True, kw_only=True)
class Bearing:
    """A rolling bearing; ``type`` names the spec that describes it."""

    # in words for sentences and titles, and the spec of the cage that goes with it
    kind: ClassVar[str] = "bearing"
    element: ClassVar[str] = "element"
    family: ClassVar[str] = ""  # name of the family whose equations move it
    cage_spec: ClassVar[Spec]
    # contacts of which [contacts] speaks, beside the cage's land
    places: ClassVar[tuple[str, ...]] = ("race", "pocket", "side", "rib")
    sliced: ClassVar[tuple[str, ...]] = ("race", "pocket")  # those cut in slices or strips
    endurance: ClassVar[Endurance | None] = None  # constants of its modified life, ISO 281
    carries_axial_load: ClassVar[bool] = False  # in a run, with the ring free axially and in tilt
    self_aligning: ClassVar[bool] = False  # does its inner ring tilt freely?
    row_count: ClassVar[int] = 1  # rows of elements between its rings, alike
    elsewhere: ClassVar[Mapping[str, str]] = {}  # patterns of keys that it has not: what there is

    type: str = type_name("cylindrical_roller")
    designation: str = option("", doc="name in a catalogue")

    if TYPE_CHECKING:  # what every type has as a field, or says from its fields

        @property
        def bore(self) -> float: ...
        @property
        def outside_diameter(self) -> float: ...
        @property
        def width(self) -> float: ...
        @property
        def pitch_diameter(self) -> float: ...
        @property
        def material(self) -> Material: ...
        @property
        def element_material(self) -> Material | None: ...
        @property
        def inner_ring_mass(self) -> float: ...
        @property
        def outer_ring_mass(self) -> float: ...
        @property
        def inner_ring_inertia(self) -> tuple[float, float]: ...
        @property
        def outer_ring_inertia(self) -> tuple[float, float]: ...

    @property
    def guides(self) -> Mapping[str, str]:
        """What of a ring guides a cage that is not guided by the elements, by ring."""
        return {"inner": "the inner ring", "outer": "the outer ring"}

    def free_axially(self, loaded: bool) -> bool:
        """Is the inner ring free along the axis in a run without a shaft's spring, where the load
        has an axial part (``loaded``), or none?"""
        return self.carries_axial_load

    def axial_refusal(self, load: float) -> str:
        """Why its elements cannot carry an axial load [N] on the inner ring, in words; empty where
        they can, or where the load alone does not tell."""
        return ""

    @property
    def element_count(self) -> int:
        """Z, of a row."""
        raise self._lacks("element_count")

    @property
    def total_elements(self) -> int:
        """Elements of all rows, those of one row after the other's."""
        return self.row_count * self.element_count

    @property
    def one_row(self) -> Bearing:
        """The bearing of one of its rows alone."""
        return self

    @property
    def row_places(self) -> tuple[RowPlace, ...]:
        """Where its rows stand."""
        return (RowPlace(),)

    def rows_held_by(self, cage: Cage) -> tuple[RowPlace, ...]:
        """Where the rows stand, from its middle, whose elements one such cage holds."""
        return (RowPlace(),) if cage.count_in(self) > 1 else self.row_places

    @property
    def element_azimuths(self) -> np.ndarray:
        """Azimuths (n,) [rad] of all elements, those of a row evenly spaced."""
        return self._azimuths(self.row_places)

    def pocket_azimuths(self, cage: Cage) -> np.ndarray:
        """Azimuths (n,) [rad] of the pockets of one such cage, in its frame."""
        return self._azimuths(self.rows_held_by(cage))

    def _azimuths(self, rows: tuple[RowPlace, ...]) -> np.ndarray:
        even = 2.0 * np.pi * np.arange(self.element_count) / self.element_count
        return np.concatenate([even + row.turned for row in rows])

    @property
    def element_diameter(self) -> float:
        """Dw [m]."""
        raise self._lacks("element_diameter")

    @property
    def element_length(self) -> float:
        """Length of an element along the bearing's axis [m]."""
        return self.element_diameter

    @property
    def element_edge(self) -> float:
        """Radius [m] of the edges at an element's ends; 0 for types that do not say."""
        return 0.0

    @property
    def clearance(self) -> float:
        """Radial internal clearance Pd [m]."""
        raise self._lacks("clearance")

    @property
    def has_inner_ring(self) -> bool:
        """Is there one? Without it elements run on the shaft, whose diameter is the bore."""
        return True

    def fit_refusal(self, fit: Fit) -> str:
        """Why it cannot sit as a fit says, in words; empty where it can."""
        return ""

    @property
    def race_diameters(self) -> tuple[float, float]:
        """Diameters [m] at which elements roll on inner and outer race."""
        raise self._lacks("race_diameters")

    def in_place(self, changed: Changed) -> Bearing:
        """The bearing as fits, warmth and speed change it; types without it have no [fit]."""
        raise self._lacks("in_place")

    def approach(self, mounted: Bearing, changed: Changed) -> float | None:
        """By how much [m] the inner ring of this bearing, ``mounted`` and ``changed``, meets its
        elements earlier along the axis; None of types without a place of first contact."""
        return None

    @property
    def element_mass(self) -> float:
        """Mass of a rolling element [kg]; 0 for types that do not say."""
        return 0.0

    @property
    def rolling_material(self) -> Material:
        """Material of the rolling elements: the rings', where no other is given."""
        return getattr(self, "element_material", None) or self.material

    @property
    def is_hybrid(self) -> bool:
        """Are elements and rings of different materials?"""
        return self.rolling_material != self.material

    @property
    def of_what(self) -> str:
        """Of what the elements are, in words, where it is something else than the rings."""
        return f" of {self.rolling_material.name}" if self.is_hybrid else ""

    @property
    def race_modulus(self) -> float:
        """E' of an element on a race, 2/((1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2) [Pa]."""
        if not self.is_hybrid:
            return self.material.plane_strain_modulus
        return contact_modulus(self.material, self.rolling_material)

    @property
    def stress_share(self) -> float:
        """Load on an element of its material that presses a race as hard as 1 on one of the rings'
        material: by Hertz (E'/E'_race)^2 of points, which are curved along the axis, and E'/E'_race
        of lines; 1 where its type has no materials."""
        if getattr(self, "element_material", None) is None:
            return 1.0
        power = 2 if any(self.rolling_heights) else 1
        return (self.material.plane_strain_modulus / self.race_modulus) ** power

    @property
    def nominal_contact_angle(self) -> float:
        """Contact angle [rad] to which kinematics refer."""
        return 0.0

    def rolling_angles(self, angles: tuple[float, float]) -> tuple[float, float]:
        """Angles [rad] of inner and outer race that kinematics take where elements bear at contact
        angles [rad]: the same, but for cones, whose races differ in theirs all along."""
        return angles

    @property
    def rolling_heights(self) -> tuple[float, float]:
        """h/N^(2/3) [N^(-2/3)] of inner and outer race: under a force N, an element rolls at h
        times its radius above the middle of its contact; zero where contacts are not curved."""
        return 0.0, 0.0

    def land(self, cage: Cage) -> RingLand | None:
        """Where the cage faces the ring that guides it, or that it may touch; None where it meets
        none, or where its family says nothing of the ring's land."""
        found: RingLand | None = self._by_rule("land", cage, without=None)
        return found

    def cage_space(self, cage: Cage) -> tuple[RingLimit | None, RingLimit | None]:
        """What of the inner and of the outer ring the cage meets first if it moves across the axis;
        None where its family does not say."""
        inner, outer = self._by_rule("cage_space", cage, without=(None, None))
        return inner, outer

    def stops(self, cage: Cage) -> tuple[RingLand | None, RingLand | None]:
        """Where a cage that no ring guides meets the inner and the outer ring if it moves across
        the axis; None where a run computes no contact there."""
        inner, outer = self._by_rule("stops", cage, without=(None, None))
        return inner, outer

    def _lacks(self, name: str) -> NotImplementedError:
        return NotImplementedError(f"{type(self).__name__} does not define {name}")

    def _by_rule(self, name: str, *values: Any, without: Any = _MISSING) -> Any:
        """What its family's rule says of it; ``without`` one, or NotImplementedError."""
        rule = getattr(FAMILIES[self.family].rules, name) if self.family in FAMILIES else None
        if rule is not None:
            return rule(self, *values)
        if without is _MISSING:
            raise self._lacks(name)
        return without

    def check(self, cage: Any = None, defects: Sequence[Any] = ()) -> None:
        """Raise InputError for the first impossibility found in bearing, cage or defects; without a
        cage the bearing alone is checked."""
        self._by_rule("check", cage, defects)

    @property
    def greatest_tilt(self) -> float:
        """Misalignment [rad] of the inner ring beyond which no contact law holds."""
        return inf

    @property
    def greatest_shift(self) -> float:
        """Axial displacement [m] of the inner ring beyond which elements leave the outer race."""
        return inf

    @property
    def is_thrust(self) -> bool:
        """Do ISO 76 and ISO 281 rate it for axial load?"""
        return False

    @property
    def rating_names(self) -> tuple[str, str]:
        """Symbols of the static and the dynamic rating."""
        return ("C0a", "Ca") if self.is_thrust else ("C0r", "Cr")

    @property
    def static_rating(self) -> float:
        """Basic static load rating C0 [N] of ISO 76: radial, or axial for thrust bearings."""
        return float(self._by_rule("static_rating"))

    @property
    def dynamic_rating(self) -> float:
        """Basic dynamic load rating C [N] of ISO 281: radial, or axial for thrust bearings."""
        return float(self._by_rule("dynamic_rating"))

    def equivalent_load(self, radial: float, axial: float) -> EquivalentLoad:
        """Dynamic equivalent load of ISO 281 under a radial and an axial load [N], both >= 0."""
        found: EquivalentLoad = self._by_rule("equivalent_load", radial, axial)
        return found

    def race_film(self, force: np.ndarray, speed: np.ndarray, oil: Oil) -> Film:
        """Film at inner and outer race under forces (..., 2) [N] of elements at entrainment speeds
        (..., 2) [m/s]; NaN where the type does not say."""
        unknown = np.full(np.shape(force), np.nan)
        return Film(unknown, unknown)

    def rolling_entrainment(
        self, angle: np.ndarray, orbit: np.ndarray, inner_speed: float
    ) -> np.ndarray:
        """Entrainment speeds (Z, 2) [m/s] of elements that roll without slip at contact angles
        (Z, 2) [rad] and orbit at speeds (Z,) [rad/s], where the inner ring turns at a speed [rad/s]
        and the outer one stands; NaN where the type does not say."""
        return np.full(np.shape(angle), np.nan)

    def contact_patch(self, force: float, pressure: float, race: int) -> tuple[float, float]:
        """Mean pressure [Pa] of a contact under a force [N] and a largest pressure [Pa], and the
        half of its length [m] in the rolling direction; ``race`` 0 is the inner."""
        raise self._lacks("contact_patch")

    @property
    def groove_edges(self) -> tuple[float, float]:
        """Angles [rad] from the bottoms of inner and outer groove to their edges; infinite where
        there are none, or none that the spec tells."""
        return inf, inf

    def beyond_edges(self, force: np.ndarray, angle: np.ndarray) -> np.ndarray:
        """How far (..., 2) [rad] the contact ellipses of elements run over the edges of inner and
        outer groove, under forces (..., 2) [N] at contact angles (..., 2) [rad]; < 0 within them.
        """
        return np.full(np.shape(force), -inf)

    @property
    def name_and_size(self) -> str:
        """Designation, type, and bore × outside diameter × width."""
        kind = f"{'an' if self.kind[0] in 'aeiou' else 'a'} {self.kind}"
        name = f"{self.designation}, {kind}" if self.designation else kind.capitalize()
        bore, outside = (
            typeset(v, "mm").removesuffix(" mm") for v in (self.bore, self.outside_diameter)
        )
        return f"{name} of {bore} × {outside} × {typeset(self.width, 'mm')}"

    def in_words(self) -> str:
        """Sentences on its type and main dimensions, and on defects of its races."""
        return f"{self.name_and_size}."


B = TypeVar("B", bound=Bearing)


@dataclass(frozen=True, kw_only=True)
class Rules(Generic[B]):
    """What a family says of its bearings beside their dimensions, each a function of the bearing:
    what ``Bearing`` has under the same name. None: nothing.

    Specs are data; what is possible, rated, or left to a cage between rings stands here.
    """

    check: Callable[[B, Cage | None, Sequence[Any]], None] | None = None
    static_rating: Callable[[B], float] | None = None
    dynamic_rating: Callable[[B], float] | None = None
    equivalent_load: Callable[[B, float, float], EquivalentLoad] | None = None
    land: Callable[[B, Cage], RingLand | None] | None = None
    cage_space: Callable[[B, Cage], tuple[RingLimit | None, RingLimit | None]] | None = None
    stops: Callable[[B, Cage], tuple[RingLand | None, RingLand | None]] | None = None


AnyBearing = TypeVar("AnyBearing", bound=type[Bearing])


def bearing_type(cls: AnyBearing) -> AnyBearing:
    """Register a user's own spec, as a decorator, under the default of its own ``type``."""
    BEARING_TYPES.add(name_of(cls), cls)
    return cls


def name_of(spec: type[Bearing]) -> str:
    """The name by which a case asks for a type of bearing: the default of its ``type``."""
    return str(spec.__dataclass_fields__["type"].default)


def hollow_cylinder_inertia(
    mass: float, bore: float, diameter: float, width: float
) -> tuple[float, float]:
    """Axial and transverse moments of inertia [kg m^2] about the centre."""
    r2 = 0.25 * (diameter**2 + bore**2)
    return 0.5 * mass * r2, mass * (3.0 * r2 + width**2) / 12.0
