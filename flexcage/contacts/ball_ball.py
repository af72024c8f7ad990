"""A ball against the next one, where no cage keeps them apart: Hertz contact and friction.

Both press along the line of their centres, and rub where they touch, at one point of that line: so
force and moment of momentum are kept to rounding.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.slices import friction_factors, normal_forces
from flexcage.core.jit import part
from flexcage.core.vectors import combine, cross, dot, minus, plus, times


class BallBallContact(NamedTuple):
    """What all balls of a bearing share: how they touch each other."""

    cutoff: float  # difference of azimuths [rad] from which on no two of them can touch
    normal: np.ndarray  # (N_NORMAL,)
    friction: np.ndarray  # (N_FRICTION,)


class TwoBalls(NamedTuple):
    """A ball and the next one, in one frame: the second from the first, and the first's motion less
    the second's."""

    radii: tuple[float, float]
    place: tuple[float, float, float]
    velocity: tuple[float, float, float]
    spin: tuple[float, float, float]  # angular velocity of the first
    other_spin: tuple[float, float, float]
    onset: float  # speed at which the contact closed


class BallTouch(NamedTuple):
    """How two balls touch: the line from the first to the second, distances of the contact from
    both centres, how the first slides on the second, and the force on the first and its friction.
    """

    line: tuple[float, float, float]
    arms: tuple[float, float]
    slip: tuple[float, float, float]
    force: tuple[float, float, float]
    friction: tuple[float, float, float]


@part
def rotated(c, s, a):
    """A vector in the frame of an element that is behind by an angle, cosine c and sine s."""
    return a[0], c * a[1] - s * a[2], s * a[1] + c * a[2]


@part
def ball_ball_contact(two, data, laws, sl):
    """The ``BallTouch`` of ``TwoBalls``; penetration and rate in sl.d[0], sl.v[0], and only if they
    touch (sl.d[0] > 0) forces."""
    reach = sqrt(dot(two.place, two.place))
    n, none = times(1.0 / reach, two.place), (0.0, 0.0, 0.0)
    sl.d[0], sl.v[0] = two.radii[0] + two.radii[1] - reach, dot(n, two.velocity)
    arms = two.radii[0] - 0.5 * sl.d[0], two.radii[1] - 0.5 * sl.d[0]
    if sl.d[0] <= 0.0:
        return BallTouch(n, arms, none, none, none)
    normal_forces(laws.normal, (0, 1), sl, data.normal, two.onset)
    turn = combine(times(arms[0], two.spin), arms[1], two.other_spin)
    slip = plus(two.velocity, cross(turn, n))
    slip = combine(slip, -dot(slip, n), n)
    sl.u[0] = sqrt(dot(slip, slip))
    friction_factors(laws.friction, (0, 1), sl, data.friction)
    friction = times(-sl.N[0] * sl.g[0], slip)
    return BallTouch(n, arms, slip, minus(friction, times(sl.N[0], n)), friction)
