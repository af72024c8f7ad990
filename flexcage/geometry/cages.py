"""Window cages: frozen specs, and what follows from their dimensions alone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi, sin
from typing import Any, ClassVar

from flexcage.core.errors import InputError
from flexcage.core.spec import option, quantity
from flexcage.core.units import describe
from flexcage.geometry.cage import Cage, cages_of

_SHARPEST = 1e-4  # fillet, of the pocket's smaller side; smaller ones are lost in its mesh
GUIDANCE = ("roller", "inner", "outer")
ROLLER_CAGES = cages_of("roller")


@dataclass(frozen=True, kw_only=True)
class WindowCage(Cage):
    """A machined window cage: a hollow cylinder with one rectangular pocket per roller.

    Pocket walls are planes: the crossbeam faces parallel to the pocket's radial mid-plane at
    +-pocket_width/2, the side-beam faces normal to the bearing axis at +-pocket_length/2.
    """

    cage_type: ClassVar[str] = "window"
    altered: ClassVar[str] = "Deformed"

    type: str = option("window", doc="kind of cage", choices=ROLLER_CAGES, former="window")
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
    def fillet(self) -> float:
        return self.fillet_radius

    @property
    def pocket_size(self) -> float:
        return self.pocket_width

    def check_defects(
        self,
        defects: Sequence[Any],
        *,
        pocket_count: int,
        pitch_diameter: float,
        element_diameter: float = 0.0,
    ) -> None:
        from flexcage.geometry.window_defects import check_pocket_sizes

        super().check_defects(defects, pocket_count=pocket_count, pitch_diameter=pitch_diameter)
        check_pocket_sizes(defects, self, pocket_count=pocket_count)

    def thinnest(self, pitch_diameter: float, pocket_count: int) -> float:
        beam = pi * pitch_diameter / pocket_count - self.pocket_width
        return min(0.5 * (self.outside_diameter - self.bore), beam)

    def parts(self, pitch_diameter: float, pocket_count: int) -> dict[str, float]:
        return {
            "crossbeams": self.bore * sin(pi / pocket_count) - self.pocket_width,
            "side beams": self.side_beam_width,
            "wall": 0.5 * (self.outside_diameter - self.bore),
        }

    @property
    def side_beam_width(self) -> float:
        return 0.5 * (self.width - self.pocket_length)


def check_cage(cage: WindowCage, *, pocket_count: int) -> None:
    """Refuse a cage whose dimensions leave no body: thickness, side beams, crossbeams, fillets."""
    chord = cage.bore * sin(pi / pocket_count)  # between neighbouring pockets' planes, at the bore
    half_window = 0.5 * min(cage.pocket_width, cage.pocket_length)
    if cage.outside_diameter <= cage.bore:
        what = f"must exceed its bore, {_mm(cage.bore)}"
        where = "outside_diameter"
    elif cage.pocket_length >= cage.width:
        what = f"leaves no side beams in a cage {_mm(cage.width)} wide"
        where = "pocket_length"
    elif cage.pocket_width >= chord:
        what = (
            f"makes the {pocket_count} crossbeams thinner than zero at the bore; it must be less "
            f"than {_mm(chord)}"
        )
        where = "pocket_width"
    elif cage.fillet_radius >= half_window:
        what = f"is too big; it must be less than half of the pocket's side, {_mm(half_window)}"
        where = "fillet_radius"
    elif cage.fillet_radius < 2.0 * _SHARPEST * half_window:
        what = f"is a sharp corner; it must be at least {_mm(2.0 * _SHARPEST * half_window)}"
        where = "fillet_radius"
    else:
        return
    value = getattr(cage, where)
    raise InputError(f"cage.{where}, {_mm(value)}, {what}.", where=f"cage.{where}", value=value)


def _mm(value: float) -> str:
    return describe(value, "mm")
