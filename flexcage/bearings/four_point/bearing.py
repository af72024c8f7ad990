"""Ball bearings whose races are two arcs: four-point contact, and split inner rings (three points).

Each half of a ring is ground with a shim between both: without it the centres of its arcs stand the
shim's thickness g apart, that of the arc at +x towards -x. A ball that is pressed straight into
such a race rests on both arcs at the shim angle, sin(alpha_s) = g/(2 r - D). Under axial load one
arc a race carries it, at the contact angle. T. A. Harris, Rolling Bearing Analysis, 2 (split inner
ring); here of both rings.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import acos, asin, cos, nan, pi, sin
from typing import Any, ClassVar

import numpy as np

from flexcage.bearings.ball.bearing import BallBearing
from flexcage.core.spec import quantity
from flexcage.core.units import typeset
from flexcage.geometry.bearing import type_name


@dataclass(frozen=True, kw_only=True)
class FourPointContactBearing(BallBearing):
    """A ball bearing with two arcs a race, which bears axial load both ways; displacements count
    from its middle.

    A ring whose shim is 0 has one arc: with ``outer_shim`` 0 the bearing touches at three points.
    The free contact angle and the radial clearance say the same thing, as in angular contact
    bearings: Pd/2 = r_si + r_se - A cos(alpha), with (r - D/2) cos(alpha_s) for r_s of each ring.
    Shoulders are as high above the bottom of a whole arc.
    """

    kind: ClassVar[str] = "four-point contact ball bearing"
    family: ClassVar[str] = "four_point"

    type: str = type_name("four_point_contact")
    inner_shim: float = quantity(
        "mm", doc="distance of the centres of the inner race's arcs; 0: one arc", minimum=0.0
    )
    outer_shim: float = quantity(
        "mm", doc="distance of the centres of the outer race's arcs; 0: one arc", minimum=0.0
    )
    contact_angle: float | None = quantity(
        "deg", None, doc="free contact angle", above=0.0, maximum=0.499 * pi
    )
    radial_clearance: float | None = quantity(
        "um", None, doc="radial internal clearance Pd, in place of the contact angle"
    )

    @property
    def lengths(self) -> tuple[float, float]:
        """Distances [m] of a ball's centre from the arcs' of inner and outer race where it just
        touches."""
        half = 0.5 * self.ball_diameter
        return self.inner_groove_radius - half, self.outer_groove_radius - half

    @property
    def shims(self) -> tuple[float, float]:
        """Of inner and outer ring [m]."""
        return self.inner_shim, self.outer_shim

    @property
    def shim_angles(self) -> tuple[float, float]:
        """Angles [rad] at which balls rest in inner and outer race; NaN of a shim too thick."""
        inner, outer = (
            asin(0.5 * shim / length) if 0.0 <= 0.5 * shim <= length else nan
            for shim, length in zip(self.shims, self.lengths)
        )
        return inner, outer

    @property
    def _seated(self) -> float:
        """Radial distance [m] of the arcs' centres of both races with a ball resting in both."""
        return sum(length * cos(angle) for length, angle in zip(self.lengths, self.shim_angles))

    @property
    def free_contact_angle(self) -> float:
        if self.contact_angle is not None:
            return self.contact_angle
        return acos(min(max(self.groove_offset[1] / self.groove_distance, 0.0), 1.0))

    @property
    def nominal_contact_angle(self) -> float:
        return self.free_contact_angle

    @property
    def clearance(self) -> float:
        if self.contact_angle is None:
            return self.radial_clearance or 0.0
        return 2.0 * (self._seated - self.groove_distance * cos(self.contact_angle))

    @property
    def axial_clearance(self) -> float:
        """Way [m] of the inner ring from first contact on one side to that on the other."""
        across = self.groove_distance * sin(self.free_contact_angle)
        return 2.0 * across - self.inner_shim - self.outer_shim

    def _as_clearance(self, clearance: float) -> dict[str, Any]:
        return {"contact_angle": None, "radial_clearance": clearance}

    @property
    def groove_offset(self) -> tuple[float, float]:
        return 0.0, self._seated - 0.5 * self.clearance

    def arcs(self, ring: str) -> np.ndarray:
        """Axial places (1 or 2,) [m] of the centres of a ring's arcs from its middle: first of that
        which bears an inner ring pushed towards +x."""
        half = 0.5 * (self.inner_shim if ring == "inner" else -self.outer_shim)
        return np.array([half, -half] if half else [0.0])

    def in_words(self) -> str:
        inner, outer = (typeset(angle, "deg", digits=4) for angle in self.shim_angles)
        return (
            f"{super().in_words()} Balls rest at {inner} in the inner and at {outer} in the outer "
            f"race; the axial clearance is {typeset(self.axial_clearance, 'um', digits=4)}."
        )
