"""Waves and spalls of a conical race under slices of a tapered roller.

Both are measured at right angles to the race, and depend on the azimuth of a slice's centre about
the ring's axis: so does the energy, whose slopes are the forces here, which act on the roller's
axis round the ring.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from flexcage.contacts.evaluation import MOMENT_PSI, MOMENT_R, REPORT
from flexcage.contacts.race import theta_at
from flexcage.contacts.state import add_force_and_moment, add_wrench
from flexcage.contacts.uneven import spall_depth, wave_at
from flexcage.core.jit import outlined, part
from flexcage.core.vectors import combine, cross, dot, row, times


@part
def _on_race(k, pose, side, x, b, theta):
    """How much further slice k presses, whose centre is x from the axis b of a ring that has turned
    by ``theta``; the slope of that over the way round the ring, and the direction of this."""
    distance = sqrt(dot(x, x))
    phi = theta_at(pose, x[1], x[2]) - theta
    rise, slope = wave_at(side.wave, phi)
    sunk, steep = spall_depth(side.spall, phi)
    share = side.spalled[k]
    way = times(1.0 / distance, cross(b, x))
    return side.sign * rise - share * sunk, (side.sign * slope - share * steep) / distance, way


@outlined
def add_unevenness(first, pose, side, line, b, theta, sl):
    """What an uneven race adds to penetrations and their rates; ``line`` is a ``cone.ConeLine``,
    b the ring's axis, ``theta`` its spin angle."""
    for k in range(side.s.shape[0]):
        at = first + np.uint64(k)
        x = combine(line.x0, side.s[k], line.x1)
        deeper, slope, way = _on_race(k, pose, side, x, b, theta)
        sl.d[at] += deeper
        sl.v[at] += slope * dot(way, combine(line.v0, side.s[k], line.v1))


@part
def round_the_ring(k, pose, side, line, b, theta, out):
    """Take from ``out`` (6,), the generator of slice k's normal force, what an uneven race adds to
    its penetration."""
    x = combine(line.x0, side.s[k], line.x1)
    _, slope, way = _on_race(k, pose, side, x, b, theta)
    f = times(-slope, way)
    add_force_and_moment(out, f, cross(times(side.s[k], row(pose.axis, 0)), f))


@outlined
def add_slope_forces(first, pose, side, line, b, theta, sl, pair, mode, sums):
    """Add what an uneven race's slope pushes to the pair's wrench, and its moments about the
    roller's transverse axes to ``sums``."""
    for k in range(side.s.shape[0]):
        at = first + np.uint64(k)
        if sl.N[at] > 0.0:
            x = combine(line.x0, side.s[k], line.x1)
            _, slope, way = _on_race(k, pose, side, x, b, theta)
            on_axis, f = times(side.s[k], row(pose.axis, 0)), times(-sl.N[at] * slope, way)
            add_wrench(pair.wrench, f, on_axis)
            if mode == REPORT:
                moment = cross(on_axis, f)
                sums[MOMENT_R] += dot(moment, row(pose.axis, 1))
                sums[MOMENT_PSI] += dot(moment, row(pose.axis, 2))
