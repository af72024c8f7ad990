"""Tapered rollers of a full complement against the next ones: forces, report and tangent.

They take the place of the pockets, as ``cylindrical_roller.neighbours`` has it.
"""

from __future__ import annotations

from math import cos, sin

from flexcage.bearings.cylindrical_roller.neighbours import NEXT_ROLLER, pair_of
from flexcage.contacts.ball_ball import rotated
from flexcage.contacts.cone_cone import (
    add_to_both_cones,
    cone_approach,
    cone_cone_forces,
    cone_slopes_of,
)
from flexcage.contacts.evaluation import RACE_LAW, RACE_RUBS, REPORT, TANGENT
from flexcage.contacts.laws import EXPONENT
from flexcage.contacts.roller_roller import TwoRollers
from flexcage.contacts.slices import Laws, friction_power, stored_and_damped
from flexcage.contacts.state import add_force_and_moment
from flexcage.core.jit import fields, outlined, part, zero
from flexcage.core.vectors import times, turn_of, xyz
from flexcage.system.data import IN_CONTACTS, NEIGHBOUR_DAMPING, NEIGHBOUR_FRICTION


def touch_next(t, y, yd, d, law, out, mode):
    """Forces of rollers on their neighbours into ``Scratch.wrenches``; in mode TANGENT their
    slopes, each over the own roller's motion. Arguments are those of ``residual.evaluate``."""
    at = fields(d.places)
    for i in range(at.elements):
        j = i + 1 if i + 1 < at.elements else 0
        _touch(i, j, y[: at.bodies_q], d, law, mode)


@outlined
def _touch(i, j, q, d, law, mode):
    """Rollers i and j."""
    sl, data, work = fields(d.slices).row[0], fields(d.neighbours), fields(d.scratch)
    rep = fields(d.report)
    two, ahead = pair_of(i, j, q, d)
    depth, speed = cone_approach(two, data, sl)
    if mode >= REPORT:
        rep.approach[i, NEXT_ROLLER], rep.pocket_normal[i, 0] = speed, 0.0
    if depth <= 0.0:
        return
    cone_cone_forces(two, data, Laws(law[RACE_LAW], law[RACE_RUBS]), sl)
    c, s, back = cos(ahead), sin(ahead), work.T6[0, 0]
    zero(back)
    force = add_to_both_cones(two, data, sl, work.wrenches[i], back)
    back_in_j = rotated(c, -s, xyz(back)), rotated(c, -s, turn_of(back))
    add_force_and_moment(work.wrenches[j], back_in_j[0], back_in_j[1])
    if mode == TANGENT:
        _slopes(i, j, two, ahead, d)
    elif mode >= REPORT:
        span = (0, data.s.shape[0])
        energy, damped = stored_and_damped(span, sl, data.normal[EXPONENT])
        rep.pocket_normal[i, 0] = force
        rep.contact[i, NEXT_ROLLER] = 1 if force > 0.0 else 0
        rep.energy[IN_CONTACTS] += energy
        rep.power[NEIGHBOUR_DAMPING] += damped
        rep.power[NEIGHBOUR_FRICTION] += friction_power(span, sl)


@part
def _slopes(i, j, two, ahead, d):
    """Slopes of both rollers' wrenches, each over its own motion."""
    data, sl, tan = fields(d.neighbours), fields(d.slices).row[0], fields(d.tangent)
    cone_slopes_of(two, data, sl, fields(d.pair).W, tan.Krr[i], tan.Crr[i])
    c, s = cos(ahead), sin(ahead)
    other = TwoRollers(
        (two.radii[1], two.radii[0]), rotated(c, -s, two.other_axis), rotated(c, -s, two.axis),
        rotated(c, -s, times(-1.0, two.place)), rotated(c, -s, times(-1.0, two.velocity)),
        rotated(c, -s, two.other_spin), rotated(c, -s, two.spin), two.onset,
    )  # fmt: skip
    cone_slopes_of(other, data, sl, fields(d.pair).W, tan.Krr[j], tan.Crr[j])
