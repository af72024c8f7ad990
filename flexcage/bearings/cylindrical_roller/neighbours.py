"""Rollers of a full-complement bearing against the next ones: forces, report and tangent.

They take the place of the pockets: the residual calls ``touch_next`` where it calls
``pockets.roller_pockets`` of a bearing with a cage. What the tangent leaves out is how one roller
of a pair follows the other, as with balls (``bearings.ball.neighbours``).
"""

from __future__ import annotations

from math import cos, pi, sin
from typing import TYPE_CHECKING, Any

from flexcage.contacts import laws as contact_laws
from flexcage.contacts.ball_ball import rotated
from flexcage.contacts.evaluation import RACE_LAW, RACE_RUBS, REPORT, TANGENT
from flexcage.contacts.laws import EXPONENT
from flexcage.contacts.roller_roller import (
    RollerRollerContact,
    TwoRollers,
    add_to_both,
    approach_of,
    roller_roller_forces,
    slopes_of,
)
from flexcage.contacts.slices import Laws, friction_power, stored_and_damped
from flexcage.contacts.state import KEPT_AXES, KEPT_V, KEPT_W, add_force_and_moment
from flexcage.core.jit import fields, outlined, part, zero
from flexcage.core.vectors import minus, row, times, turn_of, xyz
from flexcage.system.data import IN_CONTACTS, NEIGHBOUR_DAMPING, NEIGHBOUR_FRICTION, POCKET
from flexcage.system.layout import of_element

if TYPE_CHECKING:
    import numpy as np

    from flexcage.contacts.spec import Contacts

_LINE = 10.0 / 9.0  # exponent of ``iso_line_stiffness``
NEXT_ROLLER = POCKET  # place of a roller's contact with the next one


def roller_roller_data(
    bearing: Any, contacts: Contacts, s: np.ndarray, drop: np.ndarray
) -> RollerRollerContact:
    """How rollers touch each other, by the laws of the races; their approach under a force is that
    of a line contact, whatever its curvature (A. Palmgren, see ``laws.iso_line_stiffness``)."""
    two = contact_laws.iso_line_stiffness(
        bearing.effective_length, bearing.rolling_material.plane_strain_modulus
    )
    return RollerRollerContact(
        s=s,
        drop=drop,
        normal=contact_laws.normal_parameters(contacts.race.normal, two, _LINE, parts=len(s)),
        friction=contact_laws.friction_parameters(contacts.race.friction),
    )


def touch_next(t, y, yd, d, law, out, mode):
    """Forces of rollers on their neighbours into ``Scratch.wrenches``; in mode TANGENT their
    slopes, each over the own roller's motion. Arguments are those of ``residual.evaluate``."""
    at, count = fields(d.places), fields(d.rows).each
    for i in range(at.elements):
        j = i + 1 if (i + 1) % count != 0 else i + 1 - count
        _touch(i, j, y[: at.bodies_q], d, law, mode)


@part
def pair_of(i, j, q, d):
    """Rollers i and j in the frame of i, and how far j is ahead [rad]; the first roller of a row
    is next to its last one."""
    radius, poses = fields(d.bodies).radius, fields(d.scratch).poses
    qi, qj = q[of_element(i)], q[of_element(j)]
    ahead = qj[2] - qi[2] + (0.0 if j > i else 2.0 * pi)
    c, s, own, other = cos(ahead), sin(ahead), poses[i], poses[j]
    place = minus(rotated(c, s, (qj[0], qj[1], 0.0)), (qi[0], qi[1], 0.0))
    two = TwoRollers(
        (radius[i], radius[j]), row(own, KEPT_AXES), rotated(c, s, row(other, KEPT_AXES)), place,
        minus(row(own, KEPT_V), rotated(c, s, row(other, KEPT_V))), row(own, KEPT_W),
        rotated(c, s, row(other, KEPT_W)), fields(d.memory).pocket[i, 0],
    )  # fmt: skip
    return two, ahead


@part
def give_to_next(back, ahead, wrench):
    """Add what roller i does to the next one, in its own frame, to that one's wrench."""
    c, s = cos(ahead), sin(ahead)
    back_in_j = rotated(c, -s, xyz(back)), rotated(c, -s, turn_of(back))
    add_force_and_moment(wrench, back_in_j[0], back_in_j[1])


@part
def report_touch(i, force, data, sl, rep):
    """Force, energy and powers of the contact of roller i with the next one."""
    span = (0, data.s.shape[0])
    energy, damped = stored_and_damped(span, sl, data.normal[EXPONENT])
    rep.pocket_normal[i, 0] = force
    rep.contact[i, NEXT_ROLLER] = 1 if force > 0.0 else 0
    rep.energy[IN_CONTACTS] += energy
    rep.power[NEIGHBOUR_DAMPING] += damped
    rep.power[NEIGHBOUR_FRICTION] += friction_power(span, sl)


@part
def seen_from_next(two, ahead):
    """A pair as the second roller sees it, in its frame."""
    c, s = cos(ahead), sin(ahead)
    return TwoRollers(
        (two.radii[1], two.radii[0]), rotated(c, -s, two.other_axis), rotated(c, -s, two.axis),
        rotated(c, -s, times(-1.0, two.place)), rotated(c, -s, times(-1.0, two.velocity)),
        rotated(c, -s, two.other_spin), rotated(c, -s, two.spin), two.onset,
    )  # fmt: skip


@outlined
def _touch(i, j, q, d, law, mode):
    """Rollers i and j."""
    sl, data, rep, work = (
        fields(d.slices).row[0],
        fields(d.neighbours),
        fields(d.report),
        fields(d.scratch),
    )
    two, ahead = pair_of(i, j, q, d)
    depth, speed = approach_of(two, data, sl)
    if mode >= REPORT:
        rep.approach[i, NEXT_ROLLER], rep.pocket_normal[i, 0] = speed, 0.0
    if depth <= 0.0:
        return
    roller_roller_forces(two, data, Laws(law[RACE_LAW], law[RACE_RUBS]), sl)
    back = work.T6[0, 0]
    zero(back)
    force = add_to_both(two, data, sl, work.wrenches[i], back)
    give_to_next(back, ahead, work.wrenches[j])
    if mode == TANGENT:
        _slopes(i, j, two, ahead, d)
    elif mode >= REPORT:
        report_touch(i, force, data, sl, rep)


@part
def _slopes(i, j, two, ahead, d):
    """Slopes of both rollers' wrenches, each over its own motion."""
    data, sl, tan = fields(d.neighbours), fields(d.slices).row[0], fields(d.tangent)
    slopes_of(two, data, sl, fields(d.pair).W, tan.Krr[i], tan.Crr[i])
    for k in range(data.s.shape[0]):
        sl.t2[k] = -sl.t2[k]  # along the axis the other slides the other way
    other = seen_from_next(two, ahead)
    slopes_of(other, data, sl, fields(d.pair).W, tan.Krr[j], tan.Crr[j])
