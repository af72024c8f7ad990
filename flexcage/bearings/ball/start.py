"""The start of a ball bearing's run: its static solution, with the balls rolling.

The quasi-static solution places ring and balls, centrifugal forces included. Every ball orbits as
that has it and turns so that it rolls on both races, as far as contact angles allow; what spin
and gyroscopic moment do to it is left to the run. The cage is centred on the balls, or as far off
as its land's ring leaves it room, and the balls go with it; its modes are where rotation holds
them.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from flexcage.bearings.ball.bearing import BallBearing
from flexcage.bearings.ball.model import BallModel
from flexcage.bearings.ball.spot import BallSpot
from flexcage.system.begun import Advance, Start, StaticStart
from flexcage.system.layout import Layout
from flexcage.system.problem import BearingSystem
from flexcage.system.rings.moving import SIDES
from flexcage.system.start import (
    clear_of_land,
    place_cages,
    strained_by_rotation,
    turn_cages,
)
from flexcage.system.statics.solution import StaticSolution

_ALIKE = 1e-3  # rad: contact angles closer than this leave a ball's axis to their mean


def ball_start(
    bearing: BearingSystem, *, limit_force: float, statics: StaticStart | None, advance: Advance
) -> Start:
    """The static solution, which has to be given, with balls that roll; no force is limited."""
    assert statics is not None, "balls start at their static solution"
    solution = statics()
    return begun(bearing, solution, ball_places(bearing, solution))


def begun(bearing: BearingSystem, solution: StaticSolution, y: np.ndarray) -> Start:
    """The start with rings and balls where y has them: balls roll, the cage is strained."""
    model = bearing.data.model
    clear_of_land(model.land, bearing.layout, y)
    yd = rolling_balls(model, bearing.layout, solution, y)
    assert isinstance(bearing.spec, BallBearing)
    turn_spots(bearing.spec.ball_spot, bearing.layout, y, yd)
    if bearing.layout.modes:
        spins, modes = bearing.layout.u(y)["omega"], bearing.layout.q(y)["modes"]
        for spin, own in zip(np.atleast_2d(spins), np.atleast_2d(modes), strict=True):
            own[:] = strained_by_rotation(model.cage, float(spin[0]))
    station = np.zeros_like(bearing.data.work.report.station)
    return Start(y, yd, (), 0.0, solution.unbalanced, station, solution.warnings)


def ball_start_between_bent_rings(
    bearing: BearingSystem, *, limit_force: float, statics: StaticStart | None, advance: Advance
) -> Start:
    """The same between rings that bend, with balls on the outer race where that yields to."""
    assert bearing.rings is not None, "rings bend as in a static solution"
    start = ball_start(bearing, limit_force=limit_force, statics=statics, advance=advance)
    y, layout = bearing.rings.begun(start.y, bearing.layout), bearing.layout
    for ring in bearing.rings.start.rings:
        layout.ring_forces(y)[SIDES.index(ring.side)] = ring.force
        if ring.side == "outer":
            layout.q(y)["elements"][:, :2] += ring.deflection[:, :2]
    return replace(start, y=y)


def ball_places(bearing: BearingSystem, solution: StaticSolution) -> np.ndarray:
    """y with rings and balls where the static solution has them, the cage centred on the balls.

    A ball that bears nothing lies on the outer race at the angle of the others, or at none.
    """
    angle = np.nan_to_num(solution.elements.angle[:, 1])
    return placed(bearing, solution, angle, bearing.data.model.outer.axial)


def placed(
    bearing: BearingSystem, solution: StaticSolution, angle: np.ndarray, axial: Any
) -> np.ndarray:
    """The same with balls on the outer race at angles (Z,), in grooves whose centres' axial places
    are ``axial``, one or (Z,)."""
    model, layout, balls = bearing.data.model, bearing.layout, solution.elements
    y = np.zeros(layout.size)
    q = layout.q(y)
    depth = (balls.force[:, 1] / model.outer.normal[0]) ** (2.0 / 3.0)
    reach = model.outer.radius - model.bodies.radius + depth
    q["elements"][:, 0] = axial + reach * np.sin(angle)
    q["elements"][:, 1] = model.outer.centre + reach * np.cos(angle)
    q["elements"][:, 2] = balls.azimuth
    q["inner"][:5], q["outer"][:5] = solution.displacement, solution.outer
    x, r, psi = (q["elements"][:, k].copy() for k in range(3))
    along, up, aside, skew, tilt = solution.outer  # balls go with the race
    turned = tilt * np.cos(psi) - skew * np.sin(psi)
    q["elements"][:, 0] += along - r * turned
    q["elements"][:, 1] += up * np.cos(psi) + aside * np.sin(psi) + x * turned
    rows = np.split(q["elements"][:, 0], max(layout.cages, 1))
    along = np.array([row.mean() for row in rows])
    place_cages(layout, y, along if layout.cages > 1 else along[0], balls.azimuth)
    return y


def rolling_balls(
    model: BallModel, layout: Layout, solution: StaticSolution, y: np.ndarray
) -> np.ndarray:
    """Set velocities in y: balls that orbit and roll; returns y' (accelerations zero)."""
    yd = np.zeros_like(y)
    q, u, qd = layout.q(y), layout.u(y), layout.q(yd)
    speed = float(np.interp(0.0, *model.bodies.speed))
    orbit = np.nan_to_num(solution.elements.orbital_speed)
    bears = np.asarray((solution.elements.force > 0.0).all(axis=1))
    cages = _speeds_of_cages(orbit, bears, max(layout.cages, 1))
    orbit = np.where(bears, orbit, np.repeat(cages, layout.elements // len(cages)))
    r, rb = q["elements"][:, 1], model.bodies.radius
    u["elements"][:, 2] = r * orbit
    inner, outer = np.nan_to_num(solution.elements.angle).T
    for i in range(layout.elements):
        u["elements"][i, 3:5] = _rolling(
            float(inner[i]), float(outer[i]), float(r[i]), float(rb[i]), float(orbit[i]), speed
        )
    qd["elements"][:, 2] = orbit
    qd["elements"][:, 3:] = u["elements"][:, 3:]
    u["inner"][3] = qd["inner"][5] = speed
    turn_cages(layout, y, yd, cages if layout.cages > 1 else cages[0], solution.elements.azimuth)
    return yd


def _speeds_of_cages(orbit: np.ndarray, bears: np.ndarray, count: int) -> np.ndarray:
    """Mean orbital speeds (count,) of the balls of each cage that bear load, or of all where none
    does."""
    rows = zip(np.split(orbit, count), np.split(bears, count), strict=True)
    return np.array([row[loaded if loaded.any() else ...].mean() for row, loaded in rows])


def turn_spots(spot: BallSpot, layout: Layout, y: np.ndarray, yd: np.ndarray) -> None:
    """Set in y and y' the directions of the spots of balls, if there are any."""
    for ball in spot.balls:
        layout.q(y)["elements"][ball, 3:] = direction = spot.direction()
        turning = layout.u(y)["elements"][ball, 3:].copy()
        turning[0] -= layout.q(yd)["elements"][ball, 2]
        layout.q(yd)["elements"][ball, 3:] = np.cross(turning, direction)


def _rolling(
    inner: float, outer: float, r: float, rb: float, orbit: float, speed: float
) -> tuple[float, float]:
    """Angular velocity (x, r) [rad/s] of a ball whose centre at r orbits, rolling on both races.

    On the outer race its surface stands still, on the inner it has the ring's speed. Where both
    contacts face each other two speeds cannot be met: they are met on the mean.
    """
    rows = np.array([[np.cos(outer), -np.sin(outer)], [np.cos(inner), -np.sin(inner)]])
    wanted = np.array([-r * orbit, r * orbit - speed * (r - rb * np.cos(inner))]) / rb
    if abs(inner - outer) < _ALIKE:
        axis = np.array([np.cos(0.5 * (inner + outer)), -np.sin(0.5 * (inner + outer))])
        return tuple(wanted.mean() * axis)  # type: ignore[return-value]
    return tuple(np.linalg.solve(rows, wanted))  # type: ignore[return-value]
