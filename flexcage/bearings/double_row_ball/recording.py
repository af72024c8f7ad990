"""What runs of double row ball bearings record beside what those of balls do."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from flexcage.bearings.ball.recording import RECORDING as BALLS
from flexcage.bearings.ball.recording import gaps_to_next, overlaps
from flexcage.bearings.double_row_ball.model import DoubleRowModel
from flexcage.bearings.two_rows import row_labels
from flexcage.integrate.recording import Recording
from flexcage.system.layout import Layout

_BALLS: Recording[Any] = BALLS


def _coords(model: DoubleRowModel) -> dict[str, Any]:
    return {**_BALLS.coords(model), **row_labels(model.rows.each)}


def _overlaps(model: DoubleRowModel, layout: Layout, y: np.ndarray) -> np.ndarray:
    """As those of balls; the next ball is that of the same row."""
    found, count = overlaps(model.balls(), layout, y), model.rows.each
    behind = 2 + int(layout.has_cage)
    for row in (slice(None, count), slice(count, None)):
        balls = layout.q(y)["elements"][:, row]
        found[:, row, behind] = gaps_to_next(balls, model.bodies.radius[row])
    return found


RECORDING: Recording[Any] = replace(_BALLS, coords=_coords, overlaps=_overlaps)
