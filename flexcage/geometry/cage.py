"""What all cages share: their body of revolution, what guides them, and their unbalance."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import nan, pi
from typing import TYPE_CHECKING, Any, ClassVar

from flexcage.core.spec import option, quantity
from flexcage.geometry.materials import MATERIALS, Material


@dataclass(frozen=True, kw_only=True)
class Cage:
    """A cage of some type; ``cage_spec`` of a bearing's type says which."""

    cage_type: ClassVar[str] = ""  # name of its ``cages.cage_type.CageType``

    material: Material = option(MATERIALS["brass"], doc="cage material (a name or its values)")
    bore: float = quantity("mm", doc="inside diameter", above=0.0)
    outside_diameter: float = quantity("mm", doc="outside diameter", above=0.0)
    width: float = quantity("mm", doc="axial width", above=0.0)
    guidance: str = option("", doc="what guides the cage radially")
    unbalance: float = quantity("g*mm", 0.0, doc="mass-radius product of an unbalance", minimum=0.0)
    unbalance_phase: float = quantity("deg", 0.0, doc="azimuth of the unbalance from pocket 0")

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

    @property
    def axial_width(self) -> float:
        """What it takes up along the axis [m]."""
        return self.width

    @property
    def most_unbalance(self) -> float:
        """Unbalance [kg m] of half of its body of revolution, taken as solid: more cannot be."""
        wall = pi / 4.0 * (self.outside_diameter**2 - self.bore**2)
        return 0.5 * self.material.density * wall * self.axial_width * self.mean_radius

    if TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:  # dimensions of its own type
            ...

    def thinnest(self, pitch_diameter: float, pocket_count: int) -> float:
        """Least thickness [m] of wall and webs, for which elements must not be too large."""
        raise NotImplementedError

    def parts(self, pitch_diameter: float, pocket_count: int) -> dict[str, float]:
        """Least thickness [m] of its parts, by name; none where its type does not say."""
        return {}

    def check_defects(
        self,
        defects: Sequence[Any],
        *,
        pocket_count: int,
        pitch_diameter: float,
        element_diameter: float = 0.0,
    ) -> None:
        """Raise InputError for defects that a sound cage of these dimensions cannot have, in a
        bearing whose elements have this pitch circle [m] and diameter [m] (0: any)."""
        from flexcage.geometry.defect import check_each

        check_each(defects, self, pocket_count)

    def uneven_pockets(self, pocket_count: int, seed: int) -> tuple[Any, ...]:
        """Defects that make its pockets' spacing uneven, drawn at random; none if it is even."""
        return ()
