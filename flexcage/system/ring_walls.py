"""Ribs and lands that follow an outer ring that swings (``swinging``).

They move with the section of the ring as a whole, as its coordinates displace it; the section is
taken as rigid for that, as it nearly is at the frequencies of coordinates. What presses on them
acts on the coordinates in return, and pushes elements and cage along the slope of the wall.
"""

from __future__ import annotations

from typing import Any

from flexcage.contacts.ring_waves import AXIALLY, COSINE, IN_TILT, PLACE, RADIALLY, RATE, SINE
from flexcage.contacts.state import AXIS, CENTRE, SPIN, VELOCITY
from flexcage.core.jit import fields, part, zero
from flexcage.core.vectors import MOMENT
from flexcage.system.data import OUTER_RACE

MOVED, SLOPE, MOVES = range(3)  # in ``Swings.wall``: displacement, over the azimuth, in time


@part
def set_sections(a, v, swings):
    """Waves of the ring's section under coordinates a with rates v; nothing presses yet."""
    zero(swings.carried)
    zero(swings.borne)
    for m in range(a.shape[0]):
        crest = swings.carried[swings.harmonic[m], swings.quarter[m]]
        for c in range(swings.section.shape[1]):
            crest[PLACE, c] += swings.section[m, c] * a[m]
            crest[RATE, c] += swings.section[m, c] * v[m]


@part
def carry_ribs(i, orbit, at, d):
    """Move the outer ring ``at`` beside roller i, which orbits at a speed, as its section there."""
    swings = fields(d.swings)
    carried, wall = swings.carried, swings.wall
    if carried.shape[0] == 0:
        return
    for c in range(wall.shape[1]):
        moved = slope = moves = 0.0
        for n in range(carried.shape[0]):
            cos_n, sin_n = swings.wave[i, n, COSINE], swings.wave[i, n, SINE]
            even, odd = carried[n, COSINE], carried[n, SINE]
            moved += cos_n * even[PLACE, c] + sin_n * odd[PLACE, c]
            slope += n * (cos_n * odd[PLACE, c] - sin_n * even[PLACE, c])
            moves += cos_n * even[RATE, c] + sin_n * odd[RATE, c]
        wall[MOVED, c], wall[SLOPE, c], wall[MOVES, c] = moved, slope, moves + slope * orbit
    at[CENTRE, 0] -= wall[MOVED, AXIALLY]
    at[CENTRE, 1] -= wall[MOVED, RADIALLY]
    at[AXIS, 1] += wall[MOVED, IN_TILT]
    at[VELOCITY, 0] += wall[MOVES, AXIALLY]
    at[VELOCITY, 1] += wall[MOVES, RADIALLY]
    at[SPIN, 2] += wall[MOVES, IN_TILT]


@part
def bear_ribs(i, centre, d):
    """Let the ring bear in return what its ribs do to roller i, which is at ``centre`` from it; the
    pair's wrench is known, and ``carry_ribs`` came before."""
    swings, rings, wrench = fields(d.swings), fields(d.rings), fields(d.pair).wrench
    borne, wall = swings.borne, swings.wall
    if swings.carried.shape[0] == 0:
        return
    along, out = -wrench[0], -wrench[1]
    tilt = -(wrench[MOMENT + 2] + centre[0] * wrench[1] - centre[1] * wrench[0])
    for n in range(borne.shape[0]):
        for quarter in range(2):
            wave = swings.wave[i, n, quarter]
            borne[n, quarter, AXIALLY] += wave * along
            borne[n, quarter, RADIALLY] += wave * out
            borne[n, quarter, IN_TILT] += wave * tilt
    push = along * wall[SLOPE, AXIALLY] + out * wall[SLOPE, RADIALLY]
    rings.moment[OUTER_RACE, i] += push + tilt * wall[SLOPE, IN_TILT]


def lands_follow(model: Any) -> Any:
    """The model of a bearing whose cage's lands, if it rides on the outer ring, feel the ring
    swing: they share the waves of ``model.swings``."""
    if model.land.inner:
        return model
    swings = model.swings
    return model._replace(land=model.land._replace(crest=swings.carried, borne=swings.borne))
