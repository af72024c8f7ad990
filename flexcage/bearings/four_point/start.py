"""The start of a run: balls where the static solution has them, on one arc or more."""

from __future__ import annotations

import numpy as np

from flexcage.bearings.ball.start import begun, placed
from flexcage.bearings.four_point.bearing import FourPointContactBearing
from flexcage.bearings.four_point.inertia import HELD
from flexcage.system.begun import Advance, Start, StaticStart
from flexcage.system.problem import BearingSystem
from flexcage.system.statics.solution import StaticSolution


def four_point_start(
    bearing: BearingSystem, *, limit_force: float, statics: StaticStart | None, advance: Advance
) -> Start:
    """The static solution, which has to be given, with balls that roll; no force is limited.

    A ball on two arcs of a race begins to turn about an axis parallel to the bearing's, as fast as
    it rolls on the outer one; a ball that bears nothing rests on both outer arcs.
    """
    assert statics is not None, "balls start at their static solution"
    spec, solution = bearing.spec, statics()
    assert isinstance(spec, FourPointContactBearing)
    angle = np.where(
        np.isnan(solution.elements.angle[:, 1]), spec.shim_angles[1], solution.elements.angle[:, 1]
    )
    arcs = spec.arcs("outer")
    start = begun(
        bearing, solution, placed(bearing, solution, angle, np.where(angle < 0, arcs[-1], arcs[0]))
    )
    _turn_straight(bearing, solution, angle, start)
    return start


def _turn_straight(
    bearing: BearingSystem, solution: StaticSolution, angle: np.ndarray, start: Start
) -> None:
    """Turn the axes of balls that roll on both arcs of a race."""
    loads, u = solution.elements.arcs, bearing.layout.u(start.y)["elements"]
    assert loads is not None, "the static solution of a four-point contact bearing"
    for ring in ("inner", "outer"):
        two = [force for name, force in loads.items() if name.startswith(f"{ring} ")]
        if not two:
            continue
        straight = np.min(two, axis=0) > HELD * np.max(two, axis=0)
        spin = -u[:, 2] / (bearing.data.model.bodies.radius * np.cos(angle))
        u[straight, 3], u[straight, 4] = spin[straight], 0.0
    bearing.layout.q(start.yd)["elements"][:, 3:] = u[:, 3:]
