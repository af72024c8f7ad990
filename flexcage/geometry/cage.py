"""What all cages share: their body of revolution, what guides them, and their unbalance."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import nan, pi
from typing import TYPE_CHECKING, ClassVar, Protocol

from flexcage.core.errors import InputError
from flexcage.core.spec import GIVEN, option, quantity
from flexcage.core.units import describe, typeset
from flexcage.core.wings import CAGE_TYPES, Parts
from flexcage.geometry.materials import MATERIALS, Material
from flexcage.geometry.temperature import material_at

if TYPE_CHECKING:
    from flexcage.geometry.riveted_joint import JointShape

Objection = tuple[str, str]  # name of a value, and what is wrong with it


def cages_of(element: str) -> Parts[type]:
    """Specs of the cages that hold such elements ("ball"), by the name that a case gives."""
    return Parts(
        CAGE_TYPES,
        lambda made: {made.name: made.spec} if element in made.holds else {},
        what="cage type",
    )


@dataclass(frozen=True)
class RingLimit:
    """A part of a ring beside the cage: its diameter [m], and what it is."""

    diameter: float
    name: str


class HeldElements(Protocol):
    """The elements that a cage holds, as their bearing has them (``geometry.bearing``)."""

    element: ClassVar[str]

    @property
    def element_count(self) -> int: ...
    @property
    def element_diameter(self) -> float: ...
    @property
    def element_length(self) -> float: ...
    @property
    def element_edge(self) -> float: ...
    @property
    def pitch_diameter(self) -> float: ...
    def cage_space(self, cage: Cage) -> tuple[RingLimit | None, RingLimit | None]: ...


@dataclass(frozen=True, kw_only=True)
class Cage:
    """A cage of some type: ``type`` of those whose elements several cages hold says which, and
    ``cage_spec`` of a bearing's type what it is where nobody says."""

    cage_type: ClassVar[str] = ""  # name of its ``cages.cage_type.CageType``
    altered: ClassVar[str] = "Defects"  # heads the list of its defects
    # do rivets of ``rivet_diameter`` between its pockets hold two halves together?
    riveted: ClassVar[bool] = False
    # is one half of a common cage for two rows the mirror image of the other, or just elsewhere?
    mirrored: ClassVar[bool] = False

    if TYPE_CHECKING:  # of those that are riveted, and what every type has as a field or says

        @property
        def rivet_diameter(self) -> float: ...
        @property
        def bore(self) -> float: ...
        @property
        def outside_diameter(self) -> float: ...
        @property
        def width(self) -> float: ...

    material: Material = option(MATERIALS["brass"], doc="cage material (a name or its values)")
    temperature: float | None = quantity(
        "degC", None, above=0.0,
        doc="temperature of the cage, from which modulus and damping follow; room temperature "
        "by default; dimensions, density and strength stay",
    )  # fmt: skip
    guidance: str = option("", doc="what guides the cage radially")
    unbalance: float = quantity("g*mm", 0.0, doc="mass-radius product of an unbalance", minimum=0.0)
    unbalance_phase: float = quantity(
        "deg", 0.0, doc="azimuth of the unbalance from pocket 0", when={"unbalance": GIVEN}
    )
    unbalance_offset: float = quantity(
        "mm", 0.0, doc="place of the unbalance along +x from the cage's middle: a couple as well",
        when={"unbalance": GIVEN},
    )  # fmt: skip

    def rivet_joint(
        self, pitch_diameter: float, pocket_count: int, root_radius: float
    ) -> JointShape:
        """The joint at one of its rivets, whose heads have roots of this radius [m]; for cages that
        are ``riveted``."""
        raise NotImplementedError

    @property
    def warm_material(self) -> Material:
        """Its material at its temperature. Raises InputError for one of unknown modulus."""
        return material_at(self.material, self.temperature)

    @property
    def mean_radius(self) -> float:
        """Radius [m] of the middle of its wall."""
        return 0.25 * (self.bore + self.outside_diameter)

    @property
    def fillet(self) -> float:
        """Radius [m] of its pockets' corners; zero without corners."""
        return 0.0

    @property
    def pocket_size(self) -> float:
        """Width [m] of a pocket around the cage; NaN where its type does not say."""
        return nan

    def pocket_clearance(self, bearing: HeldElements) -> float:
        """Clearance [m] of an element in its pocket around the cage; NaN likewise."""
        return self.pocket_size - bearing.element_diameter

    @property
    def pocket_reach(self) -> float:
        """How far [m] a pocket reaches to both sides along the axis."""
        raise NotImplementedError

    @property
    def has_faces(self) -> bool:
        """Have its pockets plane faces, which a basis may have attachment vectors for?"""
        return True

    @property
    def has_land(self) -> bool:
        """May a ring's land touch it?"""
        return True

    @property
    def land_ring(self) -> str:
        """The ring that its land faces, "inner" or "outer": the one that guides it, if any does."""
        return "outer" if self.guidance == "outer" else "inner"

    @property
    def land_radius(self) -> float:
        """Radius [m] of its land."""
        return 0.5 * (self.outside_diameter if self.land_ring == "outer" else self.bore)

    @property
    def axial_width(self) -> float:
        """What it takes up along the axis [m]."""
        return self.width

    @property
    def axial_reach(self) -> float:
        """How far it reaches [m] from the plane of the elements' centres, to one side at least."""
        return 0.5 * self.axial_width

    @property
    def most_unbalance(self) -> float:
        """Unbalance [kg m] of half of its body of revolution, taken as solid: more cannot be."""
        wall = pi / 4.0 * (self.outside_diameter**2 - self.bore**2)
        return 0.5 * self.material.density * wall * self.axial_width * self.mean_radius

    @property
    def inner_reach(self) -> float | None:
        """How far one row's half of a common cage reaches [m] from the plane of the elements'
        centres to its end at -x, in which both halves may hold together; None where not."""
        return None

    @property
    def half_section(self) -> Sequence[tuple[float, float]]:
        """Corners (x, r) [m] of the section through the axis of one row's half, beside a pocket,
        from the plane of the elements' centres; none where its type does not say."""
        return ()

    def thinnest(self, pitch_diameter: float, pocket_count: int) -> float:
        """Least thickness [m] of wall and webs, for which elements must not be too large."""
        raise NotImplementedError

    def parts(self, pitch_diameter: float, pocket_count: int) -> dict[str, float]:
        """Least thickness [m] of its parts, by name; none where its type does not say."""
        return {}

    def in_words(self) -> str:
        """Half a sentence on a sound cage's shape and pockets, after "Its cage is ...;"."""
        return f"it is {typeset(self.width, 'mm')} wide"

    def impossible(self, pocket_count: int) -> Iterator[Objection]:
        """Dimensions that leave no body."""
        return iter(())

    def check(self, pocket_count: int) -> None:
        """Raise InputError for the first of its dimensions that leaves no body."""
        for name, what in self.impossible(pocket_count):
            value, where = getattr(self, name), f"cage.{name}"
            raise InputError(f"{where}, {self.described(name)}, {what}.", where=where, value=value)
        material_at(self.material, self.temperature)

    def described(self, name: str) -> str:
        """One of its lengths in mm, or of its angles in degrees."""
        angle = self.__dataclass_fields__[name].metadata["unit"] == "deg"
        return describe(getattr(self, name), "deg" if angle else "mm")

    def obstructions(self, bearing: HeldElements) -> Iterator[Objection]:
        """What leaves no room in it for a bearing's elements, or for itself between them."""
        return iter(())


@dataclass(frozen=True, kw_only=True)
class CylindricalCage(Cage):
    """A cage made of a hollow cylinder, which gives its dimensions."""

    bore: float = quantity("mm", doc="inside diameter", above=0.0)
    outside_diameter: float = quantity("mm", doc="outside diameter", above=0.0)
    width: float = quantity("mm", doc="axial width", above=0.0)

    @property
    def inner_reach(self) -> float | None:
        return 0.5 * self.width

    def impossible(self, pocket_count: int) -> Iterator[Objection]:
        if self.outside_diameter <= self.bore:
            yield "outside_diameter", f"must exceed its bore, {describe(self.bore, 'mm')}"
