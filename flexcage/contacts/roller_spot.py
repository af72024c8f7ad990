"""A pit or a flat of a roller on a race: how far each slice sinks, and what pushes back.

The depth of a slice depends on the angle from the spot's middle to the contact, about the roller's
axis. So does the energy, whose slopes are the forces here: a force along the race at the roller's
axis, and a moment about it. Nothing of it turns a ring about its own axis.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.evaluation import MOMENT_PSI, MOMENT_R, REPORT
from flexcage.contacts.state import AXIS, CENTRE, MOMENT, add_force_and_moment
from flexcage.contacts.uneven import spall_depth
from flexcage.core.jit import part
from flexcage.core.vectors import combine, cross, dot, plus, row, times


class SpotTurn(NamedTuple):
    """How far a slice sinks [m], its slope over the angle [m/rad], and what turns the contact away
    from the spot: the angle over a displacement of the roller's axis there [rad/m], and over a turn
    of the roller."""

    sunk: float
    slope: float
    shift: tuple[float, float, float]
    turn: tuple[float, float, float]


@part
def spot_turn(pose, side, n, b, distance):
    """``SpotTurn`` of a slice with normal ``n`` on the roller, whose axis is at a ``distance`` from
    the ring's axis ``b``; both relative to the ring, a cylinder or a cone."""
    a = row(pose.axis, 0)
    along = -dot(n, a)
    across = combine(times(-1.0, n), -along, a)  # towards the contact
    size = sqrt(dot(across, across))
    angle = np.arctan2(dot(across, row(pose.axis, 2)), dot(across, row(pose.axis, 1)))
    sunk, slope = spall_depth(side.spot, angle - pose.spot[1])
    t = cross(b, n)
    lean = sqrt(dot(t, t))  # cosine of a cone's half angle; 1 of a cylinder
    push = -side.sign * dot(t, cross(a, across)) / (lean * distance * size * size)
    turn = combine(times(-1.0, a), along / (size * size), across)
    return SpotTurn(sunk, slope, times(push, t), turn)


@part
def add_spot_depth(first, pose, side, line, ring_axis, spin, sl):
    """What the roller's spot takes from penetrations and their rates; ``line`` is a
    ``race.RollerAxis``, ``spin`` that of the roller less the ring's."""
    for k in range(side.s.shape[0]):
        if side.spotted[k] > 0.0:
            at = first + np.uint64(k)
            x = combine(line.x0, side.s[k], line.x1)
            n = (sl.n1[at], sl.n2[at], sl.n3[at])
            of = spot_turn(pose, side, n, ring_axis, sqrt(dot(x, x)))
            v = combine(line.v0, side.s[k], line.v1)
            sl.d[at] -= side.spotted[k] * of.sunk
            sl.v[at] -= side.spotted[k] * of.slope * (dot(of.shift, v) + dot(of.turn, spin))


@part
def spot_generator(k, n, pose, side, partner, out):
    """Add to ``out`` (6,), the generator of slice k's normal force, what the spot adds to it."""
    a, b = row(pose.axis, 0), row(partner, AXIS)
    x = combine(row(partner, CENTRE), side.s[k], a)
    x = combine(x, -dot(x, b), b)
    of = spot_turn(pose, side, n, b, sqrt(dot(x, x)))
    slope = side.spotted[k] * of.slope
    lever = plus(cross(times(side.s[k], a), of.shift), of.turn)
    add_force_and_moment(out, times(slope, of.shift), times(slope, lever))


@part
def add_spot_wrench(first, pose, side, partner, sl, pair, mode, sums):
    """Add what the spot's slope pushes to the pair's wrench, and its moments to ``sums``."""
    added = pair.W[0]
    for k in range(side.s.shape[0]):
        at = first + np.uint64(k)
        if side.spotted[k] > 0.0 and sl.N[at] > 0.0:
            for j in range(6):
                added[j] = 0.0
            spot_generator(k, (sl.n1[at], sl.n2[at], sl.n3[at]), pose, side, partner, added)
            for j in range(6):
                pair.wrench[j] += sl.N[at] * added[j]
            if mode == REPORT:
                sums[MOMENT_R] += sl.N[at] * added[MOMENT + 1]
                sums[MOMENT_PSI] += sl.N[at] * added[MOMENT + 2]
