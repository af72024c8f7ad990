"""Slopes of a force between an element and a body, by all that moves either.

A contact gives its wrench W on the element as a function of the element's place D from the body's
origin, of the velocities v = V - V_body - w_body x D and w - w_body, and of the body's modes; minus
the slopes are K and C. In a frame that is held, the body's displacement counts as -D, and its
rotation is a rotation of all else the other way, after which the wrench is turned. The element's
rows are in its frame F, which its orbit turns: what this does is added to the column of the orbit.

Only where the element looks the same however it has turned: its rotation has no column.
"""

from __future__ import annotations

from typing import NamedTuple

from flexcage.core.jit import outlined, part
from flexcage.core.vectors import RIGID, TURN, cross, dot, minus, plus, times, turn_of, xyz


class RelativeMotion(NamedTuple):
    """Motion of an element and of the body that it touches, components in F."""

    lever: tuple[float, float, float]  # D
    velocity: tuple[float, float, float]  # of its centre less that of the body's origin
    body_spin: tuple[float, float, float]
    own_velocity: tuple[float, float, float]
    own_spin: tuple[float, float, float]
    radius: float  # of its orbit


class BodyUnknowns(NamedTuple):
    """The body's unknowns in the border."""

    start: int  # the first
    velocities: int  # so many: translation in space, and rotation
    round: int  # 1: looks the same however it has turned about its first axis
    own_axes: int  # 1: moments are in axes that turn with it
    modes: int  # where its modes begin


@outlined
def add_contact_tangent(i, by, body, moves, K, C, wrench, column, tan):
    """Add a contact's slopes ``K``, ``C`` (6 + n, 6 + n) on element i to the tangent ``tan``.

    ``by``: ``RelativeMotion``; ``body``: ``BodyUnknowns``; ``moves`` (6, 6): translation and
    rotation in F that a unit of each of the body's velocities is; ``wrench`` on the element. ``K``
    is changed; ``column`` (6 + n) is a buffer.
    """
    _at_fixed_velocities(by.body_spin, K, C)
    _columns_of_element(i, by, body, moves, K, C, wrench, column, tan)
    _columns_of_body(i, by, body, moves, K, C, wrench, column, tan)
    for m in range(RIGID, K.shape[0]):
        b = body.modes + m - RIGID
        for k in range(K.shape[0]):
            column[k] = K[k, m]
        _add_to_border(column, b, by, body, moves, (0.0, 0.0, 0.0), tan.Krb[i], tan.Kbb)
        for k in range(K.shape[0]):
            column[k] = C[k, m]
        _add_to_border(column, b, by, body, moves, (0.0, 0.0, 0.0), tan.Crb[i], tan.Cbb)


@part
def _at_fixed_velocities(body_spin, K, C):
    """Make of slopes at the same relative velocity ones at the same velocities of both: where the
    element is displaced, the body's material passes otherwise."""
    for k in range(K.shape[0]):
        passing = cross(body_spin, xyz(C[k]))
        for c in range(3):
            K[k, c] += passing[c]


@outlined
def _columns_of_element(i, by, body, moves, K, C, wrench, column, tan):
    f, m, axial = xyz(wrench), turn_of(wrench), (1.0, 0.0, 0.0)
    for c in range(RIGID):
        for k in range(K.shape[0]):
            column[k] = C[k, c]
        _add_to_element(column, i, c, tan.Crr)
        _add_to_body(column, c, by, body, moves, (0.0, 0.0, 0.0), tan.Cbr[i])
    along, faster = cross(axial, by.own_velocity), cross(axial, by.own_spin)
    for c in range(3):
        step = (1.0 if c == 0 else 0.0, 1.0 if c == 1 else 0.0, 1.0 if c == 2 else 0.0)
        for k in range(K.shape[0]):
            column[k] = K[k, c]
            if c == 2:  # velocities turn with the frame
                column[k] += (dot(xyz(C[k]), along) + dot(turn_of(C[k]), faster)) / by.radius
        _add_to_body(column, c, by, body, moves, cross(step, f), tan.Kbr[i])
        if c == 2:  # and so do the rows
            turned = (*cross(axial, f), *cross(axial, m))
            for k in range(RIGID):
                column[k] += turned[k] / by.radius
        _add_to_element(column, i, c, tan.Krr)


@outlined
def _columns_of_body(i, by, body, moves, K, C, wrench, column, tan):
    f, m = xyz(wrench), turn_of(wrench)
    on_body = plus(m, cross(by.lever, f))  # minus the moment about its origin
    for a in range(body.velocities):
        step, turn = xyz(moves[a]), turn_of(moves[a])
        here = plus(step, cross(turn, by.lever))  # of the body at the element
        for k in range(K.shape[0]):
            column[k] = -dot(xyz(C[k]), here) - dot(turn_of(C[k]), turn)
        b = body.start + a
        _add_to_border(column, b, by, body, moves, (0.0, 0.0, 0.0), tan.Crb[i], tan.Cbb)
        if body.round != 0 and a == TURN:
            continue
        slower, behind = cross(turn, by.velocity), cross(turn, by.own_spin)
        turned = (*cross(turn, f), *cross(turn, m))
        for k in range(K.shape[0]):
            column[k] = -dot(xyz(K[k]), here) - dot(xyz(C[k]), slower) - dot(turn_of(C[k]), behind)
            if k < RIGID:
                column[k] -= turned[k]
        moment_change = times(-1.0, cross(step, f))
        if body.own_axes != 0:
            moment_change = minus(moment_change, cross(turn, on_body))
        _add_to_border(column, b, by, body, moves, moment_change, tan.Krb[i], tan.Kbb)


@part
def _add_to_element(column, i, c, blocks):
    for k in range(RIGID):
        blocks[i, k, c] += column[k]


@part
def _add_to_border(column, b, by, body, moves, moment_change, rb, bb):
    for k in range(RIGID):
        rb[k, b] += column[k]
    _add_to_body(column, b, by, body, moves, moment_change, bb)


@part
def _add_to_body(column, b, by, body, moves, moment_change, M):
    """Add what a column of slopes of the element's wrench is to the body, to column b of M;
    ``moment_change``: the moment that the wrench itself does more as the lever or the axes move."""
    f = xyz(column)
    moment = minus(moment_change, plus(turn_of(column), cross(by.lever, f)))
    for a in range(body.velocities):
        row = moves[a]
        M[body.start + a, b] += dot(turn_of(row), moment) - dot(xyz(row), f)
    for k in range(RIGID, column.shape[0]):
        M[body.modes + k - RIGID, b] += column[k]
