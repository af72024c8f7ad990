"""Rollers in motion between rings that bend: the residual of ``residual`` with races that yield.

A roller meets a race as one of a rigid ring that is displaced and tilted as the race is at its
azimuth; ribs and lands follow their ring's modes (``system.rings.sections``).
"""

from __future__ import annotations

from dataclasses import replace

from flexcage.bearings.cylindrical_roller.model import RollerModel
from flexcage.bearings.cylindrical_roller.motion import MOTION
from flexcage.bearings.cylindrical_roller.residual import (
    POCKETS,
    SHARED,
    add_to_ring,
    on_ribs,
    report_outer,
    report_race,
    report_ribs,
    ring_partner,
    roller_rows,
    set_bodies,
)
from flexcage.bearings.cylindrical_roller.scales import roller_weights
from flexcage.bearings.cylindrical_roller.start import roller_start_between_bent_rings
from flexcage.contacts.evaluation import OUTER_RING, RACE_LAW, RACE_RUBS, REPORT, RESIDUAL
from flexcage.contacts.race import race_friction, race_penetrations, race_wrench
from flexcage.contacts.slices import Laws, normal_forces_of_lot
from flexcage.contacts.state import AXIS, CENTRE, Q_SPIN, SPIN, VELOCITY, take_pose
from flexcage.core.jit import VECTORISED, fields, outlined, part
from flexcage.core.vectors import MOMENT, dot, row
from flexcage.system.data import FAMILY_PARTS, INNER_RACE, OUTER_RACE
from flexcage.system.motion import BendingMotion, bending_model, parts_type
from flexcage.system.ring import inner_of, outer_of
from flexcage.system.rings.modes import (
    displace_by_modes,
    mode_rows,
    push_modes_by_element,
    report_modes,
)
from flexcage.system.rings.races import (
    STEPS,
    TILT_PORT,
    after,
    at_once,
    borne_of,
    close,
    deflect_races,
    displace,
    force_rows,
    guess,
    push_by_slopes,
    report_races,
    with_ring_weights,
)
from flexcage.system.rings.sections import bear_ribs, carry_ribs

BendingRollerModel = bending_model("BendingRollerModel", RollerModel, __name__)
BendingRollerParts = parts_type("BendingRollerParts", BendingRollerModel, __name__)


def evaluate(t, y, yd, d, law, out, mode):
    """Residual into ``out``, as ``residual.evaluate``."""
    at, races = fields(d.places), fields(d.rings)
    Z, q, u = at.elements, y[: at.bodies_q], y[at.u : at.bodies_u]
    s = y[at.loads :]
    asked = RESIDUAL if mode == OUTER_RING else mode
    set_bodies(y, d, asked)
    deflect_races(q, inner_of(y, d).q, outer_of(y, d).q, s, races)
    displace_by_modes(q, u, y, d)
    if mode != OUTER_RING:
        ring, modes = inner_of(y, d), fields(d.inner_modes)
        _on_race(INNER_RACE, y, s, ring, fields(d.inner), modes, d, law, mode)
        _on_its_ribs(INNER_RACE, q, ring, fields(d.rib), modes, d, law, mode)
    ring, modes = outer_of(y, d), fields(d.outer_modes)
    _on_race(OUTER_RACE, y, s, ring, fields(d.outer), modes, d, law, asked)
    _on_its_ribs(OUTER_RACE, q, ring, fields(d.outer_rib), modes, d, law, asked)
    for i in range(Z):
        take_pose(fields(d.scratch).poses[i], fields(d.pose))
        push_modes_by_element(i, d)
        push_by_slopes(i, q, y, d)
    if mode >= REPORT:
        report_outer(d)
    if mode == OUTER_RING:
        return
    if mode >= REPORT:
        report_races(u, q, s, races, fields(d.report))
        report_modes(y, d)
    force_rows(s, yd[at.loads :], races, out[at.loads :])
    law[POCKETS](t, y, yd, d, law[:FAMILY_PARTS], out, mode)
    roller_rows(y, yd, d, out, mode)
    law[SHARED](t, y, yd, d, law[:FAMILY_PARTS], out, mode)
    mode_rows(y, yd, d, out, mode)


@outlined
def _on_race(side, y, s, ring, race, modes, d, law, mode):
    """All rollers on the race of a ring (``side``), in lots."""
    pose, pair, work, races = fields(d.pose), fields(d.pair), fields(d.scratch), fields(d.rings)
    rw, memory, turn = fields(d.race_work), fields(d.memory).race, ring.q[Q_SPIN]
    q, radius, lot = y[: fields(d.places).bodies_q], fields(d.bodies).radius, rw.who.shape[0]
    laws, first = Laws(law[RACE_LAW], law[RACE_RUBS]), 0
    while first < work.poses.shape[0]:
        count, first, last = 0, first + lot, min(first + lot, work.poses.shape[0])
        for i in range(first - lot, last):
            take_pose(work.poses[i], pose)
            at = rw.partner[count]
            ring_partner(i, q, ring, d, at)
            displace(at, guess(side, i, s, races), races.way)
            _carry(i, at, modes, races.way)
            if race_penetrations(count, pose, race, radius[i], turn, memory[i, side], rw):
                rw.who[count] = i
                count += 1
        _press(count, side, race, s, d, laws)
        for m in range(count):
            i = rw.who[m]
            take_pose(work.poses[i], pose)
            race_wrench(m, pose, race, radius[i], turn, rw, pair, mode, work.sums)
            _bear(i, rw.partner[m, CENTRE], pair.wrench, modes)
            ring_partner(i, q, ring, d, rw.partner[m])  # forces act on its seat
            add_to_ring(i, rw.partner[m, CENTRE], ring.b, d, mode)
            if mode >= REPORT:
                report_race(i, side, work.sums, fields(d.report))


@outlined
def _on_its_ribs(side, q, ring, ribs, modes, d, law, mode):
    """Rollers on a ring's ribs, if it has any, which follow its modes."""
    if ribs.end <= ribs.first:
        return
    pose, work, at = fields(d.pose), fields(d.scratch), fields(d.race_work).partner[0]
    moment = fields(d.rings).moment[side]
    for i in range(work.poses.shape[0]):
        take_pose(work.poses[i], pose)
        ring_partner(i, q, ring, d, at)
        carry_ribs(i, at, modes)
        if on_ribs(i, at, ribs, d, law, mode):
            bear_ribs(i, at[CENTRE], fields(d.pair).wrench, modes, moment)
            ring_partner(i, q, ring, d, at)
            add_to_ring(i, at[CENTRE], ring.b, d, mode)
            if mode >= REPORT:
                report_ribs(i, ribs.column, work.sums, fields(d.report))


@part
def _carry(i, at, modes, way):
    """Move the ring ``at`` beside roller i as its modes move its race: it tilts about its place
    beneath the roller."""
    if modes.push.shape[0] == 0:
        return
    for p in range(2):
        if way[p] == TILT_PORT:
            at[SPIN, 2] += modes.rate[i, p]
            at[VELOCITY, 0] += modes.rate[i, p] * at[CENTRE, 1]
        else:
            at[VELOCITY, way[p]] += modes.rate[i, p]


@part
def _bear(i, centre, wrench, modes):
    """What a race with modes bears of roller i at its ports, radially and in tilt."""
    if modes.push.shape[0] == 0:
        return
    modes.total[i, 0] = -wrench[1]
    modes.total[i, 1] = -(wrench[MOMENT + 2] + centre[0] * wrench[1])


@part
def _press(count, ring, side, s, d, laws):
    """Forces of the lot's contacts on a race that yields at once, and what it bears of them."""
    rw, rings = fields(d.race_work), fields(d.rings)
    normal_forces_of_lot(laws.normal, (0, count * side.s.shape[0]), rw.lot[0], side.normal)
    for m in range(count):
        i = rw.who[m]
        take_pose(fields(d.scratch).poses[i], fields(d.pose))
        taken = borne_of(ring, i, s, rings)
        force, slope = _on_ports(m, fields(d.pose), side, rw)
        step = at_once(ring, taken, force, slope, rings)
        for _ in range(STEPS - 1):
            if close(taken, force):
                break
            taken = after(force, slope, step)
            _deepen(m, step, fields(d.pose), side, rw)
            normal_forces_of_lot(laws.normal, _slices_of(m, side), rw.lot[0], side.normal)
            force, slope = _on_ports(m, fields(d.pose), side, rw)
            step = at_once(ring, taken, force, slope, rings)
        _follow(m, step, fields(d.pose), side, rw)
        rings.force[ring, i, 0], rings.force[ring, i, 1] = after(force, slope, step)
    race_friction(count, side, laws, rw)


@part(fastmath=VECTORISED)
def _on_ports(m, pose, side, rw):
    """Elastic force and moment of contact m on its race, radially and in tilt, and how both fall
    (11, 12, 22) where the race yields."""
    sl, n = rw.lot[0], side.s.shape[0]
    x0, x1 = _along(m, pose, rw)
    force = moment = a = b = c = 0.0
    for k in range(n):
        at = m * n + k
        if sl.N[at] > 0.0:
            x, up = x0 + side.s[k] * x1, sl.n2[at]
            stiff = sl.Nd[at] * sl.Ne[at] / sl.N[at] * up * up
            force -= sl.Ne[at] * up
            moment -= sl.Ne[at] * up * x
            a += stiff
            b += stiff * x
            c += stiff * x * x
    return (force, moment), (a, b, c)


@part
def _slices_of(m, side):
    """The span of contact m's slices in the lot."""
    n = side.s.shape[0]
    return m * n, (m + 1) * n


@part(fastmath=VECTORISED)
def _deepen(m, step, pose, side, rw):
    """Penetrations of contact m's slices after the race yields by a ``step`` more."""
    sl, n = rw.lot[0], side.s.shape[0]
    x0, x1 = _along(m, pose, rw)
    for k in range(n):
        at = m * n + k
        sl.d[at] += sl.n2[at] * (step[0] + step[1] * (x0 + side.s[k] * x1))


@part(fastmath=VECTORISED)
def _follow(m, step, pose, side, rw):
    """Penetrations and forces of contact m's slices after the race yields by a ``step`` more."""
    sl, n = rw.lot[0], side.s.shape[0]
    x0, x1 = _along(m, pose, rw)
    for k in range(n):
        at = m * n + k
        if sl.N[at] > 0.0:
            deeper = sl.n2[at] * (step[0] + step[1] * (x0 + side.s[k] * x1))
            elastic = sl.Nd[at] * sl.Ne[at] / sl.N[at]
            sl.d[at] += deeper
            sl.N[at] = max(sl.N[at] + sl.Nd[at] * deeper, 0.0)
            sl.Ne[at] = max(sl.Ne[at] + elastic * deeper, 0.0)


@part
def _along(m, pose, rw):
    """Where along the ring's axis a roller's slice at s is: x0 + s x1, from the ring's middle."""
    axis = row(rw.partner[m], AXIS)
    return dot(row(rw.partner[m], CENTRE), axis), dot(row(pose.axis, 0), axis)


BENDING = BendingMotion(
    motion=replace(
        MOTION,
        parts=BendingRollerParts,
        evaluate=evaluate,
        start=roller_start_between_bent_rings,
        error_weights=with_ring_weights(roller_weights),
        implicit_share=0.0,
    ),
    model=BendingRollerModel,
)
