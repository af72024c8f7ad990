"""Pockets of a tapered roller bearing: every roller's contacts with the cage."""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.pockets import (
    modes_of_cage,
    report_pocket,
    scatter_pocket,
)
from flexcage.contacts.cone_pocket import (
    cone_pocket_contact,
    set_face,
    set_pocket_axes,
    stations_in_pocket_axes,
)
from flexcage.contacts.evaluation import (
    POCKET_LAW,
    POCKET_RUBS,
    REPORT,
    SIDE_LAW,
    SIDE_RUBS,
    TANGENT,
)
from flexcage.contacts.pocket_wall import FACES, SIDES, CageAtRoller, PocketLaws, RollerInPocket
from flexcage.contacts.state import take_pose
from flexcage.core.jit import array_from, fields, part
from flexcage.core.vectors import RIGID, cross, dot, minus, plus, put, row, turned, xyz
from flexcage.system.data import CAGE_SPIN, LEVER, PARTNER_V, PARTNER_W, POCKET
from flexcage.system.equations import push_pair
from flexcage.system.floating import modes_at, push_modes
from flexcage.system.layout import of_element


def cone_pockets(t, y, yd, d, law, out, mode):
    """Add the pockets' wrenches to ``Scratch.wrenches`` and ``border``, as
    ``cylindrical_roller.pockets.roller_pockets``."""
    at, work = fields(d.places), fields(d.scratch)
    q, modes = y[: at.bodies_q], modes_of_cage(0, y, d)
    Rc, Vc = array_from(y, at.cage_q), array_from(y, at.cage_u)
    for i in range(at.elements):
        take_pose(work.poses[i], fields(d.pose))
        cage = Rc, Vc, modes
        in_pocket(i, q[of_element(i)], cage, fields(d.frames), d, law, mode)


@part
def in_pocket(i, qi, cage, frames, d, law, mode):
    """Roller i, whose pose is taken, in its pocket, whose faces are as ``frames`` have it; the
    ``cage`` is at Rc, moves as Vc and has modes."""
    Rc, Vc, modes = cage
    pose, pair, pw, work = fields(d.pose), fields(d.pair), fields(d.pocket_work), fields(d.scratch)
    data, memory = fields(d.pocket), fields(d.memory)
    F, A, vec, sums, at = pose.F, work.A, work.vec, work.sums, fields(d.places)
    D, Vr, wr = vec[LEVER], vec[PARTNER_V], vec[PARTNER_W]
    put(D, plus((0.0, qi[1], 0.0), turned(F, (qi[0] - Rc[0], -Rc[1], -Rc[2]))))
    set_pocket_axes(data.azimuth[i], A, F, pw)
    put(Vr, turned(F, xyz(Vc)))
    put(wr, turned(F, xyz(vec[CAGE_SPIN])))
    roller = RollerInPocket(pose, frames.whole, D, memory.pocket[i], memory.deflection[i])
    there = CageAtRoller(Vr, wr, modes)
    laws = PocketLaws(law[POCKET_LAW], law[SIDE_LAW], law[POCKET_RUBS], law[SIDE_RUBS])
    sl = fields(d.slices).row[0]
    hit = cone_pocket_contact(i, roller, there, (data, frames), laws, sl, pw, pair, mode, sums)
    if hit:
        push_pair(i, pair.wrench, A, xyz(D), at.cage_b, d)
        push_modes(data, i, pw, work.border[modes_at(at.cage_b + RIGID, at.modes)])
    if mode == TANGENT:
        scatter_pocket(i, hit, modes, d)
    elif mode >= REPORT:
        report_pocket(i, hit, sums, pw, fields(d.report), mode)
        if hit:
            stations_in_pocket_axes(frames, pw.st, fields(d.report).station[i])
        _approach(i, frames, d)


@part
def _approach(i, frames, d):
    """Approach speed of roller i at each wall of its pocket, at its centre."""
    vec, pw, rep = fields(d.scratch).vec, fields(d.pocket_work), fields(d.report)
    cage = plus(xyz(vec[PARTNER_V]), cross(xyz(vec[PARTNER_W]), xyz(vec[LEVER])))
    v = minus(xyz(fields(d.pose).V), cage)
    for f in range(FACES):
        set_face(frames, f, pw)
        sgn = 1.0 if f % 2 == 0 else -1.0
        rep.approach[i, POCKET + f] = sgn * dot(row(pw.G, 2 if f < SIDES else 0), v)
