"""The start of a run: balls of both rows where the static solution has them."""

from __future__ import annotations

import numpy as np

from flexcage.bearings.ball.start import begun, placed
from flexcage.bearings.double_row_ball.model import DoubleRowModel
from flexcage.system.begun import Advance, Start, StaticStart
from flexcage.system.problem import BearingSystem
from flexcage.system.statics.solution import StaticSolution


def double_row_start(
    bearing: BearingSystem, *, limit_force: float, statics: StaticStart | None, advance: Advance
) -> Start:
    """The static solution, which has to be given, with balls that roll; no force is limited. A ball
    that bears nothing lies on the outer race where the inner one leaves it most room."""
    assert statics is not None, "balls start at their static solution"
    solution, model = statics(), bearing.data.model
    angle = solution.elements.angle[:, 1]
    angle = np.where(np.isnan(angle), between_centres(model, solution), angle)
    return begun(bearing, solution, placed(bearing, solution, angle, model.axial("outer")))


def between_centres(model: DoubleRowModel, solution: StaticSolution) -> np.ndarray:
    """Angles (2Z,) [rad] of the line from the centre of the outer groove to that of the inner one,
    by the azimuth of every ball."""
    psi, places = solution.elements.azimuth, []
    for ring, moved in (("outer", solution.outer), ("inner", solution.displacement)):
        along, up, aside, skew, tilt = moved
        turned = tilt * np.cos(psi) - skew * np.sin(psi)
        x, r = model.axial(ring), getattr(model, ring).centre
        places.append(
            (x + along - r * turned, r + up * np.cos(psi) + aside * np.sin(psi) + x * turned)
        )
    outer, inner = np.array(places)
    angle: np.ndarray = np.arctan2(*(inner - outer))
    return angle
