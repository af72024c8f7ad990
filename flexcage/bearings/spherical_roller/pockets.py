"""Pockets of a spherical roller bearing: every barrel's contacts with the cage.

Each row's pockets are planes in axes of their own, as those of tapered rollers, with s away from
the bearing's middle: at -x along minus a barrel's axis.
"""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.pockets import modes_of_cage
from flexcage.bearings.tapered_roller.pockets import in_pocket
from flexcage.contacts.state import take_pose
from flexcage.core.jit import array_from, fields, outlined, part
from flexcage.core.vectors import put, row, times
from flexcage.system.layout import of_element


def barrel_pockets(t, y, yd, d, law, out, mode):
    """Add the pockets' wrenches to ``Scratch.wrenches`` and ``border``, as
    ``cylindrical_roller.pockets.roller_pockets``."""
    at, pose = fields(d.places), fields(d.pose)
    q, cage = y[: at.bodies_q], (array_from(y, at.cage_q), array_from(y, at.cage_u))
    modes = modes_of_cage(0, y, d)
    for i in range(at.elements):
        take_pose(fields(d.scratch).poses[i], pose)
        if i < fields(d.rows).each:
            _turn_round(pose)
            _in_pocket(i, q[of_element(i)], cage, modes, fields(d.frames), d, law, mode)
        else:
            _in_pocket(i, q[of_element(i)], cage, modes, fields(d.frames_other), d, law, mode)


@part
def _turn_round(pose):
    """A barrel with its axis the other way, turned by 180 degrees about its second one."""
    put(pose.axis[0], times(-1.0, row(pose.axis, 0)))
    put(pose.axis[2], times(-1.0, row(pose.axis, 2)))


@outlined
def _in_pocket(i, qi, cage, modes, frames, d, law, mode):
    """Barrel i in its pocket, compiled once."""
    in_pocket(i, qi, (cage[0], cage[1], modes), frames, d, law, mode)
