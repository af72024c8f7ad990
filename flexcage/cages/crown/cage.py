"""Crown (snap) cages of deep groove ball bearings: a ring on one side, claws around the balls.

The wall is a hollow cylinder. On the side -x of the balls it is a closed ring; between the balls,
bars stand on it; on each bar two claws, one round either ball. Pockets are spheres that are open on
the side +x, where the ball is pushed in between the claws' tips. About an axis through a ball's
centre, along the bearing's, a pocket and the claws around it are a body of revolution.
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

_THINNEST = (
    0.02  # claws and ring over the pockets' diameter; elements are as small as they are thin
)


@dataclass(frozen=True, kw_only=True)
class CrownCage(BallCage):
    """A ring with claws that point to +x; pockets are spheres about the balls' centres.

    ``width`` is from the ring's back to the claws' tips. The tips end in the plane in which the
    pockets' spheres are ``throat`` wide; a ball snaps in through there.
    """

    cage_type: ClassVar[str] = "crown"
    pockets_vary: ClassVar[bool] = False
    mirrored: ClassVar[bool] = True

    type: str = option("crown", doc="kind of cage", choices=BALL_CAGES)
    material: Material = option(MATERIALS["PA66"], doc="cage material (a name or its values)")
    pocket_shape: str = option("spherical", doc="shape of pockets", choices=("spherical",))
    guidance: str = option("ball", doc="what guides the cage radially", choices=("ball",))
    throat: float = quantity(
        "mm",
        doc="width of the pockets' openings between the claws' tips; less than the ball's diameter "
        "by what it snaps in",
        above=0.0,
    )
    claw_thickness: float = quantity("mm", doc="thickness of the claws", above=0.0)
    bar_height: float = quantity(
        "mm", 0.0, doc="where the bars between the pockets end and the claws begin, from the plane "
        "of the balls' centres", minimum=0.0,
    )  # fmt: skip
    root_radius: float | None = quantity(
        "mm", None, doc="radius between claws and bars; half the claws' thickness if not given",
        above=0.0,
    )  # fmt: skip

    def in_words(self) -> str:
        return (
            f"it is a ring with claws, {typeset(self.claw_thickness, 'mm')} thick, around pockets "
            f"that are spheres of {typeset(self.pocket_diameter, 'mm')}, open by "
            f"{typeset(self.throat, 'mm')} on the side +x"
        )

    @property
    def tip(self) -> float:
        """Place x [m] of the claws' tips."""
        return 0.5 * sqrt(max(self.pocket_diameter**2 - self.throat**2, 0.0))

    @property
    def back(self) -> float:
        """Place x [m] of the ring's back."""
        return self.tip - self.width

    @property
    def ring_thickness(self) -> float:
        """Thickness [m] of the ring under the pockets, its thinnest section."""
        return -0.5 * self.pocket_diameter - self.back

    @property
    def axial_reach(self) -> float:
        return max(self.tip, -self.back)

    @property
    def inner_reach(self) -> float:
        return -self.back

    @property
    def root(self) -> float:
        """Radius [m] between claws and bars."""
        return 0.5 * self.claw_thickness if self.root_radius is None else self.root_radius

    @property
    def claw_outside(self) -> float:
        """Radius [m] of the sphere on which the claws end outside."""
        return 0.5 * self.pocket_diameter + self.claw_thickness

    @property
    def root_centre(self) -> tuple[float, float]:
        """(x, rho) [m] of the middle of the root's arc, rho from the axis through a ball."""
        x = self.bar_height + self.root
        return x, sqrt(max((self.claw_outside + self.root) ** 2 - x**2, 0.0))

    @property
    def claw_begin(self) -> float:
        """Place x [m] where the root's arc ends outside and the claw is as thick as it says."""
        return self.claw_outside / (self.claw_outside + self.root) * self.root_centre[0]

    @property
    def most_unbalance(self) -> float:
        """Unbalance [kg m] of half of its ring, as thick as it is under the pockets."""
        wall = pi / 4.0 * (self.outside_diameter**2 - self.bore**2)
        return 0.5 * self.material.density * wall * max(self.ring_thickness, 0.0) * self.mean_radius

    def wall_ends(self, pitch_radius: float, radius: float) -> tuple[float, float, float, float]:
        outward, inward, _, _ = super().wall_ends(pitch_radius, radius)
        return outward, inward, self.tip / radius, 2.0

    def thinnest(self, pitch_diameter: float, pocket_count: int) -> float:
        wall = 0.5 * (self.outside_diameter - self.bore)
        return min(self.claw_thickness, self.ring_thickness, wall)

    def parts(self, pitch_diameter: float, pocket_count: int) -> dict[str, float]:
        return {
            "ring under the pockets": self.ring_thickness,
            "claws": self.claw_thickness,
            "wall": 0.5 * (self.outside_diameter - self.bore),
        }

    def impossible(self, pocket_count: int) -> Iterator[Objection]:
        yield from CylindricalCage.impossible(self, pocket_count)
        if self.throat >= self.pocket_diameter:
            yield (
                "throat",
                "leaves no claws; it must be less than the pockets' diameter, "
                f"{describe(self.pocket_diameter, 'mm')}",
            )
            return
        thin = _THINNEST * self.pocket_diameter
        if self.claw_thickness < thin:
            yield "claw_thickness", f"makes no claws; it must be at least {describe(thin, 'mm')}"
        least = self.tip + 0.5 * self.pocket_diameter + thin
        if self.width < least:
            yield (
                "width",
                "leaves no ring under the pockets, which with their claws are "
                f"{describe(self.tip + 0.5 * self.pocket_diameter, 'mm')} wide; it must be at "
                f"least {describe(least, 'mm')}",
            )
        if not self.claw_begin + thin < self.tip:
            yield (
                "bar_height",
                f"leaves no claws between bars and tips, which are {describe(self.tip, 'mm')} from "
                "the plane of the balls' centres; make bars lower, roots smaller or the throat "
                "narrower",
            )
        if self.pocket_scatter > 0.0:
            yield "pocket_scatter", "is of machined cages; a crown cage has its pockets evenly"

    def obstructions(self, bearing: HeldElements) -> Iterator[Objection]:
        yield from self._tight(bearing)
        if not self.throat < bearing.element_diameter:
            size = describe(bearing.element_diameter, "mm")
            yield (
                "throat",
                f"so the balls fall out; it must be less than the ball's diameter, {size}",
            )
        yield from self._low_rim(bearing.pitch_diameter)
        yield from self._touching_claws(bearing.pitch_diameter * sin(pi / bearing.element_count))
        yield from self._over_shoulders(bearing)

    def _touching_claws(self, chord: float) -> Iterator[Objection]:
        """Claws of neighbouring pockets that meet; ``chord`` [m] is between balls' centres."""
        gap = chord - 2.0 * self.root_centre[1]
        if gap > 0.0:
            return
        yield (
            "claw_thickness",
            f"so the claws of neighbouring pockets meet: with pockets of "
            f"{describe(self.pocket_diameter, 'mm')} and roots of {describe(self.root, 'mm')} they "
            f"take {describe(chord - gap, 'mm')} of the {describe(chord, 'mm')} between two balls' "
            "centres; make claws, roots or pockets smaller",
        )

    def _over_shoulders(self, bearing: HeldElements) -> Iterator[Objection]:
        """Claws and ring that overlap a ring's shoulder, given or assumed."""
        inner, outer = bearing.cage_space(self)
        if inner is not None and not self.bore > inner.diameter:
            yield (
                "bore",
                f"so the claws overlap {inner.name}; it must be greater than "
                f"{describe(inner.diameter, 'mm')}",
            )
        if outer is not None and not self.outside_diameter < outer.diameter:
            yield (
                "outside_diameter",
                f"so the claws overlap {outer.name}; it must be less than "
                f"{describe(outer.diameter, 'mm')}",
            )
