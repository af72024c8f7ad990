"""The cage's lands on the ring that guides it and on the other one, and the drag on the cage."""

from __future__ import annotations

from math import cos, sin

from flexcage.contacts.evaluation import (
    APPROACH,
    DAMPED,
    LAND_LAW,
    LAND_RUBS,
    NORMAL,
    REPORT,
    RUBBED,
    SHEARED,
    STORED,
)
from flexcage.contacts.land import NONE as NO_LAND
from flexcage.contacts.land import (
    LandCage,
    LandForces,
    LandRing,
    land_contact,
    other_contact,
    other_land,
)
from flexcage.contacts.land_frame import bring_back, is_tilted, seen_from_ring
from flexcage.contacts.slices import Laws
from flexcage.contacts.state import Q_SKEW
from flexcage.core.jit import array_from, copy_into, fields, outlined, part, zero
from flexcage.core.vectors import RIGID, TURN, cross, turned_back, xyz
from flexcage.system.data import (
    CAGE_FORCE,
    CAGE_MOMENT,
    CAGE_SPIN,
    DRAG,
    FILM,
    IN_CONTACTS,
    LAND_DAMPING,
    LAND_FRICTION,
    LANDS,
    OTHER_LAND,
    RING_FORCE,
    RING_MOMENT,
)
from flexcage.system.floating import modes_at
from flexcage.system.layout import FRAME, cage_at
from flexcage.system.ring import inner_of, outer_of


@part
def land_forces(k, y, d, law, mode):
    """Lands of cage k, which is under work, on the ring that guides it and on the other one, and
    the drag on it."""
    work, data, rep, at = fields(d.scratch), fields(d.land), fields(d.report), fields(d.places)
    vec, border, A, nm, own = work.vec, work.border, work.A, at.modes, cage_at(k, at)
    b = own.b
    Fc, Mc, wg = vec[CAGE_FORCE], vec[CAGE_MOMENT], vec[CAGE_SPIN]
    zero(Fc)
    zero(Mc)
    lw, onset = fields(d.land_work), array_from(fields(d.memory).land, k * LANDS)
    cage = LandCage(
        A, array_from(y, own.q), array_from(y, own.u), wg,
        y[modes_at(own.q + FRAME, nm)], y[modes_at(own.u + RIGID, nm)],
    )  # fmt: skip
    forces = LandForces(
        Fc, Mc, border[modes_at(b + RIGID, nm)], vec[RING_FORCE], vec[RING_MOMENT]
    )  # fmt: skip
    laws, sl = Laws(law[LAND_LAW], law[LAND_RUBS]), fields(d.slices).row[0]
    ring = inner_of(y, d) if data.inner != 0 else outer_of(y, d)
    seen, met, pushed, tilted = cage, _land_ring(ring, forces), forces, is_tilted(ring.axis)
    if tilted:
        seen, met, pushed = _from_ring(ring, cage, met, forces, work, lw)
    land_contact(seen, met, data, onset, laws, sl, lw, pushed, work.sums)
    if tilted:
        bring_back(pushed, work.R[0], forces)
    _push_ring(forces, ring.b, border)
    if mode >= REPORT:
        _report_land(lw.st, work.sums, k * LANDS, _stations_before(k, at, rep), rep)
    if data.other_kind != NO_LAND:
        _other_ring(k, y, cage, forces, d, law, mode)
    drag = fields(d.bodies).drag[1] * abs(wg[0]) * wg[0]
    Mc[0] -= drag
    moment = turned_back(A, xyz(Mc))
    for c in range(3):
        border[b + c] += Fc[c]
        border[b + TURN + c] += moment[c]
    if mode >= REPORT:
        copy_into(array_from(rep.land, 3 * k), Fc)
        rep.power[DRAG] -= drag * wg[0]


@part
def _land_ring(ring, forces):
    """A ring as the cage's land meets it, where it is not tilted; it bears no forces yet."""
    zero(forces.ring_force)
    zero(forces.ring_moment)
    return LandRing(ring.q, ring.u, array_from(ring.u, TURN))


@part
def _from_ring(ring, cage, met, forces, work, lw):
    """Cage, ring and forces in the frame of a ring that is tilted: ``work.R[0]``."""
    frame, axis = work.R[0], xyz(ring.axis)
    third = (sin(ring.q[Q_SKEW]), 0.0, cos(ring.q[Q_SKEW]))
    for k, e in enumerate((axis, cross(third, axis), third)):
        frame[0, k], frame[1, k], frame[2, k] = e
    return seen_from_ring(cage, met, frame, forces.modal, lw)


@outlined
def _other_ring(k, y, cage, forces, d, law, mode):
    """Cage k on the ring that does not guide it."""
    work, data, rep = fields(d.scratch), fields(d.land), fields(d.report)
    land = other_land(data)
    laws, sl = Laws(law[LAND_LAW], law[LAND_RUBS]), fields(d.slices).row[0]
    first = k * LANDS + OTHER_LAND
    lw, onset = fields(d.land_work), array_from(fields(d.memory).land, first)
    ring = inner_of(y, d) if data.inner == 0 else outer_of(y, d)
    seen, met, pushed, tilted = cage, _land_ring(ring, forces), forces, is_tilted(ring.axis)
    if tilted:
        seen, met, pushed = _from_ring(ring, cage, met, forces, work, lw)
    other_contact(seen, met, land, onset, laws, sl, lw, pushed, work.sums)
    if tilted:
        bring_back(pushed, work.R[0], forces)
    _push_ring(forces, ring.b, work.border)
    if mode >= REPORT:
        begin = _stations_before(k, fields(d.places), rep) + lw.st.shape[0]
        _report_land(lw.st, work.sums, first, begin, rep)


@part
def _push_ring(forces, b, border):
    """Add what lands do to a ring whose rows of the border begin at b."""
    for c in range(3):
        border[b + c] += forces.ring_force[c]
        border[b + TURN + c] += forces.ring_moment[c]


@part
def _stations_before(k, at, rep):
    """So many stations of lands are those of the cages before cage k."""
    return k * (rep.land_station.shape[0] // at.cages)


@part
def _report_land(st, sums, first, begin, rep):
    """Report two lands, the ones from ``first`` on, with the forces at their stations, those from
    ``begin`` on."""
    copy_into(rep.land_station[begin : begin + st.shape[0]], st)
    for c in range(2):
        rep.land_touch[first + c, 0] = sums[NORMAL + c]
        rep.land_touch[first + c, 1] = sums[APPROACH + c]
    rep.energy[IN_CONTACTS] += sums[STORED]
    rep.power[LAND_DAMPING] += sums[DAMPED]
    rep.power[LAND_FRICTION] += sums[RUBBED]
    rep.power[FILM] += sums[SHEARED]
