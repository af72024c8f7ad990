"""Slopes of a groove's wrench on a ball, over the ball's place and the relative velocities.

In the frame of the contact (normal, rolling direction, across it) the wrench depends on depth,
velocities and angular velocities alone; a ball that moves along or across the groove takes that
frame with it. So the slope over its place is that over the depth, and what turning all vectors
does. On an uneven race the depth follows place along and across the groove too; left out is how
these directions change (the curvature of waves and of a spall's edges, a few per cent of the
contact's stiffness).
"""

from __future__ import annotations

from math import sqrt

from flexcage.contacts.evaluation import RESIDUAL
from flexcage.contacts.groove import (
    LEAST_ROLLING,
    gradient_direction,
    groove_contact,
    line_of_contact,
    penetration_gradient,
)
from flexcage.contacts.state import add_generator, clear, friction_tangent
from flexcage.core.jit import part
from flexcage.core.vectors import (
    MOMENT,
    TURN,
    combine,
    cross,
    dot,
    minus,
    plus,
    times,
    turn_of,
    xyz,
)


@part
def groove_tangent(ball, race, laws, sl, pair, sums):
    """Wrench of a raceway on a ball (``BallOnRace``) and its slopes into ``pair``; does it touch?

    ``pair.K``, columns 0 to 2: minus the slope over the ball's place from the ring, with the
    relative velocity at the ball's centre, v - w_ring x P, and both angular velocities as they are;
    ``pair.C``: minus the slope over those relative velocities, linear and angular.
    """
    clear(pair, True)
    if not groove_contact(ball, race, laws, sl, pair.wrench, RESIDUAL, sums):
        return False
    if sl.N[0] <= 0.0:
        return True
    P, b = ball.centre, ball.axis
    e, n, distance, reach = line_of_contact(P, b, race)
    g = cross(b, e)
    normal_share, push, uneven = 1.0, (*n, 0.0, 0.0, 0.0), race.uneven + ball.spotted > 0
    if uneven:
        depth, sl.d[0] = sl.d[0], reach - race.radius + ball.radius
        by, twist = penetration_gradient(ball, race, (e, n, distance, reach), sl)
        normal_share, push, sl.d[0] = by[0], (*gradient_direction(by, n, g), *twist), depth
    N = sl.N[0] * normal_share
    t = cross(n, g)
    spin = minus(ball.spin, ball.ring_spin)
    v = minus(minus(ball.velocity, ball.ring_velocity), cross(ball.ring_spin, P))
    by_load, by_middle = _strips(ball, race, (N, n, g, t), spin, sl, pair)
    by_load = _rolling(race, N, n, spin, by_load, pair.C)
    even = (*n, 0.0, 0.0, 0.0)
    # the normal force follows depth and approach, n.P and n.v; the middle of the contact sinks by
    # half the depth; on an uneven race the effective depth has its own direction
    for k in range(6):
        by_force = normal_share * by_load[k]
        if uneven:
            by_force += normal_share * even[k] - push[k]
        by_depth = sl.Nd[0] * by_force - 0.5 * by_middle[k]
        for c in range(3):
            pair.K[k, c] -= by_depth * push[c]
            pair.C[k, c] -= sl.Nv[0] * by_force * push[c]
        if ball.spotted > 0:
            for c in range(3):
                pair.C[k, TURN + c] -= sl.Nv[0] * by_force * push[TURN + c]
    for c in range(3):  # the frame turns about the ring's axis and about the rolling direction
        _turn(combine(times(g[c] / distance, b), -t[c] / reach, g), v, spin, c, pair)
    return True


@part
def _strips(ball, race, frame, spin, sl, pair):
    """Add the strips' friction to ``pair.C``; slopes of the wrench over load and middle. ``frame``:
    the load, then the directions n, g and t."""
    N, n, g, t = frame
    middle = ball.radius - 0.5 * sl.d[0]
    long = race.long * N ** (1.0 / 3.0)
    along, across = pair.W[0], pair.W[1]
    force, moment = times(-1.0, n), (0.0, 0.0, 0.0)  # over the load
    pulled, turned = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)  # over the middle
    for k in range(race.strip.shape[0]):
        place = race.strip[k] * long
        at = combine(times(middle - 0.5 * race.bend * place * place, n), place, t)
        load, g_k, t1, t2 = N * race.share[k], sl.g[k], sl.t1[k], sl.t2[k]
        add_generator(g, at, along)
        add_generator(t, at, across)
        friction_tangent(pair.C, load, g_k, sl.dg[k], sl.u[k], t1, t2, along, across)
        h = sl.dg[k] / sl.u[k] if sl.u[k] > 1e-12 else 0.0
        pull = times(-race.share[k] * g_k, combine(times(t1, g), t2, t))
        force, moment = plus(force, pull), plus(moment, cross(at, pull))
        pull = times(N, pull)
        law = (load, g_k, h, t1, t2)
        # the ellipse grows by the cube root of the load
        step = times(place / (3.0 * N), combine(t, -race.bend * place, n))
        f, m = _moved(step, at, pull, law, g, t, spin)
        force, moment = plus(force, f), plus(moment, m)
        f, m = _moved(n, at, pull, law, g, t, spin)
        pulled, turned = plus(pulled, f), plus(turned, m)
    return (*force, *moment), (*pulled, *turned)


@part
def _moved(step, at, pull, law, g, t, spin):
    """What a strip's friction ``pull`` and its moment change by where its place moves by
    ``step``: there it slides otherwise."""
    load, g_k, h, t1, t2 = law
    slides = cross(spin, step)
    d1, d2 = dot(slides, g), dot(slides, t)
    bent = h * (t1 * d1 + t2 * d2)
    f = times(-load, combine(times(g_k * d1 + bent * t1, g), g_k * d2 + bent * t2, t))
    return f, plus(cross(at, f), cross(step, pull))


@part
def _rolling(race, N, n, spin, by_load, C):
    """Add the rolling resistance to ``C``; the wrench's slope over the load with it."""
    if race.rolling[0] <= 0.0:
        return by_load
    roll = combine(spin, -dot(spin, n), n)
    speed = sqrt(dot(roll, roll))
    fast = max(speed, LEAST_ROLLING)
    resisting = race.rolling[0] * fast ** race.rolling[1] * N ** race.rolling[2] / fast
    bend = (race.rolling[1] - 1.0) * resisting / (fast * fast) if speed > LEAST_ROLLING else 0.0
    for r in range(3):
        for c in range(3):
            across = (1.0 if r == c else 0.0) - n[r] * n[c]
            C[MOMENT + r, TURN + c] += resisting * across + bend * roll[r] * roll[c]
    f1, f2, f3, m1, m2, m3 = by_load
    m1, m2, m3 = combine((m1, m2, m3), -race.rolling[2] * resisting / N, roll)
    return f1, f2, f3, m1, m2, m3


@part
def _turn(by, v, spin, c, pair):
    """Subtract from column c of ``pair.K`` what turning the frame of the contact by ``by`` does."""
    K, C = pair.K, pair.C
    force, moment = cross(by, xyz(pair.wrench)), cross(by, turn_of(pair.wrench))
    behind, slower = cross(by, v), cross(by, spin)
    for k in range(3):
        K[k, c] -= force[k] + dot(xyz(C[k]), behind) + dot(turn_of(C[k]), slower)
        row = C[MOMENT + k]
        K[MOMENT + k, c] -= moment[k] + dot(xyz(row), behind) + dot(turn_of(row), slower)
