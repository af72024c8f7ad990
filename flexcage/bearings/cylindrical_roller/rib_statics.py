"""Axial load through rollers that stand between a rib of the inner and one of the outer ring.

Without friction both ribs press a roller equally hard. Each bears on its end at half of their
overlap, as in a run; the inner ring's rib lower than the outer's, and the couple of both tilts the
roller until its slices on the races hold it. The roller's place along the axis is where both
contacts, in series, leave it, and no unknown. A rib is as stiff as in a run.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from flexcage.bearings.cylindrical_roller import designs, ribs
from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.system.statics.elements import Response


@dataclass(frozen=True)
class RibPairs:
    """Pairs of ribs that carry axial load. ``ways``: towards +x (1) and -x (-1), as there are."""

    ways: tuple[int, ...]
    play: float  # m, the inner ring's to one side
    stiffness: float  # N/m, of the two contacts in series
    ring: np.ndarray  # (3,) how v moves the inner ring's rib along the axis there
    own: np.ndarray  # (2,) and how w moves a roller's two ends against each other

    def depths(self, v: np.ndarray, w: np.ndarray) -> np.ndarray:
        """How far (ways, Z) both ribs of a pair are pressed in together [m]."""
        moved = v @ self.ring + w @ self.own
        return np.stack([np.maximum(way * moved - self.play, 0.0) for way in self.ways])

    def forces(self, v: np.ndarray, w: np.ndarray) -> np.ndarray:
        """Axial forces (Z,) [N] that the rollers carry from the inner to the outer ring."""
        return self.stiffness * (np.array(self.ways) @ self.depths(v, w))

    def add(self, v: np.ndarray, w: np.ndarray, r: Response) -> Response:
        """A response of races with that of the ribs added."""
        depth, force = self.depths(v, w), self.forces(v, w)[:, None]
        slope = self.stiffness * (depth > 0.0).sum(axis=0)[:, None, None]
        ring, own = self.ring, self.own
        return Response(
            energy=r.energy + 0.5 * self.stiffness * (depth**2).sum(axis=0),
            ring=r.ring + force * ring,
            unbalance=r.unbalance + force * own,
            ring_v=r.ring_v + slope * np.outer(ring, ring),
            ring_w=r.ring_w + slope * np.outer(ring, own),
            unbalance_v=r.unbalance_v + slope * np.outer(own, ring),
            unbalance_w=r.unbalance_w + slope * np.outer(own, own),
        )


def rib_pairs(b: RollerBearing, stiffness: float) -> RibPairs | None:
    """Pairs of a bearing whose ribs are of a ``stiffness`` [N/m] each; None if none carries."""
    ways = tuple(way for way, there in zip((1, -1), b.carried) if there)
    if not ways:
        return None
    inner, outer = (ribs.rib_height(b, ring) for ring in designs.RINGS)
    return RibPairs(
        ways=ways,
        play=ribs.axial_clearance(b),
        stiffness=0.5 * stiffness,
        ring=np.array([1.0, 0.0, -(b.pitch_radius + inner)]),
        own=np.array([0.0, 2.0 / b.effective_length * (inner - outer)]),
    )
