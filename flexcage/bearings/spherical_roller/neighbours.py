"""Barrels of a full complement against the next ones of their row, as tapered rollers."""

from __future__ import annotations

from flexcage.bearings.tapered_roller.neighbours import touch
from flexcage.core.jit import fields


def touch_in_rows(t, y, yd, d, law, out, mode):
    """Forces of barrels on their neighbours, as ``tapered_roller.neighbours.touch_next``: the last
    one of a row is next to its first one."""
    at, each = fields(d.places), fields(d.rows).each
    for i in range(at.elements):
        j = i + 1 if (i + 1) % each != 0 else i + 1 - each
        touch(i, j, y[: at.bodies_q], d, law, mode)
