"""The start of a run: balls of both rows where the static solution has them."""

from __future__ import annotations

from typing import Any

import numpy as np

from flexcage.bearings.ball.start import begun, placed
from flexcage.system.begun import Advance, Start, StaticStart
from flexcage.system.problem import BearingSystem


def double_row_start(
    bearing: BearingSystem, *, limit_force: float, statics: StaticStart | None, advance: Advance
) -> Start:
    """The static solution, which has to be given, with balls that roll; no force is limited. A ball
    that bears nothing lies on the outer race at the free contact angle of its row."""
    assert statics is not None, "balls start at their static solution"
    solution, spec = statics(), bearing.spec
    free = free_angles(spec)
    angle = np.where(np.isnan(solution.elements.angle[:, 1]), free, solution.elements.angle[:, 1])
    return begun(
        bearing, solution, placed(bearing, solution, angle, bearing.data.model.axial("outer"))
    )


def free_angles(spec: Any) -> np.ndarray:
    """Free contact angles (2Z,) [rad] of the balls of both rows, with their signs."""
    senses = [place.sense for place in spec.row_places]
    return np.repeat(senses, spec.element_count) * spec.row.free_contact_angle
