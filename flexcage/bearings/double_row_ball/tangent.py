"""Newton's matrix of a double row ball bearing: that of balls, with the slopes of both rows."""

from __future__ import annotations

from flexcage.bearings.ball.residual import NEIGHBOUR_FORCES, SHARED, set_bodies
from flexcage.bearings.ball.tangent import inertia_slopes, pocket_slopes, race_slopes
from flexcage.bearings.double_row_ball.residual import take_second
from flexcage.contacts.evaluation import TANGENT
from flexcage.contacts.state import set_frame
from flexcage.core.jit import array_from, fields, outlined
from flexcage.system.data import FAMILY_PARTS, INNER_RACE, OUTER_RACE
from flexcage.system.layout import cage_at, of_element
from flexcage.system.ring import inner_of, outer_of


def linearise(t, y, yd, data):
    """Keep dF/dy and dF/dy' at this point; see ``system.newton``."""
    d, law = data[0], data[1]
    at, first = fields(d.places), fields(d.rows).each
    q, u = y[: at.bodies_q], y[at.u : at.bodies_u]
    modes = set_bodies(y, d, TANGENT)
    law[NEIGHBOUR_FORCES](t, y, yd, d, law[:FAMILY_PARTS], fields(d.scratch).out, TANGENT)
    cage = cage_at(0, at)
    for i in range(at.elements):
        qi, ui = q[of_element(i)], u[of_element(i)]
        set_frame(qi[2], fields(d.pose).F)
        onset = fields(d.memory).race[i]
        inner, outer = inner_of(y, d), outer_of(y, d)
        if i < first:
            _slopes(i, qi, ui, inner, fields(d.inner), onset[INNER_RACE], d, law)
            _slopes(i, qi, ui, outer, fields(d.outer), onset[OUTER_RACE], d, law)
        else:
            _slopes(i, qi, ui, inner, fields(d.inner_other), onset[INNER_RACE], d, law)
            _slopes(i, qi, ui, outer, fields(d.outer_other), onset[OUTER_RACE], d, law)
        if i == at.in_cage:
            modes, cage = take_second(y, d)
        if at.cages > 0:
            Rc, Vc = array_from(y, cage.q), array_from(y, cage.u)
            pocket_slopes(i, qi, ui, Rc, Vc, modes, d, law)
        inertia_slopes(i, qi[1], ui, d)
    law[SHARED](t, y, yd, d, law[:FAMILY_PARTS], fields(d.scratch).out, TANGENT)


@outlined
def _slopes(i, qi, ui, ring, groove, onset, d, law):
    """Slopes of ball i on its groove of a ring, compiled once."""
    race_slopes(i, qi, ui, ring, groove, onset, d, law)
