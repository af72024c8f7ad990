"""The residual F(t, y, y') = 0 of a four-point contact bearing, and its report.

Balls move as in ``ball.residual``, between two arcs a race: each is a groove of its own, with its
friction. What the report says of a race is that of its arc that bears most; its power and energy
are of both.
"""

from __future__ import annotations

from flexcage.bearings.ball.residual import (
    NEIGHBOUR_FORCES,
    SHARED,
    ball_in_pocket,
    ball_rows,
    on_race,
    set_bodies,
)
from flexcage.contacts.evaluation import (
    APPROACH,
    DAMPED,
    N_RACE,
    NORMAL,
    RACE_LAW,
    RACE_RUBS,
    REPORT,
    ROLLED,
    RUBBED,
    STORED,
)
from flexcage.contacts.groove import groove_contact
from flexcage.contacts.slices import Laws
from flexcage.contacts.state import set_frame
from flexcage.core.jit import array_from, fields, outlined, part, zero
from flexcage.system.data import (
    FAMILY_PARTS,
    IN_CONTACTS,
    INNER_RACE,
    OUTER_RACE,
    POCKET,
    RACE_DAMPING,
    RACE_FRICTION,
    ROLLING_RESISTANCE,
)
from flexcage.system.equations import push_pair
from flexcage.system.layout import of_element
from flexcage.system.ring import inner_of, outer_of

INNER, INNER_OTHER, OUTER, OUTER_OTHER = range(1, 5)  # ribs of the arcs, see ``model.RIBS``


def evaluate(t, y, yd, d, law, out, mode):
    """Residual into ``out``, as ``ball.residual.evaluate``."""
    at, arcs = fields(d.places), fields(d.arcs)
    q, u, qd, ud = y[: at.bodies_q], y[at.u : at.bodies_u], yd[: at.bodies_q], yd[at.u :]
    r_q, r_u = out[: at.bodies_q], out[at.u :]
    modes = set_bodies(y, d, mode)
    law[NEIGHBOUR_FORCES](t, y, yd, d, law[:FAMILY_PARTS], out, mode)
    Rc, Vc = array_from(y, at.cage_q), array_from(y, at.cage_u)
    for i in range(at.elements):
        own = of_element(i)
        qi, ui = q[own], u[own]
        set_frame(qi[2], fields(d.pose).F)
        ring = inner_of(y, d)
        _on_arc(i, qi, ui, ring, fields(d.inner), (INNER_RACE, INNER), d, law, mode)
        if arcs.inner > 1:
            _on_arc(i, qi, ui, ring, fields(d.inner_other), (INNER_RACE, INNER_OTHER), d, law, mode)
        ring = outer_of(y, d)
        _on_arc(i, qi, ui, ring, fields(d.outer), (OUTER_RACE, OUTER), d, law, mode)
        if arcs.outer > 1:
            _on_arc(i, qi, ui, ring, fields(d.outer_other), (OUTER_RACE, OUTER_OTHER), d, law, mode)
        if at.cages > 0:
            ball_in_pocket(i, qi, ui, Rc, Vc, modes, d, law, mode)
        ball_rows(i, qi, ui, qd[own], ud[own], d, r_q[own], r_u[own], mode)
    law[SHARED](t, y, yd, d, law[:FAMILY_PARTS], out, mode)


@outlined
def _on_arc(i, qi, ui, ring, groove, places, d, law, mode):
    """Ball i on one arc of a ring, in its frame F; ``places``: its race and its rib."""
    work, pair = fields(d.scratch), fields(d.pair)
    laws, sl = Laws(law[RACE_LAW], law[RACE_RUBS]), fields(d.slices).row[0]
    zero(pair.wrench)
    ball = on_race(i, qi, ui, ring, fields(d.memory).rib[i, places[1]], d)
    if groove_contact(ball, groove, laws, sl, pair.wrench, mode, work.sums):
        push_pair(i, pair.wrench, work.unit, ball.centre, ring.b, d)
    if mode >= REPORT:
        _report_arc(i, places[0], places[1], work.sums, fields(d.report))


@part
def _report_arc(i, race, rib, sums, rep):
    closed = 1 if sums[NORMAL] > 0.0 else 0
    place = POCKET + rep.pocket_normal.shape[1] + rib
    rep.contact[i, place] = closed
    rep.approach[i, place] = sums[APPROACH]
    rep.rib[i, rib] = sums[NORMAL]
    first = rib == INNER or rib == OUTER
    if first or sums[NORMAL] > rep.race[i, race, NORMAL]:
        for c in range(N_RACE):
            rep.race[i, race, c] = sums[c]
        rep.approach[i, race] = sums[APPROACH]
    rep.contact[i, race] = max(rep.contact[i, race], closed)
    rep.energy[IN_CONTACTS] += sums[STORED]
    rep.power[RACE_DAMPING] += sums[DAMPED]
    rep.power[RACE_FRICTION] += sums[RUBBED]
    rep.power[ROLLING_RESISTANCE] += sums[ROLLED]
