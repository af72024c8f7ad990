"""The lengths of a riveted joint: a rivet with two heads through two sheets."""

from __future__ import annotations

from dataclasses import dataclass

from flexcage.core.errors import InputError
from flexcage.core.units import mm

_BEVEL = 1.25  # of the hole's edge, over the root's radius


@dataclass(frozen=True, kw_only=True)
class JointShape:
    """Lengths [m] of a riveted joint. ``inner`` and ``outer`` (y of the strip's edges) and
    ``length`` (along z) bound the sheets."""

    shank_diameter: float
    head_diameter: float
    head_height: float
    root_radius: float
    thickness: float  # of each sheet
    inner: float
    outer: float
    length: float

    def __post_init__(self) -> None:
        bevel, seat = self.bevel, 0.5 * (self.head_diameter - self.shank_diameter)
        if not bevel < 0.9 * seat:
            raise InputError(
                f"root_radius is {mm(self.root_radius)}, which leaves the head no seat; it must be "
                f"less than {mm(0.9 * seat / _BEVEL)}.",
                where="root_radius",
                value=self.root_radius,
            )
        if not bevel < 0.9 * self.thickness:
            raise InputError(
                f"root_radius is {mm(self.root_radius)}, too much for sheets of "
                f"{mm(self.thickness)}.",
                where="root_radius",
                value=self.root_radius,
            )
        available = min(-self.inner, self.outer, 0.5 * self.length)
        if not 0.5 * self.head_diameter < 0.98 * available:
            raise InputError(
                f"The strip ends {mm(available)} from the rivet's middle, within its head of "
                f"{mm(self.head_diameter)}.",
                where="rivet",
                value=self.head_diameter,
            )

    @property
    def bevel(self) -> float:
        """Bevel of a hole's edge under a head [m]."""
        return _BEVEL * self.root_radius

    @property
    def rim(self) -> float:
        """Radius [m] up to which the mesh is round; beyond, it goes over into the strip."""
        available = min(-self.inner, self.outer, 0.5 * self.length)
        return 0.5 * (0.5 * self.head_diameter + available)
