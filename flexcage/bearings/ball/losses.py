"""Losses of balls in the static solution: spin, differential slip, rolling resistance and drag.

A ball's four speeds, its orbit and its rotation about x, e_r and e_psi, follow from its balance:
forces along its path, and moments with the gyroscopic one. Tractions are those of a run
(``contacts.groove``): strips over the ellipse on the curved surface of contact.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from math import cos, nan, pi, sin
from typing import Any

import numpy as np

from flexcage.bearings.ball.bearing import BallBearing
from flexcage.contacts.spec import Contacts, Lubricant
from flexcage.core.errors import RunFailed
from flexcage.system.statics.losses import (
    Losses,
    Ratio,
    friction_over_speed,
    settled_speeds,
    summed,
)
from flexcage.system.statics.state import StaticState

_SIDES = (-1.0, 1.0)  # of inner and outer race, outwards
Touch = tuple[int, float, float]  # race (0: inner), force [N] and contact angle [rad]


@dataclass(frozen=True)
class _Contact:
    """A ball on one arc of a race (0: inner): its force, and strips. In F = (e_x, e_r, e_psi)."""

    race: int
    force: float
    normal: np.ndarray  # (3,) from the ball through the contact
    across: np.ndarray  # (3,) along the long axis
    points: np.ndarray  # (n, 3) strips' middles, from the ball's centre
    share: np.ndarray  # (n,)
    rolling: np.ndarray  # (3,) factor and powers
    ring_speed: float

    def act(
        self, ratio: Ratio, turn: np.ndarray, relative: float, smooth: float
    ) -> tuple[float, np.ndarray, float, float]:
        """Force along e_psi, moment (3,) on the ball, and losses [W] of sliding and rolling.

        ``turn`` (3,): the ball's angular velocity from the ring's; ``relative``: its centre's speed
        along e_psi from the ring's material there; ``smooth``: of the friction law.
        """
        slip = np.cross(turn, self.points)
        slip[:, 2] += relative
        along, over = slip[:, 2], slip @ self.across
        size = -self.force * self.share * ratio(np.hypot(along, over), smooth)
        forces = np.outer(size * over, self.across)
        forces[:, 2] += size * along
        moment = np.cross(self.points, forces).sum(axis=0)
        slid = -float(forces[:, 2].sum() * relative + moment @ turn)
        roll = turn - (turn @ self.normal) * self.normal
        fast = float(np.linalg.norm(roll))
        factor, by_speed, by_load = self.rolling
        resisting = factor * fast ** (by_speed - 1.0) * self.force**by_load if fast > 0.0 else 0.0
        return (
            float(forces[:, 2].sum()), moment - resisting * roll, slid, resisting * fast * fast
        )  # fmt: skip


@dataclass(frozen=True)
class _Ball:
    """A ball between both races: what acts on it at given speeds."""

    contacts: tuple[_Contact, ...]
    radius: float  # of its orbit
    inertia: float
    drag: float  # over speed squared
    ratio: Ratio

    def acts(
        self, speeds: np.ndarray, smooth: float = 0.0
    ) -> list[tuple[float, np.ndarray, float, float]]:
        turn, orbit = speeds[:3], speeds[3]
        return [
            c.act(self.ratio, turn - np.array([c.ring_speed, 0.0, 0.0]),
                  self.radius * (orbit - c.ring_speed), smooth)
            for c in self.contacts
        ]  # fmt: skip

    def unbalance(self, speeds: np.ndarray, smooth: float = 0.0) -> np.ndarray:
        """Moments and force (4,) over what friction of 1 would give."""
        acts = self.acts(speeds, smooth)
        force, moment = sum(a[0] for a in acts), sum(a[1] for a in acts)
        turn, orbit = speeds[:3], speeds[3]
        gyroscopic = self.inertia * orbit * np.array([0.0, turn[2], -turn[1]])
        v = self.radius * orbit
        scale = max(c.force for c in self.contacts)
        arm = float(np.linalg.norm(self.contacts[-1].points[0]))
        moments = (moment + gyroscopic) / (scale * arm)
        return np.array([*moments, (force - self.drag * abs(v) * v) / scale])

    def torque(self, speeds: np.ndarray) -> float:
        """Torque [N m] that the ball takes from the inner ring."""
        own = [a for a, c in zip(self.acts(speeds), self.contacts) if c.race == 0]
        return sum(self.radius * a[0] + float(a[1][0]) for a in own)

    def lost(self, speeds: np.ndarray) -> np.ndarray:
        """Losses [W] of sliding and of rolling (2, 2) on inner and outer race."""
        lost = np.zeros((2, 2))
        for act, contact in zip(self.acts(speeds), self.contacts):
            lost[:, contact.race] += act[2:]
        return lost


def on_races(bearing: Any, solution: StaticState, k: int) -> list[Touch]:
    """Where ball ``k`` touches races of one arc."""
    e = solution.elements
    return [(race, float(e.force[k, race]), float(e.angle[k, race])) for race in (0, 1)]


def ball_losses(
    bearing: BallBearing, solution: StaticState, *, contacts: Contacts, lubricant: Lubricant,
    touches: Callable[[Any, StaticState, int], list[Touch]] = on_races, orbit: float = nan,
) -> Losses:  # fmt: skip
    """Losses of a ball bearing's static solution, whose rings may be of another temperature's;
    ``touches`` says where a ball bears, ``orbit`` [rad/s] how fast balls go round if none does."""
    e, speed = solution.elements, solution.speed
    ratio = friction_over_speed(contacts.race.friction)
    drag = 0.5 * lubricant.density * lubricant.oil_fraction * lubricant.drag_coefficient
    drag *= 0.25 * pi * bearing.ball_diameter**2
    loaded = np.flatnonzero((e.force > 0.0).all(axis=1))
    sliding, rolling, torque, dragged = np.zeros(2), np.zeros(2), 0.0, 0.0
    found = []
    for k in loaded:
        at = touches(bearing, solution, int(k))
        sides = _contacts(bearing, solution, at, contacts, lubricant)
        radius = _orbit_radius(bearing, solution, int(k))
        ball = _Ball(sides, radius, bearing.ball_inertia, drag, ratio)
        first = _rolling(bearing, solution, int(k), ball.radius)
        speeds = _settled(ball, first, abs(speed))
        lost = ball.lost(speeds)
        sliding += lost[0]
        rolling += lost[1]
        torque += ball.torque(speeds)
        dragged += drag * abs(ball.radius * speeds[3]) ** 3
        found.append((speeds[3], np.linalg.norm(speeds[:3])))
    if found:
        orbit, _ = np.mean(found, axis=0)
    else:
        turn = abs(orbit) * bearing.pitch_diameter / bearing.ball_diameter
        found.append((orbit, np.float64(turn)))
    for k in np.setdiff1d(np.arange(len(e.force)), loaded):
        rolled, in_oil = _unloaded(bearing, float(e.force[k, 1]), orbit, lubricant, drag)
        rolling[1] += rolled
        dragged += in_oil
        torque += (rolled + in_oil) / speed
    return summed({"drag": dragged}, sliding, rolling, drive=torque, speeds=np.array(found))


def _contacts(
    bearing: BallBearing, solution: StaticState, touches: list[Touch], contacts: Contacts,
    lubricant: Lubricant,
) -> tuple[_Contact, ...]:  # fmt: skip
    from flexcage.bearings.ball.model import groove_of  # its kernels take seconds to load

    sides, radius = [], 0.5 * bearing.ball_diameter
    for race, force, angle in touches:
        groove, side = groove_of(bearing, contacts, lubricant, inner=race == 0), _SIDES[race]
        normal = side * np.array([sin(angle), cos(angle), 0.0])
        across = side * np.array([cos(angle), -sin(angle), 0.0])
        depth = (force / bearing.contacts[race].stiffness) ** (2.0 / 3.0)
        s = groove.strip * groove.long * force ** (1.0 / 3.0)
        height = radius - 0.5 * depth - 0.5 * groove.bend * s * s
        sides.append(_Contact(
            race, force, normal, across, np.outer(height, normal) + np.outer(s, across),
            groove.share, groove.rolling, 0.0 if race else solution.speed,
        ))  # fmt: skip
    return tuple(sides)


def _orbit_radius(bearing: BallBearing, solution: StaticState, k: int) -> float:
    """Radius [m] on which a ball's centre orbits: where it is pressed into the outer groove."""
    e, contact = solution.elements, bearing.contacts[1]
    depth = (float(e.force[k, 1]) / contact.stiffness) ** (2.0 / 3.0)
    reach = bearing.outer_groove_radius - 0.5 * bearing.ball_diameter + depth
    return float(bearing.outer_groove_centre[1] + reach * cos(float(e.angle[k, 1])))


def _rolling(bearing: BallBearing, solution: StaticState, k: int, radius: float) -> np.ndarray:
    """First guess of a ball's speeds (4,): both contacts roll in the mean, about an axis halfway
    between them."""
    e, half = solution.elements, 0.5 * bearing.ball_diameter
    inner, outer = e.angle[k]
    axis = 0.5 * (inner + outer)
    orbit = float(e.orbital_speed[k])
    on_outer = -radius * orbit / half
    on_inner = (radius * orbit - solution.speed * (radius - half * cos(inner))) / half
    spin = 0.5 * (on_outer + on_inner)
    return np.array([spin * cos(axis), -spin * sin(axis), 0.0, orbit])


def _settled(ball: _Ball, first: np.ndarray, size: float) -> np.ndarray:
    """Steady speeds (4,) of a ball, sought from ``first``; of one that is pressed too lightly to be
    turned across the bearing's axis, from rolling on both races about that axis."""
    try:
        return settled_speeds(ball.unbalance, first, size)
    except RunFailed:
        inner, outer = (abs(float(c.points[:, 1].mean())) for c in ball.contacts)
        surface = ball.contacts[0].ring_speed * (ball.radius - inner)
        turn = surface / (inner + outer)
        about = np.array([-turn, 0.0, 0.0, turn * outer / ball.radius])
        return settled_speeds(ball.unbalance, about, size)


def _unloaded(
    bearing: BallBearing, force: float, orbit: float, lubricant: Lubricant, drag: float
) -> tuple[float, float]:
    """Losses [W] of a ball that its centrifugal force alone presses outwards: rolling, and drag."""
    from flexcage.contacts.laws import point_rolling_resistance

    radius = 0.5 * bearing.pitch_diameter
    factor, by_speed, by_load = point_rolling_resistance(lubricant, bearing.contacts[1])
    turn = abs(orbit) * radius / (0.5 * bearing.ball_diameter)
    rolled = factor * turn ** (by_speed + 1.0) * force**by_load if force > 0.0 else 0.0
    return float(rolled), float(drag * abs(radius * orbit) ** 3)
