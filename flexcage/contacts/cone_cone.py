"""A tapered roller against the next one, where no cage keeps them apart: a line contact, in slices.

Cones that share an apex touch along lines through it. Slices are spheres on both axes (``cone``),
and those equally far along face each other: they press along the line between their centres, so
that force and moment of momentum are kept to rounding, and forces are slopes of an energy. ``two``
is a ``roller_roller.TwoRollers``, whose radii are not read.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.slices import friction_factors, normal_forces
from flexcage.contacts.state import add_force_and_moment, add_generator, add_outer, friction_tangent
from flexcage.core.jit import part
from flexcage.core.vectors import combine, cross, dot, minus, plus, times


class ConeConeContact(NamedTuple):
    """What all rollers of a bearing share: how they touch each other."""

    s: np.ndarray  # (ns,) places of the slices' spheres along a roller, as in ``cone.ConeSide``
    reach: np.ndarray  # (ns,) their radii, less the profile's drop
    normal: np.ndarray  # (N_NORMAL,) of one slice
    friction: np.ndarray  # (N_FRICTION,)


@part
def _line(k, two, data):
    """Slice k's sphere on the first roller's axis, the direction from it to the second's, and how
    far apart both are."""
    p = times(data.s[k], two.axis)
    line = minus(combine(two.place, data.s[k], two.other_axis), p)
    reach = sqrt(dot(line, line))
    return p, times(1.0 / reach, line), reach


@part
def cone_approach(two, data, sl):
    """Depths of all slices into sl.d; returns the largest, and the speed at which the rollers
    approach at their centres of mass."""
    most = -np.inf
    for k in range(data.s.shape[0]):
        _, _, reach = _line(k, two, data)
        sl.d[k] = 2.0 * data.reach[k] - reach
        most = max(most, sl.d[k])
    return most, dot(two.velocity, two.place) / sqrt(dot(two.place, two.place))


@part
def _at(k, two, data, sl):
    """Where slice k touches, from both rollers' centres; directions to the second roller, along
    the line of contact and across both."""
    p, n, reach = _line(k, two, data)
    a = combine(p, 0.5 * reach, n)
    l = combine(two.axis, -dot(two.axis, n), n)
    l = times(1.0 / sqrt(dot(l, l)), l)
    return a, minus(a, two.place), n, l, cross(n, l)


@part
def cone_cone_forces(two, data, laws, sl):
    """Normal forces sl.N, sliding (sl.t1 along the line, sl.t2 across it) and friction sl.g of all
    slices, whose depths are known."""
    n_slices = data.s.shape[0]
    for k in range(n_slices):
        a, b, n, l, t = _at(k, two, data, sl)
        v = plus(two.velocity, minus(cross(two.spin, a), cross(two.other_spin, b)))
        sl.v[k], sl.t1[k], sl.t2[k] = dot(v, n), dot(v, l), dot(v, t)
        sl.u[k] = sqrt(sl.t1[k] ** 2 + sl.t2[k] ** 2)
    normal_forces(laws.normal, (0, n_slices), sl, data.normal, two.onset)
    friction_factors(laws.friction, (0, n_slices), sl, data.friction)


@part
def add_to_both_cones(two, data, sl, first, second):
    """Add the slices' forces to the wrenches (6,) on both rollers, about their centres, in F;
    returns the normal force."""
    total = 0.0
    for k in range(data.s.shape[0]):
        if sl.N[k] <= 0.0:
            continue
        a, b, n, l, t = _at(k, two, data, sl)
        rub = -sl.N[k] * sl.g[k]
        f = combine(combine(times(-sl.N[k], n), rub * sl.t1[k], l), rub * sl.t2[k], t)
        back = times(-1.0, f)
        add_force_and_moment(first, f, cross(a, f))
        add_force_and_moment(second, back, cross(b, back))
        total += sl.N[k]
    return total


@part
def cone_slopes_of(two, data, sl, W, K, C):
    """Add the slopes of the wrench on the first roller over its own motion, in F; W (3, 6) is a
    workspace. Sliding sl.t1, sl.t2 is found again: it is the same seen from either roller."""
    normal, along, across = W[0], W[1], W[2]
    for k in range(data.s.shape[0]):
        if sl.N[k] <= 0.0:
            continue
        a, b, n, l, t = _at(k, two, data, sl)
        v = plus(two.velocity, minus(cross(two.spin, a), cross(two.other_spin, b)))
        add_generator(n, a, normal)
        add_generator(l, a, along)
        add_generator(t, a, across)
        add_outer(K, sl.Nd[k], normal, normal)
        add_outer(C, sl.Nv[k], normal, normal)
        friction_tangent(
            C, sl.N[k], sl.g[k], sl.dg[k], sl.u[k], dot(v, l), dot(v, t), along, across
        )
