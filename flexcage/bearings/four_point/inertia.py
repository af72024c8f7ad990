"""What rotation does to balls that may touch two arcs of a race.

Two arcs of a race count as one contact: by the mean of their directions, weighted by their forces.
Where a ball touches one arc a race, it moves as under race control (``ball.race_control``). Where
it touches two, it cannot roll on both about the axis of that: its orbit takes the means, and its
axis becomes parallel to the bearing's, which ends the gyroscopic moment, as the lesser outer arc
bears a share ``HELD`` of what the other does. That is an assumption. It holds for two contacts, and
for four alike; in a run of a QJ 208 axes are parallel from a share of 0.2 to 0.4 on, as balls enter
or leave the loaded zone (measured), for lack of anything that turns them. Arrays may be complex, as
in ``ball.race_control``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from flexcage.bearings.ball.race_control import BallMotion

HELD = 0.3  # of the other arc's force: so much and the axis is held parallel
_LEAST = 1e-6  # N, that each arc counts beside its force: of a race that bears none, the mean


@dataclass(frozen=True)
class Arcs:
    """The n arcs of one race: axial places of their centres in their ring, and the springs."""

    places: np.ndarray  # (n,)
    length: float  # of a ball's centre from an arc's where it just touches
    stiffness: float

    @property
    def senses(self) -> np.ndarray:
        """(n,) signs of the contact angle at which each bears; of a single arc 1."""
        return np.array([1.0, -1.0])[: len(self.places)]

    def forces(self, lines: np.ndarray) -> np.ndarray:
        """Forces (n, Z) along lines (n, 2, Z) from one centre to the other."""
        reach = np.sqrt(lines[:, 0] * lines[:, 0] + lines[:, 1] * lines[:, 1])
        depth = np.where(reach.real > self.length, reach - self.length, 0.0)
        force: np.ndarray = self.stiffness * depth * np.sqrt(depth)
        return force

    def mean(self, lines: np.ndarray) -> Mean:
        """Of the directions of contacts along lines (n, 2, Z)."""
        reach = np.sqrt(lines[:, 0] * lines[:, 0] + lines[:, 1] * lines[:, 1])
        sine, cosine = lines[:, 0] / reach, lines[:, 1] / reach
        weight = self.forces(lines) + _LEAST
        weight = weight / weight.sum(axis=0)
        senses = self.senses[:, None]
        return Mean(
            weight, np.stack([-cosine, sine], axis=1), (weight * cosine).sum(axis=0),
            (weight * senses * sine).sum(axis=0), (weight * sine).sum(axis=0), _leaning(weight),
        )  # fmt: skip


class Mean(NamedTuple):
    """Of a race's arcs, weighted by their forces."""

    weight: np.ndarray  # (n, Z)
    across: np.ndarray  # (n, 2, Z) directions in which a gyroscopic moment > 0 loads the ring
    cosine: np.ndarray  # (Z,) of contact angles
    sine: np.ndarray  # (Z,) counted towards the side on which an arc bears
    signed: np.ndarray  # (Z,) sine, with its sign
    sided: np.ndarray  # (Z,) which of both turns a ball's axis, and how far: 1 arc 0, -1 arc 1


def _leaning(weight: np.ndarray) -> np.ndarray:
    """Of forces (n, Z) how far (Z,) the axis leans as on one arc alone, > 0 for arc 0."""
    if len(weight) == 1:
        return np.ones_like(weight[0])
    first = weight[0].real > weight[1].real
    share = np.where(first, weight[1], weight[0]) / np.where(first, weight[0], weight[1])
    lean = np.where(share.real < HELD, 1.0 - share / HELD, 0.0)
    return np.where(first, lean, -lean)


@dataclass(frozen=True)
class Inertia:
    """Centrifugal and gyroscopic forces of balls between both races' arcs."""

    motion: BallMotion
    inner: Arcs
    outer: Arcs

    def means(
        self, inner: np.ndarray, outer: np.ndarray
    ) -> tuple[Mean, Mean, np.ndarray, np.ndarray, np.ndarray]:
        """Means of both races, their directions (cos, sin) (2, Z), and the sign (Z,), between -1
        and 1, of the gyroscopic moment at these."""
        i, o = self.inner.mean(inner), self.outer.mean(outer)
        if len(self.inner.places) == len(self.outer.places) == 2:
            return i, o, np.stack([i.cosine, i.sine]), np.stack([o.cosine, o.sine]), o.sided
        signed = np.stack([i.cosine, i.signed]), np.stack([o.cosine, o.signed])
        return i, o, *signed, np.ones_like(o.cosine)

    def forces(
        self, inner: np.ndarray, outer: np.ndarray, radial: np.ndarray
    ) -> tuple[np.ndarray, np.ndarray]:
        """Forces (2, Z) on balls beside their contacts' normal forces, and the share (n, 2, Z) of
        them that each inner arc exerts, axially and radially [N]; lines (n, 2, Z) of both races'
        contacts, and places ``radial`` (Z,) [m] from the circle of the outer arcs' centres."""
        i, o, at_inner, at_outer, sign = self.means(inner, outer)
        push = self.motion.centrifugal(at_inner, at_outer, radial)
        unit = 2.0 * sign * self.motion.moment(at_inner, at_outer) / self.motion.diameter
        to_inner, to_outer = (share * unit for share in self.motion.gyroscopic)
        ring = to_inner * i.weight[:, None] * i.across
        ball = ring.sum(axis=0) - to_outer * (o.weight[:, None] * o.across).sum(axis=0)
        return ball + np.stack([0.0 * push, push]), ring
