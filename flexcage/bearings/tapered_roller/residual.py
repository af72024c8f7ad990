"""The residual F(t, y, y') = 0 of a tapered roller bearing, its tangent, and its report.

Rollers move by the equations of cylindrical ones, with their centre of mass for a centre and an
axis that leans: their tilt is about minus the angle between both axes. Races are cones, and the
ribs of the inner ring are two more (``contacts.cone``, ``cone_end``).
"""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.residual import (
    POCKETS,
    SHARED,
    add_to_ring,
    report_outer,
    report_race,
    ring_partner,
    roller_rows,
    set_bodies,
)
from flexcage.bearings.tapered_roller.model import LARGE_RIB, SMALL_RIB
from flexcage.contacts.cone import cone_penetrations, cone_wrench
from flexcage.contacts.cone_end import end_contact
from flexcage.contacts.evaluation import (
    APPROACH,
    DAMPED,
    NORMAL,
    OUTER_RING,
    RACE_LAW,
    RACE_RUBS,
    REPORT,
    RESIDUAL,
    RIB_LAW,
    RIB_RUBS,
    RUBBED,
    STORED,
    TANGENT,
)
from flexcage.contacts.race import race_forces
from flexcage.contacts.slices import Laws
from flexcage.contacts.state import CENTRE, Q_SPIN, take_pose
from flexcage.core.jit import fields, outlined, part
from flexcage.core.vectors import TURN, dot, row, turned, xyz
from flexcage.system.data import (
    FAMILY_PARTS,
    IN_CONTACTS,
    INNER_RACE,
    OUTER_RACE,
    POCKET,
    RIB_DAMPING,
    RIB_FRICTION,
)
from flexcage.system.ring import inner_of, outer_of


def evaluate(t, y, yd, d, law, out, mode):
    """Residual into ``out``; arguments as those of ``cylindrical_roller.residual.evaluate``."""
    at = fields(d.places)
    Z, q = at.elements, y[: at.bodies_q]
    asked = RESIDUAL if mode == OUTER_RING else mode
    set_bodies(y, d, asked)
    lot = fields(d.race_work).who.shape[0]
    for first in range(0, Z if mode != OUTER_RING else 0, lot):
        span = (first, min(first + lot, Z))
        _on_cone(span, q, inner_of(y, d), fields(d.inner), INNER_RACE, d, law, mode)
    for first in range(0, Z, lot):
        span = (first, min(first + lot, Z))
        _on_cone(span, q, outer_of(y, d), fields(d.outer), OUTER_RACE, d, law, asked)
    after_races(t, y, yd, d, law, out, mode)


@part
def after_races(t, y, yd, d, law, out, mode):
    """What follows the contacts with races: of rollers whose axes lean."""
    if mode >= REPORT:
        report_outer(d)
    if mode == OUTER_RING:
        return
    law[POCKETS](t, y, yd, d, law[:FAMILY_PARTS], out, mode)
    if mode == TANGENT:
        along_axes(d)
    roller_rows(y, yd, d, out, mode)
    law[SHARED](t, y, yd, d, law[:FAMILY_PARTS], out, mode)


@part
def _on_cone(span, q, ring, side, race, d, law, mode):
    """Rollers span[0] to before span[1] on the race ``side`` of a ring, and on the inner's rib."""
    pose, pair, work, rw = fields(d.pose), fields(d.pair), fields(d.scratch), fields(d.race_work)
    memory, turn, count = fields(d.memory).race, ring.q[Q_SPIN], 0
    for i in range(span[0], span[1]):
        take_pose(work.poses[i], pose)
        at = rw.partner[count]
        ring_partner(i, q, ring, d, at)
        if race == INNER_RACE:
            _on_rib(i, LARGE_RIB, fields(d.end), at, ring.b, d, law, mode)
            if fields(d.small_end).radius > 0.0:
                _on_rib(i, SMALL_RIB, fields(d.small_end), at, ring.b, d, law, mode)
        if mode >= REPORT:
            _approach(i, race, ring, side, d)
        if cone_penetrations(count, pose, side, turn, memory[i, race], rw):
            rw.who[count] = i
            count += 1
    race_forces(count, side, Laws(law[RACE_LAW], law[RACE_RUBS]), rw)
    for m in range(count):
        i = rw.who[m]
        take_pose(work.poses[i], pose)
        cone_wrench(m, pose, side, turn, rw, pair, mode, work.sums)
        add_to_ring(i, rw.partner[m, CENTRE], ring.b, d, mode)
        if mode >= REPORT:
            report_race(i, race, work.sums, fields(d.report))


@part
def _on_rib(i, rib, end, at, b, d, law, mode):
    """Roller i's ``end`` on a ``rib`` of the inner ring, its partner ``at``, whose border begins at
    b."""
    pose, pair, sums, rep = fields(d.pose), fields(d.pair), fields(d.scratch).sums, fields(d.report)
    laws, sl = Laws(law[RIB_LAW], law[RIB_RUBS]), fields(d.slices).row[0]
    onset = fields(d.memory).rib[i, rib]
    touches = end_contact(pose, at, end, onset, laws, sl, pair, mode, sums)
    if touches:
        add_to_ring(i, at[CENTRE], b, d, mode)
    if mode >= REPORT:
        place = POCKET + rep.pocket_normal.shape[1] + rib
        rep.rib[i, rib], rep.approach[i, place] = sums[NORMAL], sums[APPROACH]
        rep.contact[i, place] = 1 if sums[NORMAL] > 0.0 else 0
        rep.energy[IN_CONTACTS] += sums[STORED]
        rep.power[RIB_DAMPING] += sums[DAMPED]
        rep.power[RIB_FRICTION] += sums[RUBBED]


@part
def _approach(i, race, ring, side, d):
    """Speed at which roller i approaches a race, at its centre (for the onset memory)."""
    F, V = fields(d.pose).F, xyz(fields(d.pose).V)
    along = V[0] - ring.u[0]
    outwards = V[1] - dot(row(F, 1), xyz(ring.u))
    fields(d.report).approach[i, race] = -side.sign * (side.cos * outwards + side.sin * along)


@outlined
def along_axes(d):
    """Turn what contacts have added to the tangent into the axes of the rollers' rotations, which
    are not those of the orbital frames."""
    tan, poses = fields(d.tangent), fields(d.scratch).poses
    for i in range(poses.shape[0]):
        take_pose(poses[i], fields(d.pose))
        axis = fields(d.pose).axis
        for M in (tan.Krr[i], tan.Crr[i]):
            _turn_rows(axis, M)
            _turn_columns(axis, M)
        for M in (tan.Krb[i], tan.Crb[i]):
            _turn_rows(axis, M)
        for M in (tan.Kbr[i], tan.Cbr[i]):
            _turn_columns(axis, M)


@part
def _turn_rows(axis, M):
    """Moments, the rows from TURN on."""
    for c in range(M.shape[1]):
        m = turned(axis, (M[TURN, c], M[TURN + 1, c], M[TURN + 2, c]))
        M[TURN, c], M[TURN + 1, c], M[TURN + 2, c] = m


@part
def _turn_columns(axis, M):
    """Rotations, the columns from TURN on."""
    for r in range(M.shape[0]):
        m = turned(axis, (M[r, TURN], M[r, TURN + 1], M[r, TURN + 2]))
        M[r, TURN], M[r, TURN + 1], M[r, TURN + 2] = m
