"""Ribs and lands that follow their ring's modes (``modes``).

They move with the section of the ring as a whole, as its modes displace it; the section is taken as
rigid for that, as it nearly is at the frequencies of these modes. What presses on them acts on the
modes in return, and pushes elements and cage along the slope of the wall.
"""

from __future__ import annotations

from typing import Any

from flexcage.contacts.ring_waves import AXIALLY, COSINE, IN_TILT, PLACE, RADIALLY, RATE, SINE
from flexcage.contacts.state import AXIS, CENTRE, SPIN, VELOCITY
from flexcage.core.jit import outlined, part, zero
from flexcage.core.vectors import MOMENT

MOVED, SLOPE, MOVES = range(3)  # in ``RingModes.wall``: displacement, over the azimuth, in time


@part
def set_sections(a, v, modes):
    """Waves of the ring's section under modes a with rates v; nothing presses yet."""
    zero(modes.carried)
    zero(modes.borne)
    for m in range(a.shape[0]):
        crest = modes.carried[modes.harmonic[m], modes.quarter[m]]
        for c in range(modes.section.shape[1]):
            crest[PLACE, c] += modes.section[m, c] * a[m]
            crest[RATE, c] += modes.section[m, c] * v[m]


@outlined
def carry_ribs(i, at, modes):
    """Move a ring ``at`` beside roller i as its section is moved there by its modes."""
    carried, wall = modes.carried, modes.wall
    if carried.shape[0] == 0:
        return
    for c in range(wall.shape[1]):  # sums of the waves at the roller's azimuth
        moved = slope = moves = 0.0
        for n in range(carried.shape[0]):
            cos_n, sin_n = modes.wave[i, n, COSINE], modes.wave[i, n, SINE]
            even, odd = carried[n, COSINE], carried[n, SINE]
            moved += cos_n * even[PLACE, c] + sin_n * odd[PLACE, c]
            slope += n * (cos_n * odd[PLACE, c] - sin_n * even[PLACE, c])
            moves += cos_n * even[RATE, c] + sin_n * odd[RATE, c]
        wall[MOVED, c], wall[SLOPE, c] = moved, slope
        wall[MOVES, c] = moves + slope * modes.orbit[i]
    at[CENTRE, 0] -= wall[MOVED, AXIALLY]
    at[CENTRE, 1] -= wall[MOVED, RADIALLY]
    at[AXIS, 1] += wall[MOVED, IN_TILT]
    at[VELOCITY, 0] += wall[MOVES, AXIALLY]
    at[VELOCITY, 1] += wall[MOVES, RADIALLY]
    at[SPIN, 2] += wall[MOVES, IN_TILT]


@outlined
def bear_ribs(i, centre, wrench, modes, moment):
    """Let a ring's modes bear in return what its ribs do to roller i, which is at ``centre`` from
    it, by a ``wrench``; what the slope does about the axis is added to the ``moment`` (Z,).
    ``carry_ribs`` comes before."""
    borne, wall = modes.borne, modes.wall
    if modes.carried.shape[0] == 0:
        return
    # the reaction on the ring, with its moment about the ring's centre
    along, out = -wrench[0], -wrench[1]
    tilt = -(wrench[MOMENT + 2] + centre[0] * wrench[1] - centre[1] * wrench[0])
    for n in range(borne.shape[0]):
        for quarter in range(2):
            wave = modes.wave[i, n, quarter]
            borne[n, quarter, AXIALLY] += wave * along
            borne[n, quarter, RADIALLY] += wave * out
            borne[n, quarter, IN_TILT] += wave * tilt
    push = along * wall[SLOPE, AXIALLY] + out * wall[SLOPE, RADIALLY]
    moment[i] += push + tilt * wall[SLOPE, IN_TILT]


def lands_follow(model: Any) -> Any:
    """The model of a bearing whose cage's lands feel the modes of the ring that guides it: they
    share its waves."""
    ring = model.inner_modes if model.land.inner else model.outer_modes
    return model._replace(land=model.land._replace(crest=ring.carried, borne=ring.borne))
