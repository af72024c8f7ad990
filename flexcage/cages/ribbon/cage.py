"""Riveted ribbon cages of deep groove ball bearings: two pressed halves of sheet.

Each half is a strip as broad as the cage's wall and as thick as its sheet: flat between the
pockets, where both halves lie on each other in the plane of ball centres and a rivet joins them,
and pressed to half a hollow sphere round every ball. About an axis through a ball's centre, along
the bearing's, a pocket and the sheet around it are a body of revolution.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import pi, sin, sqrt
from typing import ClassVar

from flexcage.cages.round_pocket.cage import BALL_CAGES, BallCage
from flexcage.core.spec import option, quantity
from flexcage.core.units import describe, typeset
from flexcage.geometry.cage import CylindricalCage, HeldElements, Objection
from flexcage.geometry.materials import MATERIALS, Material
from flexcage.geometry.riveted_joint import JointShape

HEAD = 1.75  # a round head's diameter over its rivet's, and
HEAD_HEIGHT = 0.6  # its height, likewise (ISO 1051)
_THINNEST = 0.02  # sheet over the pockets' diameter; elements are as small as it is thin
_LEAST_OPENING = 0.1  # of the sheet's thickness; smaller holes want elements as small
_LEAST_NECK = 0.02  # likewise: the least sheet beside the holes


@dataclass(frozen=True, kw_only=True)
class RibbonCage(BallCage):
    """Two halves of sheet, riveted between the pockets; pockets are spheres about ball centres.

    Pockets end at ``width``/2 to both sides, so that a cage narrower than its pockets leaves the
    balls' sides open; one as wide or wider is closed over them. The halves hold together within the
    circles of the rivets' heads, and are free of each other elsewhere.
    """

    cage_type: ClassVar[str] = "ribbon"
    pockets_vary: ClassVar[bool] = False
    riveted: ClassVar[bool] = True

    type: str = option("ribbon", doc="kind of cage", choices=BALL_CAGES)
    material: Material = option(MATERIALS["steel"], doc="cage material (a name or its values)")
    pocket_shape: str = option("spherical", doc="shape of pockets", choices=("spherical",))
    guidance: str = option("ball", doc="what guides the cage radially", choices=("ball",))
    thickness: float = quantity("mm", doc="thickness of the sheet", above=0.0)
    rivet_diameter: float = quantity("mm", doc="diameter of a rivet's shank", above=0.0)
    bend_radius: float | None = quantity(
        "mm", None, doc="radius between flats and pockets; half the thickness if not given",
        above=0.0,
    )  # fmt: skip

    def in_words(self) -> str:
        opening = typeset(2.0 * self.opening, "mm")
        return (
            f"it is two halves of sheet, {typeset(self.thickness, 'mm')} thick and riveted between "
            f"pockets, which are spheres of {typeset(self.pocket_diameter, 'mm')}, "
            + (f"open at the sides by {opening}" if self.opening else "closed at the sides")
        )

    @property
    def opening(self) -> float:
        """Radius [m] of the hole at a pocket's sides; 0 where it is closed."""
        return sqrt(max(0.25 * (self.pocket_diameter**2 - self.width**2), 0.0))

    @property
    def reach(self) -> float:
        """Half of the cage's axial width [m] over its pockets."""
        outside = 0.5 * self.pocket_diameter + self.thickness
        return 0.5 * self.width if self.opening else outside

    @property
    def axial_width(self) -> float:
        return 2.0 * self.reach

    @property
    def most_unbalance(self) -> float:
        """Unbalance [kg m] of half of its two flat strips."""
        wall = pi / 4.0 * (self.outside_diameter**2 - self.bore**2)
        return self.material.density * wall * self.thickness * self.mean_radius

    @property
    def bend(self) -> float:
        """Radius [m] between flats and pockets."""
        return 0.5 * self.thickness if self.bend_radius is None else self.bend_radius

    @property
    def head_radius(self) -> float:
        """Radius [m] of a rivet's head, within which the halves hold together."""
        return 0.5 * HEAD * self.rivet_diameter

    def rivet_joint(
        self, pitch_diameter: float, pocket_count: int, root_radius: float
    ) -> JointShape:
        pitch = 0.5 * pitch_diameter
        return JointShape(
            shank_diameter=self.rivet_diameter, head_diameter=2.0 * self.head_radius,
            head_height=HEAD_HEIGHT * self.rivet_diameter, root_radius=root_radius,
            thickness=self.thickness, inner=0.5 * self.bore - pitch,
            outer=0.5 * self.outside_diameter - pitch,
            # flat from pocket to pocket: the bends beyond the flats are left out
            length=pitch_diameter * sin(pi / pocket_count) - self.pocket_diameter,
        )  # fmt: skip

    @property
    def bend_centre(self) -> tuple[float, float]:
        """(x, rho) [m] of the middle of the bend's arc, rho from the axis through a ball."""
        x = self.thickness + self.bend
        return x, sqrt((0.5 * self.pocket_diameter + x) ** 2 - x**2)

    @property
    def wall_end(self) -> float:
        return self.width / self.pocket_diameter if self.opening else 2.0

    def thinnest(self, pitch_diameter: float, pocket_count: int) -> float:
        return min(self.thickness, 0.5 * (self.outside_diameter - self.bore))

    def parts(self, pitch_diameter: float, pocket_count: int) -> dict[str, float]:
        found = {"sheet": self.thickness, "wall": 0.5 * (self.outside_diameter - self.bore)}
        if self.opening:
            found["necks beside the pockets"] = self._neck_reach(pitch_diameter) - self.opening
        return found

    def _neck_reach(self, pitch_diameter: float) -> float:
        """From the circle of the balls' centres to the strip's further edge [m]."""
        inner, outer, pitch = self.bore, self.outside_diameter, pitch_diameter
        return 0.5 * max(outer - pitch, pitch - inner)

    def impossible(self, pocket_count: int) -> Iterator[Objection]:
        yield from CylindricalCage.impossible(self, pocket_count)
        thin = _THINNEST * self.pocket_diameter
        if self.thickness < thin:
            yield "thickness", f"makes no sheet; it must be at least {describe(thin, 'mm')}"
        if 0.0 < self.opening < _LEAST_OPENING * self.thickness:
            yield (
                "width",
                f"leaves holes of {describe(2.0 * self.opening, 'mm')} at the sides of pockets of "
                f"{describe(self.pocket_diameter, 'mm')}; make it as wide as they are, or narrower",
            )
        x = self.bend_centre[0]
        bent = x * (1.0 - self.bend / (0.5 * self.pocket_diameter + x))  # where the bend ends
        if not bent < self.reach:
            yield (
                "width",
                f"ends the pockets below their bends, {describe(bent, 'mm')} from the cage's "
                f"middle; it must be greater than {describe(2.0 * bent, 'mm')}",
            )
        if self.pocket_scatter > 0.0:
            yield "pocket_scatter", "is of machined cages; a ribbon cage has its pockets evenly"

    def obstructions(self, bearing: HeldElements) -> Iterator[Objection]:
        pitch_diameter, pocket_count = bearing.pitch_diameter, bearing.element_count
        yield from self._tight(bearing)
        yield from self._low_rim(pitch_diameter)
        inner, outer = 0.5 * self.bore, 0.5 * self.outside_diameter
        left = self._neck_reach(pitch_diameter) - _LEAST_NECK * self.thickness
        if not self.opening < left:
            least = 2.0 * sqrt(max(0.25 * self.pocket_diameter**2 - left**2, 0.0))
            yield (
                "width",
                f"so the holes of {describe(2.0 * self.opening, 'mm')} at the sides of its pockets "
                f"cut the sheet through, or nearly; it must exceed {describe(least, 'mm')}",
            )
        flat = pitch_diameter * sin(pi / pocket_count) - 2.0 * self.bend_centre[1]
        if not flat > self.rivet_diameter:
            spared = f"flats of {describe(flat, 'mm')} alone" if flat > 0.0 else "no flats"
            yield (
                "rivet_diameter",
                f"but pockets, sheet and bends leave {spared} between them; make pockets, sheet, "
                "bends or rivets smaller",
            )
        broad, head = outer - inner, 2.0 * self.head_radius
        available = min(broad, pitch_diameter * sin(pi / pocket_count) - self.pocket_diameter)
        if not head < available:
            yield (
                "rivet_diameter",
                f"so its head is {describe(head, 'mm')} across, but the sheet between pockets has "
                f"{describe(available, 'mm')} for it",
            )
