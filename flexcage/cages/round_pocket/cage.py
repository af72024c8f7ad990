"""Cages of ball bearings."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import hypot, pi, sin
from typing import ClassVar

from flexcage.core.spec import option, quantity
from flexcage.core.units import describe, typeset
from flexcage.geometry.cage import CylindricalCage, HeldElements, Objection, cages_of
from flexcage.geometry.materials import MATERIALS, Material

POCKET_SHAPES = ("cylindrical", "spherical")
GUIDANCE = ("ball", "inner", "outer")
BALL_CAGES = cages_of("ball")


@dataclass(frozen=True, kw_only=True)
class BallCage(CylindricalCage):
    """A cage with one round pocket per ball: a hollow cylinder with radial holes, or spheres.

    ``pocket_diameter`` is that of cylinder or sphere. A cage that a ring guides has its land there,
    with the clearance of [contacts.land]. ``type`` may name another type with a spec of its own.
    """

    cage_type: ClassVar[str] = "machined"
    pockets_vary: ClassVar[bool] = True  # may defects enlarge, elongate or displace pockets?

    type: str = option("machined", doc="kind of cage", choices=BALL_CAGES)
    material: Material = option(MATERIALS["PA66"], doc="cage material (a name or its values)")
    pocket_diameter: float = quantity("mm", doc="diameter of a pocket", above=0.0)
    pocket_shape: str = option("cylindrical", doc="shape of pockets", choices=POCKET_SHAPES)
    pocket_scatter: float = quantity(
        "um", 0.0, doc="standard deviation of pockets' places around the cage", minimum=0.0
    )
    guidance: str = option("ball", doc="what guides the cage radially", choices=GUIDANCE)

    @property
    def pocket_size(self) -> float:
        return self.pocket_diameter

    @property
    def pocket_reach(self) -> float:
        return 0.5 * self.pocket_diameter

    def in_words(self) -> str:
        across = typeset(self.pocket_diameter, "mm")
        shape = f"its pockets are {self.pocket_shape}, {across} across"
        if self.pocket_scatter:
            scatter = typeset(self.pocket_scatter, "um")
            shape += f", unevenly spaced by {scatter} (standard deviation)"
        return shape

    @property
    def has_faces(self) -> bool:
        return False

    @property
    def has_land(self) -> bool:
        return self.guidance != "ball"

    def thinnest(self, pitch_diameter: float, pocket_count: int) -> float:
        web = pitch_diameter * sin(pi / pocket_count) - self.pocket_diameter
        wall, rim = self.outside_diameter - self.bore, self.width - self.pocket_diameter
        return min(0.5 * wall, 0.5 * rim, web)

    def parts(self, pitch_diameter: float, pocket_count: int) -> dict[str, float]:
        where = pitch_diameter if self.pocket_shape == "spherical" else self.bore
        return {
            "webs between pockets": where * sin(pi / pocket_count) - self.pocket_diameter,
            "rims beside the pockets": 0.5 * (self.width - self.pocket_diameter),
            "wall": 0.5 * (self.outside_diameter - self.bore),
        }

    @property
    def wall_end(self) -> float:
        """Sine of the latitude towards the cage's ends at which a spherical pocket's wall ends;
        over 1: it does not."""
        return 2.0

    def wall_ends(self, pitch_radius: float, radius: float) -> tuple[float, float, float, float]:
        """Sines of the latitudes at which the wall of a sphere of ``radius`` [m] ends: outwards,
        inwards, towards +x and -x; over 1 where it does not, and for cylinders. The rims at bore
        and outside are as high as they stand in front of the ball and behind it."""
        if self.pocket_shape != "spherical":
            return 2.0, 2.0, 2.0, 2.0
        radii = (0.5 * self.outside_diameter, 0.5 * self.bore)
        reach = [
            (r**2 - pitch_radius**2 - radius**2) / (2.0 * pitch_radius * radius) for r in radii
        ]
        outward, inward = (s if abs(s) < 1.0 else 2.0 for s in (reach[0], -reach[1]))
        return outward, inward, self.wall_end, self.wall_end

    def impossible(self, pocket_count: int) -> Iterator[Objection]:
        """Dimensions that leave no body: thickness, rims beside pockets, webs at the bore."""
        yield from super().impossible(pocket_count)
        chord = self.bore * sin(pi / pocket_count)  # between the web's middles
        if self.pocket_diameter >= self.width:
            yield "pocket_diameter", f"leaves no rims in a cage {describe(self.width, 'mm')} wide"
        if self.pocket_diameter >= chord and self.pocket_shape != "spherical":
            yield (
                "pocket_diameter",
                f"makes the {pocket_count} webs thinner than zero at the bore; it must be less "
                f"than {describe(chord, 'mm')}",
            )

    def obstructions(self, bearing: HeldElements) -> Iterator[Objection]:
        yield from self._tight(bearing)
        yield from self._low_rim(bearing.pitch_diameter)
        chord = bearing.pitch_diameter * sin(pi / bearing.element_count)
        if self.pocket_diameter >= chord:
            yield (
                "pocket_diameter",
                f"so the {bearing.element_count} pockets run into each other; it must be less than "
                f"{describe(chord, 'mm')}",
            )

    def _tight(self, bearing: HeldElements) -> Iterator[Objection]:
        """Pockets that no ball goes into."""
        if self.pocket_diameter <= bearing.element_diameter:
            size = describe(bearing.element_diameter, "mm")
            yield "pocket_diameter", f"but must be greater than the {bearing.element}'s, {size}"

    def _low_rim(self, pitch_diameter: float) -> Iterator[Objection]:
        """Spheres that end below a ball's middle in front of it and behind."""
        least = hypot(pitch_diameter, self.pocket_diameter)
        if self.pocket_shape == "spherical" and self.outside_diameter <= least:
            yield (
                "outside_diameter",
                "so in front of a ball its pocket ends below the ball's middle; it must be greater "
                f"than {describe(least, 'mm')}",
            )
