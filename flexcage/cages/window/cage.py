"""Window cages: frozen specs, and what follows from their dimensions alone."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import hypot, pi, sin
from typing import ClassVar

from flexcage.cages.window.windowed import WindowedCage
from flexcage.core.spec import option, quantity
from flexcage.core.units import mm, typeset
from flexcage.geometry.cage import CylindricalCage, HeldElements, Objection, cages_of

GUIDANCE = ("roller", "inner", "outer")
ROLLER_CAGES = cages_of("roller")


@dataclass(frozen=True, kw_only=True)
class WindowCage(WindowedCage, CylindricalCage):
    """A machined window cage: a hollow cylinder with one rectangular pocket per roller.

    Pocket walls are planes: the crossbeam faces parallel to the pocket's radial mid-plane at
    +-pocket_width/2, the side-beam faces normal to the bearing axis at +-pocket_length/2.
    """

    cage_type: ClassVar[str] = "window"
    altered: ClassVar[str] = "Deformed"

    type: str = option("window", doc="kind of cage", choices=ROLLER_CAGES)
    pocket_width: float = quantity("mm", doc="circumferential pocket width Cq", above=0.0)
    pocket_length: float = quantity("mm", doc="axial pocket length Cp", above=0.0)
    fillet_radius: float = quantity(
        "mm",
        0.5e-3,
        doc="pocket corner fillet radius",
        above=0.0,
        assumption="not given; a corner as cutters leave it: without one, root stress is singular",
    )
    guidance: str = option("roller", doc="what guides the cage radially", choices=GUIDANCE)

    @property
    def pocket_reach(self) -> float:
        return 0.5 * self.pocket_length

    def thinnest(self, pitch_diameter: float, pocket_count: int) -> float:
        beam = pi * pitch_diameter / pocket_count - self.pocket_width
        return min(self.wall, beam)

    def parts(self, pitch_diameter: float, pocket_count: int) -> dict[str, float]:
        return {
            "crossbeams": self.bore * sin(pi / pocket_count) - self.pocket_width,
            "side beams": self.side_beam_width,
            "wall": self.wall,
        }

    @property
    def side_beam_width(self) -> float:
        return 0.5 * (self.width - self.pocket_length)

    @property
    def half_section(self) -> Sequence[tuple[float, float]]:
        half, low, high = 0.5 * self.width, 0.5 * self.bore, 0.5 * self.outside_diameter
        return [(-half, low), (half, low), (half, high), (-half, high)]

    def rim_width(self, side: float) -> float:
        return self.side_beam_width

    def in_words(self) -> str:
        return (
            f"pockets are {typeset(self.pocket_width, 'mm')} wide and "
            f"{typeset(self.pocket_length, 'mm')} long"
        )

    def impossible(self, pocket_count: int) -> Iterator[Objection]:
        """Dimensions that leave no body: thickness, side beams, crossbeams, fillets."""
        yield from super().impossible(pocket_count)
        chord = self.bore * sin(pi / pocket_count)  # between neighbouring pockets' planes, at bore
        if self.pocket_length >= self.width:
            yield "pocket_length", f"leaves no side beams in a cage {mm(self.width)} wide"
        if self.pocket_width >= chord:
            yield (
                "pocket_width",
                f"makes the {pocket_count} crossbeams thinner than zero at the bore; it must be "
                f"less than {mm(chord)}",
            )
        yield from self.unfit_fillets(0.5 * min(self.pocket_width, self.pocket_length))

    def obstructions(self, bearing: HeldElements) -> Iterator[Objection]:
        for name, size, own, what in (
            ("pocket_width", self.pocket_width, bearing.element_diameter, "diameter"),
            ("pocket_length", self.pocket_length, bearing.element_length, "length"),
        ):
            if size <= own:
                yield (
                    name,
                    f"a clearance of {mm(size - own)}; it must be greater than the "
                    f"{bearing.element}'s {what}, {mm(own)}",
                )
        yield from self._edges_in_fillets(bearing)

    def _edges_in_fillets(self, bearing: HeldElements) -> Iterator[Objection]:
        edge = bearing.element_edge
        aside = self.fillet_radius - edge - 0.5 * (self.pocket_width - bearing.element_diameter)
        along = self.fillet_radius - edge - 0.5 * (self.pocket_length - bearing.element_length)
        depth = hypot(max(aside, 0.0), max(along, 0.0)) + edge - self.fillet_radius
        if depth > 0.0 and min(aside, along) > 0.0:
            yield (
                "fillet_radius",
                f"so that the edges of a {bearing.element} in the middle of its pocket, with a "
                f"radius of {mm(edge)}, lie {mm(depth)} inside the fillets; make it smaller, or "
                "the pockets larger",
            )
