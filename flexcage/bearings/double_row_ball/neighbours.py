"""Every ball and the next one of its row; and, where rows are near each other, those of the other
row."""

from __future__ import annotations

from math import floor, pi

from flexcage.bearings.ball.neighbours import add_slopes, ahead_of, next_ball, press
from flexcage.contacts.evaluation import REPORT, TANGENT
from flexcage.core.jit import fields, part
from flexcage.system.layout import of_element


def touch_in_rows(t, y, yd, d, law, out, mode):
    """Forces of balls on their neighbours, as ``ball.neighbours.touch_neighbours``: the last ball
    of a row is next to its first one."""
    at, cutoff, rows = fields(d.places), fields(d.neighbours).cutoff, fields(d.rows)
    q, u, each = y[: at.bodies_q], y[at.u : at.bodies_u], rows.each
    for i in range(at.elements):
        j = i + 1 if (i + 1) % each != 0 else i + 1 - each
        ahead = ahead_of(i, j, q)
        if ahead < cutoff:
            _touch(i, j, ahead, q, u, d, law, mode)
        elif mode >= REPORT:
            fields(d.report).approach[i, next_ball(fields(d.report))] = 0.0
        if rows.meet != 0 and i < each:
            for k in range(each, at.elements):
                ahead = q[of_element(k)][2] - q[of_element(i)][2]
                ahead -= 2.0 * pi * floor(ahead / (2.0 * pi) + 0.5)
                if abs(ahead) < cutoff:
                    _touch(i, k, ahead, q, u, d, law, mode)


@part
def _touch(i, j, ahead, q, u, d, law, mode):
    """Balls i and j, which are near each other."""
    if mode == TANGENT:
        add_slopes(i, j, ahead, q, u, d, law)
    else:
        press(i, j, ahead, q, u, d, law, mode)
