"""A roller that rolls steadily on its partners, and what it loses there.

Its two speeds, its orbit and its rotation about its own axis, follow from its balance about the
bearing's axis and about its own. Skew is left out (what holds it does no work).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from flexcage.system.statics.losses import Ratio


class Act(NamedTuple):
    """What a partner does to a roller: moments [N m] about the bearing's axis and the roller's, and
    losses [W] of sliding and rolling."""

    about_bearing: float
    about_own: float
    sliding: float
    rolling: float


@dataclass(frozen=True)
class Touch:
    """Where a roller touches a ring, in slices: their radii (n,) [m] about the bearing's axis and
    its own (> 0 inwards), the ring's speed [rad/s], and the law of its rolling resistance (0 where
    none is), by ``middle``, the number of the slice there."""

    ring_radius: np.ndarray
    own_radius: np.ndarray
    ring_speed: float
    rolling: np.ndarray
    middle: int = 0

    def act(self, ratio: Ratio, force: np.ndarray, speeds: np.ndarray, smooth: float = 0.0) -> Act:
        """Under forces (n,) [N] of the slices. ``speeds``: of the roller about its axis, relative
        to its orbit, and of the orbit."""
        from flexcage.contacts.laws import rolling_forces

        turn, orbit = speeds
        own, ring = -turn * self.own_radius, (self.ring_speed - orbit) * self.ring_radius
        slip, resists, k = own - ring, np.zeros(1), self.middle
        traction = -force * ratio(np.abs(slip), smooth) * slip
        passing = own[k] + ring[k]
        if self.rolling[0] > 0.0:
            load = np.array([force.sum()])
            rolling_forces(1, self.rolling, np.array([0.5 * passing]), load, resists)
        R = float(resists[0])
        return Act(
            float(traction @ self.ring_radius) + R * float(self.ring_radius[k]),
            R * float(self.own_radius[k]) - float(traction @ self.own_radius),
            -float(traction @ slip),
            R * float(passing),
        )


@dataclass(frozen=True)
class RollingRoller:
    """A roller on its partners, inner race first, under the ``forces`` of their slices [N].
    ``pitch`` [m]: radius of its orbit; ``drag`` [N s^2/m^2] of the oil."""

    touches: tuple[Touch, ...]
    forces: tuple[np.ndarray, ...]
    ratios: tuple[Ratio, ...]
    pitch: float
    drag: float

    def acts(self, speeds: np.ndarray, smooth: float = 0.0) -> list[Act]:
        parts = zip(self.touches, self.ratios, self.forces)
        return [touch.act(ratio, force, speeds, smooth) for touch, ratio, force in parts]

    def unbalance(self, speeds: np.ndarray, smooth: float = 0.0) -> np.ndarray:
        """Moments about both axes (2,) over what friction of 1 would give."""
        acts, v = self.acts(speeds, smooth), self.pitch * speeds[1]
        scale, inner = max(float(f.sum()) for f in self.forces), self.touches[0]
        about_bearing = sum(a.about_bearing for a in acts) - self.drag * abs(v) * v * self.pitch
        about_own = sum(a.about_own for a in acts)
        own = float(inner.own_radius[inner.middle])
        return np.array([about_own / (scale * own), about_bearing / (scale * self.pitch)])
