"""Tapered rollers of a full complement against the next ones: forces, report and tangent.

They take the place of the pockets, as ``cylindrical_roller.neighbours`` has it.
"""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.neighbours import (
    NEXT_ROLLER,
    give_to_next,
    pair_of,
    report_touch,
    seen_from_next,
)
from flexcage.contacts.cone_cone import (
    add_to_both_cones,
    cone_approach,
    cone_cone_forces,
    cone_slopes_of,
)
from flexcage.contacts.evaluation import RACE_LAW, RACE_RUBS, REPORT, TANGENT
from flexcage.contacts.slices import Laws
from flexcage.core.jit import fields, outlined, part, zero


def touch_next(t, y, yd, d, law, out, mode):
    """Forces of rollers on their neighbours into ``Scratch.wrenches``; in mode TANGENT their
    slopes, each over the own roller's motion. Arguments are those of ``residual.evaluate``."""
    at = fields(d.places)
    for i in range(at.elements):
        j = i + 1 if i + 1 < at.elements else 0
        touch(i, j, y[: at.bodies_q], d, law, mode)


@outlined
def touch(i, j, q, d, law, mode):
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
    back = work.T6[0, 0]
    zero(back)
    force = add_to_both_cones(two, data, sl, work.wrenches[i], back)
    give_to_next(back, ahead, work.wrenches[j])
    if mode == TANGENT:
        _slopes(i, j, two, ahead, d)
    elif mode >= REPORT:
        report_touch(i, force, data, sl, rep)


@part
def _slopes(i, j, two, ahead, d):
    """Slopes of both rollers' wrenches, each over its own motion."""
    data, sl, tan = fields(d.neighbours), fields(d.slices).row[0], fields(d.tangent)
    cone_slopes_of(two, data, sl, fields(d.pair).W, tan.Krr[i], tan.Crr[i])
    other = seen_from_next(two, ahead)
    cone_slopes_of(other, data, sl, fields(d.pair).W, tan.Krr[j], tan.Crr[j])
