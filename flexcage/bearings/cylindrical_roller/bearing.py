"""Cylindrical roller bearings: the spec, roller mass and inertia."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from math import pi
from typing import TYPE_CHECKING, ClassVar

import numpy as np

from flexcage.bearings.cylindrical_roller import designs
from flexcage.bearings.cylindrical_roller.spot import RollerSpot
from flexcage.cages.window.cage import WindowCage
from flexcage.core.spec import option, quantity
from flexcage.core.units import typeset
from flexcage.geometry.bearing import Bearing, Spec, hollow_cylinder_inertia, type_name
from flexcage.geometry.film import Film, Oil, both_races, line_film, rolling_entrainment
from flexcage.geometry.life.iso281 import ROLLERS, Endurance
from flexcage.geometry.materials import MATERIALS, Material
from flexcage.geometry.other_kinds import SURROUNDINGS
from flexcage.geometry.rollers import B_M, OfRollers, RollerProfile
from flexcage.geometry.spall import BY_RACE, Spall, spalls_in_words
from flexcage.geometry.waviness import waviness, waviness_azimuth, waviness_order

if TYPE_CHECKING:
    from flexcage.geometry.fits.changed import Changed

BY_DESIGN = (
    f"of cylindrical roller bearings flexcage has the designs {designs.ALL}, single-row: give "
    "bearing.design (type 'cylindrical_roller'); a full complement has model = \"none\" in [cage]"
)
#: Names of designs of cylindrical roller bearings, and what asks for them.
OTHER_DESIGNS = {r"(cylindrical_roller_)?(rnu|nup?|nj|nf|nnu?|n?ncf)([-_ ]?\d.*)?": BY_DESIGN}
#: Names of makers' full complement bearings, as designs: what has their ribs.
FULL_COMPLEMENT = {
    r"(r?ncf|sl18)[-_ ]?v?": 'NCF is the design "NF" with model = "none" in [cage]',
    r"(njg|sl19)[-_ ]?(vh?)?": 'NJG is the design "NJ" with model = "none" in [cage]',
}
BY_RIBS = (
    "bearing.design says which ring has ribs; bearing.rib_diameter and rib_gap are of the two that "
    "guide the rollers, counter_rib_diameter and counter_rib_gap of the other ring's"
)


@dataclass(frozen=True, kw_only=True)
class RollerBearing(OfRollers, Bearing):
    """A single-row cylindrical roller bearing; ``design`` says which of its rings have ribs.

    Race diameters are those at zero clearance; half of the radial clearance is taken from the
    inner race's diameter and half added to the outer's.
    """

    kind: ClassVar[str] = "cylindrical roller bearing"
    cage_spec: ClassVar[Spec] = WindowCage
    element: ClassVar[str] = "roller"
    family: ClassVar[str] = "cylindrical_roller"
    endurance: ClassVar[Endurance | None] = ROLLERS
    rating_factor: ClassVar[float] = B_M  # of ISO 281
    cage_between_ribs: ClassVar[bool] = False  # along the axis: it faces the races, not the ribs
    elsewhere: ClassVar[Mapping[str, str]] = {
        "(inner_|outer_)?(ribs?|flanges?)(_.*)?": BY_RIBS,
        **BY_RACE,
        **SURROUNDINGS,
    }

    type: str = type_name("cylindrical_roller")
    bore: float = quantity("mm", doc="bearing bore d", above=0.0)
    outside_diameter: float = quantity("mm", doc="bearing outside diameter D", above=0.0)
    width: float = quantity("mm", doc="bearing width B", above=0.0)
    inner_race_diameter: float = quantity("mm", doc="race diameter F of the inner ring", above=0.0)
    outer_race_diameter: float = quantity("mm", doc="race diameter E of the outer ring", above=0.0)
    roller_diameter: float = quantity("mm", doc="diameter Dw of a roller", above=0.0)
    roller_length: float = quantity("mm", doc="length Lw of a roller, overall", above=0.0)
    effective_length: float = quantity(
        "mm", doc="length Lwe of a roller without end chamfers", above=0.0
    )
    roller_count: int = option(doc="number Z of rollers", minimum=3)
    radial_clearance: float = quantity(
        "um", 0.0, doc="operating radial clearance Pd; with [fit] before mounting"
    )
    design: str = option(
        "N", choices=tuple(designs.DESIGNS),
        doc="ribs: N two on the inner ring, NU on the outer; NJ as NU and one on the inner, NUP as "
        "NU and two on the inner, NF as N and one on the outer",
        elsewhere=FULL_COMPLEMENT,
    )  # fmt: skip
    rib_diameter: float = quantity(
        "mm", doc="diameter of the two ribs that guide the rollers, towards them", above=0.0
    )
    rib_gap: float = quantity("mm", doc="axial distance between these two ribs", above=0.0)
    counter_rib_diameter: float | None = quantity(
        "mm", None, doc="diameter of the other ring's ribs (NJ, NUP, NF)", above=0.0
    )
    counter_rib_gap: float | None = quantity(
        "mm", None, doc="their axial distance, for one rib twice that from the middle", above=0.0,
    )  # fmt: skip
    thrust: str = option(
        "+x", choices=designs.SIDES,
        doc="axial load on the inner ring that a single counter rib carries (NJ, NF)",
    )  # fmt: skip
    profile: RollerProfile = option(RollerProfile(), doc="roller profile")
    material: Material = option(MATERIALS["GCr15"], doc="material of the rings, and of the rollers")
    element_material: Material | None = option(
        None, doc="material of the rollers, as Si3N4 (default: bearing.material)"
    )
    roller_scatter: float = quantity(
        "um", 0.0, doc="standard deviation of roller diameters (seeded)", minimum=0.0
    )
    inner_waviness: float = waviness("inner")
    inner_waviness_order: int = waviness_order("inner")
    inner_waviness_azimuth: float = waviness_azimuth("inner")
    outer_waviness: float = waviness("outer")
    outer_waviness_order: int = waviness_order("outer")
    outer_waviness_azimuth: float = waviness_azimuth("outer")
    inner_spall: Spall = option(Spall(), doc="a pit of the inner race, which turns with its ring")
    outer_spall: Spall = option(Spall(), doc="a pit of the outer race")
    roller_spot: RollerSpot = option(RollerSpot(), doc="a pit or a flat on a roller")

    @property
    def pitch_diameter(self) -> float:
        return 0.5 * (self.inner_race_diameter + self.outer_race_diameter)

    @property
    def pitch_radius(self) -> float:
        return 0.5 * self.pitch_diameter

    @property
    def inner_race_radius(self) -> float:
        return 0.5 * self.inner_race_diameter - 0.25 * self.radial_clearance

    @property
    def outer_race_radius(self) -> float:
        return 0.5 * self.outer_race_diameter + 0.25 * self.radial_clearance

    @property
    def gamma(self) -> float:
        return self.roller_diameter / self.pitch_diameter

    @cached_property
    def roller_mass(self) -> float:
        density = self.rolling_material.density
        return density * 0.25 * pi * self.roller_diameter**2 * self.roller_length

    @cached_property
    def roller_inertia(self) -> tuple[float, float]:
        """Axial and transverse moments of inertia of a roller [kg m^2]."""
        radius = 0.5 * self.roller_diameter
        axial = 0.5 * self.roller_mass * radius**2
        transverse = self.roller_mass * (3.0 * radius**2 + self.roller_length**2) / 12.0
        return axial, transverse

    @property
    def clearance(self) -> float:
        return self.radial_clearance

    @property
    def race_diameters(self) -> tuple[float, float]:
        return self.inner_race_diameter, self.outer_race_diameter

    def in_place(self, changed: Changed) -> RollerBearing:
        """Races are kept as those of zero clearance; ribs move with the race of their ring."""
        half = 0.5 * (changed.clearance - changed.initial)
        grown = {"inner": changed.inner_race, "outer": changed.outer_race}
        design = designs.DESIGNS[self.design]
        counter = self.counter_rib_diameter
        return replace(
            self,
            inner_race_diameter=self.inner_race_diameter + changed.inner_race + half,
            outer_race_diameter=self.outer_race_diameter + changed.outer_race - half,
            roller_diameter=self.roller_diameter + changed.element,
            radial_clearance=changed.clearance,
            rib_diameter=self.rib_diameter + grown[design.guide],
            counter_rib_diameter=None if counter is None else counter + grown[design.other],
        )

    @property
    def element_mass(self) -> float:
        return self.roller_mass

    def ribs(self, ring: str) -> designs.Ribs | None:
        """Ribs of the "inner" or "outer" ring; None if it has none."""
        design = designs.DESIGNS[self.design]
        if ring == design.guide:
            return designs.Ribs(self.rib_diameter, self.rib_gap, designs.BOTH)
        if not design.counter:
            return None
        diameter, gap = self.counter_rib_diameter, self.counter_rib_gap
        assert diameter is not None and gap is not None  # see ``checks``
        return designs.Ribs(diameter, gap, self._counter_sides)

    def cage_ribs(self, ring: str) -> designs.Ribs | None:
        """Those of the ring that a cage faces across the axis."""
        return None if self.cage_between_ribs else self.ribs(ring)

    def impossible(self) -> Iterator[tuple[str, str]]:
        """What else its type cannot have: where, and in a sentence."""
        yield from ()

    @property
    def _counter_sides(self) -> tuple[bool, bool]:
        """Sides of the counter ribs. A single one of the inner ring pushes the rollers the way of
        the axial load; one of the outer ring stands in that way."""
        design = designs.DESIGNS[self.design]
        if design.counter == 2:
            return designs.BOTH
        plus = (self.thrust == "+x") == (design.other == "outer")
        return plus, not plus

    @property
    def carried(self) -> tuple[bool, bool]:
        """Does the bearing carry axial load on its inner ring towards +x, and towards -x?"""
        counter = designs.DESIGNS[self.design].counter
        plus, minus = (
            counter == 2 or (counter == 1 and self.thrust == side) for side in designs.SIDES
        )
        return plus, minus

    @property
    def guides(self) -> Mapping[str, str]:
        own = {ring: f"the {ring} ring's {ribs.name}" for ring in designs.RINGS
               if (ribs := self.cage_ribs(ring))}  # fmt: skip
        return {**super().guides, **own}

    def free_axially(self, loaded: bool) -> bool:
        return loaded and any(self.carried)

    def axial_refusal(self, load: float) -> str:
        """Why the ribs cannot carry an axial load [N] on the inner ring; empty if they can."""
        if load == 0.0 or self.carried[0 if load > 0.0 else 1]:
            return ""
        if not any(self.carried):
            guide = designs.DESIGNS[self.design].guide
            return (
                f"the design {self.design} has ribs on the {guide} ring alone and carries no axial "
                "load: NJ carries one towards one side, NUP towards both"
            )
        towards = "+x" if load > 0.0 else "-x"
        return (
            f"this {self.design} carries axial load towards {self.thrust} alone: bearing.thrust = "
            f'"{towards}" turns it round, and the design NUP carries both'
        )

    @property
    def ring_bore(self) -> float:
        """Bore [m] of what lies inside the inner race: the ring, or without it the solid shaft."""
        return self.bore if self.has_inner_ring else 0.0

    @cached_property
    def inner_ring_mass(self) -> float:
        """Inner ring as a hollow cylinder from bore to race, without ribs [kg]."""
        area = 0.25 * pi * (self.inner_race_diameter**2 - self.ring_bore**2)
        return self.material.density * area * self.width

    @cached_property
    def inner_ring_inertia(self) -> tuple[float, float]:
        """Axial and transverse moments of inertia of that hollow cylinder [kg m^2]."""
        return hollow_cylinder_inertia(
            self.inner_ring_mass, self.ring_bore, self.inner_race_diameter, self.width
        )

    @cached_property
    def outer_ring_mass(self) -> float:
        area = 0.25 * pi * (self.outside_diameter**2 - self.outer_race_diameter**2)
        return self.material.density * area * self.width

    @cached_property
    def outer_ring_inertia(self) -> tuple[float, float]:
        """Axial and transverse moments of inertia of a hollow cylinder of that mass [kg m^2]."""
        return hollow_cylinder_inertia(
            self.outer_ring_mass, self.outer_race_diameter, self.outside_diameter, self.width
        )

    @property
    def greatest_shift(self) -> float:
        return 0.5 * (self.width - self.roller_length)

    def race_film(self, force: np.ndarray, speed: np.ndarray, oil: Oil) -> Film:
        """The load spread evenly over the effective length: a profile's ends are not resolved."""
        roller, modulus = 0.5 * self.roller_diameter, self.race_modulus
        films = []
        for k, (race, side) in enumerate(
            ((self.inner_race_radius, 1.0), (self.outer_race_radius, -1.0))
        ):
            radius = roller * race / (race + side * roller)
            load = force[..., k] / self.effective_length
            films.append(line_film(radius, modulus, load, speed[..., k], oil))
        return both_races(films)

    def rolling_entrainment(
        self, angle: np.ndarray, orbit: np.ndarray, inner_speed: float
    ) -> np.ndarray:
        return rolling_entrainment(
            angle, orbit, inner_speed, diameter=self.roller_diameter, pitch=self.pitch_diameter
        )

    def in_words(self) -> str:
        return (
            f"{self.name_and_size} with {self.roller_count} "
            f"rollers of {typeset(self.roller_diameter, 'mm')}{self.of_what}, radial clearance "
            f"{typeset(self.radial_clearance, 'um')}."
            f"{spalls_in_words(self)}"
            f"{self.roller_spot.in_words()}"
        )
