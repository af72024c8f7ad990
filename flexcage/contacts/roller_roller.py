"""A roller against the next one, where no cage keeps them apart: a line contact, slice by slice.

Slices of both rollers that lie in one plane across the bearing's axis face each other, and press
along the line between the rollers' axes in that plane: so force and moment of momentum are kept to
rounding. Both have the profile of the first there; as ribs leave rollers a tenth of a millimetre
along the axis, that is as good as the second's own.
"""

from __future__ import annotations

from math import sqrt
from typing import NamedTuple

import numpy as np

from flexcage.contacts.slices import friction_factors, normal_forces
from flexcage.contacts.state import add_force_and_moment, add_generator, add_outer, friction_tangent
from flexcage.core.jit import part
from flexcage.core.vectors import combine, cross, dot, minus, plus, times


class RollerRollerContact(NamedTuple):
    """What all rollers of a bearing share: how they touch each other."""

    s: np.ndarray  # (ns,) places of slices along a roller
    drop: np.ndarray  # (ns,) of its profile there
    normal: np.ndarray  # (N_NORMAL,) of one slice
    friction: np.ndarray  # (N_FRICTION,)


class TwoRollers(NamedTuple):
    """A roller and the next one in the first one's frame F: its axis and the other's, the second's
    centre from the first's, and the first's motion; ``velocity`` less the second's."""

    radii: tuple[float, float]
    axis: tuple[float, float, float]
    other_axis: tuple[float, float, float]
    place: tuple[float, float, float]
    velocity: tuple[float, float, float]
    spin: tuple[float, float, float]  # angular velocity of the first
    other_spin: tuple[float, float, float]
    onset: float  # speed at which the contact closed


@part
def _facing(k, two, data):
    """Slice k of the first roller and what it faces: places on both axes from the rollers' centres,
    direction from the first to the second, and how far apart both axes are there."""
    p, b = times(data.s[k], two.axis), two.other_axis
    q = times((p[0] - two.place[0]) / b[0], b)
    line = minus(plus(two.place, q), p)
    reach = sqrt(line[1] * line[1] + line[2] * line[2])
    return p, q, (0.0, line[1] / reach, line[2] / reach), reach


@part
def _levers(k, two, data, sl):
    """Where slice k touches, from both rollers' centres, and the direction to the second roller."""
    p, q, n, _ = _facing(k, two, data)
    less = data.drop[k] + 0.5 * sl.d[k]
    a, b = two.radii
    return plus(p, times(a - less, n)), minus(q, times(b - less, n)), n


@part
def approach_of(two, data, sl):
    """Depths of all slices into sl.d; returns the largest, and the speed at which the rollers'
    middles approach."""
    most = -np.inf
    for k in range(data.s.shape[0]):
        _, _, _, reach = _facing(k, two, data)
        sl.d[k] = two.radii[0] + two.radii[1] - 2.0 * data.drop[k] - reach
        most = max(most, sl.d[k])
    y, z = two.place[1], two.place[2]
    return most, (two.velocity[1] * y + two.velocity[2] * z) / sqrt(y * y + z * z)


@part
def roller_roller_forces(two, data, laws, sl):
    """Normal forces sl.N, sliding (sl.t1 around, sl.t2 along the axis) and friction sl.g of all
    slices, whose depths are known."""
    n_slices = data.s.shape[0]
    for k in range(n_slices):
        a, b, n = _levers(k, two, data, sl)
        v = plus(two.velocity, minus(cross(two.spin, a), cross(two.other_spin, b)))
        sl.v[k] = dot(v, n)
        sl.t1[k], sl.t2[k] = v[2] * n[1] - v[1] * n[2], v[0]
        sl.u[k] = sqrt(sl.t1[k] ** 2 + sl.t2[k] ** 2)
    normal_forces(laws.normal, (0, n_slices), sl, data.normal, two.onset)
    friction_factors(laws.friction, (0, n_slices), sl, data.friction)


@part
def add_to_both(two, data, sl, first, second):
    """Add the slices' forces to the wrenches (6,) on both rollers, about their centres, in F;
    returns the normal force."""
    total = 0.0
    for k in range(data.s.shape[0]):
        if sl.N[k] <= 0.0:
            continue
        a, b, n = _levers(k, two, data, sl)
        rub = -sl.N[k] * sl.g[k]
        around = rub * sl.t1[k]
        f = combine((rub * sl.t2[k], -around * n[2], around * n[1]), -sl.N[k], n)
        back = times(-1.0, f)
        add_force_and_moment(first, f, cross(a, f))
        add_force_and_moment(second, back, cross(b, back))
        total += sl.N[k]
    return total


@part
def slopes_of(two, data, sl, W, K, C):
    """Add the slopes of the wrench on the first roller over its own motion, in F; W (3, 6) is a
    workspace."""
    normal, around, along = W[0], W[1], W[2]
    for k in range(data.s.shape[0]):
        if sl.N[k] <= 0.0:
            continue
        a, _, n = _levers(k, two, data, sl)
        add_generator(n, a, normal)
        add_generator((0.0, -n[2], n[1]), a, around)
        add_generator((1.0, 0.0, 0.0), a, along)
        add_outer(K, sl.Nd[k], normal, normal)
        add_outer(C, sl.Nv[k], normal, normal)
        friction_tangent(C, sl.N[k], sl.g[k], sl.dg[k], sl.u[k], sl.t1[k], sl.t2[k], around, along)
