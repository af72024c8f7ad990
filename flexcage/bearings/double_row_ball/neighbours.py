"""Every ball and the next one of its row."""

from __future__ import annotations

from flexcage.bearings.ball.neighbours import add_slopes, ahead_of, next_ball, press
from flexcage.contacts.evaluation import REPORT, TANGENT
from flexcage.core.jit import fields


def touch_in_rows(t, y, yd, d, law, out, mode):
    """Forces of balls on their neighbours, as ``ball.neighbours.touch_neighbours``: the last ball
    of a row is next to its first one."""
    at, cutoff, count = fields(d.places), fields(d.neighbours).cutoff, fields(d.rows).each
    q, u = y[: at.bodies_q], y[at.u : at.bodies_u]
    for i in range(at.elements):
        j = i + 1 if (i + 1) % count != 0 else i + 1 - count
        ahead = ahead_of(i, j, q)
        if ahead < cutoff:
            if mode == TANGENT:
                add_slopes(i, j, ahead, q, u, d, law)
            else:
                press(i, j, ahead, q, u, d, law, mode)
        elif mode >= REPORT:
            fields(d.report).approach[i, next_ball(fields(d.report))] = 0.0
