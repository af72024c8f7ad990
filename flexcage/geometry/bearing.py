"""What all bearing types share: the name by which a case asks for one.

A type is a spec of its own, one file each in this room. It names itself here, and supplies its
parts by being registered with the functions that want them: ``checks.check_geometry``,
``catalogue.static_rating``, ``catalogue.dynamic_rating`` and ``catalogue.equivalent_load``.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, ClassVar, TypeVar

from flexcage.core.binding import check_value
from flexcage.core.spec import option
from flexcage.core.wings import FAMILIES, Parts
from flexcage.geometry.cage import Cage

Spec = type  # by another name, for inside the spec ``type`` is a field

#: Designs of cylindrical roller bearings other than N, and what there is instead.
OTHER_DESIGNS = {
    r"(cylindrical_roller_)?(rnu|nup?|nj|nf|nnu?|n?ncf)([-_ ]?\d.*)?": (
        "of cylindrical roller bearings flexcage has the design N alone, with two ribs on the "
        "inner ring and a plain outer ring (type 'cylindrical_roller')"
    )
}
#: Specs of bearings by the name that a case gives: those of all families, and users' own.
BEARING_TYPES: Parts[Spec] = Parts(
    FAMILIES, lambda family: {name_of(spec): spec for spec in family.types}, what="bearing type"
)


@dataclass(frozen=True)
class RingLimit:
    """A part of a ring beside the cage: its diameter [m], and what it is."""

    diameter: float
    name: str


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


def type_name(default: str) -> Any:
    """The field ``type`` of a bearing."""
    return option(default, doc="type of bearing", choices=BEARING_TYPES, elsewhere=OTHER_DESIGNS)


def check_type(name: Any) -> None:
    """Raise InputError for a type of bearing that there is not."""
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
    carries_axial_load: ClassVar[bool] = False  # in a run, with the ring free axially and in tilt
    in_motion: ClassVar[bool] = False  # are there equations of motion for this type?
    elsewhere: ClassVar[Mapping[str, str]] = {}  # patterns of keys that it has not: what there is
    explicit_only: ClassVar[bool] = False  # do they lack the tangent that implicit methods want?

    type: str = type_name("cylindrical_roller")
    designation: str = option("", doc="name in a catalogue")

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:  # dimensions of its own type
            ...

    @property
    def element_count(self) -> int:
        """Z."""
        raise NotImplementedError

    @property
    def element_diameter(self) -> float:
        """Dw [m]."""
        raise NotImplementedError

    @property
    def element_mass(self) -> float:
        """Mass of a rolling element [kg]; 0 for types that do not say."""
        return 0.0

    @property
    def nominal_contact_angle(self) -> float:
        """Contact angle [rad] to which kinematics refer."""
        return 0.0

    @property
    def rolling_heights(self) -> tuple[float, float]:
        """h/N^(2/3) [N^(-2/3)] of inner and outer race: under a force N, an element rolls at h
        times its radius above the middle of its contact; zero where contacts are not curved."""
        return 0.0, 0.0

    def land(self, cage: Cage) -> RingLand | None:
        """Where the cage faces the ring that guides it, or that it may touch; None where it meets
        none, or where the spec says nothing of the ring's land."""
        return None

    def cage_space(self, cage: Cage) -> tuple[RingLimit | None, RingLimit | None]:
        """What of the inner and of the outer ring the cage meets first if it moves across the axis;
        None where the spec does not say."""
        return None, None

    @property
    def is_thrust(self) -> bool:
        """Do ISO 76 and ISO 281 rate it for axial load?"""
        return False


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
