"""Ball against a grooved race: elliptical Hertz contact, traction in strips over the ellipse.

The race is a torus about the ring's axis: groove centres lie on a circle. A ball that is further
from its groove's centre than it would just touch presses along the line from there. Strips of the
ellipse slide at the speed of their own points on the curved surface of contact, so that spin,
differential slip across the groove (Heathcote's) and gyroscopic slip are all one velocity (T. A.
Harris, Rolling Bearing Analysis, 2 and 8). The races control nothing. Waves and a spall of the race
(``contacts.uneven``) change the depth; so the ball is pushed along and across the groove too, at
its centre, as an edge of the spall does. Its traction stays where an even race has it. The spot of
a ball does likewise, and turns it.
"""

from __future__ import annotations

from math import atan2, sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.evaluation import (
    ACROSS,
    ALONG,
    ANGLE,
    APPROACH,
    DAMPED,
    NORMAL,
    REPORT,
    ROLLED,
    RUBBED,
    SLIDING,
    STORED,
)
from flexcage.contacts.laws import EXPONENT
from flexcage.contacts.slices import (
    friction_factors,
    normal_forces,
    stored_and_damped,
)
from flexcage.contacts.state import add_force_and_moment
from flexcage.contacts.uneven import effective_penetration, spotted_penetration
from flexcage.core.jit import VECTORISED, outlined, part, zero
from flexcage.core.vectors import combine, cross, dot, minus, plus, times

LEAST_ROLLING = 1e-3  # rad/s: below it the rolling resistance fades out
LEAST_GRADIENT = 1e-3  # of a ball on the sides of a spall: below it, it nears them as an even race


class Groove(NamedTuple):
    """One raceway: geometry and parameters that all balls share."""

    side: float  # +1 outer, -1 inner
    axial: float  # place of the groove's centre in the ring
    centre: float  # radius of the circle of groove centres
    radius: float  # of the groove's arc
    long: float  # semi-axis of the ellipse at 1 N, across the rolling direction
    bend: float  # curvature of the surface of contact across the rolling direction
    strip: np.ndarray  # (ns,) middles of the strips, in -1..1 of the long axis
    share: np.ndarray  # (ns,) of the load that each bears
    normal: np.ndarray  # (N_NORMAL,)
    friction: np.ndarray  # (N_FRICTION,)
    rolling: np.ndarray  # (3,) moment of rolling resistance: factor, powers of speed and load
    wave: np.ndarray  # (3,) and
    spall: np.ndarray  # (5,) as in ``contacts.uneven``
    sides: np.ndarray  # (2,) angles across the groove between which the spall lies
    reach: float  # half of the ellipse's length over the root of the depth
    spot: np.ndarray  # (4,) of the ball that has one, as in ``uneven.spotted_penetration``
    uneven: int  # 1 if there is a wave or a spall (records hold no booleans)


class BallOnRace(NamedTuple):
    """A ball and the ring that it runs on, all in one frame."""

    radius: float
    centre: tuple[float, float, float]  # the ball's from the ring's
    velocity: tuple[float, float, float]
    spin: tuple[float, float, float]  # angular velocity
    axis: tuple[float, float, float]  # of the ring
    ring_velocity: tuple[float, float, float]
    ring_spin: tuple[float, float, float]
    onset: float  # speed at which the contact closed
    azimuth: float  # of the frame's e_r, from the ring's material
    spotted: int  # 1 if it has a spot, in the direction that follows, of any length
    spot: tuple[float, float, float]


@part
def groove_contact(ball, race, laws, sl, wrench, mode, sums):
    """Wrench on a ball (``BallOnRace``) from one raceway, added to ``wrench``; does it touch?

    From REPORT on ``sums``: normal force, contact angle, traction along the rolling direction and
    across it, sliding speed in the middle, elastic energy, power of damping, friction and rolling
    resistance, and speed of approach; angle and approach also of a ball that does not touch.
    """
    if mode >= REPORT:
        zero(sums)
    P, b = ball.centre, ball.axis
    # a torus: d = reach - (r_groove - r_ball), d' = n . v of the centre over the ring's material
    e, n, distance, reach = line_of_contact(P, b, race)
    spin = minus(ball.spin, ball.ring_spin)
    v = minus(minus(ball.velocity, ball.ring_velocity), cross(ball.ring_spin, P))
    sl.d[0], sl.v[0] = reach - race.radius + ball.radius, dot(n, v)
    gradient, twist, near = (1.0, 0.0, 0.0), (0.0, 0.0, 0.0), sl.v[0]
    uneven = race.uneven + ball.spotted > 0
    if uneven:
        gradient, twist = penetration_gradient(ball, race, (e, n, distance, reach), sl)
        near = sl.v[0] / gradient[0] if gradient[0] > LEAST_GRADIENT else near
    if mode >= REPORT:
        sums[ANGLE] = atan2(race.side * dot(n, b), race.side * dot(n, e))
        sums[APPROACH] = near
    if sl.d[0] <= 0.0:
        return False
    normal_forces(laws.normal, (0, 1), sl, race.normal, ball.onset)
    N = sl.N[0] * gradient[0]
    if mode >= REPORT:
        sums[STORED], sums[DAMPED] = stored_and_damped((0, 1), sl, race.normal[EXPONENT])
    # traction: strips of the ellipse, whose long half axis grows with N^(1/3) (Hertz)
    g = cross(b, e)  # rolling direction, along the race
    t = cross(n, g)
    size = N ** (1.0 / 3.0)
    middle = ball.radius - 0.5 * sl.d[0]
    _strip_sliding(race, race.long * size, middle, n, g, t, v, spin, sl)
    friction_factors(laws.friction, (0, race.strip.shape[0]), sl, race.friction)
    force, moment = _strip_friction(race, race.long * size, middle, N, n, g, t, sl)
    roll = combine(spin, -dot(spin, n), n)
    speed = sqrt(dot(roll, roll))
    resisting = 0.0  # a moment of factor w^p N^q against the rolling velocity w
    if race.rolling[0] > 0.0 and N > 0.0:
        fast = max(speed, LEAST_ROLLING)
        resisting = race.rolling[0] * fast ** race.rolling[1] * N ** race.rolling[2] / fast
    moment = combine(moment, -resisting, roll)
    total = combine(force, -N, n)
    whole = moment
    if uneven:  # minus the slopes of the energy along g and t, and over rotation
        total = combine(total, -sl.N[0], gradient_direction((0.0, gradient[1], gradient[2]), n, g))
        whole = combine(moment, -sl.N[0], twist)
    add_force_and_moment(wrench, total, whole)
    if mode >= REPORT:
        sums[NORMAL], sums[ALONG], sums[ACROSS] = N, dot(force, g), dot(force, t)
        sums[SLIDING] = dot(plus(v, cross(spin, times(middle, n))), g)
        sums[RUBBED] = dot(force, v) + dot(moment, spin) + resisting * speed * speed
        sums[ROLLED] = -resisting * speed * speed
    return True


@outlined
def penetration_gradient(ball, race, line, sl):
    """How the depth on an uneven race, or of a spotted ball, follows the ball's place, along n, g
    and t, and its rotation; the effective depth, and its rate, into sl.d and sl.v. ``line``: what
    ``line_of_contact`` gives."""
    e, n, distance, reach = line
    b, twist = ball.axis, (0.0, 0.0, 0.0)
    by_depth, along, across = 1.0, 0.0, 0.0
    if race.uneven:
        place = atan2(race.side * dot(n, b), race.side * dot(n, e))
        phi = ball.azimuth + atan2(e[2], e[1])
        sl.d[0], by_depth, by_phi, by_place = effective_penetration(race, phi, place, sl.d[0])
        along, across = by_phi / distance, by_place / reach
    if ball.spotted > 0 and dot(ball.spot, n) > 0.0:
        g = cross(b, e)
        t = cross(n, g)
        s = times(1.0 / sqrt(dot(ball.spot, ball.spot)), ball.spot)
        places = ball.radius * dot(s, g), ball.radius * dot(s, t)
        sl.d[0], on, by_x, by_y = spotted_penetration(
            race, race.spot, places[0], places[1], sl.d[0]
        )
        twist = times(ball.radius, combine(times(by_x, cross(s, g)), by_y, cross(s, t)))
        by_depth *= on
        along = on * along - dot(twist, b) / distance  # the contact moves away from the spot
        across = on * across + dot(twist, g) / reach
    gradient, spin = (by_depth, along, across), minus(ball.spin, ball.ring_spin)
    v = minus(minus(ball.velocity, ball.ring_velocity), cross(ball.ring_spin, ball.centre))
    sl.v[0] = dot(gradient_direction(gradient, n, cross(b, e)), v) + dot(twist, spin)
    return gradient, twist


@part
def gradient_direction(gradient, n, g):
    """The direction in which the depth grows, as long as it grows there; t is n x g."""
    return combine(combine(times(gradient[0], n), gradient[1], g), gradient[2], cross(n, g))


@part
def line_of_contact(P, b, race):
    """Radial direction of a ball at P from the ring with axis b, the direction in which it presses,
    and its distances from the ring's axis and the groove's centre."""
    along = dot(P, b)
    radial = combine(P, -along, b)
    distance = sqrt(dot(radial, radial))
    e = times(1.0 / distance, radial)
    line = combine(times(along - race.axial, b), distance - race.centre, e)
    reach = sqrt(dot(line, line))
    return e, times(1.0 / reach, line), distance, reach


@part(fastmath=VECTORISED)
def _strip_sliding(race, long, middle, n, g, t, v, spin, sl):
    """Sliding velocities of the strips, along the rolling direction and across it."""
    for k in range(race.strip.shape[0]):
        across = race.strip[k] * long
        # a point of the curved surface of contact, from the ball's centre: v + spin x r
        at = combine(times(middle - 0.5 * race.bend * across * across, n), across, t)
        slip = plus(v, cross(spin, at))
        sl.t1[k], sl.t2[k] = dot(slip, g), dot(slip, t)
        sl.u[k] = sqrt(sl.t1[k] * sl.t1[k] + sl.t2[k] * sl.t2[k])


@part(fastmath=VECTORISED)
def _strip_friction(race, long, middle, N, n, g, t, sl):
    """Friction force of the strips and its moment about the ball's centre."""
    force = moment = (0.0, 0.0, 0.0)
    for k in range(race.strip.shape[0]):
        across = race.strip[k] * long
        at = combine(times(middle - 0.5 * race.bend * across * across, n), across, t)
        size = -N * race.share[k] * sl.g[k]  # f = -share N (mu/u) slip
        f = combine(times(size * sl.t1[k], g), size * sl.t2[k], t)
        force = plus(force, f)
        moment = plus(moment, cross(at, f))
    return force, moment
