"""What happens at accepted points and at sampling times: memory of contacts, events, reports."""

from __future__ import annotations

from flexcage.contacts.evaluation import OUTER_RING, REPORT
from flexcage.core.jit import array_from, copy_into, fields, part
from flexcage.core.vectors import RIGID, TURN
from flexcage.system.data import (
    CONSTRAINTS,
    DRIVE,
    EVENT_CLOSED,
    EVENT_ELEMENT,
    EVENT_PLACE,
    EVENT_TIME,
    EXCHANGED,
    LOAD,
    POCKET,
)
from flexcage.system.equations import load_power
from flexcage.system.layout import DRIVE_TORQUE, FRAME, cage_at


@part
def give_powers(t, y, d, power):
    """Powers of the last report into ``power``, if it has room, and by (t, y) those of loads and
    constraints."""
    if power.shape[0] == 0:
        return
    report = fields(d.report)
    for k in range(power.shape[0]):
        power[k] = report.power[k]
    at, c = fields(d.places), fields(d.constraints)
    power[DRIVE] += y[at.lam + DRIVE_TORQUE] * y[at.inner_u + TURN]
    power[LOAD] += load_power(t, y, d)
    for k in range(c.level.shape[0]):  # those that move bodies
        for j in range(at.border):
            power[CONSTRAINTS] += y[at.held + k] * c.G[k, j] * y[at.bodies_u + j]


def powers(t, y, data, power):
    """Powers at y, a Newton step beyond the point evaluated last: those of that point, but by y
    those of loads and constraints, which are large and alternate: what they do is a small
    difference, and multipliers are what such a step changes most. Returns how many are exchanged
    with the outside; those behind are losses, and what constraints do."""
    give_powers(t, y, data[0], power)
    return EXCHANGED


def settle(t, y, data):
    """Such a y was accepted.

    What contacts remember is that of the point evaluated last; the races' force on the outer ring,
    whose acceleration is a result, is evaluated at y.
    """
    d = data[0]
    force, races = fields(d.report).outer_wrench, fields(d.report).outer_races
    for c in range(RIGID):
        force[c] -= races[c]
    data[2](t, y, y, d, data[1], fields(d.scratch).out, OUTER_RING)
    for c in range(RIGID):
        force[c] += races[c]
    keep_point(t, y, d)


def note(t, y, data):
    """The point evaluated last, of this y, was accepted."""
    keep_point(t, y, data[0])


@part
def keep_point(t, y, d):
    """Memory of contacts, events, force on the outer ring and loads of the cage from the last
    report."""
    report, events = fields(d.report), fields(d.events)
    keep_loads(t, y, d)
    remember(t, fields(d.memory), report, events)
    _keep_summits(t, events, report.pocket_normal)
    for c in range(3):
        events.force[0, c] = events.force[1, c]
    copy_into(events.pocket_force_before, events.pocket_force)
    copy_into(events.pocket_force, report.pocket_normal)
    events.force[1, 0] = t
    events.force[1, 1], events.force[1, 2] = report.outer_wrench[1], report.outer_wrench[2]


@part
def keep_loads(t, y, d):
    """Modes of y and forces on the cage while something touches it (a film does not), and as long
    after as samples are apart."""
    between, rep = fields(d.between), fields(d.report)
    clock, spacing, n = between.clock, between.spacing, between.fill[0]
    row = between.fill[1]
    full = row + rep.pocket_normal.size > between.force.shape[0]
    if n == between.time.shape[0] or full or t < clock[0]:
        return
    for i in range(rep.pocket_normal.shape[0]):
        for f in range(rep.pocket_normal.shape[1]):
            if rep.pocket_normal[i, f] > 0.0:
                between.face[row, 0], between.face[row, 1] = i, f
                copy_into(between.force[row], rep.station[i, f])
                row += 1
    touched = row - between.fill[1]
    on_lands = 0.0
    for side in range(rep.land_touch.shape[0]):
        on_lands = max(on_lands, rep.land_touch[side, 0])
    if touched > 0 or on_lands > 0.0:
        clock[1] = t + spacing[1]
    if t > clock[1]:
        return
    at = fields(d.places)
    for k in range(at.cages):
        first, modes = cage_at(k, at).q + FRAME, array_from(between.modes[n], k * at.modes)
        for m in range(at.modes):
            modes[m] = y[first + m]
    copy_into(between.land[n], rep.land_station)
    between.time[n], between.touched[n] = t, touched
    between.fill[0], between.fill[1] = n + 1, row
    clock[0] = t + spacing[0]


@part
def _keep_summits(t, events, values):
    """Largest forces up to a step at t, and between the two before it: a contact lasts a few steps,
    so the highest of its parabola through three of them is nearer to its largest force."""
    before, last = events.force[0, 0], events.force[1, 0]
    known = before < last < t and 0.5 < (last - before) / (t - last) < 2.0
    for i in range(values.shape[0]):
        for f in range(values.shape[1]):
            most, at = max(events.pocket_force_peak[i, f], values[i, f]), events.pocket_force[i, f]
            if known and at > 0.0 and at >= max(events.pocket_force_before[i, f], values[i, f]):
                rise = (at - events.pocket_force_before[i, f]) / (last - before)
                fall = (values[i, f] - at) / (t - last)
                bend = (fall - rise) / (t - before)
                slope = rise + bend * (last - before)
                if bend < 0.0:
                    most = max(most, at - 0.25 * slope * slope / bend)
            events.pocket_force_peak[i, f] = most


@part
def _keep_larger(most, values):
    """most = max(most, values), entry by entry (n, m)."""
    for i in range(values.shape[0]):
        for f in range(values.shape[1]):
            most[i, f] = max(most[i, f], values[i, f])


@part
def remember(t, memory, rep, events):
    """Keep the onset speed of every contact, and contact changes; races come before the faces of
    pockets, those before ribs."""
    ribs = POCKET + memory.pocket.shape[1]
    for i in range(rep.contact.shape[0]):
        for k in range(rep.contact.shape[1]):
            closed = rep.contact[i, k]
            if closed == 0 or events.closed[i, k] == 0:
                speed = max(rep.approach[i, k], 0.0)
                if k < POCKET:
                    memory.race[i, k] = speed
                elif k < ribs:
                    memory.pocket[i, k - POCKET] = speed
                else:
                    memory.rib[i, k - ribs] = speed
            if closed != events.closed[i, k]:
                events.closed[i, k] = closed
                _note(events, t, i, k, closed)
        copy_into(memory.deflection[i], rep.residual[i])
    for side in range(rep.land_touch.shape[0]):
        closed = 1 if rep.land_touch[side, 0] > 0.0 else 0
        if closed == 0 or events.land[side] == 0:
            memory.land[side] = max(rep.land_touch[side, 1], 0.0)
        if closed != events.land[side]:
            events.land[side] = closed
            _note(events, t, -1, rep.contact.shape[1] + side, closed)


@part
def _note(events, t, element, place, closed):
    """Write down that a contact closed or opened; a full buffer keeps the first ones."""
    n = events.fill[0]
    if n < events.rows.shape[0]:
        row = events.rows[n]
        row[EVENT_TIME], row[EVENT_ELEMENT] = t, element
        row[EVENT_PLACE], row[EVENT_CLOSED] = place, closed
        events.fill[0] = n + 1


@part
def is_main(sample, stride):
    """Whether a sample is one of those of which the whole report is kept."""
    return sample % stride == stride - 1


def wanted(sample, data):
    """Whether y of a sample is wanted to the last mode."""
    return is_main(sample, fields(data[0].samples).stride)


def observe(sample, t, y, yd, data):
    """Keep the report at sampling time t, for y and y' of dense output."""
    s = fields(data[0].samples)
    if is_main(sample, s.stride):
        data[2](t, y, yd, data[0], data[1], fields(data[0].scratch).out, REPORT)
        keep_report(s, sample // s.stride, fields(data[0].report), fields(data[0].events))
    keep_force(sample, t, s, fields(data[0].events))


@part
def keep_report(s, k, rep, events):
    """Copy a whole report into row k of the samples.

    The step that went past the sample is among those before it, and first of those after it.
    """
    _keep_larger(events.pocket_force_peak, rep.pocket_normal)
    copy_into(s.pocket_peak[k], events.pocket_force_peak)
    copy_into(events.pocket_force_peak, events.pocket_force)
    copy_into(s.race[k], rep.race)
    copy_into(s.pocket_normal[k], rep.pocket_normal)
    copy_into(s.pocket_friction[k], rep.pocket_friction)
    copy_into(s.slice_normal[k], rep.slice_normal)
    copy_into(s.slice_friction[k], rep.slice_friction)
    copy_into(s.point_normal[k], rep.point_normal)
    copy_into(s.point_friction[k], rep.point_friction)
    copy_into(s.station[k], rep.station)
    copy_into(s.residual[k], rep.residual)
    copy_into(s.rib[k], rep.rib)
    copy_into(s.land[k], rep.land)
    copy_into(s.land_station[k], rep.land_station)
    copy_into(s.energy[k], rep.energy)
    copy_into(s.outer_wrench[k], rep.outer_wrench)


@part
def keep_force(sample, t, s, events):
    """Force on the outer ring at time t, between the last two accepted points."""
    before, after = events.force[0], events.force[1]
    w = (t - before[0]) / (after[0] - before[0])
    for c in range(2):
        s.force[sample, c] = (1.0 - w) * before[1 + c] + w * after[1 + c]
