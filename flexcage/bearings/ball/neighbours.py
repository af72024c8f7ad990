"""Every ball and the next one: do they touch, and how; forces, report and tangent.

A difference of two azimuths tells that they do not, which costs nothing beside the rest. What the
tangent leaves out is how one ball of a pair follows the other: Newton's matrix has no place for it,
so that implicit steps are short while two balls are pressed together.
"""

from __future__ import annotations

from math import asin, cos, pi, sin
from typing import TYPE_CHECKING

import numpy as np

from flexcage.contacts import laws as contact_laws
from flexcage.contacts.ball_ball import BallBallContact, TwoBalls, ball_ball_contact, rotated
from flexcage.contacts.evaluation import RACE_LAW, RACE_RUBS, REPORT, TANGENT
from flexcage.contacts.laws import EXPONENT
from flexcage.contacts.slices import Laws, stored_and_damped
from flexcage.contacts.state import (
    add_force_and_moment,
    add_generator,
    add_outer,
    friction_tangent,
)
from flexcage.core.jit import fields, outlined, part
from flexcage.core.vectors import cross, dot, minus, times, turn_of, xyz
from flexcage.geometry.hertz import PointContact
from flexcage.system.data import IN_CONTACTS, NEIGHBOUR_DAMPING, NEIGHBOUR_FRICTION, POCKET
from flexcage.system.layout import of_element

if TYPE_CHECKING:
    from flexcage.bearings.ball.bearing import BallBearing
    from flexcage.contacts.spec import Contacts

_INWARDS = 0.05  # of the pitch radius: no ball comes nearer to the axis
_NEAR = 1.05  # balls so many diameters apart or nearer are looked at
_POINT = 1.5  # exponent of a Hertz contact


def ball_ball_data(bearing: BallBearing, contacts: Contacts, radius: np.ndarray) -> BallBallContact:
    """How balls of these radii (Z,) [m] touch each other, by the laws of the races."""
    half = 0.25 * bearing.ball_diameter  # of two equal spheres
    two = PointContact(
        rolling=half, transverse=half, modulus=bearing.rolling_material.plane_strain_modulus
    )
    inner_radius = 0.5 * bearing.pitch_diameter * (1.0 - _INWARDS)
    return BallBallContact(
        cutoff=2.0 * asin(min(_NEAR * float(radius.max()) / inner_radius, 1.0)),
        normal=contact_laws.normal_parameters(contacts.race.normal, two.stiffness, _POINT),
        friction=contact_laws.friction_parameters(contacts.race.friction),
    )


def touch_neighbours(t, y, yd, d, law, out, mode):
    """Forces of balls on their neighbours into ``Scratch.wrenches``; in mode TANGENT their slopes,
    each over the own ball's motion.

    Compiled separately, so that the code of all other contacts stays as it is, to the bit.
    """
    at, cutoff = fields(d.places), fields(d.neighbours).cutoff
    Z, q, u = at.elements, y[: at.bodies_q], y[at.u : at.bodies_u]
    for i in range(Z):
        j = i + 1 if i + 1 < Z else 0
        ahead = ahead_of(i, j, q)
        if ahead < cutoff:
            if mode == TANGENT:
                add_slopes(i, j, ahead, q, u, d, law)
            else:
                press(i, j, ahead, q, u, d, law, mode)
        elif mode >= REPORT:
            fields(d.report).approach[i, next_ball(fields(d.report))] = 0.0


@part
def next_ball(rep):
    """Place of a ball's contact with the next one, behind that with its pocket, if it has one."""
    return POCKET + rep.pocket_normal.shape[1]


@part
def ahead_of(i, j, q):
    """How far ball j is ahead of ball i [rad]; ball 0 is next to the last one."""
    ahead = q[of_element(j)][2] - q[of_element(i)][2]
    return ahead if j > i else ahead + 2.0 * pi


@part
def _pair(i, j, ahead, q, u, d):
    """Balls i and j in the frame of i."""
    radius, onset = fields(d.bodies).radius, fields(d.memory).rib[i, 0]
    qi, qj, ui, uj = q[of_element(i)], q[of_element(j)], u[of_element(i)], u[of_element(j)]
    c, s = cos(ahead), sin(ahead)
    place = minus(rotated(c, s, (qj[0], qj[1], 0.0)), (qi[0], qi[1], 0.0))
    velocity = minus(xyz(ui), rotated(c, s, xyz(uj)))
    return TwoBalls(
        (radius[i], radius[j]), place, velocity, turn_of(ui), rotated(c, s, turn_of(uj)), onset
    )


@outlined
def press(i, j, ahead, q, u, d, law, mode):
    """Balls i and j, which are near each other."""
    work, sl = fields(d.scratch), fields(d.slices).row[0]
    data, rep = fields(d.neighbours), fields(d.report)
    two = _pair(i, j, ahead, q, u, d)
    touch = ball_ball_contact(two, data, Laws(law[RACE_LAW], law[RACE_RUBS]), sl)
    if mode >= REPORT:
        rep.approach[i, next_ball(rep)] = sl.v[0]
    if sl.d[0] <= 0.0:
        return
    arms, c, s = touch.arms, cos(ahead), sin(ahead)
    moment = cross(touch.line, touch.friction)
    back = rotated(c, -s, times(-1.0, touch.force))
    add_force_and_moment(work.wrenches[i], touch.force, times(arms[0], moment))
    add_force_and_moment(work.wrenches[j], back, rotated(c, -s, times(arms[1], moment)))
    if mode >= REPORT:
        energy, damped = stored_and_damped((0, 1), sl, data.normal[EXPONENT])
        rep.rib[i, 0] = sl.N[0]
        rep.contact[i, next_ball(rep)] = 1 if sl.N[0] > 0.0 else 0
        rep.energy[IN_CONTACTS] += energy
        rep.power[NEIGHBOUR_DAMPING] += damped
        rep.power[NEIGHBOUR_FRICTION] += dot(touch.friction, touch.slip)


@outlined
def add_slopes(i, j, ahead, q, u, d, law):
    """Those of balls i and j, which are near each other."""
    sl, pair, tan = fields(d.slices).row[0], fields(d.pair), fields(d.tangent)
    two = _pair(i, j, ahead, q, u, d)
    touch = ball_ball_contact(two, fields(d.neighbours), Laws(law[RACE_LAW], law[RACE_RUBS]), sl)
    if sl.d[0] <= 0.0:
        return
    c, s, arms = cos(ahead), sin(ahead), touch.arms
    line, slip = touch.line, touch.slip
    _own_slopes(line, slip, arms[0], sl, pair, tan.Krr[i], tan.Crr[i])
    line, slip = rotated(c, -s, times(-1.0, line)), rotated(c, -s, times(-1.0, slip))
    _own_slopes(line, slip, arms[1], sl, pair, tan.Krr[j], tan.Crr[j])


@part
def _own_slopes(line, slip, arm, sl, pair, K, C):
    """Add those of one ball, whose neighbour lies in the direction ``line``."""
    normal, along, across = pair.W[0], pair.W[1], pair.W[2]
    first = cross((1.0, 0.0, 0.0), line)
    first = times(1.0 / np.sqrt(dot(first, first)), first)
    second, at = cross(line, first), times(arm, line)
    add_generator(line, (0.0, 0.0, 0.0), normal)
    add_generator(first, at, along)
    add_generator(second, at, across)
    add_outer(K, sl.Nd[0], normal, normal)
    add_outer(C, sl.Nv[0], normal, normal)
    t1, t2 = dot(slip, first), dot(slip, second)
    friction_tangent(C, sl.N[0], sl.g[0], sl.dg[0], sl.u[0], t1, t2, along, across)
