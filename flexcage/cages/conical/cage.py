"""Conical window cages of tapered rollers: frozen specs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from math import pi
from typing import Any, ClassVar

import numpy as np

from flexcage.cages.conical.shape import ConeShaped
from flexcage.core.spec import option, quantity
from flexcage.core.units import typeset
from flexcage.geometry.cage import HeldElements, Objection, cages_of
from flexcage.geometry.materials import MATERIALS, Material

GUIDANCE = ("roller",)
TAPERED_ROLLER_CAGES = cages_of("tapered roller")
STEEPEST = pi / 3.0  # flanks of bars


@dataclass(frozen=True, kw_only=True)
class ConicalCage(ConeShaped):
    """A conical window cage, pressed from sheet or moulded: two rims, and bars along the cone.

    Pocket walls are planes: the ends across the roller's axis, and the bars' faces, which approach
    each other towards the small rim (``pocket_width_large``, ``pocket_width_small``) and, by the
    ``flank_angle``, outwards.
    """

    cage_type: ClassVar[str] = "conical"
    altered: ClassVar[str] = "Deformed"

    type: str = option("conical", doc="kind of cage", choices=TAPERED_ROLLER_CAGES)
    material: Material = option(MATERIALS["steel"], doc="cage material (a name or its values)")
    cone_angle: float = quantity(
        "deg", doc="half angle of the cone, that of the rollers' axes", above=0.0, maximum=0.25 * pi
    )
    pitch_diameter: float = quantity(
        "mm", doc="diameter on which the pockets' middles lie, the rollers' Dpw", above=0.0
    )
    offset: float = quantity(
        "mm", doc="distance of the wall's middle from the rollers' axes; > 0 outwards"
    )
    thickness: float = quantity("mm", doc="thickness of the wall", above=0.0)
    small_rim: float = quantity("mm", doc="width of the small rim, along the wall", above=0.0)
    large_rim: float = quantity("mm", doc="width of the large rim, along the wall", above=0.0)
    pocket_length: float = quantity("mm", doc="pocket length along the roller's axis", above=0.0)
    pocket_width_small: float = quantity(
        "mm", doc="pocket width at its small end, halfway up the bars' faces", above=0.0
    )
    pocket_width_large: float = quantity(
        "mm", doc="pocket width at its large end, halfway up the bars' faces", above=0.0
    )
    flank_angle: float = quantity(
        "deg", 0.0, doc="slope of the bars' faces: pockets narrow outwards where it is > 0",
        minimum=-STEEPEST, maximum=STEEPEST,
    )  # fmt: skip
    fillet_radius: float = quantity(
        "mm",
        0.3e-3,
        doc="pocket corner fillet radius",
        above=0.0,
        assumption="not given; a corner as punches leave it: without one, root stress is singular",
    )
    guidance: str = option("roller", doc="what guides the cage radially", choices=GUIDANCE)

    @property
    def pocket_width(self) -> float:  # type: ignore[override]
        """Width of a pocket [m] halfway along it and halfway up the bars' faces."""
        return 0.5 * (self.pocket_width_small + self.pocket_width_large)

    def large_end(self, n: Any) -> Any:
        return np.full_like(n, -0.5 * self.pocket_length - self.large_rim, dtype=float)

    def from_large_end(self, points: np.ndarray) -> np.ndarray:
        return self.along_crossbeams(points) - self.section.large

    def in_words(self) -> str:
        small, large = (
            typeset(w, "mm") for w in (self.pocket_width_small, self.pocket_width_large)
        )
        return (
            f"it is a cone of {typeset(self.cone_angle, 'deg', digits=4)} with a wall "
            f"{typeset(self.thickness, 'mm')} thick; pockets are {small} to {large} wide and "
            f"{typeset(self.pocket_length, 'mm')} long"
        )

    def obstructions(self, bearing: HeldElements) -> Iterator[Objection]:
        from flexcage.cages.conical.rollers import obstructions

        return obstructions(self, bearing)
