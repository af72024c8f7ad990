"""The residual F(t, y, y') = 0 of a spherical roller bearing, its tangent, and its report.

Barrels of both rows move by the equations of cylindrical rollers: the axis of one leans towards the
bearing's where its row is, so that its tilt is about the contact angle at -x, and minus that at +x.
Races are arcs (``contacts.barrel``): both rows meet the sphere of the outer ring, and each a groove
of the inner one. No rib bears. What holds a barrel along its axis are the arcs of both races, which
are nearest to each other beside the middle; a guide ring between the rows floats.
"""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.residual import (
    add_to_ring,
    report_race,
    ring_partner,
    set_bodies,
)
from flexcage.bearings.tapered_roller.residual import after_races
from flexcage.contacts.barrel import barrel_penetrations, barrel_wrench
from flexcage.contacts.evaluation import (
    OUTER_RING,
    RACE_LAW,
    RACE_RUBS,
    REPORT,
    RESIDUAL,
)
from flexcage.contacts.race import race_forces
from flexcage.contacts.slices import Laws
from flexcage.contacts.state import CENTRE, take_pose
from flexcage.core.jit import fields, outlined, part
from flexcage.core.vectors import dot, row, xyz
from flexcage.system.data import INNER_RACE, OUTER_RACE
from flexcage.system.ring import inner_of, outer_of


def evaluate(t, y, yd, d, law, out, mode):
    """Residual into ``out``; arguments as those of ``cylindrical_roller.residual.evaluate``."""
    at, each = fields(d.places), fields(d.rows).each
    q = y[: at.bodies_q]
    asked = RESIDUAL if mode == OUTER_RING else mode
    set_bodies(y, d, asked)
    if mode != OUTER_RING:
        _of_row((0, each), q, inner_of(y, d), fields(d.inner), INNER_RACE, d, law, mode)
        _of_row(
            (each, at.elements), q, inner_of(y, d), fields(d.inner_other), INNER_RACE, d, law, mode
        )
    _of_row((0, at.elements), q, outer_of(y, d), fields(d.outer), OUTER_RACE, d, law, asked)
    after_races(t, y, yd, d, law, out, mode)


@outlined
def _of_row(rollers, q, ring, side, race, d, law, mode):
    """Rollers from rollers[0] to before rollers[1] on the race ``side`` of a ring, in lots."""
    lot = fields(d.race_work).who.shape[0]
    for first in range(rollers[0], rollers[1], lot):
        _on_arc((first, min(first + lot, rollers[1])), q, ring, side, race, d, law, mode)


@part
def _on_arc(span, q, ring, side, race, d, law, mode):
    """Rollers span[0] to before span[1] on the race ``side`` of a ring."""
    pose, pair, work, rw = fields(d.pose), fields(d.pair), fields(d.scratch), fields(d.race_work)
    memory, count = fields(d.memory).race, 0
    for i in range(span[0], span[1]):
        take_pose(work.poses[i], pose)
        ring_partner(i, q, ring, d, rw.partner[count])
        if mode >= REPORT:
            _approach(i, race, ring, side, d)
        if barrel_penetrations(count, pose, side, memory[i, race], rw):
            rw.who[count] = i
            count += 1
    race_forces(count, side, Laws(law[RACE_LAW], law[RACE_RUBS]), rw)
    for m in range(count):
        i = rw.who[m]
        take_pose(work.poses[i], pose)
        barrel_wrench(m, pose, side, rw, pair, mode, work.sums)
        add_to_ring(i, rw.partner[m, CENTRE], ring.b, d, mode)
        if mode >= REPORT:
            report_race(i, race, work.sums, fields(d.report))


@part
def _approach(i, race, ring, side, d):
    """Speed at which roller i approaches a race, at its centre along its second axis (for the onset
    memory)."""
    F, up = fields(d.pose).F, row(fields(d.pose).axis, 1)
    V, u = xyz(fields(d.pose).V), xyz(ring.u)
    v = V[0] - u[0], V[1] - dot(row(F, 1), u), V[2] - dot(row(F, 2), u)
    fields(d.report).approach[i, race] = -side.sign * dot(up, v)
