"""The residual F(t, y, y') = 0 of a double row ball bearing, and its report.

Balls move as in ``ball.residual``, those of either row between grooves of their own, on the same
two rings, in one cage or in one for each row.
"""

from __future__ import annotations

from flexcage.bearings.ball.residual import (
    NEIGHBOUR_FORCES,
    SHARED,
    ball_in_pocket,
    ball_rows,
    modes_of_cage,
    push_on_race,
    set_bodies,
)
from flexcage.contacts.state import set_frame
from flexcage.core.jit import array_from, fields, outlined, part
from flexcage.system.data import FAMILY_PARTS, INNER_RACE, OUTER_RACE
from flexcage.system.floating import take_cage
from flexcage.system.layout import cage_at, of_element
from flexcage.system.ring import inner_of, outer_of


def evaluate(t, y, yd, d, law, out, mode):
    """Residual into ``out``, as ``ball.residual.evaluate``."""
    at, first = fields(d.places), fields(d.rows).each
    q, u, qd, ud = y[: at.bodies_q], y[at.u : at.bodies_u], yd[: at.bodies_q], yd[at.u :]
    r_q, r_u = out[: at.bodies_q], out[at.u :]
    modes = set_bodies(y, d, mode)
    law[NEIGHBOUR_FORCES](t, y, yd, d, law[:FAMILY_PARTS], out, mode)
    cage = cage_at(0, at)
    for i in range(at.elements):
        own = of_element(i)
        qi, ui = q[own], u[own]
        set_frame(qi[2], fields(d.pose).F)
        inner, outer = inner_of(y, d), outer_of(y, d)
        if i < first:
            _in_groove(i, qi, ui, inner, fields(d.inner), INNER_RACE, d, law, mode)
            _in_groove(i, qi, ui, outer, fields(d.outer), OUTER_RACE, d, law, mode)
        else:
            _in_groove(i, qi, ui, inner, fields(d.inner_other), INNER_RACE, d, law, mode)
            _in_groove(i, qi, ui, outer, fields(d.outer_other), OUTER_RACE, d, law, mode)
        if i == at.in_cage:  # each row has a cage
            modes, cage = take_second(y, d)
        if at.cages > 0:
            Rc, Vc = array_from(y, cage.q), array_from(y, cage.u)
            ball_in_pocket(i, qi, ui, Rc, Vc, modes, d, law, mode)
        ball_rows(i, qi, ui, qd[own], ud[own], d, r_q[own], r_u[own], mode)
    law[SHARED](t, y, yd, d, law[:FAMILY_PARTS], out, mode)


@part
def take_second(y, d):
    """The second row's cage as the one under work; its modes and its places."""
    take_cage(1, y, d)
    return modes_of_cage(1, y, d), cage_at(1, fields(d.places))


@outlined
def _in_groove(i, qi, ui, ring, groove, race, d, law, mode):
    """Ball i on its groove of a ring, compiled once."""
    push_on_race(i, qi, ui, ring, groove, race, d, law, mode)
