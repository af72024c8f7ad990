"""Tapered roller's spherical end against the large rib, whose face is a cone: one sphere more of
those that ``cone`` has as slices.

Its friction acts at the middle of the spot; the end's turning on its own spot is left out.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.cone import add_sphere_tangent, cone_line
from flexcage.contacts.evaluation import (
    APPROACH,
    DAMPED,
    NORMAL,
    REPORT,
    RUBBED,
    SLIDING,
    STORED,
    TANGENT,
)
from flexcage.contacts.laws import EXPONENT
from flexcage.contacts.slices import (
    friction_factors,
    friction_power,
    normal_forces,
    stored_and_damped,
)
from flexcage.contacts.state import AXIS, add_wrench, clear
from flexcage.core.jit import part, zero
from flexcage.core.vectors import combine, cross, dot, row, times


class EndData(NamedTuple):
    """A roller's spherical end, and the conical face of the rib."""

    place: float  # of the sphere's centre on the roller's axis
    radius: float
    cos: float  # the face's normal, towards the roller, is cos e_D + sin b
    sin: float
    apex: float  # place of the face's apex on the ring's axis
    normal: np.ndarray  # (N_NORMAL,)
    friction: np.ndarray  # (N_FRICTION,)


@part
def end_contact(pose, partner, data, onset, laws, sl, pair, mode, sums):
    """Wrench on the roller from the rib of its ``partner`` (4, 3), closed at the speed ``onset``.

    From REPORT on with ``sums``: normal force, approach speed, sliding round the rib, elastic
    energy, power of damping and of friction; returns whether they touch.
    """
    ring_axis, a = row(partner, AXIS), row(pose.axis, 0)
    line, spin = cone_line(pose, partner)
    s = data.place
    x = combine(line.x0, s, line.x1)
    distance = sqrt(dot(x, x))
    e = times(1.0 / distance, x)
    n = combine(times(data.cos, e), data.sin, ring_axis)
    v = combine(line.v0, s, line.v1)
    along = line.l0 + s * line.l1 - data.apex
    sl.d[0], sl.v[0] = data.radius - data.cos * distance - data.sin * along, -dot(n, v)
    if mode >= REPORT:
        zero(sums)
        sums[APPROACH] = sl.v[0]
    if sl.d[0] <= 0.0:
        return False
    clear(pair, mode == TANGENT)
    t = cross(ring_axis, e)
    l = cross(n, t)
    v = combine(v, -data.radius, cross(spin, n))
    sl.t1[0], sl.t2[0] = dot(v, l), dot(v, t)
    sl.u[0] = sqrt(sl.t1[0] ** 2 + sl.t2[0] ** 2)
    normal_forces(laws.normal, (0, 1), sl, data.normal, onset)
    friction_factors(laws.friction, (0, 1), sl, data.friction)
    f = combine(n, -sl.g[0] * sl.t1[0], l)
    f = times(sl.N[0], combine(f, -sl.g[0] * sl.t2[0], t))
    add_wrench(pair.wrench, f, combine(times(s, a), -data.radius, n))
    if mode == TANGENT:
        add_sphere_tangent(0, (s, data.radius, data.cos / distance), a, (n, l, t), sl, pair)
    elif mode >= REPORT:
        sums[NORMAL], sums[SLIDING], sums[RUBBED] = sl.N[0], sl.t2[0], friction_power((0, 1), sl)
        sums[STORED], sums[DAMPED] = stored_and_damped((0, 1), sl, data.normal[EXPONENT])
    return True
